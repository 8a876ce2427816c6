#!/bin/sh
# Fig. 5: pressures of the two-dimensional wave along the dotted lines of Fig. 4.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig05 'Fig. 5, the pressures along the dotted lines of Fig. 4' "$@"
run_decks fig05 fig05_fine
draw_figure 600 400 "side = $(header_value fig05 lines cell_x)" \
   "fine_side = $(header_value fig05_fine lines cell_x)" <<'EOF'
lines = table('fig05', 'lines')
fine = table('fig05_fine', 'lines')
stats lines using "pbar_over_pstar" nooutput
loads = STATS_blocks
stats fine using "pbar_over_pstar" nooutput
fine_loads = STATS_blocks
# Grey curves are those of loads that both runs have.
black_loads = ' '
do for [i = 0:loads - 1] {
   stats lines index i using "pbar_over_pstar" nooutput
   black_loads = black_loads.sprintf('%.9g ', STATS_max)
}
is_black(number) = strstrt(black_loads, sprintf(' %.9g ', number)) > 0
has_grey = 0
do for [i = 0:fine_loads - 1] {
   stats fine index i using "pbar_over_pstar" nooutput
   if (is_black(STATS_max)) { has_grey = 1 }
}

set yrange [-0.05:2.05]
set ytics 0, 0.5 format '%.1f'
set mytics 5
set xtics 0.1 format '%.1f'
set mxtics 2
set key at graph 0.5, 0.96 center top samplen 3
grey_distance(load, distance) = is_black(load) ? distance/fine_side : NaN
pressures = 'for [i = 0:fine_loads - 1] fine index i every :::block::block' \
   .' using (grey_distance(column("pbar_over_pstar"), column("distance"))):"pressure_over_pstar" with lines ls 5,' \
   .' for [i = 0:loads - 1] lines index i every :::block::block' \
   .' using (column("distance")/side):"pressure_over_pstar" with lines ls 1'

set multiplot
# Panels as wide as the lines that they show are long.
eval margins(0.105, 0.445, 0.16, 0.93)
set ylabel p.'/'.p_star
set xlabel '{/:Italic x}/'.lambda
set xrange [0:0.5]
set label 'crest' at graph 0, 1.04 left
set label 'trough' at graph 1, 1.04 right
block = 0
plot @pressures

unset label
unset ylabel
eval margins(0.495, 0.98, 0.16, 0.93)
set xrange [0:0.5*sqrt(2)]
set xlabel 'distance along the diagonal /'.lambda
set format y ''
set label 'saddle' at graph 0.5, 1.04 center
set label 'crest' at graph 1, 1.04 right
# A load is named over its curve's saddle.
do for [i = 0:loads - 1] {
   stats lines index i every :::1::1 \
      using (abs(column("x")/side - 0.25) < 1e-6 ? column("pressure_over_pstar") : NaN) nooutput
   saddle = STATS_max
   stats lines index i using "pbar_over_pstar" nooutput
   if (i < loads - 1) {
      set label sprintf('%g', STATS_max) at graph 0.5, first saddle + 0.07 center font ',12'
   } else {
      set label sprintf('%s = %g', load, STATS_max) at graph 0.5, first saddle + 0.17 center font ',12'
   }
}
block = 1
plot @pressures, \
     NaN with lines ls 1 title 'harmonics to the 9th', \
     for [i = 1:has_grey] NaN with lines ls 5 title 'to the 60th'
unset multiplot
EOF
