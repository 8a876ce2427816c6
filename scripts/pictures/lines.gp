# The picture of fields along lines: pressure above gap, a column for each line; closed forms are dashed.
block(r, i) = block_of[(r - 1)*loads_shown + i]
closed_forms = solved ? folder.'/theory_lines' : run(1)
array names[2] = [pressure_forms, gap_forms]
# gnuplot wants columns that are there even if it plots nothing of them.
array field[2] = [solved ? 'pressure' : 'distance', solved ? 'gap' : 'distance']
factor(row, r) = row == 1 ? pressure_factor[r] : gap_factor[r]
of_theory(row) = row == 1 ? pressure_of_theory : gap_of_theory
array label_of[2] = [pressure_label, gap_label]
array low[2] = [pressure_low, gap_low]
array high[2] = [pressure_high, gap_high]
array step[2] = [pressure_step, gap_step]

# In two dimensions a closed form holds for light loads, about a crest, or for heavy ones, about a trough; outside it
# is 0.
holds(name, i) = dimension == 1 || (name[1:5] eq 'hertz') == light[i]
form(row, name, i) = holds(name, i) && (dimension == 1 || column(name) > 0) ? of_theory(row)*column(name) : NaN
# From light loads, pale, to heavy ones; runs that are compared have colours of their own.
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
set cbrange [0:1]
if (solved) { set style line 43 lw 1.2 dt (4, 3) } else { set style line 43 lw 1.5 dt solid }

left = 72.0/width
right = 1 - 150.0/width
between = dimension == 1 ? 0 : 0.04
unit = (right - left - between)/(dimension == 1 ? longest[1] : longest[1] + longest[2])
# Runs that are compared have their loads above.
if (runs > 1) { do for [i = 1:loads_shown] { title_words = title_words.(i > 1 ? ', ' : '').load_name[i] } }
if (runs > 1) { set label 1 title_words enhanced font small }
set multiplot
set xtics length_step
do for [row = 1:2] {
   set tmargin at screen (row == 1 ? 0.92 : 0.52)
   set bmargin at screen (row == 1 ? 0.555 : 0.155)
   set yrange [low[row]:high[row]]
   set ytics step[row]
   set format x (row == 1 ? '' : '%g')
   start = left
   do for [line = 1:dimension] {
      set lmargin at screen start
      set rmargin at screen start + unit*longest[line]
      start = start + unit*longest[line] + between
      set xrange [0:longest[line]]
      if (line == 1) { set ylabel label_of[row]; set format y '%g' } else { unset ylabel; set format y '' }
      if (row == 2) { set xlabel (line == 1 ? length_label : diagonal_label) }
      if (row == 1 && line == dimension) { set key at screen right + 0.015, 0.93 left top samplen 2 spacing 1 font ',10.5' } else { unset key }
      plot for [i = 1:runs == 1 && solved ? loads_shown : 0] run(1) index block(1, i) every :::line - 1::line - 1 \
              using (length_factor[1]*column('distance')):(factor(row, 1)*column(field[row])) \
              with lines lc palette cb shade(i) lw 1.5 title load_name[i], \
           for [i = 1:runs > 1 ? loads_shown : 0] for [r = 1:runs] run(r) index block(r, i) \
              every :::line - 1::line - 1 using (length_factor[r]*column('distance')):(factor(row, r)*column(field[row])) \
              with lines ls 30 + r, \
           for [name in names[row]] for [i = 1:loads_shown] closed_forms index block(1, i) every :::line - 1::line - 1 \
              using (length_factor[1]*column('distance')):(form(row, name, i)) \
              with lines ls 43 lc palette cb shade(i), \
           for [k = 1:solved && pressure_forms ne ''] NaN with lines ls 43 lc rgb black title 'closed forms', \
           for [r = 1:runs > 1 ? runs : 0] NaN with lines ls 30 + r title run_names[r] noenhanced
      unset label 1
   }
}
unset multiplot
