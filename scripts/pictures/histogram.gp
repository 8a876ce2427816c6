# The picture of histograms: densities of pressure over the contact and of gap over the open area, times p* and Delta.
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
set cbrange [0:1]
set bmargin at screen 67.5/height
set tmargin at screen 1 - 42.0/height
set multiplot

set lmargin at screen 82.0/width
set rmargin at screen 297.0/width
set xrange [pressure_low:pressure_high]
set xtics pressure_step
set yrange [pressure_density_low:pressure_density_high]
set ytics pressure_density_step
set xlabel pressure_label
set ylabel 'density of pressure × '.p_star
unset key
plot for [i = 1:loads_shown] run(1) index block_of[i] \
   using (pressure_factor[1]*column('pressure')):(pressure_size*column('pressure_density')) \
   with histeps lc palette cb shade(i) lw 1.2
unset label 1

set lmargin at screen 387.0/width
set rmargin at screen 602.0/width
set xrange [gap_low:gap_high]
set xtics gap_step
set yrange [gap_density_low:gap_density_high]
set ytics gap_density_step
set xlabel gap_label
set ylabel 'density of gap × '.Delta
set key at graph 1.03, 1 left top samplen 1.5
plot for [i = 1:loads_shown] run(1) index block_of[i] \
   using (gap_factor[1]*column('gap')):(gap_size*column('gap_density')) \
   with histeps lc palette cb shade(i) lw 1.2 title load_name[i]
unset multiplot
