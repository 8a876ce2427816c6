# The picture of planes below profiles: a stress along one wavelength, a panel for each depth. The fields stand in
# folder.'/map1-1' ..., numbers of load and depth, as records of x, y and the stress.
map(i, j) = sprintf('%s/map%d-%d', folder, i, j)
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
set cbrange [0:1]

set xrange [0:longest]
set xtics length_step font small
set yrange [stress_low:stress_high]
set ytics stress_step
set xlabel length_label
set tmargin at screen 1 - 50.0/height
set bmargin at screen 56.0/height
set multiplot
do for [j = 1:depths_shown] {
   set lmargin at screen (78.0 + 190*(j - 1))/width
   set rmargin at screen (78.0 + 190*(j - 1) + 158)/width
   set title depth_name[j] offset 0, -0.6 font small
   if (j == 1) { set ylabel stress_label; set format y '%g' } else { unset ylabel; set format y '' }
   if (j == depths_shown) { set key at screen (78.0 + 190*j)/width, graph 1 left top samplen 2 } else { unset key }
   plot for [i = 1:loads_shown] map(i, j) binary record=(columns) format='%double%double%double' \
      using (length_factor[1]*$1):(stress_factor[1]*$3) with lines lc palette cb shade(i) lw 1.5 title load_name[i]
   unset label 1
}
unset multiplot
