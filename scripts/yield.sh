#!/bin/sh
# Stresses below the crest of the two-dimensional wave, and its largest von Mises stress against the load.
#
# Asymptotes: on the axis of a Hertzian contact, K. L. Johnson, Contact Mechanics (1985), eqs (3.45); full contact by
# src/core/stress/README.md.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure yield 'von Mises stresses below the two-dimensional wave' "$@"
run_decks yield
# Two ratios nu a run, as those of two bodies. To 1e-5: with the deck's 1e-4 the stress at the edge of contact is hardly
# known at 0.18 p*, next to the load at which spots merge.
for lateral in constrained hydrostatic; do
   for nu in 0,0.15 0.3,0.5; do
      "$wavycon" --quiet inputs/yield_loads.nml --set method.accuracy=1e-5 --set stress.lateral=$lateral \
         --set stress.nu=$nu --set scene.case="yield_$lateral-${nu%,*}"
   done
done
draw_figure 640 480 "p_star_here = $(header_value yield summary 'p*')" \
   "side = $(header_value yield summary cell_x)" <<'END'
loads = '0.02 0.15 0.4 0.9'
ratios = '0 0.15 0.3 0.5'
section = table('yield', 'stress_section')
lines = table('yield', 'lines')
largest = table('yield', 'stress_largest')
stress = '{/:Italic σ}_{vM}/'.p_star
isolines(i) = sprintf('outputs/yield/isolines%d', i)

set datafile columnheaders
set contour base
unset surface
set cntrparam levels incremental 0.1, 0.1, 1.3
do for [i = 1:words(loads)] {
   set table isolines(i)
   splot section index i - 1 using (column('distance')/side):(column('depth')/side):(column('von_mises')/p_star_here)
   unset table
}
unset contour
set surface

# Above: sections through the crest in the middle, with isolines, the contact, and the place of the largest stress.
unset key
eval of_size
set cbrange [0:1.2]
set multiplot
set border 15 lw 0.7
set tics out nomirror
set xrange [-0.5:0.5]
set yrange [0.5:0]
do for [i = 1:words(loads)] {
   eval margins(0.2*i - 0.1, 0.2*i + 0.082, 0.74, 0.935)
   set xtics ('−0.4' -0.4, '0' 0, '0.4' 0.4)
   set xlabel '{/:Italic x}/'.lambda offset 0, 0.3
   set title load.' = '.word(loads, i) offset 0, -0.3 font ',12'
   set ytics 0.25 format (i == 1 ? '%g' : '')
   if (i == 1) { set ylabel '{/:Italic z}/'.lambda }
   if (i == words(loads)) {
      set colorbox user origin 0.893, 0.74 size 0.012, 0.195
      set cbtics 0.4 font ',11' offset -0.6, 0
      set cblabel stress offset -0.8, 0
   } else {
      unset colorbox
   }
   set datafile columnheaders
   plot for [way in '-1 1'] section index i - 1 \
           using (way*column('distance')/side):(column('depth')/side):(column('von_mises')/p_star_here) with image, \
        for [way in '-1 1'] lines index i - 1 every :::0::0 \
           using (way*column('distance')/side):(column('pressure') > 0 ? 0 : NaN) with lines lc rgb red lw 4, \
        largest using (column('load') == i ? 0 : NaN):(column('von_mises_depth')/side) \
           with points pt 2 ps mark lw 1.5 lc rgb red
   # These files have no names of columns.
   unset datafile columnheaders
   unset title
   unset xlabel
   unset ylabel
   set xtics ('' -0.4, '' 0, '' 0.4)
   set format y ''
   unset colorbox
   plot for [way in '-1 1'] isolines(i) using (way*$1):2 with lines lc rgb outline lw 0.5
}
set datafile columnheaders

# Below: the largest stress. Von Mises stress over the peak pressure at the depth t, over the radius, on the axis of a
# Hertzian contact, and its largest value.
hertz(nu, t) = 3/(2*(1 + t**2)) - (1 + nu)*(1 - t*atan(1/t))
array most_of_hertz[words(ratios)]
do for [k = 1:words(ratios)] {
   most_of_hertz[k] = 0.0
   do for [n = 300:700] {
      found = hertz(real(word(ratios, k)), n/1000.0)
      if (found > most_of_hertz[k]) { most_of_hertz[k] = found }
   }
}
# In full contact: below the crest, and on the surface between crests and troughs. `mean` is the part of the mean
# pressure: none if it is hydrostatic.
below(nu, mean) = 1.5*exp(-2*(1 + nu)/3) + mean
between(nu, mean) = sqrt(mean**2 + 0.75*(1 - 2*nu)**2)
full(nu, mean) = below(nu, mean) > between(nu, mean) ? below(nu, mean) : between(nu, mean)
part(lateral, nu, P) = lateral eq 'constrained' ? (1 - 2*nu)/(1 - nu)*P : 0
run(lateral, nu) = 'yield_'.lateral.'-'.(nu < 0.2 ? '0' : '0.3')

set border 3 lw 0.7
set tics nomirror out
set xrange [0:1]
set xtics 0.2 format '%.1f'
set mxtics 2
set xlabel load
do for [i = 1:2] {
   lateral = word('constrained hydrostatic', i)
   eval margins(0.475*i - 0.375, 0.475*i + 0.025, 0.145, 0.555)
   most = i == 1 ? 2.0 : 1.0
   set yrange [0:most]
   set ytics most/4 format '%g'
   if (i == 1) { set ylabel 'largest '.stress offset 0.8, 0 } else { unset ylabel }
   set title "lateral stress '".lateral."'" offset 0, -0.4 font ',13'
   if (i == 1) { set key top left samplen 2.5 font ',11' } else { set key bottom right samplen 2.5 font ',11' }
   plot for [k = 1:i == 1 ? words(ratios) : 0] NaN with lines ls 30 + k dt solid \
           title '{/:Italic ν} = '.word(ratios, k), \
        for [k = 1:i == 2] NaN with lines ls 2 title 'Hertz, light loads', \
        for [k = 1:i == 2] NaN with lines ls 4 title 'full contact', \
        for [k = 1:words(ratios)] table(run(lateral, real(word(ratios, k))), 'stress_largest') every 2::1 - k%2 \
           using 'pbar_over_pstar':'largest_von_mises_over_pstar' with lines ls 30 + k dt solid, \
        for [k = 1:words(ratios)] table('yield_constrained-0', 'theory') \
           using (column('pbar_over_pstar') < 0.11 ? column('pbar_over_pstar') : NaN): \
           (most_of_hertz[k]*column('hertz_peak_pressure_over_pstar')) with lines ls 30 + k dt (7, 4), \
        for [k = 1:words(ratios)] [0.4:1] '+' \
           using 1:(full(real(word(ratios, k)), part(lateral, real(word(ratios, k)), $1))) with lines ls 30 + k dt (1.5, 3.5)
}
unset multiplot
END
