# What the pictures of scripts/plot share; loaded after figure_style.gp. scripts/plot sets before
#    folder: the folder in which the tables to be drawn stand as 1.dat, 2.dat ..., and companions under their kinds
#    title_words, title_size: the title and the size of its letters; runs, run_names: number and names of the tables

mean_gap = '{/:Italic ḡ}'
x_symbol = '{/:Italic x}'
y_symbol = '{/:Italic y}'
depth_symbol = '{/:Italic z}'
gap_symbol = '{/:Italic g}'
area = '{/:Italic A}'
area_0 = '{/:Italic A}_0'
p_max = '{/:Italic p}_{max}'
run(r) = sprintf('%s/%d.dat', folder, r)
small = ',12'

# Columns have names, which stand at the head of each block.
set datafile columnheaders

# A panel's looks and the range of an axis: x, y; `wide` is 1 for a logarithmic axis.
set border 3 lw 0.7
set tics nomirror out
set grid lc rgb '#d9d9d9' lw 0.7 dt solid
set key font small
# In the middle of the picture's upper edge; pictures of several panels unset it after the first.
set label 1 title_words noenhanced at screen 0.5, screen 1 - 15.0/height center font sprintf(',%g', title_size)
format_of(wide) = wide ? '10^{%T}' : '%g'
