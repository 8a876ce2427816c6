#!/bin/sh
# Fig. 2: pressures of the one-dimensional wave: quadratic programming, Westergaard, Dundurs et al.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig02 'Fig. 2, the pressures of the one-dimensional wave' "$@"
run_decks fig02
draw_figure 480 420 "edge_level = $(header_value fig02 lines edge_level)" \
   "side = $(header_value fig02 lines cell_x)" <<'EOF'
lines = table('fig02', 'lines')
theory = table('fig02', 'theory_lines')
stats lines using "pbar_over_pstar" nooutput
loads = STATS_blocks
dundurs = loads > 1 ? 1 : 0   # the series is shown at the second load, in the paper 0.4 p*
set xlabel '{/:Italic x}/'.lambda
set ylabel p.'/'.p_star
set xrange [-0.5:0.5]
set yrange [-0.1:2]
set xtics 0.1 format '%.1f'
set ytics 0, 0.5 format '%.1f'
set mytics 5
set tmargin at screen 0.885
set key at graph 0.5, 1.02 center bottom horizontal maxrows 2 samplen 3

# A load is named under its crest, the highest beside it.
do for [i = 0:loads - 1] {
   stats theory index i using "westergaard_pressure_over_pstar" nooutput
   crest = STATS_max
   stats lines index i using "pbar_over_pstar" nooutput
   if (i == dundurs) { dundurs_load = STATS_max }
   if (i < loads - 1) {
      set label sprintf('%g', STATS_max) at 0, crest - 0.16 center font ',13'
   } else {
      set label sprintf('%s = %g', load, STATS_max) at 0.06, (crest < 1.9 ? crest + 0.03 : 1.93) left font ',13'
   }
}

plot for [i = 0:loads - 1] for [way = -1:1:2] theory index i \
        using (way*column("x")/side):"westergaard_pressure_over_pstar" with lines ls 1, \
     for [i = 0:loads - 1] for [way = -1:1:2] lines index i \
        using (way*column("x")/side):"pressure_over_pstar" with lines ls 2 lc rgb blue, \
     for [way = -1:1:2] theory index dundurs using (way*column("x")/side):"dundurs_pressure_over_pstar" \
        with lines ls 3 lc rgb red, \
     edge_level with lines ls 3 lw 0.8, \
     NaN with lines ls 2 lc rgb blue title 'quadratic programming', \
     NaN with lines ls 1 title 'Westergaard', \
     NaN with lines ls 3 lc rgb red title sprintf('Dundurs {/:Italic et al.}, %g', dundurs_load), \
     NaN with lines ls 3 lw 0.8 title sprintf('%g ', edge_level).p_star
EOF
