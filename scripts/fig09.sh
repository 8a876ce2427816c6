#!/bin/sh
# Fig. 9: contact areas of the crossed blocks of the experiment, computed.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig09 'Fig. 9, the contact areas of the experiment as computed,' "$@"
run_decks fig09
draw_figure 600 280 "edge_level = $(header_value fig09 map 'edge_level[p*]')" <<'EOF'
map = table('fig09', 'map')
edges = table('fig09', 'contour')
stats map using 2 nooutput
side = STATS_max
stats map using 1 nooutput
loads = STATS_blocks

set size ratio -1
set xrange [-side:side]
set yrange [-side:side]
set xtics side/2 nomirror out font ',12'
set ytics side/2 nomirror out font ',12'
set xlabel '{/:Italic X}, mm'
unset key
set cbrange [0:1]
set palette defined (0 '#303338', 1 '#f1ead8')

# Two waves on either block, as in the experiment: the cell of the tables, drawn four times.
set multiplot layout 1, loads margins 0.115, 0.98, 0.23, 0.83 spacing 0.05, 0
do for [i = 0:loads - 1] {
   stats table('fig09', 'summary') every ::i::i using 2 nooutput
   mean_pressure = STATS_max
   stats map index i using 1 nooutput
   set title sprintf('%s = %.4f N/mm²', p_bar, mean_pressure)."\n".sprintf('%s = %.2f', load, STATS_max)
   if (i == 0) { set ylabel '{/:Italic Y}, mm' } else { unset ylabel; set format y '' }
   plot for [k = -1:0] for [l = -1:0] map index i \
           using (k*side + $2):(l*side + $3):($5 > edge_level ? 1 : 0) with image, \
        for [k = -2:2] for [l = -2:2] edges index i \
           using (k*side + $2):(l*side + $3) with lines lc rgb '#303338' lw 0.7
}
unset multiplot
EOF
