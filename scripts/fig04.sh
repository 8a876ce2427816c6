#!/bin/sh
# Fig. 4: the unit cell of the two-dimensional wave.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig04 'Fig. 4, the unit cell of the two-dimensional wave' "$@"
run_decks fig04
draw_figure 480 480 "side = $(header_value fig04 map cell_x)" "Delta_here = $(header_value fig04 map Delta)" <<'EOF'
step = 0.2
levels = 9
set contour base
set cntrparam levels incremental step, step, levels*step
unset surface
set table $contours
splot table('fig04', 'map') using (column("x")/side):(column("y")/side):(column("undeformed_gap")/Delta_here) with lines
unset table

set style fill solid noborder
load 'scripts/unit_cell.gp'
set key at graph 0.5, 1.025 center bottom horizontal samplen 1.5 width 1
eval margins(0.16, 0.95, 0.13, 0.92)

# Contours are labelled where they cross the line from the crest in the middle to the trough on its right.
set style textbox opaque fillcolor rgb '#ffffff' noborder margins 0.3, 0.3
do for [i = 1:levels] {
   stats $contours using (abs($2 - 0.5) < 1e-6 && $1 > 0.5 && abs($3 - step*i) < 1e-6 ? $1 : NaN) nooutput
   set label sprintf('%.1f', step*i) at STATS_max, 0.5 center rotate by 90 front font ',9' boxed
}
set label 'A' at 0.03, 0.07 center front
set label 'B' at 0.035, 0.43 center front
set label 'C' at 0.28, 0.22 center front

# The triangle ABC; the lines of Fig. 5 from a crest to a trough and over the saddle to the next crest.
$triangle << EOD
0.00 0.00
0.00 0.50
0.25 0.25
EOD
$crests << EOD
0.0 0.0
0.0 1.0
1.0 0.0
1.0 1.0
0.5 0.5
EOD
$troughs << EOD
0.5 0.0
0.0 0.5
1.0 0.5
0.5 1.0
EOD
$saddles << EOD
0.25 0.25
0.75 0.25
0.25 0.75
0.75 0.75
EOD
$dotted << EOD
0.5 0.0
0.0 0.0
0.5 0.5
EOD
# The map ends before its first row and column come again: the contours and their mirror images fill the cell.
mirrored(k, x) = k > 0 ? x : 1 - x
plot $triangle using 1:2 with filledcurves closed lc rgb '#e4e4e4', \
     for [k = -1:1:2] for [l = -1:1:2] $contours using (mirrored(k, $1)):(mirrored(l, $2)) with lines ls 5, \
     NaN with lines ls 5 title '{/:Italic h}/'.Delta, \
     $triangle using 1:2 with lines ls 1 lw 1.4, \
     $dotted using 1:2 with lines ls 4 lc rgb red lw 2.4, \
     $crests using 1:2 with points ls 11 ps 1.5*mark title 'crest', \
     $troughs using 1:2 with points ls 13 ps 1.5*mark title 'trough', \
     $saddles using 1:2 with points ls 13 pt 1 ps 1.5*mark title 'saddle'
EOF
