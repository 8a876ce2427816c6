#!/bin/sh
# A ball on a rough plane: the contact beside Hertz's circle, and contact area and approach against the force beside
# Hertz's contact of a smooth ball.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure ball 'a ball on a rough plane' "$@"
run_decks ball_on_rough
"$wavycon" --quiet inputs/ball_on_rough.nml --set load.force=3 --set output.contours=F --set output.map=T \
   --set output.map_points=512 --set output.map_format=text --set scene.case=ball_map
draw_figure 640 300 <<'END'
set datafile columnheaders
micro = 1000.0
map = table('ball_map', 'map')
theory = table('ball_map', 'theory')
all = table('ball_on_rough', 'summary')
hertz = table('ball_on_rough', 'theory')
stats theory using 'ball_half_axis_x' name 'axis' nooutput
unset key
set multiplot

# Left: pressures of contact. Right of it: area and approach.
set border 15 lw 0.7
set tics out nomirror
eval margins(0.075, 0.41, 0.16, 0.917)
set xrange [10:90]
set yrange [10:90]
set xtics 20
set ytics 20
set xlabel '{/:Italic x} [µm]' offset 0, 0.3
set ylabel '{/:Italic y} [µm]' offset 1, 0
eval of_contact
set cbrange [0:8]
set cbtics 2 offset -0.6, 0
set colorbox user origin 0.422, 0.16 size 0.012, 0.757
set cblabel "{/:Italic p} [GPa]" offset 0.3, 0
set title 'contact under 3 N, and Hertz’s circle' offset 0, -0.5
set parametric
set trange [0:2*pi]
plot map using (micro*column('x')):(micro*column('y')):(column('pressure') > 0 ? column('pressure')/1000 : NaN) \
        with image, \
     50 + micro*axis_mean*cos(t), 50 + micro*axis_mean*sin(t) with lines lc rgb red lw 1.6
unset parametric
unset colorbox

set border 3 lw 0.7
set logscale xy
set xrange [0.008:6.5]
set xtics (0.01, 0.1, 1) format '%g'
set title
set key bottom right samplen 2.2 font ',12'

eval margins(0.645, 0.99, 0.58, 0.917)
set yrange [2:5000]
set ytics (10, 100, 1000)
unset xlabel
set format x ''
set ylabel 'contact area [µm²]' offset 0.4, 0
plot all using 'force':(1e6*column('contact_area')) with linespoints ls 31 title 'rough', \
     hertz using 'force':(1e6*column('ball_contact_area')) with lines ls 2 title 'Hertz'
eval margins(0.645, 0.99, 0.16, 0.5)
set yrange [0.008:2]
set ytics (0.01, 0.1, 1)
set xtics format '%g'
set xlabel 'force [N]' offset 0, 0.3
set ylabel 'approach [µm]' offset 0.4, 0
plot all using 'force':(micro*column('approach')) with linespoints ls 31 title 'rough', \
     hertz using 'force':(micro*column('ball_approach')) with lines ls 2 title 'Hertz'
unset multiplot
END
