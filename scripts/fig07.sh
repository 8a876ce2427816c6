#!/bin/sh
# Fig. 7: contact area of the two-dimensional wave against the mean pressure.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig07 'Fig. 7, the contact area of the two-dimensional wave,' "$@"
run_decks fig07 fig07_curves
draw_figure 480 380 "edge_level = $(header_value fig07 summary 'edge_level[p*]')" <<'EOF'
curves = table('fig07_curves', 'theory')
set xlabel load
set ylabel '{/:Italic A}_{real} / {/:Italic A}_0'
set xrange [0:1]
set yrange [0:1]
set xtics 0.2 format '%.1f'
set ytics 0.2 format '%.1f'
set mxtics 2
set mytics 2
set key bottom right
stats curves using 2 nooutput
set label '(23)' at 0.97, STATS_max offset 0, -1.6 right
stats curves using 3 nooutput
set label '(24)' at 0.03, STATS_min offset 0, 1.6 left
plot curves using 1:2 with lines ls 2, \
     curves using 1:3 with lines ls 2 title 'asymptotes (23), (24)', \
     table('fig07', 'summary') using 1:5 with points ls 12 \
        title sprintf('numerical, %s ≥ %.1f %s', p, edge_level, p_star), \
     'inputs/reference_2d.dat' using 1:3 with points ls 14 title 'converged, other methods'
EOF
