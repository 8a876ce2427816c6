#!/bin/sh
# Fig. 9: contact areas of the crossed blocks of the experiment, computed.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig09 'Fig. 9, the contact areas of the experiment as computed,' "$@"
run_decks fig09
draw_figure 600 300 "edge_level = $(header_value fig09 map 'edge_level[p*]')" \
   "p_star_here = $(header_value fig09 map 'p*[pressure]')" "side = $(header_value fig09 map 'cell_x[length]')" <<'EOF'
map = table('fig09', 'map')
edges = table('fig09', 'contour')
summary = table('fig09', 'summary')
dark = '#303338'
light = '#f1ead8'
stats map using "load" nooutput
loads = STATS_blocks

set size ratio -1
set xrange [-side:side]
set yrange [-side:side]
set xtics side/2 nomirror out font ',12'
set ytics side/2 nomirror out font ',12'
set xlabel '{/:Italic x} [mm]'
unset key
set cbrange [0:1]
set palette defined (0 dark, 1 light)

set object 1 rectangle at screen 0.42, 0.045 size screen 0.024, screen 0.04 fc rgb light fs solid border lc rgb black
set object 2 rectangle at screen 0.58, 0.045 size screen 0.024, screen 0.04 fc rgb dark fs solid border lc rgb black
set label 1 'contact' at screen 0.442, 0.045 left font ',12'
set label 2 'gap' at screen 0.602, 0.045 left font ',12'

# Two waves on either block, as in the experiment: the cell of the tables, drawn four times.
set multiplot layout 1, loads margins 0.115, 0.98, 0.28, 0.85 spacing 0.05, 0
do for [i = 0:loads - 1] {
   stats summary using (column("load") == i + 1 ? column("mean_pressure") : NaN) nooutput
   mean_pressure = STATS_max
   stats summary using (column("load") == i + 1 ? column("pbar_over_pstar") : NaN) nooutput
   set title sprintf('%s = %.4f N/mm²', p_bar, mean_pressure)."\n".sprintf('%s = %.2f', load, STATS_max)
   if (i == 0) { set ylabel '{/:Italic y} [mm]' } else { unset ylabel; set format y '' }
   plot for [k = -1:1] for [l = -1:1] map index i using (k*side + column("x")):(l*side + column("y")): \
           (column("pressure") > edge_level*p_star_here ? 1 : 0) with image, \
        for [k = -2:2] for [l = -2:2] edges index i \
           using (k*side + column("x")):(l*side + column("y")) with lines lc rgb dark lw 0.7
   unset label
   unset object
}
unset multiplot
EOF
