# The picture of maps of surfaces: pressure and gap over one cell with the edge of contact, a column for each load. The
# fields stand in folder.'/map1' ... as records of x, y, pressure and gap.
map(i) = sprintf('%s/map%d', folder, i)
array label_of[2] = [pressure_label, gap_label]
array most[2] = [pressure_most, gap_most]
factor(n) = n == 1 ? pressure_factor[1] : gap_factor[1]
s = length_factor[1]
has_edge(i) = edge_of[i] >= 0

unset key
unset grid
set border 15 lw 0.7
set xrange [0:cell[1]]
set yrange [0:cell[2]]
set xtics length_step out
set ytics length_step out
set size ratio -1

# Panels side by side for one load, otherwise pressures above gaps.
beside = loads_shown == 1
down(n) = beside ? 0 : n - 1
start(i, n) = (70 + (beside ? (n - 1)*(panel_wide + 91) : (i - 1)*(panel_wide + 16)))/width
top(n) = 1 - (46 + down(n)*(panel_tall + 16))/height
lowest = beside ? 0 : 1
set multiplot
do for [n = 1:2] {
   # White without pressure, and where the gap is closed.
   if (n == 1) { set palette defined (0 '#ffffff', 0.05 '#e8eef5', 0.5 '#5b8db8', 1 '#14304a') }
   if (n == 2) { set palette defined (0 '#ffffff', 0.05 '#fbeee6', 0.5 '#d98a55', 1 '#5a2403') }
   set cbrange [0:most[n]]
   do for [i = 1:loads_shown] {
      set lmargin at screen start(i, n)
      set rmargin at screen start(i, n) + panel_wide/width
      set tmargin at screen top(n)
      set bmargin at screen top(n) - panel_tall/height
      if (down(n) == lowest) { set xlabel length_label; set format x '%g' } else { unset xlabel; set format x '' }
      if (i == 1 && (n == 1 || !beside)) { set ylabel y_label; set format y '%g' }
      if (i > 1 || (n > 1 && beside)) { unset ylabel; set format y '' }
      if (down(n) == 0) { set title load_name[i] offset 0, -0.6 font small } else { unset title }
      if (i == loads_shown) {
         set colorbox user origin screen start(i, n) + (panel_wide + 8)/width, screen top(n) - 0.9*panel_tall/height \
            size screen 9.0/width, screen 0.8*panel_tall/height
         set cblabel label_of[n] offset -0.5, 0
         set cbtics font ',11' offset -0.6, 0
      } else {
         unset colorbox
      }
      plot map(i) binary record=(columns, rows) format='%double%double%double%double' \
              using (s*$1):(s*$2):(factor(n)*column(2 + n)) with image, \
           for [c = 1:has_edge(i)] for [k = first_copy[1]:last_copy[1]] for [l = first_copy[2]:last_copy[2]] \
              folder.'/contour' index (has_edge(i) ? edge_of[i] : 0) \
              using (k*cell[1] + s*(has_edge(i) ? column('x') : 0)):(l*cell[2] + s*(has_edge(i) ? column('y') : 0)) \
              with lines lc rgb '#303338' lw 0.8
      unset label 1
   }
}
unset multiplot
