# The picture of the coefficients of the pressure: their sizes against the harmonic.
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
set cbrange [0:1]
set logscale y
set yrange [least:most]
set xrange [0:highest + 0.5]
set format y '10^{%T}'
set ylabel 'coefficient |'.(dimension == 1 ? '{/:Italic A_i}' : '{/:Italic A_{ij}}').'|/'.p_star
set xlabel 'harmonic '.(dimension == 1 ? '{/:Italic i}' : '({/:Italic i}^2 + {/:Italic j}^2)^{1/2}')
set lmargin at screen 0.15
set rmargin at screen 0.72
set bmargin at screen 0.2
set key at graph 1.03, 1 left top samplen 1.5
set tmargin at screen 1 - 42.0/height
plot for [i = 1:loads_shown] run(1) index block_of[i] using (sqrt(column('i')**2 + column('j')**2)): \
        (abs(column('pressure_over_pstar'))) \
   with points lc palette cb shade(i) lw 1.2 pt 7 ps 0.7*mark title load_name[i]
