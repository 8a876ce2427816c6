# The picture of sections and planes: a stress as colours, a panel for each load and depth. The fields stand in
# folder.'/map1-1' ..., numbers of load and depth, as records of two coordinates and the stress.
map(i, j) = sprintf('%s/map%d-%d', folder, i, j)
s = length_factor[1]
by_load = loads_shown > 1

unset key
unset grid
set border 15 lw 0.7 front
set xtics step_of[1] out font small
set ytics step_of[2] out font small
# Where there is tension and compression the first is orange.
eval negative && positive ? of_sign : of_size
if (!positive) { set palette negative }
set cbrange [(negative ? -most : 0):(positive || !negative ? most : 0)]
set xrange [0:side[1]]
if (downwards) { set yrange [side[2]:0] } else { set yrange [0:side[2]] }
left(c) = (102 + (c - 1)*(panel_wide + 24))/width
top(r) = 1 - (46 + (r - 1)*(panel_tall + 16))/height
bottom = top(down) - panel_tall/height
set multiplot
do for [r = 1:down] {
   do for [c = 1:across] {
      i = by_load ? c : 1
      j = by_load ? r : c
      above = by_load ? load_name[i] : depth_name[j]
      beside_it = by_load ? depth_name[j] : load_name[i]
      # One panel has its load above; a section has no depths.
      if (above eq '') { above = beside_it; beside_it = '' }
      set lmargin at screen left(c)
      set rmargin at screen left(c) + panel_wide/width
      set tmargin at screen top(r)
      set bmargin at screen top(r) - panel_tall/height
      if (r == down) { set xlabel length_label; set format x '%g' } else { unset xlabel; set format x '' }
      if (c == 1) { set format y '%g' } else { unset ylabel; set format y '' }
      # gnuplot puts a label of two lines into the numbers of the axis.
      if (c == 1 && beside_it eq '') { set ylabel y_label offset 0, 0 }
      if (c == 1 && beside_it ne '') { set ylabel beside_it."\n".y_label offset -1.2, 0 }
      if (r == 1) { set title above offset 0, -0.6 font small } else { unset title }
      if (c == across && r == down) {
         # Beside all rows.
         set colorbox user origin screen left(c) + (panel_wide + 8)/width, screen bottom \
            size screen 9.0/width, screen top(1) - bottom
         set cblabel stress_label offset -0.5, 0 font (panel_tall < 160 && down == 1 ? ',11' : '')
         set cbtics font ',11' offset -0.6, 0
      } else {
         unset colorbox
      }
      plot map(i, j) binary record=(columns, rows) format='%double%double%double' \
              using (s*$1):(s*$2):(stress_factor[1]*$3) with image, \
           for [k = 1:edge_width[i] > 0] sprintf('%s/edge%d', folder, i) using 1:2 \
              with lines lc rgb outline lw edge_width[i] dt (3, 3)
      unset label 1
   }
}
unset multiplot
