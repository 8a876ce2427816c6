#!/bin/sh
# Fig. 7: contact area of the two-dimensional wave against the mean pressure.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fig07 'Fig. 7, the contact area of the two-dimensional wave' "$@"
run_decks fig07 fig07_curves
draw_figure 480 380 "edge_level = $(header_value fig07 summary edge_level)" <<'EOF'
curves = table('fig07_curves', 'theory')
set xlabel load
set ylabel '{/:Italic A}_{real} / {/:Italic A}_0'
set xrange [0:1]
set yrange [0:1]
set xtics 0.2 format '%.1f'
set ytics 0.2 format '%.1f'
set mxtics 2
set mytics 2
set key bottom right
stats curves using "hertz_contact_area_fraction" nooutput
set label '(23)' at 0.97, STATS_max offset 0, -1.6 right
stats curves using "crack_contact_area_fraction" nooutput
set label '(24)' at 0.03, STATS_min offset 0, 1.6 left
plot curves using "pbar_over_pstar":"hertz_contact_area_fraction" with lines ls 2, \
     curves using "pbar_over_pstar":"crack_contact_area_fraction" with lines ls 2 title 'asymptotes (23), (24)', \
     'outputs/reference/wave_2d.dat' using "pbar_over_pstar":"contact_area_fraction" with lines ls 31 \
        title 'converged', \
     table('fig07', 'summary') using "pbar_over_pstar":"contact_area_fraction" with points ls 12 ps 0.85*mark \
        title sprintf('numerical, %s ≥ %g %s', p, edge_level, p_star), \
     'inputs/reference_2d.dat' using "pbar_over_pstar":"contact_area_fraction" with points ls 14 \
        title 'converged, other methods'
EOF
