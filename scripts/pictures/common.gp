# What the pictures of scripts/plot share; loaded after figure_style.gp. scripts/plot sets before
#    folder: the folder in which the tables to be drawn stand as 1.dat, 2.dat ..., and companions under their kinds
#    title_words: the name of the case; runs, run_names: number and names of the tables

mean_gap = '{/:Italic ḡ}'
x_symbol = '{/:Italic x}'
y_symbol = '{/:Italic y}'
gap_symbol = '{/:Italic g}'
area = '{/:Italic A}'
area_0 = '{/:Italic A}_0'
p_max = '{/:Italic p}_{max}'
run(r) = sprintf('%s/%d.dat', folder, r)
small = ',12'

# Colours that the colour-blind tell apart, and dashes, for runs and for closed forms.
green = '#0b7a3b'
violet = '#9c5fa0'
set style line 31 lc rgb blue lw 1.3 dt solid pt 7 ps 0.7*mark
set style line 32 lc rgb red lw 1.3 dt (7, 3) pt 5 ps 0.65*mark
set style line 33 lc rgb green lw 1.3 dt (2.5, 2.5) pt 9 ps 0.8*mark
set style line 34 lc rgb black lw 1.3 dt (9, 3, 2, 3) pt 11 ps 0.8*mark
set style line 35 lc rgb violet lw 1.3 dt (5, 5) pt 13 ps 0.8*mark
set style line 36 lc rgb grey lw 1.6 dt solid pt 6 ps 0.8*mark
set style line 37 lc rgb '#a67c00' lw 1.3 dt solid pt 4 ps 0.65*mark
set style line 38 lc rgb '#5ab4e0' lw 1.3 dt (7, 3) pt 8 ps 0.8*mark

# Columns have names, which stand at the head of each block.
set datafile columnheaders

# A panel's looks and the range of an axis: x, y; `wide` is 1 for a logarithmic axis.
set border 3 lw 0.7
set tics nomirror out
set grid lc rgb '#d9d9d9' lw 0.7 dt solid
set key font small
format_of(wide) = wide ? '10^{%T}' : '%g'
