# The picture of a summary table, on standard output. scripts/plot calls it with
#    the table, the name of the case, the format (png, svg, pdf), the number of columns
table = ARG1
case_name = ARG2

set encoding utf8
if (ARG3 eq 'png') {
   set terminal pngcairo size 1800,660 font 'sans-serif,18' linewidth 2 pointscale 1.5 background '#ffffff'
}
if (ARG3 eq 'svg') {
   set terminal svg size 1200,440 dynamic font 'sans-serif,13' linewidth 1.3 background '#ffffff'
}
if (ARG3 eq 'pdf') {
   set terminal pdfcairo size 30cm,11cm font 'sans-serif,14' linewidth 1.5 background '#ffffff'
}

# The last column is the status.
status_column = int(ARG4)
good(status) = (status eq 'converged' || status eq 'full_contact' || status eq 'no_load' || status eq 'closed_form')
inaccurate(status) = (status eq 'not_accurate')
if_good(value) = good(strcol(status_column)) ? value : NaN
if_inaccurate(value) = inaccurate(strcol(status_column)) ? value : NaN
if_bad(value) = good(strcol(status_column)) || inaccurate(strcol(status_column)) ? NaN : value
least(a, b) = (a < b) ? a : b
greatest(a, b) = (a > b) ? a : b

stats table using (good(strcol(status_column)) || inaccurate(strcol(status_column)) ? 0 : 1) name 'unsolved' nooutput
stats table using (inaccurate(strcol(status_column)) ? 1 : 0) name 'inaccurate' nooutput
stats table using 1 name 'load' nooutput
stats table using 3 name 'gap' nooutput

set linetype 1 linecolor rgb '#1f4e8c' linewidth 1.3 pointtype 7 pointsize 0.8
set linetype 2 linecolor rgb '#c0392b' linewidth 1.3 pointtype 2 pointsize 1.1
set linetype 3 linecolor rgb '#d17a00' linewidth 1.3 pointtype 9 pointsize 1.1
set border 3 linewidth 0.8
set tics nomirror out scale 0.7
set grid linecolor rgb '#d0d0d0' linewidth 0.6 dashtype 1
set xlabel 'mean pressure  {/:Italic p̄} / {/:Italic p}*'
set xrange [0:greatest(1.0, load_max)]
unset key

curves = 'table using (if_good($1)):(column(n)) smooth unique with lines linetype 1 notitle, ' \
   .'table using (if_good($1)):(column(n)) with points linetype 1 notitle, ' \
   .'table using (if_bad($1)):(column(n)) with points linetype 2 title unsolved_title, ' \
   .'table using (if_inaccurate($1)):(column(n)) with points linetype 3 title inaccurate_title'
# A title that is empty has no line in the key.
unsolved_title = unsolved_max > 0 ? 'not solved' : ''
inaccurate_title = inaccurate_max > 0 ? 'not accurate' : ''

set multiplot layout 1,3 title case_name noenhanced

n = 5
set ylabel 'real area of contact  {/:Italic A} / {/:Italic A}_0'
set yrange [0:1]
plot @curves

n = 3
set ylabel 'mean gap  {/:Italic g̅} / Δ'
set yrange [least(0.0, gap_min):greatest(1.0, gap_max)]
if (unsolved_max > 0 || inaccurate_max > 0) {
   set key top right Left reverse samplen 1
}
plot @curves

n = 6
unset key
set ylabel 'peak pressure  {/:Italic p}_{max} / {/:Italic p}*'
set yrange [0:*]
plot @curves

unset multiplot
