# The picture of power spectra against the wave number: the isotropic one and those along x and y side by side, of a
# profile the one along it.
set logscale xy
set format '10^{%T}'
set xrange [q_low:q_high]
set xlabel q_label
set bmargin at screen 72.0/height
set tmargin at screen 1 - 42.0/height
# Rounding of the heights is left out.
above(density, least) = density >= least ? density : NaN
width_of_panel = 240.0/width
set multiplot
if (lines) {
   set lmargin at screen 80.0/width
   set rmargin at screen 80.0/width + width_of_panel
   set yrange [spectrum_2d_low:spectrum_2d_high]
   set ylabel spectrum_2d_label offset 0.5, 0
   unset key
   plot run(1) index 0 using (column('wave_number')):(above(column('spectrum_2d'), spectrum_2d_low)) \
      with linespoints ls 31 ps 0.5*mark
   unset label 1
}
set lmargin at screen (80.0 + 330*lines)/width
set rmargin at screen (80.0 + 330*lines)/width + width_of_panel
set yrange [spectrum_1d_low:spectrum_1d_high]
set ylabel spectrum_1d_label offset 0.5, 0
if (lines) { set key top right samplen 2 } else { unset key }
plot for [k = 0:lines] run(1) index (lines + k) \
   using (column('wave_number')):(above(column('spectrum_1d'), spectrum_1d_low)) \
   with linespoints ls 31 + k ps 0.5*mark title (k == 0 ? 'along '.x_symbol : 'along '.y_symbol)
unset multiplot
