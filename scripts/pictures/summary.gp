# The picture of summaries: contact area, mean gap and peak pressure against the mean pressure.
array quantity[3] = ['contact_area_fraction', 'mean_gap', 'peak_pressure']
array error_of[3] = ['contact_area_fraction_error', 'mean_gap_over_amplitude_error', 'peak_pressure_over_pstar_error']
array label_of[3] = [area_label, gap_label, peak_label]
array low[3] = [area_low, gap_low, peak_low]
array high[3] = [area_high, gap_high, peak_high]
array step[3] = [area_step, gap_step, peak_step]
array wide[3] = [area_wide, gap_wide, peak_wide]
factor(n, r) = n == 1 ? area_factor[1] : n == 2 ? gap_factor[r] : peak_factor[r]
unit_of_error(n, r) = n == 1 ? 1 : n == 2 ? Delta_of[r] : p_star_of[r]

x(r) = load_factor[r]*column('mean_pressure')
y(n, r) = factor(n, r)*column(quantity[n])
code(x) = column('status_code')
# Errors that are as large as the value or unknown, NaN, have no bar: the point is open. The paper's series has none.
bar(error, value) = error > 0 && error < value ? error : NaN
error_on_axis(n, r) = factor(n, r)*unit_of_error(n, r)*column(error_of[n])
error(n, r) = bar(error_on_axis(n, r), y(n, r))
too_large(error, value) = error > 0 && error >= value
unknown(n) = code(0) == 4 && stringcolumn(error_of[n]) eq 'NaN'
open(n, r) = unknown(n) || (code(0) < 10 && too_large(error_on_axis(n, r), y(n, r))) ? y(n, r) : NaN

# Converged values of the paper's waves, normalised: a table, or Kuznetsov's and Westergaard's closed forms.
closed_form(n, P) = n == 1 ? 2/pi*asin(sqrt(P)) : n == 2 ? 1 - P + P*log(P) : 2*sqrt(P)
array of_reference[3] = ['contact_area_fraction', 'mean_gap_over_amplitude', 'peak_pressure_over_pstar']
one = p_star_of[1]*load_factor[1]   # p* on the axis

# The points of the paper's series are not joined: the curve is that of the converged values.
joined = reference eq '' ? runs : 0
set style line 41 lc rgb red lw 1.3 pt 2 ps mark
set style line 42 lc rgb red lw 1.3 pt 6 ps 1.3*mark

set xlabel load_label
set xrange [load_low:load_high]
if (load_wide) { set logscale x }
set xtics load_step
if (load_wide) { set mxtics (load_step > 10 ? 1 : 10) }
set format x (format_of(load_wide))
unset key
set bmargin at screen 67.5/height
set tmargin at screen 1 - (title_high + key_high + 10.0)/height
set multiplot
do for [n = 1:3] {
   set lmargin at screen 0.09 + 0.33*(n - 1)
   set rmargin at screen 0.32 + 0.33*(n - 1)
   set ylabel label_of[n]
   unset logscale y
   set yrange [low[n]:high[n]]
   if (wide[n]) { set logscale y }
   set ytics step[n]
   if (wide[n]) { set mytics (step[n] > 10 ? 1 : 10) } else { unset mytics }
   set format y (format_of(wide[n]))
   if (n == 2) { unset label 1 }
   # Each loop runs once or never: a reference, a key.
   plot for [k = 1:reference eq 'table'] folder.'/reference' using (one*column('pbar_over_pstar')): \
           (factor(n, 1)*unit_of_error(n, 1)*column(of_reference[n])) with lines ls 31, \
        for [k = 1:reference eq 'closed form'] [P = 0:1] '+' using (one*P): \
           (factor(n, 1)*unit_of_error(n, 1)*closed_form(n, P)) with lines ls 31, \
        for [k = 1:linear_law && n == 1] run(1) using (x(1)):(factor(1, 1)*column('linear_area_fraction')) \
           smooth unique with lines ls 33, \
        for [r = 1:joined] run(r) using (code(0) <= 10 ? x(r) : NaN):(y(n, r)) smooth unique with lines ls 30 + r, \
        for [r = 1:runs == 1] run(r) using (x(r)):(y(n, r) - error(n, r)):(0):(2*error(n, r)) \
           with vectors ls 31 nohead, \
        for [r = 1:runs] run(r) using (code(0) < 10 ? x(r) : NaN):(y(n, r)) with points ls joined ? 30 + r : 11, \
        for [r = 1:runs == 1] run(r) using (x(r)):(open(n, r)) with points lc rgb '#ffffff' pt 7 ps 0.35*mark, \
        for [r = 1:runs] run(r) using (code(0) > 10 ? x(r) : NaN):(y(n, r)) with points ls 41, \
        for [r = 1:runs] run(r) using (code(0) == 10 ? x(r) : NaN):(y(n, r)) with points ls 42
}

# The key, in a plot of nothing that is as wide as the picture, below the title; runs that are compared have no title.
set lmargin at screen 0.02
set rmargin at screen 0.985
set bmargin at screen 0.9
set tmargin at screen 0.99
unset border
unset tics
unset grid
unset xlabel
unset ylabel
unset logscale
set xrange [0:1]
set yrange [0:1]
set key at screen 0.5, 1 - (title_high + 0.5*key_high)/height center center horizontal maxrows 1 samplen 2 width 1
plot NaN @key_entries
unset multiplot
