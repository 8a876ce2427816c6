# The picture of loops of the tangential load against the displacement, a colour for each block.
set tmargin at screen 0.9
set xlabel slip_label
set xrange [slip_low:slip_high]
set xtics slip_step
set ylabel traction_label
set yrange [traction_low:traction_high]
set ytics traction_step
unset key
plot for [b = 1:blocks] run(1) index b - 1 \
   using (slip_factor[1]*column('displacement')):(traction_factor[1]*column('tangential_load')) with lines ls 30 + b dt solid
