# The looks of all figures, and what they share. draw_figure of figure_common.sh sets before: format, width,
# height (points of 1/72 inch) and picture.

set encoding utf8
set minussign
# "Times" is whatever serif face the machine has. The pictures have room for texts as wide as those of Times: letters of
# a wider face, such as DejaVu Serif, are drawn smaller by `letters`. Digits of Times are half as wide as the face is
# high: 50 units at 75 points. A machine that draws svg without cairo does not know its face.
# N.B. The png terminal takes a point as 4/3 of its unit of length, hence the 0.75.
face = 'Times,14'
letters = 1.0
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
   set terminal pngcairo size 1000, 1000 font 'Times,75'
   set output '/dev/null'
   plot x
   if (exists('GPVAL_TERM_HCHAR')) { letters = 50.0/(999.0*GPVAL_TERM_HCHAR/GPVAL_TERM_XSIZE) }
   if (letters > 1) { letters = 1.0 }
}
pixels_a_point = 10.0/3
mark = 1.0   # size of a point
if (format eq 'png') {
   set terminal pngcairo size width*pixels_a_point, height*pixels_a_point font face \
      fontscale 0.75*pixels_a_point*letters linewidth pixels_a_point pointscale 0.75*pixels_a_point \
      dashlength 0.35*pixels_a_point background '#ffffff' butt
}
if (format eq 'svg') {
   set terminal svg size width, height font face fontscale 0.9*letters linewidth 1 background '#ffffff' butt
   mark = 0.65
}
if (format eq 'pdf') {
   set terminal pdfcairo size width/72.0, height/72.0 font face fontscale 0.8*letters linewidth 2.4 pointscale 1.1 \
      background '#ffffff' butt
}
set output picture

# Colours that the colour-blind tell apart; printed without colour they differ in darkness or dash.
black = '#000000'
grey = '#8c8c8c'
blue = '#0065a3'
red = '#c8500a'
green = '#0b7a3b'
violet = '#9c5fa0'
body = '#d9d9d9'

# The line styles of the captions.
set style line 1 lc rgb black lw 1.1 dt solid
set style line 2 lc rgb black lw 1.1 dt (7, 4)
set style line 3 lc rgb black lw 1.1 dt (12, 4, 2, 4)
set style line 4 lc rgb black lw 1.1 dt (1.5, 3.5)
set style line 5 lc rgb grey lw 0.7 dt solid
# Points: of the quadratic programme, and values to compare with.
set style line 11 lc rgb black lw 1.0 pt 6 ps mark
set style line 12 lc rgb black lw 1.0 pt 7 ps mark
set style line 13 lc rgb black lw 1.2 pt 2 ps mark
set style line 14 lc rgb red lw 1.2 pt 1 ps 1.1*mark

# Colours and dashes for runs and for closed forms; 31 is that of converged values.
set style line 31 lc rgb blue lw 1.3 dt solid pt 7 ps 0.7*mark
set style line 32 lc rgb red lw 1.3 dt (7, 3) pt 5 ps 0.65*mark
set style line 33 lc rgb green lw 1.3 dt (2.5, 2.5) pt 9 ps 0.8*mark
set style line 34 lc rgb black lw 1.3 dt (9, 3, 2, 3) pt 11 ps 0.8*mark
set style line 35 lc rgb violet lw 1.3 dt (5, 5) pt 13 ps 0.8*mark
set style line 36 lc rgb grey lw 1.6 dt solid pt 6 ps 0.8*mark
set style line 37 lc rgb '#a67c00' lw 1.3 dt solid pt 4 ps 0.65*mark
set style line 38 lc rgb '#5ab4e0' lw 1.3 dt (7, 3) pt 8 ps 0.8*mark

# Colour maps, to be chosen by `eval`: equal steps of a number are equal steps of lightness, so that they read in grey.
# Curves from light loads, pale, to heavy ones.
of_loads = "set palette defined (0 '#7baad5', 1 '#4985bc', 2 '#2f6191', 3 '#1c3e66', 4 '#0a1f3d')"
# What is positive in the contact, or in the gap: the least of it is well off the white of where it is not.
of_contact = "set palette defined (0 '#a9d0ee', 1 '#7baad5', 2 '#4985bc', 3 '#2f6191', 4 '#1c3e66', 5 '#0a1f3d')"
of_gap = "set palette defined (0 '#f6cda2', 1 '#e49d66', 2 '#cd6e2b', 3 '#9e4d18', 4 '#6c3110', 5 '#3f1702')"
# From zero, white; and from negative numbers, blue, over zero, grey, to positive ones.
of_size = "set palette defined (0 '#ffffff', 1 '#bbd9f1', 2 '#85b1da', 3 '#518ac0', 4 '#316496', 5 '#1d4068', 6 '#0a1f3d')"
of_sign = "set palette defined (-4 '#0b2f5e', -3 '#234574', -2 '#365d8a', -1 '#4975a1', 0 '#8b8b8b', 1 '#b0a090', \
   2 '#e2b47c', 3 '#f1d2a9', 4 '#fdf0d8')"
outline = '#303338'
eval of_loads
unset colorbox

set border lw 0.7
set tics scale 0.6 front
set key spacing 1.15 samplen 3.2 noautotitle Left reverse

p = '{/:Italic p}'
p_bar = '{/:Italic p̄}'
p_star = '{/:Italic p}*'
load = p_bar.'/'.p_star
lambda = '{/:Italic λ}'
Delta = '{/:Italic Δ}'

# To be chosen by `eval`: the left, right, lower and upper edge of a panel, as parts of the picture.
margins(left, right, bottom, top) = sprintf('set lmargin at screen %.9g; set rmargin at screen %.9g; ' \
   .'set bmargin at screen %.9g; set tmargin at screen %.9g', left, right, bottom, top)

table(case, kind) = 'outputs/'.case.'/'.case.'.'.kind.'.dat'
