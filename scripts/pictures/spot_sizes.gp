# The picture of the sizes of spots: how many of a load have at least an area. Pools of gap are dashed.
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
set cbrange [0:1]
set logscale xy
set xrange [least:most]
set yrange [0.8:highest]
set format x '10^{%T}'
set format y '10^{%T}'
set xlabel 'area '.area.'/'.area_0
set ylabel 'number of at least this area'
set lmargin at screen 0.13
set rmargin at screen 0.7
set bmargin at screen 0.2
set tmargin at screen 1 - 42.0/height
set key at graph 1.03, 1 left top samplen 1.5
plot for [i = 1:loads_shown] run(1) index block_of[i] \
        using (column('area_fraction')):(strcol('region') eq 'spot' ? column('rank') : NaN) \
        with linespoints lc palette cb shade(i) lw 1.2 pt 7 ps 0.4*mark title load_name[i], \
     for [i = 1:loads_shown] run(1) index block_of[i] \
        using (column('area_fraction')):(strcol('region') eq 'pool' ? column('rank') : NaN) \
        with linespoints lc palette cb shade(i) lw 1.2 dt (4, 3) pt 6 ps 0.4*mark notitle, \
     NaN with linespoints lc rgb grey lw 1.2 pt 7 ps 0.4*mark title 'spots', \
     NaN with linespoints lc rgb grey lw 1.2 dt (4, 3) pt 6 ps 0.4*mark title 'pools'
