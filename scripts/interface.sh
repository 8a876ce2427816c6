#!/bin/sh
# What the interface does: contact stiffness and resistance, partial slip and adhesion of the two-dimensional wave.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure interface 'stiffness, resistance, partial slip and adhesion of the two-dimensional wave' "$@"
run_decks contact_resistance slip_loop pull_off
draw_figure 640 520 "p_star_loop = $(header_value slip_loop summary 'p*')" <<'EOF'
set datafile columnheaders
set multiplot
set border 3 lw 0.7
set tics out nomirror

# Above left: stiffness and resistance.
eval margins(0.095, 0.43, 0.605, 0.945)
set border 11
set xlabel load offset 0, 0.3
set xrange [0:1]
set xtics 0.2 format '%.1f'
set logscale y
set yrange [0.02:200]
set ytics 10 format '10^{%T}'
set ylabel "contact stiffness ".'[{/:Italic p}*/{/:Italic Δ}]' offset 0.5, 0
set logscale y2
set y2range [1e-9:1e-5]
set y2tics 10 format '10^{%T}'
set y2label 'resistance [Ω mm²]' offset -0.8, 0
set key top center samplen 2.2 font ',12'
set title 'stiffness and resistance' offset 0, -0.5
all = table('contact_resistance', 'interface')
plot all using 'pbar_over_pstar':'contact_stiffness_normalised' with lines ls 31 title 'stiffness', \
     all using 'pbar_over_pstar':'contact_resistance' axes x1y2 with lines ls 32 title 'resistance'
unset logscale
unset y2tics
unset y2label
set border 3

# Above right: loops.
eval margins(0.645, 0.965, 0.605, 0.945)
set title 'loops of tangential load' offset 0, -0.5
set xlabel 'displacement [nm]' offset 0, 0.3
set ylabel '{/:Italic Q} / ({/:Italic f p̄})' offset 0.8, 0
set autoscale x
set xrange [-400:400]
set xtics 200 format '%g'
set yrange [-1:1]
set ytics 0.5 format '%.1f'
unset key
loops = table('slip_loop', 'slip_loop')
limit = 0.5*0.4*p_star_loop
do for [i = 1:3] {
   stats loops index i - 1 using (1e6*column('displacement')):(column('tangential_load')/limit) nooutput
   set label sprintf('%.1f', STATS_max_y) at STATS_pos_max_y + 7, STATS_max_y - 0.03 left tc ls 30 + i font ',11'
}
plot for [i = 1:3] loops index i - 1 using (1e6*column('displacement')):(column('tangential_load')/limit) \
        with lines ls 30 + i dt solid
unset label

# Below left: where the contact sticks and slips under the middle load.
eval margins(0.095, 0.36, 0.1, 0.44)
set border 15
set size ratio -1
set xrange [0:1]
set yrange [0:1]
set xtics 0.5 format '%g'
set ytics 0.5 format '%g'
set xlabel '{/:Italic x} [mm]' offset 0, 0.3
set ylabel '{/:Italic y} [mm]' offset 0.6, 0
set title '{/:Italic Q} = 0.7 {/:Italic f p̄}: stick, slip, open' offset 0, -0.5
eval of_contact
set cbrange [1:2.7]
unset colorbox
# The map ends before its first row and column come again.
plot for [k = 0:1] for [l = 0:1] table('slip_loop', 'slip_map') index 1 \
        using (k + column('x')):(l + column('y')):(column('slip_state') > 0 ? column('slip_state') : NaN) with image

# Below right: adhesion.
set size noratio
set border 3
eval margins(0.48, 0.965, 0.1, 0.44)
set xlabel load offset 0, 0.3
set ylabel '{/:Italic A} / {/:Italic A}_0' offset -0.2, 0
set xrange [-0.1:0.3]
set yrange [0:1]
set xtics 0.1 format '%.1f'
set ytics 0.2 format '%.1f'
set title 'area with adhesion' offset 0, -0.5
set key bottom right samplen 2.2 font ',12'
curve = table('pull_off', 'adhesion')
P = 'pbar_over_pstar'
A = 'contact_area_fraction'
of(branch, point) = strcol('branch') eq branch && (point eq 'any' || strcol('point') eq point) ? column(A) : NaN
plot for [branch in 'spots pools'] curve index 0 using P:(of(branch, 'any')) with lines ls 32, \
     for [branch in 'spots pools'] curve index 0 using P:(of(branch, 'stable')) with lines ls 31, \
     NaN with lines ls 31 title 'stable', NaN with lines ls 32 title 'unstable', \
     for [branch in 'spots pools'] curve index 1 using P:(of(branch, 'pull_off')) with points ls 11 \
        title branch eq 'spots' ? 'pull-off' : '', \
     curve index 1 using P:(of('spots', 'jump_to_pools')) with points ls 13 title 'jump to pools', \
     curve index 1 using P:(of('pools', 'jump_to_full_contact')) with points ls 12 title 'jump to full contact'
unset multiplot
EOF
