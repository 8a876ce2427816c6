#!/bin/sh
# Fig. 6: shapes of the contact areas of the two-dimensional wave.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig06 'Fig. 6, the shapes of the contact areas' "$@"
run_decks fig06
draw_figure 480 480 "edge_level = $(header_value fig06 contour edge_level)" \
   "side = $(header_value fig06 contour cell_x)" <<'EOF'
edges = table('fig06', 'contour')
circles = table('fig06', 'theory')
stats edges using "load" nooutput
loads = STATS_blocks
array P[loads]
array number[loads]   # in the deck's order
# Before there are ranges, which would leave out values.
do for [i = 0:loads - 1] {
   stats edges index i using "load" nooutput
   number[i + 1] = STATS_max
   stats table('fig06', 'summary') using (column("load") == number[i + 1] ? column("pbar_over_pstar") : NaN) nooutput
   P[i + 1] = STATS_max
}

load 'scripts/unit_cell.gp'
set cbrange [0:1]
eval margins(0.17, 0.93, 0.13, 0.89)
set key at graph 0.5, 1.01 center bottom samplen 3 font ',12.5'

# A load is named where its curve crosses the line from the crest in the middle to the trough on its right
# or on its left.
part(name) = column(name)/side   # of a wavelength
is_diagonal(x, y) = abs(x - y) < 0.01 && x > 0 && x < 0.25
set style textbox opaque fillcolor rgb '#ffffff' noborder margins 0.3, 0.3
do for [i = 0:loads - 1] {
   stats edges index i \
      using (abs(part("y")) < 0.01 && abs(part("x")) < 0.5 ? abs(part("x")) : NaN) nooutput
   r = STATS_mean
   # The lightest load's stands where its curve is farthest from the circle beside it, on the diagonal, if it is a spot's.
   stats edges index i using (is_diagonal(part("x"), part("y"))) nooutput
   if (i == 0 && STATS_sum > 0) {
      stats edges index i using (is_diagonal(part("x"), part("y")) ? part("x") : NaN) nooutput
      set label sprintf('%g', P[i + 1]) at 0.5 + STATS_mean, 0.5 + STATS_mean \
         center rotate by -45 front font ',9' boxed
   } else {
      set label sprintf('%g', P[i + 1]) at 0.5 + (i % 2 ? -r : r), 0.5 center rotate by 90 front font ',10' boxed
   }
}

# The circles of one load: contact spots of the first, open pools of the last.
set datafile columnheaders
of_load(one, value) = column('load') == one ? value : NaN
contact(x) = of_load(number[1], x)
pool(x) = of_load(number[loads], x)

# The table has the edges of one cell; the next ones are a wavelength away.
set style fill empty
plot for [i = 0:loads - 1] for [k = 0:2] for [l = 0:2] edges index i \
        using (k + part("x")):(l + part("y")) \
        with lines lc palette cb P[i + 1] lw 1.4, \
     for [k = 0:1] for [l = 0:1] circles using (contact(k)):(l):(part("hertz_radius")) with circles ls 4, \
     circles using (contact(0.5)):(0.5):(part("hertz_radius")) with circles ls 4, \
     for [k = 0:1] circles using (pool(k)):(0.5):(part("crack_radius")) with circles ls 4, \
     for [k = 0:1] circles using (pool(0.5)):(k):(part("crack_radius")) with circles ls 4, \
     NaN with lines lc palette cb P[loads] lw 1.4 \
        title sprintf('%s = %g %s, %s = %g to %g', p, edge_level, p_star, load, P[1], P[loads]), \
     NaN with lines ls 4 title sprintf('(23) at %g, (24) at %g', P[1], P[loads])
EOF
