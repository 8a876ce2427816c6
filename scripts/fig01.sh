#!/bin/sh
# Fig. 1: profiles of a flat and a one-dimensional wave, unloaded, in complete and in partial contact.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig01 'Fig. 1, the profiles of a flat and a one-dimensional wave' "$@"
run_decks fig01
draw_figure 480 480 "side = $(header_value fig01 theory_lines cell_x)" <<'EOF'
# The gap of eq. (5) over the wavelengths shown, from that over half a wavelength.
lines = table('fig01', 'theory_lines')
bottom = -2.45
top = 0.75
gap = "westergaard_gap_over_amplitude"
unfold(profile) = sprintf('set table $pieces; plot for [k = -2:2] for [way = -1:1:2] lines index %d ', profile) \
   .'using (k + way*column("x")/side):(-column(gap)) with lines; unset table'
joined(curve) = 'set table '.curve.'; plot $pieces using 1:2 smooth unique with lines; unset table'
set xrange [-1.25:1.25]
set yrange [bottom:top]
do for [profile = 0:2] {
   eval unfold(profile)
   eval joined(word('$unloaded $complete $partial', profile + 1))
}
stats table('fig01', 'theory') \
   using (column("load") == 3 ? column("westergaard_contact_area_fraction") : NaN) nooutput
contact = STATS_max   # 2a/lambda of the partial contact

unset tics
unset border
unset key
set style fill solid noborder
set style arrow 1 heads size screen 0.012, 18 filled lc rgb black lw 0.7 front
set style arrow 2 nohead lc rgb black lw 0.5 front
set object 1 rectangle from graph 0, first 0 to graph 1, first top fc rgb '#f2f2f2' fs solid noborder behind
surfaces = 'using 1:2 with filledcurves y1=bottom lc rgb body, 0 with lines ls 1,'

set multiplot layout 3, 1 margins screen 0.17, 0.99, 0.01, 0.99 spacing 0, 0.03

set label '(a)' at graph -0.19, first -0.6
set label p_bar.' = 0' at graph -0.19, first -1.3
set arrow from 0, 0 to 0, 0.5 arrowstyle 2
set arrow from 1, 0 to 1, 0.5 arrowstyle 2
set arrow from 0, 0.32 to 1, 0.32 arrowstyle 1
set label lambda at 0.5, 0.5 center front
set arrow from -0.5, 0 to -0.5, -1 arrowstyle 1
set arrow from -0.5, -1 to -0.5, -2 arrowstyle 1
set label Delta at -0.47, -0.5 left front
set label Delta at -0.47, -1.5 left front
plot $unloaded @surfaces -1 with lines ls 4, $unloaded using 1:2 with lines ls 1
unset label
unset arrow

set label '(b)' at graph -0.19, first -0.6
set label p_bar.' = '.p_star at graph -0.19, first -1.3
plot $complete @surfaces $complete using 1:2 with lines ls 1
unset label

set label '(c)' at graph -0.19, first -0.6
set label p_bar.' < '.p_star at graph -0.19, first -1.3
do for [k = -1:1] {
   set arrow from k - contact/2, 0 to k - contact/2, 0.5 arrowstyle 2
   set arrow from k + contact/2, 0 to k + contact/2, 0.5 arrowstyle 2
   set arrow from k - contact/2, 0.32 to k + contact/2, 0.32 arrowstyle 1
   set label '2{/:Italic a}' at k, 0.52 center front
}
plot $partial @surfaces $partial using 1:2 with lines ls 1
unset multiplot
EOF
