#!/bin/sh
# Errors of fits from the literature and of asymptotes: contact area and mean gap of the two-dimensional wave.
#
# Fits: R. L. Jackson & J. L. Streator, Wear 261 (2006) 1337-1347, contact area; A. Rostami & R. L. Jackson,
# Proc. IMechE J: J. Eng. Tribol. 227 (2013), mean gap.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure fits 'errors of fits and asymptotes of the two-dimensional wave' "$@"
run_decks fits
# Each row of the summary, names first, and the theory's row of the same load beside it.
awk '/^#/ { next } NR == FNR { row[++rows] = $0; next } { print row[++joined], $0 }' \
   outputs/fits/fits.summary.dat outputs/fits/fits.theory.dat >outputs/fits/fits.joined
draw_figure 640 320 <<'EOF'
joined = 'outputs/fits/fits.joined'

# Jackson and Streator, A_1 and A_2 being (23) and (24).
area_fit(p, a1, a2) = p < 0.8 ? a1*(1 - p**1.51) + a2*p**1.04 : a2
# Rostami and Jackson.
gap_fit(p) = (1 - sqrt(p))**2.5
error(formula, exact) = abs(formula/exact - 1)
area(formula) = error(formula, column('contact_area_fraction'))
gap(formula) = error(formula, column('mean_gap_over_amplitude'))
up_to(most, value) = column('pbar_over_pstar') < most ? value : NaN
set datafile columnheaders
P = 'pbar_over_pstar'

# Where a curve dips the error changes its sign. The asymptotes at light load mean nothing near closure.
set multiplot layout 1, 2 margins 0.11, 0.975, 0.17, 0.89 spacing 0.12, 0
set xlabel load
set xrange [0:1]
set xtics 0.2 format '%.1f'
set mxtics 2
set logscale y
set yrange [1e-6:1]
set ytics 10 format '10^{%T}'
set key bottom center samplen 2.5 spacing 1.0 font ',10'
set ylabel 'relative error' offset 0.4, 0
set title 'contact area {/:Italic A}_{real}' offset 0, -0.5
A_1 = 'hertz_contact_area_fraction'
A_2 = 'crack_contact_area_fraction'
plot joined using P:(area(column(A_1))) with lines ls 2 title '(23)', \
     '' using P:(area(column('light_longer_contact_area_fraction'))) with lines ls 31 dt (7, 4) title '(23), longer', \
     '' using P:(area(column(A_2))) with lines ls 1 title '(24)', \
     '' using P:(area(column('closure_longer_contact_area_fraction'))) with lines ls 31 title '(24), longer', \
     '' using P:(area(area_fit(column(P), column(A_1), column(A_2)))) with lines ls 32 dt solid \
        title 'Jackson and Streator'
unset ylabel
set title 'mean gap {/:Italic G}'
plot joined using P:(up_to(0.5, gap(column('light_eq29_mean_gap_over_amplitude')))) with lines ls 2 title '(29)', \
     '' using P:(up_to(0.5, gap(column('light_lattice_mean_gap_over_amplitude')))) with lines ls 4 \
        title '(29), the whole lattice', \
     '' using P:(gap(column('light_longer_mean_gap_over_amplitude'))) with lines ls 31 dt (7, 4) title '(29), longer', \
     '' using P:(gap(column('crack_mean_gap_over_amplitude'))) with lines ls 1 title '(30)', \
     '' using P:(gap(column('closure_longer_mean_gap_over_amplitude'))) with lines ls 31 title '(30), longer', \
     '' using P:(gap(gap_fit(column(P)))) with lines ls 32 dt solid title 'Rostami and Jackson'
unset multiplot
EOF
