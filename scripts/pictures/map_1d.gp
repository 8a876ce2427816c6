# The picture of maps of profiles: pressure above gap along one wavelength. The fields stand in folder.'/map1' ... as
# records of x, y, pressure and gap.
map(i) = sprintf('%s/map%d', folder, i)
array label_of[2] = [pressure_label, gap_label]
array low[2] = [pressure_low, gap_low]
array high[2] = [pressure_high, gap_high]
array step[2] = [pressure_step, gap_step]
factor(n) = n == 1 ? pressure_factor[1] : gap_factor[1]
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
set cbrange [0:1]

set xrange [0:cell[1]]
set xtics length_step
set lmargin at screen 72.0/width
set rmargin at screen 1 - 150.0/width
set multiplot
do for [row = 1:2] {
   set tmargin at screen (row == 1 ? 0.92 : 0.52)
   set bmargin at screen (row == 1 ? 0.555 : 0.155)
   set yrange [low[row]:high[row]]
   set ytics step[row]
   set ylabel label_of[row]
   set format x (row == 1 ? '' : '%g')
   if (row == 2) { set xlabel length_label }
   if (row == 1) { set key at screen 1 - 143.0/width, 0.93 left top samplen 2 } else { unset key }
   plot for [i = 1:loads_shown] map(i) binary record=(columns) format='%double%double%double%double' \
      using (length_factor[1]*$1):(factor(row)*column(2 + row)) \
      with lines lc palette cb shade(i) lw 1.5 title load_name[i]
   unset label 1
}
unset multiplot
