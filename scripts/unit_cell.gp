# Axes of the unit cell of the two-dimensional wave, a wavelength each way.
set size ratio -1
set xlabel '{/:Italic x}/'.lambda
set ylabel '{/:Italic y}/'.lambda
set xrange [0:1]
set yrange [0:1]
set xtics 0.25 format '%.2f' nomirror
set ytics 0.25 format '%.2f' nomirror
