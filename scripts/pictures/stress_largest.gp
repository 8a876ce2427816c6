# The picture of the largest stresses against the mean pressure: von Mises stress, shear stress, depth, and the ratio to
# the yield stress if there is one.
array quantity[4] = ['largest_von_mises', 'largest_shear', 'von_mises_depth', 'stress_over_yield_stress']
factor(n, r) = factor_of[(n - 1)*runs + r]
# Runs that are compared show one body of each.
style(r, b) = 30 + (runs > 1 ? r : b)
x(r) = load_factor[r]*column('mean_pressure')
# Bars of errors; depths have none, but gnuplot wants a column that is there.
array error_of[4] = ['largest_von_mises_over_pstar_error', 'largest_shear_over_pstar_error', 'von_mises_depth', \
                     'stress_over_yield_stress_error']
error_on_axis(n, r) = (n == 4 ? 1 : factor(n, r)*p_star_of[r])*column(error_of[n])
y(n, r) = factor(n, r)*column(quantity[n])
# As in the summary an error that is as large as the value has no bar.
error(n, r) = error_on_axis(n, r) < y(n, r) ? error_on_axis(n, r) : NaN
# Its point is open, and so is that of an unknown one, NaN, but for the paper's series, which knows none.
known(n, r) = stringcolumn(error_of[n]) eq 'NaN' ? 0 : error_on_axis(n, r) < y(n, r)
open(n, r) = !estimated || n == 3 || column('status_code') >= 10 || known(n, r) ? NaN : y(n, r)

set xlabel load_label
set xrange [load_low:load_high]
if (load_wide) { set logscale x }
set xtics load_step
set format x (format_of(load_wide))
unset key
set bmargin at screen 67.5/height
set tmargin at screen 1 - (title_high + key_high + 10.0)/height
set multiplot
do for [n = 1:panels] {
   set lmargin at screen (260.0*(n - 1) + 70)/width
   set rmargin at screen (260.0*(n - 1) + 250)/width
   set ylabel label_of[n]
   unset logscale y
   set yrange [low_of[n]:high_of[n]]
   if (wide_of[n]) { set logscale y }
   set ytics step_of[n]
   set format y (format_of(wide_of[n]))
   if (n == 3 && runs == 1) { set key bottom right samplen 2 } else { unset key }
   if (n == 2) { unset label 1 }
   # Each loop runs once or never: yield, depths.
   plot for [k = 1:n == 4] 1 with lines ls 2, \
        for [r = 1:runs] for [b = first_body:last_body] run(r) every bodies_of[r]::b - 1 using (x(r)):(y(n, r)) \
           smooth unique with lines ls style(r, b), \
        for [r = 1:n == 3 ? 0 : runs] for [b = first_body:last_body] run(r) every bodies_of[r]::b - 1 \
           using (x(r)):(y(n, r) - error(n, r)):(0):(2*error(n, r)) with vectors ls style(r, b) dt solid nohead, \
        for [r = 1:runs] for [b = first_body:last_body] run(r) every bodies_of[r]::b - 1 using (x(r)):(y(n, r)) \
           with points ls style(r, b), \
        for [r = 1:runs == 1] for [b = first_body:last_body] run(r) every bodies_of[r]::b - 1 \
           using (x(r)):(open(n, r)) with points lc rgb '#ffffff' pt 7 ps 0.35*mark, \
        for [k = 1:n == 3 && runs == 1] for [b = first_body:last_body] run(1) every bodies_of[1]::b - 1 \
           using (x(1)):(factor(n, 1)*column('shear_depth')) with points ls 11 ps 1.3*mark, \
        for [r = 1:runs] for [b = first_body:last_body] run(r) every bodies_of[r]::b - 1 \
           using (column('status_code') >= 10 ? x(r) : NaN):(y(n, r)) with points ls 42, \
        for [k = 1:n == 3 && runs == 1] NaN with points ls 31 title 'von Mises', \
        for [k = 1:n == 3 && runs == 1] NaN with points ls 11 ps 1.3*mark title 'shear'
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
