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
# A row of the summary, 15 columns, and the theory's row of the same load beside it.
awk '/^#/ { next } NR == FNR { row[++rows] = $0; next } { print row[++joined], $0 }' \
   outputs/fits/fits.summary.dat outputs/fits/fits.theory.dat >outputs/fits/fits.joined
draw_figure 640 320 <<'EOF'
joined = 'outputs/fits/fits.joined'

# Jackson and Streator, A_1 and A_2 being (23) and (24).
area_fit(p, a1, a2) = p < 0.8 ? a1*(1 - p**1.51) + a2*p**1.04 : a2
# Rostami and Jackson.
gap_fit(p) = (1 - sqrt(p))**2.5
error(formula, exact) = abs(formula/exact - 1)

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
plot joined using 1:(error($17, $5)) with lines ls 2 title '(23)', \
     '' using 1:(error($22, $5)) with lines lc rgb blue lw 1.1 dt (7, 4) title '(23), longer', \
     '' using 1:(error($18, $5)) with lines ls 1 title '(24)', \
     '' using 1:(error($24, $5)) with lines lc rgb blue lw 1.1 title '(24), longer', \
     '' using 1:(error(area_fit($1, $17, $18), $5)) with lines lc rgb red lw 1.4 title 'Jackson and Streator'
unset ylabel
set title 'mean gap {/:Italic G}'
plot joined using 1:($1 < 0.5 ? error($19, $3) : NaN) with lines ls 2 title '(29)', \
     '' using 1:($1 < 0.5 ? error($20, $3) : NaN) with lines ls 4 title '(29), the whole lattice', \
     '' using 1:(error($23, $3)) with lines lc rgb blue lw 1.1 dt (7, 4) title '(29), longer', \
     '' using 1:(error($21, $3)) with lines ls 1 title '(30)', \
     '' using 1:(error($25, $3)) with lines lc rgb blue lw 1.1 title '(30), longer', \
     '' using 1:(error(gap_fit($1), $3)) with lines lc rgb red lw 1.4 title 'Rostami and Jackson'
unset multiplot
