# The picture of maps of surfaces: contact, pressure and gap over one cell, a column for each load. The fields stand in
# folder.'/map1' ... as records of x, y, pressure and gap, the edges of contact in folder.'/edge1' ...
map(i) = sprintf('%s/map%d', folder, i)
edge(i) = sprintf('%s/edge%d', folder, i)
array label_of[3] = ['', pressure_label.pressure_beyond, gap_label.gap_beyond]
array most[3] = [1, pressure_most, gap_most]
s = length_factor[1]
# What a panel shows, white where there is nothing of it: contact, the pressure in it, the gap beside it.
in_contact(p) = p > edge_pressure
shown(n, p, g) = n == 1 ? (in_contact(p) ? 0.75 : NaN) : n == 2 ? (in_contact(p) ? pressure_factor[1]*p : NaN) : \
   (in_contact(p) ? NaN : gap_factor[1]*g)

unset key
unset grid
set border 15 lw 0.7 front
set xrange [0:cell[1]]
set yrange [0:cell[2]]
set xtics length_step out font small
set ytics length_step out font small
set size ratio -1

# Panels side by side for one load, otherwise contacts above pressures above gaps.
beside = loads_shown == 1
down(n) = beside ? 0 : n - 1
start(i, n) = (96 + (beside ? (n - 1)*(panel_wide + 30) + 85*(n == 3) : (i - 1)*(panel_wide + 30)))/width
top(n) = 1 - (46 + down(n)*(panel_tall + 16))/height
lowest = beside ? 0 : 2
set multiplot
do for [n = 1:3] {
   eval n == 3 ? of_gap : of_contact
   set cbrange [0:most[n]]
   do for [i = 1:loads_shown] {
      set lmargin at screen start(i, n)
      set rmargin at screen start(i, n) + panel_wide/width
      set tmargin at screen top(n)
      set bmargin at screen top(n) - panel_tall/height
      if (down(n) == lowest) { set xlabel length_label } else { unset xlabel }
      set format x (down(n) == lowest ? '%g' : '')
      first = beside ? n == 1 : i == 1
      named = first && n == 1 && !beside
      if (first) { set ylabel (named ? "contact\n".y_label : y_label) offset (named ? -1.2 : 0), 0 } else { unset ylabel }
      set format y (first ? '%g' : '')
      if (down(n) == 0 && n == 1) { set title load_name[i] offset 0, -0.6 font small } else { unset title }
      if (n > 1 && i == loads_shown) {
         set colorbox user origin screen start(i, n) + (panel_wide + 8)/width, screen top(n) - 0.95*panel_tall/height \
            size screen 9.0/width, screen 0.9*panel_tall/height
         set cblabel label_of[n] offset -0.5, 0 font small
         set cbtics font ',11' offset -0.6, 0
      } else {
         unset colorbox
      }
      plot map(i) binary record=(columns, rows) format='%double%double%double%double' \
              using (s*$1):(s*$2):(shown(n, $3, $4)) with image, \
           for [k = 1:edge_width[i] > 0] edge(i) using 1:2 with lines lc rgb outline lw edge_width[i]
      unset label 1
   }
}
unset multiplot
