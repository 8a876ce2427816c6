#!/bin/sh
# Fig. 8: mean gap of the two-dimensional wave against the mean pressure.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig08 'Fig. 8, the mean gap of the two-dimensional wave' "$@"
run_decks fig07 fig07_curves
draw_figure 480 380 <<'EOF'
curves = table('fig07_curves', 'theory')
numerical = table('fig07', 'summary')
converged = 'outputs/reference/wave_2d.dat'
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
set datafile columnheaders
P = "pbar_over_pstar"
gap = "mean_gap_over_amplitude"
plot curves using P:"light_eq29_mean_gap_over_amplitude" with lines ls 2, \
     curves using P:"crack_mean_gap_over_amplitude" with lines ls 2 title 'asymptotes (29), (30)', \
     curves using P:(column(P) < 0.5 ? column("light_lattice_mean_gap_over_amplitude") : NaN) \
        with lines ls 5 title '(29), the whole lattice', \
     converged using P:gap with lines ls 31 title 'converged', \
     independent using P:gap with points ls 14 title 'converged, other methods', \
     numerical using P:gap with points ls 13 title 'numerical, equation (28)'

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
     curves using P:"crack_mean_gap_over_amplitude" with lines ls 2, \
     converged using P:gap with lines ls 31, \
     independent using P:gap with points ls 14, \
     numerical using P:gap with points ls 13
unset multiplot
EOF
