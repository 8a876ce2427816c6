#!/bin/sh
# Fig. 9: contact areas of the crossed blocks of the experiment, computed: converged, and by the paper's nine harmonics.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig09 'Fig. 9, the contact areas of the experiment as computed' "$@"
run_decks fig09 fig09_converged
draw_figure 600 285 "edge_level = $(header_value fig09 contour edge_level)" \
   "side = $(header_value fig09 contour cell_x)" <<'EOF'
pools = table('fig09_converged', 'contour')
isobars = table('fig09', 'contour')
summary = table('fig09', 'summary')
dark = '#303338'
light = '#f1ead8'
stats pools using "load" nooutput
loads = STATS_blocks

set size ratio -1
set xrange [-side:side]
set yrange [-side:side]
set xtics side/2 nomirror out font ',12'
set ytics side/2 nomirror out font ',12'
set xlabel '{/:Italic x} [mm]'
set border lw 0.7 front
set style fill solid noborder
unset key

set object 1 rectangle at screen 0.18, 0.045 size screen 0.024, screen 0.04 fc rgb light fs solid border lc rgb black
set object 2 rectangle at screen 0.31, 0.045 size screen 0.024, screen 0.04 fc rgb dark fs solid border lc rgb black
set arrow 1 from screen 0.53, 0.045 to screen 0.56, 0.045 nohead lc rgb red lw 1.2
set label 1 'contact' at screen 0.202, 0.045 left font ',12'
set label 2 'gap, converged' at screen 0.332, 0.045 left font ',12'
set label 3 sprintf('%s = %g %s, nine harmonics', p, edge_level, p_star) at screen 0.572, 0.045 left font ',12'

# Two waves on either block, as in the experiment: the cell of the tables, drawn four times.
set multiplot layout 1, loads margins 0.115, 0.98, 0.285, 0.83 spacing 0.05, 0
do for [i = 0:loads - 1] {
   stats summary using (column("load") == i + 1 ? column("mean_pressure") : NaN) nooutput
   mean_pressure = STATS_max
   stats summary using (column("load") == i + 1 ? column("pbar_over_pstar") : NaN) nooutput
   set title sprintf('%s = %.4f N/mm²', p_bar, mean_pressure)."\n".sprintf('%s = %.2f', load, STATS_max)
   if (i == 0) { set ylabel '{/:Italic y} [mm]' } else { unset ylabel; set format y '' }
   set object 3 rectangle from graph 0, 0 to graph 1, 1 fc rgb light fs solid noborder behind
   plot for [k = -2:2] for [l = -2:2] pools index i using (k*side + column("x")):(l*side + column("y")) \
           with filledcurves closed lc rgb dark, \
        for [k = -2:2] for [l = -2:2] isobars index i using (k*side + column("x")):(l*side + column("y")) \
           with lines lc rgb red lw 1.2
   unset label
   unset arrow
   unset object 1
   unset object 2
}
unset multiplot
EOF
