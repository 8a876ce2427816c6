# Draws a table of rough_cases.py, of wavycon alone: processor time and transforms against the contact fraction, and
# processor time against the points along a side, at a shortest wave of 1/32 of the cell. To be loaded after
# scripts/figure_style.gp; wants the name of the table in `runs`, and in `grid` the points a side where the contact
# varies.

small = ',11'
array series[3] = ['0.01', '0.2', '0.8']
array share[3] = ['1', '20', '80']
set grid xtics ytics lc rgb '#e4e4e4' lw 0.6 dt solid
set logscale xy
set xtics font small
set ytics font small
unset mxtics

# Straight lines in logarithms, by least squares: over contact up to `light`, and over all grids.
light = 0.11
line(x, a, b) = exp(a + b*log(x))
contacts = sprintf('%d 16 wavycon', grid)
reached(i) = strcol(5) eq 'reached' ? column(i) : NaN
of_series(j) = strcol(3) eq 'A='.series[j] && column(1) == 32*column(2) ? column(1) : NaN

stats runs index contacts using (column(7) <= light ? log(reached(7)) : NaN):(log(column(8))) nooutput name 'contact'
array slope[3]
array start[3]
do for [j = 1:3] {
   stats runs using (log(of_series(j))):(log(column(8))) nooutput name 'points'
   slope[j] = points_slope
   start[j] = points_intercept
}

set multiplot layout 1, 2 margins 0.085, 0.98, 0.17, 0.94 spacing 0.185
set key right bottom Left reverse samplen 2 font small
set xlabel 'fraction {/:Italic A} of the points in contact' offset 0, 0.3
set ylabel 'processor time [s]' offset 1.2, 0
set yrange [*:3<*]
set ytics nomirror
set y2label 'transforms, there and back' offset -1.2, 0
set y2range [0:*]
set y2tics font small
set xrange [5e-5:1.5]
set format x '10^{%T}'
set format y '%g'
plot runs index contacts using 7:(reached(8)) with points ls 31 title sprintf('time, %d^2 points', grid), \
   [7e-5:light] line(x, contact_intercept, contact_slope) with lines ls 31 \
   title sprintf('{/:Italic A}^{%.2f}, to 10 %%', contact_slope), \
   runs index contacts using 7:(reached(10)) axes x1y2 with points ls 32 title 'transforms (right axis)'
set key left top
set ytics mirror
unset y2label
unset y2tics
set yrange [*:*]
set xlabel 'points {/:Italic N} along a side' offset 0, 0.3
set ylabel 'processor time [s]' offset 1.2, 0
set xrange [200:5200]
set xtics (256, 512, 1024, 2048, 4096)
set format x '%g'
plot for [j = 1:3] runs using (of_series(j)):8 with points ls 30 + j \
   title share[j].sprintf(' %% in contact, {/:Italic N}^{ %.2f}', slope[j]), \
   for [j = 1:3] line(x, start[j], slope[j]) with lines ls 30 + j notitle
unset multiplot
