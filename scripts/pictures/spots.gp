# The picture of contact spots against the load: their number, their areas, and what percolates.
point_size = 0.7*mark
set xrange [load_low:load_high]
set xtics load_step
if (load_wide) { set logscale x }
set format x (format_of(load_wide))
set xlabel load_label
# On the axis p* is `full`.
x(r) = full*column("pbar_over_pstar")
set bmargin at screen 67.5/height
set tmargin at screen 1 - 95.0/height
set key at graph 0, 1.03 left bottom vertical maxrows 3 samplen 1.5
set multiplot

set lmargin at screen 75.0/width
set rmargin at screen 290.0/width
set yrange [number_low:number_high]
if (number_wide) { set logscale y }
set ytics number_step
set format y (format_of(number_wide))
set ylabel 'number'
plot run(1) using (x(1)):"spots" with linespoints ls 31 ps point_size title 'spots', \
     run(1) using (x(1)):"closed_pools" with linespoints ls 32 ps point_size title 'closed pools'
unset label 1

set lmargin at screen 375.0/width
set rmargin at screen 590.0/width
unset logscale y
set yrange [area_low:area_high]
if (area_wide) { set logscale y }
set ytics area_step
set format y (format_of(area_wide))
set ylabel 'area '.area.'/'.area_0
plot run(1) using (x(1)):"spots_area_fraction" with linespoints ls 31 ps point_size title 'contact', \
     run(1) using (x(1)):"largest_spot_area_fraction" with linespoints ls 33 ps point_size \
        title 'largest spot', \
     run(1) using (x(1)):"closed_pools_area_fraction" with linespoints ls 32 ps point_size \
        title 'closed pools'

set lmargin at screen 705.0/width
set rmargin at screen 865.0/width
unset logscale y
unset ylabel
set yrange [0.5:4.5]
set format y '%s'
set ytics ('contact, '.x_symbol 4, 'contact, '.y_symbol 3, 'gap, '.x_symbol 2, 'gap, '.y_symbol 1)
set label 2 'percolates along' at graph 0.5, 1.04 center font small
unset key
plot run(1) using (column("contact_percolates_x") == 1 ? x(1) : NaN):(4) with points ls 31, \
     run(1) using (column("contact_percolates_y") == 1 ? x(1) : NaN):(3) with points ls 31, \
     run(1) using (column("gap_percolates_x") == 1 ? x(1) : NaN):(2) with points ls 32, \
     run(1) using (column("gap_percolates_y") == 1 ? x(1) : NaN):(1) with points ls 32
unset multiplot
