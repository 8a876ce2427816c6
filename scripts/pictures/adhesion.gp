# The picture of the contact area with adhesion: the curve, pull-off, jump into full contact, and the loads.
set tmargin at screen 0.9
set xlabel load_label
set xrange [load_least:load_most]
set ylabel area_label
set yrange [area_low:area_high]
set ytics area_step
set key bottom right
is(kind) = strcol('point') eq kind
# Where the release rate differs much along the edge the model fails.
area_of(kind) = is(kind) && column('most_release_over_w') < 1.3 ? column(area_column) : NaN
plot run(1) index 0 using load_column:area_column with lines ls 4 title 'not reliable', \
     run(1) index 0 using load_column:(area_of('stable')) with lines ls 31 title 'stable', \
     run(1) index 0 using load_column:(area_of('unstable')) with lines ls 32 title 'unstable', \
     run(1) index 1 using load_column:(area_of('pull_off')) with points ls 11 title 'pull-off', \
     run(1) index 1 using load_column:(area_of('jump_to_full_contact')) with points ls 12 title 'jump into full contact', \
     run(1) index 2 using load_column:(area_of('stable')) with points ls 13 title 'loads'
