#!/bin/sh
# Fig. 8: mean gap of the two-dimensional wave against the mean pressure.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig08 'Fig. 8, the mean gap of the two-dimensional wave,' "$@"
run_decks fig07 fig07_curves
draw_figure 480 380 <<'EOF'
curves = table('fig07_curves', 'theory')
numerical = table('fig07', 'summary')
independent = 'inputs/reference_2d.dat'
set multiplot
set xlabel load
set ylabel '{/:Italic G} = {/:Italic ḡ}/'.Delta
set xrange [0:1]
set yrange [-0.02:1]
set xtics 0.2 format '%.1f'
set ytics 0, 0.2 format '%.1f'
set mxtics 2
set mytics 2
set key top right
set label '(29)' at 0.21, 0.02 right
set label '(30)' at 0.02, 0.145 left
plot curves using 1:4 with lines ls 2, \
     curves using 1:6 with lines ls 2 title 'asymptotes (29), (30)', \
     curves using 1:($1 < 0.5 ? $5 : NaN) with lines ls 5 title '(29), the whole lattice', \
     numerical using 1:3 with points ls 13 title 'numerical, equation (28)', \
     independent using 1:2 with points ls 14 title 'converged, other methods'

# The end of the curve, enlarged.
set origin 0.45, 0.24
set size 0.52, 0.38
unset xlabel
unset ylabel
unset key
unset label
set xrange [0.65:1]
set yrange [-0.002:0.02]
set xtics 0.1 font ',11'
set ytics 0, 0.01 format '%.2f' font ',11'
plot 0 with lines ls 5, \
     curves using 1:6 with lines ls 2, \
     numerical using 1:3 with points ls 13, \
     independent using 1:2 with points ls 14
unset multiplot
EOF
