# The picture of the sizes of spots and pools: how many of a load have at least an area, as steps downwards. The steps
# stand in folder.'/spots1' ... and folder.'/pools1' ...
shade(i) = loads_shown == 1 ? 0.6 : (i - 1.0)/(loads_shown - 1)
steps(kind, i) = sprintf('%s/%s%d', folder, kind, i)
set cbrange [0:1]
set logscale xy
set xrange [least:most]
set yrange [0.8:highest]
set format x '10^{%T}'
set format y '10^{%T}'
set xlabel 'area '.area.'/'.area_0
set ylabel 'number of at least this area'
set lmargin at screen 80.0/width
set rmargin at screen 1 - 165.0/width
set bmargin at screen 67.5/height
set tmargin at screen 1 - 42.0/height
set multiplot
# Spots are blue; pools, orange and thin, have a plot of their own over this one, for its colours.
set key at screen 1 - 155.0/width, graph 1 left top samplen 1.5
plot for [i = 1:loads_shown] steps('spots', i) using 1:2 with steps lc palette cb shade(i) lw 1.5 title load_name[i], \
     NaN with lines lc rgb blue lw 1.5 title 'spots', \
     NaN with lines lc rgb red lw 0.8 title 'pools'
unset label 1
unset key
unset grid
eval of_gap
set cbrange [-0.2:1]
plot for [i = 1:loads_shown] steps('pools', i) using 1:2 with steps lc palette cb shade(i) lw 0.8
unset multiplot
