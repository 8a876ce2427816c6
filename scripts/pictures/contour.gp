# The picture of the edges of contact of all loads on one cell.
unset key
unset grid
set border 15 lw 0.7 front
set size ratio -1
set xrange [0:cell[1]]
set yrange [0:cell[2]]
set xtics length_step
set ytics length_step
set xlabel length_label
set ylabel y_label
set lmargin at screen 80.0/width
set rmargin at screen (80 + panel_wide)/width
set bmargin at screen 66.0/height
set tmargin at screen (66 + panel_tall)/height
set cbrange [load_low:load_high]
if (load_wide) { set logscale cb; set format cb '10^{%T}' }
set colorbox user origin screen (80 + panel_wide + 14)/width, screen (66 + 0.1*panel_tall)/height \
   size screen 12.0/width, screen 0.8*panel_tall/height
set cblabel load_label
set cbtics font small offset -0.5, 0

plot for [i = 1:loads_shown] sprintf('%s/edge%d', folder, i) using 1:2 \
   with lines lc palette cb load_of[i] lw (edge_width[i] > 0 ? 1.6*edge_width[i] : 0.25)
