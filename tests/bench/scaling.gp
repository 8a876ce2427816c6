# Draws the table of scaling.py: speed-up and efficiency, memory and the time of an iteration against the ranks. To be
# loaded after scripts/figure_style.gp; wants the name of the table in `runs`, the points a side of the grids of the
# strong series in `strong`, those of a rank of the weak series in `weak` (0: none), and a mean pressure of the table in
# `pressure`, all as words. For example, at the top of the tree:
#
#    gnuplot -e "format = 'png'; width = 760; height = 560; picture = 'scaling.png'; runs = 'scaling.dat'" \
#       -e "strong = '1024 2048'; weak = '1024'; pressure = '0.3'" scripts/figure_style.gp tests/bench/scaling.gp

small = ',11'
set grid xtics ytics lc rgb '#e4e4e4' lw 0.6 dt solid
set xtics font small
set ytics font small
unset mxtics
unset mytics

stats runs index 'runs' using 1 nooutput name 'ranks'
most = ranks_max
set logscale x 2
set xrange [0.9:1.1*most]

# The solve time on one rank of a grid, and what of a row belongs to it; NaN leaves out the others.
of_grid(x, y, value) = $1 >= 1 && $2 == x && $3 == y && strcol(4) eq pressure ? value : NaN
chosen = "awk '$1 == 1 && $2 == %d && $3 == %d && $4 == \"%s\" && NF > 10 {print $9; exit}' %s"
alone(points) = real(system(sprintf(chosen, points, points, pressure, runs)))
# Likewise of an iteration on the last grid: those rows have 10 words.
chosen_iteration = "awk '$1 == 1 && $2 == %d && $3 == %d && $4 == \"%s\" && NF == 10 {print $7; exit}' %s"
iteration_alone(points) = real(system(sprintf(chosen_iteration, points, points, pressure, runs)))

set multiplot layout 2, 2 margins 0.09, 0.98, 0.1, 0.96 spacing 0.12, 0.14
set key top left Left reverse samplen 2 font small
set ylabel 'speed-up of a grid' offset 1, 0
set logscale y 2
set yrange [0.7:1.4*most]
plot x with lines ls 5 title 'ideal', \
   for [i = 1:words(strong)] points = int(word(strong, i)) \
   runs index 'runs' using (of_grid(points, points, $1)):(alone(points)/$9) with linespoints ls 30 + i \
   title sprintf('%d^2 points', points)
unset logscale y
set ylabel 'efficiency' offset 1, 0
set yrange [0:1.2]
set key bottom left
plot 1 with lines ls 5, \
   for [i = 1:words(strong)] points = int(word(strong, i)) \
   runs index 'runs' using (of_grid(points, points, $1)):(alone(points)/$9/$1) with linespoints ls 30 + i \
   title sprintf('%d^2 points', points), \
   for [i = 1:words(weak)] points = int(word(weak, i)) \
   runs index 'iterations' using (of_grid(points, points*$1, $1)):(iteration_alone(points)/$7) with linespoints ls 36 \
   title sprintf('%d^2 points a rank, an iteration', points)
set xlabel 'ranks' offset 0, 0.3
set ylabel 'iteration of the last grid / s' offset 1, 0
set logscale y 10
set yrange [*:*]
set format y '%g'
unset key
plot for [i = 1:words(strong)] points = int(word(strong, i)) \
   runs index 'iterations' using (of_grid(points, points, $1)):($7/1000) with linespoints ls 30 + i, \
   for [i = 1:words(weak)] points = int(word(weak, i)) \
   runs index 'iterations' using (of_grid(points, points*$1, $1)):($7/1000) with linespoints ls 36
set ylabel 'most memory of a rank / MB' offset 1, 0
plot for [i = 1:words(strong)] points = int(word(strong, i)) \
   runs index 'runs' using (of_grid(points, points, $1)):13 with linespoints ls 30 + i, \
   for [i = 1:words(weak)] points = int(word(weak, i)) \
   runs index 'runs' using (of_grid(points, points*$1, $1)):13 with linespoints ls 36
unset multiplot
