# The picture of the heights over one cell. They stand in folder.'/heights' as records of x, y and height.
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
# Grey at the mean.
eval of_sign
set cbrange [-height_most:height_most]
set colorbox user origin screen (80 + panel_wide + 14)/width, screen (66 + 0.1*panel_tall)/height \
   size screen 12.0/width, screen 0.8*panel_tall/height
set cblabel height_label
set cbtics font small offset -0.5, 0
plot folder.'/heights' binary record=(columns, rows) format='%double%double%double' using 1:2:3 with image
