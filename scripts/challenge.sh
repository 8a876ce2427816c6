#!/bin/sh
# The kind of surface of the contact-mechanics challenge: contact area, mean gap and stiffness against the pressure.
#
# The values of reference/challenge.dat, of two surfaces, beside the deck's own run of the first on 2048 x 2048 points.
# Persson's line: B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840-3861, A/A0 = erf(sqrt(2) pbar/(E* rms slope)).
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure challenge "contact area, mean gap and stiffness of rough surfaces" "$@"
run_decks challenge
draw_figure 620 480 <<'EOF'
values = 'outputs/reference/challenge.dat'
E_star = 25.0   # [MPa], of the deck; the slope is 1
set datafile columnheaders

set logscale x
set xrange [2e-5:0.2]
set xtics 10 format '10^{%T}'
pressure = '{/:Italic p̄}/({/:Italic E}* {/:Italic h}′_{rms})'
of_load = 'pressure_over_e_star_slope'
of_seed(seed, value) = column('seed') == seed ? value : NaN
persson(p) = erf(sqrt(2)*p)

# The area is kappa pbar/(E* rms slope) at light loads: the mean of kappa at those up to `light`.
light = 3.1e-3
stats values using (column(of_load) < light ? column('contact_area_fraction')/column(of_load) : NaN) name 'kappa' nooutput
kappa = kappa_mean

set multiplot layout 2, 2 margins 0.11, 0.975, 0.105, 0.975 spacing 0.13, 0.11
set key bottom right samplen 2.5 spacing 1.0 font ',11'
unset xlabel
set logscale y
set yrange [3e-5:0.5]
set ytics 10 format '10^{%T}'
set ylabel '{/:Italic A}/{/:Italic A}_{0}' offset 0.6, 0
plot kappa*x with lines ls 5 title sprintf('{/:Italic κ} = %.2f', kappa), \
     2*x with lines ls 4 title '{/:Italic κ} = 2', \
     persson(x) with lines ls 2 title 'Persson', \
     values using of_load:(of_seed(1, column('contact_area_fraction'))) with linespoints ls 31 title 'seed 1', \
     values using of_load:(of_seed(2, column('contact_area_fraction'))) with linespoints ls 32 title 'seed 2', \
     table('challenge', 'summary') using (column('mean_pressure')/E_star):'contact_area_fraction' with points ls 13 \
        title '2048² points'

unset logscale y
set yrange [1.5:2.6]
set ytics 0.2 format '%.1f'
set ylabel '{/:Italic A E}* {/:Italic h}′_{rms}/({/:Italic A}_{0} {/:Italic p̄})' offset 0.4, 0
unset key
plot kappa with lines ls 5, 2 with lines ls 4, persson(x)/x with lines ls 2, \
     for [seed = 1:2] values using of_load:(of_seed(seed, column('contact_area_fraction')/column(of_load))): \
        (column('contact_area_fraction_error')/column(of_load)) with yerrorbars ls (30 + seed) dt solid, \
     for [seed = 1:2] values using of_load:(of_seed(seed, column('contact_area_fraction')/column(of_load))) \
        with lines ls (30 + seed), \
     table('challenge', 'summary') using (column('mean_pressure')/E_star): \
        (column('contact_area_fraction')*E_star/column('mean_pressure')) with points ls 13

set xlabel pressure offset 0, 0.3
set yrange [0:3]
set ytics 0.5 format '%.1f'
set ylabel 'mean gap [µm]' offset 0.4, 0
plot for [seed = 1:2] values using of_load:(of_seed(seed, column('mean_gap'))) with linespoints ls (30 + seed), \
     table('challenge', 'summary') using (column('mean_pressure')/E_star):'mean_gap' with points ls 13

set logscale y
set yrange [1e-3:20]
set ytics 10 format '10^{%T}'
set ylabel '−d{/:Italic p̄}/d(mean gap) [MPa/µm]' offset 0.6, 0
plot for [seed = 1:2] values using of_load:(of_seed(seed, column('stiffness'))) with linespoints ls (30 + seed)
unset multiplot
EOF
