# The picture of partial slip: stick area and displacement against the tangential load, a colour for each load.
set xlabel '{/:Italic Q} / ({/:Italic f p̄})'
set xrange [0:1]
set xtics 0.2
set multiplot layout 1, 2 margins 0.12, 0.98, 0.18, 0.88 spacing 0.15, 0
set ylabel 'stick area '.area.'/'.area_0
set yrange [stick_low:stick_high]
set ytics stick_step
unset key
of_load(k) = column('load') == load_number[k]
plot for [k = 1:|load_number|] run(1) using 'tangential_over_limit':(of_load(k) ? column('stick_area_fraction') : NaN) \
   with linespoints ls 30 + k dt solid
unset label 1
set ylabel slip_label
set yrange [slip_low:slip_high]
set ytics slip_step
set key outside top right horizontal samplen 1.5
plot for [k = 1:|load_number|] run(1) \
   using 'tangential_over_limit':(of_load(k) ? slip_factor[1]*column('displacement') : NaN) \
   with linespoints ls 30 + k dt solid title sprintf('load %d', load_number[k])
unset multiplot
