#!/bin/sh
# Fig. A1: the penny-shaped crack about a trough.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure figA1 'Fig. A1, the penny-shaped crack of radius b' "$@"
run_decks figA1 figA1_paper
draw_figure 480 480 \
   "side = $(header_value figA1 lines cell_x)" "paper_side = $(header_value figA1_paper lines cell_x)" <<'EOF'
lines = table('figA1', 'lines')
theory = table('figA1', 'theory_lines')
paper = table('figA1_paper', 'lines')
stats table('figA1', 'theory') using "pbar_over_pstar" nooutput
load_shown = STATS_max
stats table('figA1', 'theory') using "crack_radius" nooutput
b = STATS_max/side
trough = 0.5

set xrange [-0.15:0.15]
set xtics 0.05
set format x ''
set mxtics 5
set style arrow 1 heads size screen 0.012, 18 filled lc rgb black lw 0.7
set style arrow 2 nohead lc rgb black lw 0.5
set key top right font ',12.5'

set multiplot layout 2, 1 margins 0.18, 0.96, 0.13, 0.94 spacing 0, 0.04
set title sprintf('%s = %.2f', load, load_shown) offset 0, -0.6
set ylabel '{/:Italic p}({/:Italic r})/'.p_star
set yrange [-0.07:0.13]
set ytics -0.05, 0.05 format '%.2f'
set arrow from -b, graph 0 to -b, first 0.02 arrowstyle 2
set arrow from b, graph 0 to b, first 0.02 arrowstyle 2
set xzeroaxis lc rgb grey lw 0.5 lt 1 dt solid
plot for [way = -1:1:2] theory every :::0::0 using (way*(trough - column("x")/side)): \
        (column("crack_pressure_over_pstar") == 0 ? NaN : column("crack_pressure_over_pstar")) with lines ls 1, \
     NaN with lines ls 1 title 'equation (A4)'

unset title
unset arrow
set xlabel '{/:Italic r}/'.lambda
set format x '%.2f'
set ylabel '{/:Italic g}/'.Delta
set yrange [-0.016:0.072]
set ytics -0.02, 0.02 format '%.2f'
set arrow from -b, 0 to -b, -0.013 arrowstyle 2
set arrow from b, 0 to b, -0.013 arrowstyle 2
set arrow from -b, -0.011 to 0, -0.011 arrowstyle 1
set arrow from 0, -0.011 to b, -0.011 arrowstyle 1
set label '{/:Italic b}' at -b/2, -0.0072 center
set label '{/:Italic b}' at b/2, -0.0072 center
plot for [way = -1:1:2] lines every 8:::0::0 \
        using (way*(trough - column("x")/side)):"gap_over_amplitude" with points ls 11 lc rgb red ps 0.8*mark, \
     for [way = -1:1:2] paper every :::0::0 \
        using (way*(trough - column("x")/paper_side)):"gap_over_amplitude" with lines ls 2 lc rgb blue, \
     for [way = -1:1:2] theory every :::0::0 \
        using (way*(trough - column("x")/side)):"crack_gap_over_amplitude" with lines ls 1, \
     NaN with lines ls 1 title 'equation (A6)', \
     NaN with lines ls 2 lc rgb blue title 'numerical, to the 9th harmonic', \
     NaN with points ls 11 lc rgb red ps 0.8*mark title 'numerical, to the 60th'
unset multiplot
EOF
