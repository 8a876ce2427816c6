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
set title title_words noenhanced font ',15' offset 0, -0.3

# A curve is the two ends of a strip.
plot for [i = 1:loads_shown] for [k = first_copy[1]:last_copy[1]] \
   run(1) index block_of[i] using (k*cell[1] + s*column('x')):(load_of[i]) \
   with linespoints lc rgb blue lw 2 pt 7 ps 0.6*mark
