# The picture of details: a panel for each quantity against the load, the last for the estimated errors of all, in the
# colours of their panels.
# Loads that lie close together are joined without points.
point_size = many ? 0 : 0.7*mark
set xrange [load_low:load_high]
set xtics load_step
if (load_wide) { set logscale x }
set format x (format_of(load_wide))
unset key
set multiplot layout 3, 3 margins 0.09, 0.985, 0.1, 0.945 spacing 0.095, 0.06
do for [n = 1:9] {
   if (n > 6) { set xlabel 'mean pressure '.load } else { set format x '' }
   if (n == 7) { set format x (format_of(load_wide)) }
   unset logscale y
   if (n < 9) {
      set yrange [low_of[n]:high_of[n]]
      if (wide_of[n]) { set logscale y }
      set format y (format_of(wide_of[n]))
      set ytics step_of[n]
      set ylabel label_of[n]
      plot run(1) using (column('pbar_over_pstar')):(factor_of[n]*column(column_of[n])) \
         with linespoints ls 30 + n dt solid ps point_size
      unset label 1
   } else {
      set yrange [error_low:error_high]
      set logscale y
      set format y '10^{%T}'
      set ytics autofreq
      set ylabel 'errors, in the colours above'
      plot for [k = 1:8] run(1) using (column('pbar_over_pstar')):(column(column_of[k].'_error')) \
         with lines ls 30 + k dt solid
   }
}
unset multiplot
