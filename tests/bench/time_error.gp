# Draws the table of time_error.py: the error that counts against time, a row of panels for mean gap,
# contact area and peak pressure, a column for each load. To be loaded after scripts/figure_style.gp; wants
# the name of the table in `runs`.

array load_text[4] = ['0.05', '0.2', '0.5', '0.9']
array quantity[3] = ['mean gap', 'contact area', 'peak pressure']
small = ',11'
array solver[7] = ['wavycon, grids', 'wavycon, fitted', 'wavycon, paper''s series', 'tamaas', 'ContactMechanics', \
   'slippy', 'ASPHER']

set style line 21 lc rgb blue lw 2.2 dt solid pt 7 ps 0.8*mark
set style line 22 lc rgb '#0b7a3b' lw 2.2 dt solid pt 9 ps 0.9*mark
set style line 23 lc rgb blue lw 1.2 dt (5, 3) pt 6 ps 0.8*mark
set style line 24 lc rgb red lw 1.4 dt solid pt 5 ps 0.7*mark
set style line 25 lc rgb black lw 1.2 dt (7, 4) pt 8 ps 0.9*mark
set style line 26 lc rgb grey lw 1.6 dt solid pt 13 ps 0.9*mark
set style line 27 lc rgb violet lw 1.4 dt solid pt 10 ps 0.9*mark

left = 0.095
right = 0.99
bottom = 0.085
top = 0.9
gap = 0.012

block(i, j) = 7*(i - 1) + j - 1

# Read before there are ranges, which would leave out values.
array floors[12]
do for [panel = 1:4] {
   do for [row = 1:3] {
      stats runs index block(panel, 1) using (column(8 + row)) every ::0::0 nooutput name 'floor'
      floors[3*panel + row - 3] = floor_max
   }
}

set logscale xy
set xrange [0.1:3e4]
set yrange [1e-14:1]
set xtics 0.1, 100 format '' font small
set ytics 1e-14, 100 format '' font small
unset mxtics
unset mytics
set grid xtics ytics lc rgb '#e4e4e4' lw 0.6 dt solid

unset key
set multiplot
do for [row = 1:3] {
   do for [panel = 1:4] {
      wide = (right - left - 3*gap)/4
      high = (top - bottom - 2*1.6*gap)/3
      x = left + (panel - 1)*(wide + gap)
      y = top - row*high - (row - 1)*1.6*gap
      set lmargin at screen x
      set rmargin at screen x + wide
      set bmargin at screen y
      set tmargin at screen y + high
      set format y (panel == 1 ? '10^{%T}' : '')
      set format x (row == 3 ? '10^{%T}' : '')
      set ylabel (panel == 1 ? '{/*0.85 error of '.quantity[row].'}' : '') offset 1.6, 0
      set xlabel (row == 3 ? '{/*0.85 time [ms]}' : '') offset 0, 0.3
      unset label
      if (row == 1) {
         set label 1 load.' = '.load_text[panel] at graph 0.5, 1.07 center font small
      }
      # Below the floor the true value has no digits.
      set object 1 rectangle from graph 0, graph 0 to graph 1, first floors[3*panel + row - 3] \
         fc rgb '#efefef' fs noborder behind
      plot for [j = 1:7] runs index block(panel, j) using 2:(column(5 + row)) with linespoints ls 20 + j
   }
}

# The key, in a plot of nothing that is as wide as the picture.
set lmargin at screen left
set rmargin at screen right
set bmargin at screen top
set tmargin at screen 0.99
unset border
unset tics
unset grid
unset xlabel
unset ylabel
unset label
unset object
set key at screen 0.5, 0.975 center center horizontal maxrows 2 samplen 2.6 font small
plot for [j = 1:7] NaN with linespoints ls 20 + j title solver[j]
unset multiplot
