# The picture of the edges of contact of all loads on one cell.
s = length_factor[1]
unset key
unset grid
set border 15 lw 0.7
set size ratio -1
set xrange [0:cell[1]]
set yrange [0:cell[2]]
set xtics length_step
set ytics length_step
set xlabel length_label
set ylabel y_label
set lmargin at screen 72.0/width
set rmargin at screen (72 + panel_wide)/width
set bmargin at screen 66.0/height
set tmargin at screen (66 + panel_tall)/height
set cbrange [load_low:load_high]
if (load_wide) { set logscale cb; set format cb '10^{%T}' }
set colorbox user origin screen (72 + panel_wide + 14)/width, screen (66 + 0.1*panel_tall)/height \
   size screen 12.0/width, screen 0.8*panel_tall/height
set cblabel load_label
set cbtics font small offset -0.5, 0

# The table has curves in one piece, which may leave the cell.
plot for [i = 1:loads_shown] for [k = first_copy[1]:last_copy[1]] for [l = first_copy[2]:last_copy[2]] \
   run(1) index block_of[i] using (k*cell[1] + s*column('x')):(l*cell[2] + s*column('y')) \
   with lines lc palette cb load_of[i] lw 1.4
