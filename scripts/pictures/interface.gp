# The picture of the contact stiffness and, if it is there, of the constriction resistance.
set tmargin at screen 0.9
set xlabel load_label
set xrange [load_low:load_high]
set xtics load_step
if (load_wide) { set logscale x }
set format x (format_of(load_wide))
if (stiffness_wide) { set logscale y }
set format y (format_of(stiffness_wide))
set ytics stiffness_step
set ylabel stiffness_label
set yrange [stiffness_low:stiffness_high]
set key top center
stiffness = "run(1) using (load_factor[1]*column('mean_pressure')):'contact_stiffness' with linespoints ls 31"
resistance = "run(1) using (load_factor[1]*column('mean_pressure')):'contact_resistance' axes x1y2 with linespoints ls 32"
if (with_resistance) {
   set border 11
   if (resistance_wide) { set logscale y2 }
   set format y2 (format_of(resistance_wide))
   set y2tics resistance_step
   set y2range [resistance_low:resistance_high]
   set y2label 'resistance'
   eval 'plot '.stiffness." title 'stiffness', ".resistance." title 'resistance'"
} else {
   eval 'plot '.stiffness
}
