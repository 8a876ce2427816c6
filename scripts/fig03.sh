#!/bin/sh
# Fig. 3: mean gap of the one-dimensional wave against the mean pressure.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig03 'Fig. 3, the mean gap of the one-dimensional wave' "$@"
run_decks fig03 fig03_curve
draw_figure 480 360 <<'EOF'
set xlabel load
set ylabel '{/:Italic G} = {/:Italic ḡ}/'.Delta
set xrange [0:1]
set yrange [0:1]
set xtics 0.2
set ytics 0.2
set mxtics 2
set mytics 2
set format '%.1f'
set key top right
set border back
plot table('fig03_curve', 'theory') using "pbar_over_pstar":"kuznetsov_mean_gap_over_amplitude" \
        with lines ls 31 title 'converged: equation (20), Kuznetsov', \
     table('fig03', 'summary') using "pbar_over_pstar":"mean_gap_over_amplitude" \
        with points ls 11 title 'numerical, equation (19)'
EOF
