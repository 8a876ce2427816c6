# The picture of the heights of a profile. They stand in folder.'/heights' as records of x, y and height.
unset key
set xrange [0:cell[1]]
set xtics length_step
set yrange [height_low:height_high]
set ytics height_step
set xlabel length_label
set ylabel height_label
set lmargin at screen 0.2
set rmargin at screen 0.95
set bmargin at screen 0.27
set tmargin at screen 1 - 42.0/height
plot folder.'/heights' binary record=(columns) format='%double%double%double' using 1:3 with lines ls 31
