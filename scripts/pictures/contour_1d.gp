# The picture of the strips of contact of profiles, at the height of their load.
s = length_factor[1]
unset key
set xrange [0:cell[1]]
set yrange [load_low:load_high]
if (load_wide) { set logscale y }
set format y (format_of(load_wide))
set ytics load_step
set xtics length_step
set xlabel length_label
set ylabel load_label
set tmargin at screen 1 - 42.0/height

# A curve is the two ends of a strip, which is drawn as a vector from the first to the second: lines would begin with
# small spikes, as gnuplot rounds their first point to whole pixels.
first(x) = (begin = end, end = x, int(column(0))%2 ? begin : NaN)
begin = 0
end = 0
plot for [i = 1:loads_shown] for [k = first_copy:last_copy] \
   run(1) index block_of[i] using (k*cell[1] + s*first(column('x'))):(load_of[i]):(s*(end - begin)):(0) \
   with vectors nohead lc rgb blue lw 2, \
   for [i = 1:loads_shown] for [k = first_copy:last_copy] \
   run(1) index block_of[i] using (k*cell[1] + s*column('x')):(load_of[i]) with points lc rgb blue pt 7 ps 0.4*mark
