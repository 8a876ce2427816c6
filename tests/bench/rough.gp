# Draws the table of rough_cases.py: processor time against the fraction of the points in contact, a row of panels for
# each shortest wave, a column for each grid. To be loaded after scripts/figure_style.gp; wants the name of the table in
# `runs`, and the points along the sides of the grids, as words, in `grids`.

small = ',11'
array code[5] = ['wavycon', 'aspher', 'tamaas', 'contactmechanics', 'slippy']
array title[5] = ['wavycon', 'ASPHER', 'tamaas', 'ContactMechanics', 'slippy']
array wave[2] = ['16', '4']

set style line 21 lc rgb blue lw 2.2 dt solid pt 7 ps 0.8*mark
set style line 22 lc rgb violet lw 1.4 dt solid pt 10 ps 0.9*mark
set style line 23 lc rgb red lw 1.4 dt solid pt 5 ps 0.7*mark
set style line 24 lc rgb black lw 1.2 dt (7, 4) pt 8 ps 0.9*mark
set style line 25 lc rgb grey lw 1.6 dt solid pt 13 ps 0.9*mark

columns = words(grids)
left = 0.085
right = 0.985
bottom = 0.1
top = 0.88
gap = 0.014

# The logit, which shows light loads and loads near full contact alike. NaN leaves out what did not reach the residual.
logit(x) = log(x/(1 - x))
reached(i) = strcol(5) eq 'reached' && column(7) <= most ? column(i) : NaN
most = 0.99999   # of the points in contact; beyond it all times are those of full contact

set logscale y
set xrange [logit(4e-4):logit(most)]
set xtics () font small
set ytics font small
unset mxtics
set grid xtics ytics lc rgb '#e4e4e4' lw 0.6 dt solid
array share[8] = [0.001, 0.01, 0.05, 0.2, 0.5, 0.9, 0.99, 0.999]
array label[8] = ['0.1', '1', '5', '20', '50', '90', '99', '99.9']

unset key
set multiplot
wide = (right - left - (columns - 1)*gap)/columns
high = (top - bottom - 2*gap)/2
do for [row = 1:2] {
   do for [panel = 1:columns] {
      x = left + (panel - 1)*(wide + gap)
      y = top - row*high - (row - 1)*2*gap
      set lmargin at screen x
      set rmargin at screen x + wide
      set bmargin at screen y
      set tmargin at screen y + high
      set yrange [0.005:200]
      set format y (panel == 1 ? '%g' : '')
      set ylabel (panel == 1 ? 'processor time [s]' : '') offset 0.8, 0
      set xlabel (row == 2 ? 'points in contact [%]' : '') offset 0, 0.3
      set xtics ()
      do for [i = 1:8] { set xtics add ((row == 2 ? label[i] : '') logit(share[i])) }
      unset label
      grid = word(grids, panel)
      if (row == 1) { set label 1 grid.'^2 points' at graph 0.5, 1.06 center font small }
      set label 2 wave[row].' points on the shortest wave' at graph 0.03, 0.94 left font small
      plot for [j = 1:5] runs index grid.' '.wave[row].' '.code[j] using (logit(column(7))):(reached(8)) \
         with linespoints ls 20 + j
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
set key at screen 0.5, 0.965 center center horizontal maxrows 1 samplen 2.6 font small
plot for [j = 1:5] NaN with linespoints ls 20 + j title title[j]
unset multiplot
