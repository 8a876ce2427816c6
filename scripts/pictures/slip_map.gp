# The picture of stick, slip and open parts of the cell, a panel for each block.
unset grid
set border 15 lw 0.7 front
unset key
unset colorbox
eval of_contact
set cbrange [1:2.7]
set xrange [0:cell[1]]
set yrange [0:cell[2]]
set size ratio -1
set xlabel length_label offset 0, 0.3
set xtics cell[1]/2
set ytics cell[2]/2
set multiplot layout 1, panels margins 0.12, 0.97, 0.24, 0.85 spacing 0.05, 0
do for [b = 1:panels] {
   if (b > 1) { set format y '' }
   if (b == 2) { unset label 1 }
   plot run(1) index b - 1 using (length_factor[1]*column('x')):(length_factor[1]*column('y')): \
      (column('slip_state') > 0 ? column('slip_state') : NaN) with image
}
unset multiplot
