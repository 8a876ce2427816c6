# The picture of closed forms against the load, with the points of the summary if it stands beside the table.
array label_of[3] = ['contact area '.area.'/'.area_0, 'mean gap '.mean_gap.'/'.Delta, 'peak pressure '.p_max.'/'.p_star]
array solved_column[3] = ['contact_area_fraction', 'mean_gap_over_amplitude', 'peak_pressure_over_pstar']
array low[3] = [area_low, gap_low, peak_low]
array high[3] = [area_high, gap_high, peak_high]
array step[3] = [area_step, gap_step, peak_step]
array wide[3] = [area_wide, gap_wide, peak_wide]

set xlabel 'mean pressure '.load
set xrange [load_low:load_high]
set xtics load_step
if (load_wide) { set logscale x }
set format x (format_of(load_wide))
solved_style = many ? 'lines ls 36 lw 2.5' : 'points ls 11'
set multiplot
do for [n = 1:3] {
   set lmargin at screen 0.085 + 0.325*(n - 1)
   set rmargin at screen 0.325 + 0.325*(n - 1)
   set tmargin at screen 0.62
   set bmargin at screen 0.18
   set key at graph -0.02, 1.03 left bottom font ',10.5' spacing 1.05 samplen 2.4
   unset logscale y
   set yrange [low[n]:high[n]]
   if (wide[n]) { set logscale y }
   set format y (format_of(wide[n]))
   set ytics step[n]
   set ylabel label_of[n]
   plot for [k = forms_before[n] + 1:forms_before[n + 1]] run(1) \
           using (column('pbar_over_pstar')):(column(form_column[k])) with lines ls 30 + k - forms_before[n] \
           title form_name[k], \
        for [k = 1:solved] folder.'/summary' using (column('pbar_over_pstar')):(column(solved_column[n])) \
           with @solved_style title 'solved'
   unset label 1
}
unset multiplot
