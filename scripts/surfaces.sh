#!/bin/sh
# Surfaces beyond the paper's: pressures and edges of contact at a fifth of the closing pressure.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure surfaces "contact pressures of four surfaces beyond the paper's" "$@"
run_decks surface_rectangular surface_hexagonal surface_sum surface_rough
for case in surface_rectangular surface_hexagonal surface_sum surface_rough; do
   facts="${facts-} $(header_value $case map cell_x) $(header_value $case map cell_y)"
   facts="$facts $(header_value $case map 'p*')"
done
draw_figure 700 205 "facts = '$facts'" <<'END'
cases = 'surface_rectangular surface_hexagonal surface_sum surface_rough'
names = '"wavelengths 1 and 2" "hexagonal" "sum of three waves" "rough, from a file"'

unset key
set size ratio -1
eval of_contact
set cbrange [0:2]
set border lw 0.7 front
set tics out nomirror font ',12'
set xlabel '{/:Italic x}' offset 0, 0.3
set ylabel '{/:Italic y}' offset 0.8, 0
set multiplot layout 1, 4 margins 0.065, 0.88, 0.26, 0.87 spacing 0.045, 0
do for [i = 1:words(cases)] {
   map = table(word(cases, i), 'map')
   edges = table(word(cases, i), 'contour')
   wide = real(word(facts, 3*i - 2))
   tall = real(word(facts, 3*i - 1))
   p_star_here = real(word(facts, 3*i))
   side = wide > tall ? wide : tall
   set xrange [0:side]
   set yrange [0:side]
   set xtics side/2
   set ytics side/2
   if (i > 1) { unset ylabel }
   if (i == words(cases)) {
      set colorbox user origin 0.895, 0.28 size 0.013, 0.57
      set cbtics 0.5 font ',11' offset -0.6, 0
      set cblabel '{/:Italic p}/{/:Italic p}*' offset -0.8, 0
   } else {
      unset colorbox
   }
   set title word(names, i) font ',12' offset 0, -0.4
   # The cell of the tables, drawn as often as the window holds it.
   plot for [k = 0:2] for [l = 0:2] map \
           using (k*wide + column("x")):(l*tall + column("y")): \
           (column("pressure") > 0 ? column("pressure")/p_star_here : NaN) with image, \
        for [k = -2:2] for [l = -2:2] edges \
           using (k*wide + column("x")):(l*tall + column("y")) with lines lc rgb outline lw 0.7
}
unset multiplot
END
