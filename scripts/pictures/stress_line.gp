# The picture of stresses below the crest: a panel for each, depth downwards.
block(r, i) = block_of[(r - 1)*loads_shown + i]
# From light loads, pale, to heavy ones; runs that are compared have colours of their own.
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
set cbrange [0:1]
# Runs that are compared have their loads above.
if (runs > 1) { do for [i = 1:loads_shown] { title_words = title_words.(i > 1 ? ', ' : '').load_name[i] } }
if (runs > 1) { set label 1 title_words enhanced font small }

set yrange [deepest:0]
set tics font small
set ytics depth_step
set multiplot
do for [n = 1:panels] {
   column_here = (n - 1) % across
   row = (n - 1)/across
   set lmargin at screen (78.0 + 132*column_here)/width
   set rmargin at screen (78.0 + 132*column_here + 98)/width
   set tmargin at screen 1 - (38.0 + 235*row)/height
   set bmargin at screen 1 - (38.0 + 235*row + 175)/height
   set xrange [low_of[n]:high_of[n]]
   set xtics step_of[n]
   set xlabel label_of[n]
   if (column_here == 0) { set ylabel depth_label; set format y '%g' } else { unset ylabel; set format y '' }
   if (n == across) { set key at screen (78.0 + 132*across)/width, graph 1 left top samplen 2 } else { unset key }
   plot for [i = 1:runs == 1 ? loads_shown : 0] run(1) index block(1, i) \
           using (stress_factor[1]*column(column_of[n])):(depth_factor[1]*column('depth')) \
           with lines lc palette cb shade(i) lw 1.5 title load_name[i], \
        for [i = 1:runs > 1 ? loads_shown : 0] for [r = 1:runs] run(r) index block(r, i) \
           using (stress_factor[r]*column(column_of[n])):(depth_factor[r]*column('depth')) with lines ls 30 + r, \
        for [r = 1:runs > 1 ? runs : 0] NaN with lines ls 30 + r title run_names[r] noenhanced
   unset label 1
}
unset multiplot
