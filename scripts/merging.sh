#!/bin/sh
# How the gap at the saddle closes where spots merge: its local exponent in the distance from the merging load, beside
# the logarithmic law of scripts/merging.gp and the exponent 6/5, published with that of the flow, 3.45 = 3 x 1.15.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure merging 'the gap at the saddle where spots merge' "$@"
mkdir -p outputs/merging
# Slopes between neighbouring loads below merging, at their geometric mean; errors are those of the gaps and of the
# merging load.
awk '/^#/ { next }
   FILENAME ~ /merging/ { if ($1 == "wave_2d" && $2 == "below") { merging = $3; load_error = $4 } ; next }
   !n { for (n = 1; n <= NF; n++) place[$n] = n; print "distance gap exponent error"; next }
   { d = merging - $place["pbar_over_pstar"]; g = $place["saddle_gap_over_amplitude"]
     e = $place["saddle_gap_over_amplitude_error"]/g + load_error/(d > 0 ? d : 1)
     if (d <= 0) exit
     if (last) printf "%.9e %.9e %.9e %.2e\n", sqrt(d*last), sqrt(g*last_g), log(g/last_g)/log(d/last),
                      (e + last_e)/log(last/d)
     last = d; last_g = g; last_e = e }' \
   outputs/reference/merging.dat outputs/reference/wave_2d.dat >outputs/merging/exponents.dat
draw_figure 480 340 <<'EOF'
exponents = 'outputs/merging/exponents.dat'
set datafile columnheaders
set fit quiet logfile '/dev/null'
# distance = gap L, L = c_1 + c_2 ln gap + c_3 ln^2 gap: the local exponent is L/(L + c_2 + 2 c_3 ln gap).
c_1 = 1.0
c_2 = -0.1
c_3 = 0.01
law(gap) = c_1 + c_2*log(gap) + c_3*log(gap)**2
fit [*:*] x*law(x) exponents using (column('distance') < 0.02 ? column('gap') : NaN):'distance': \
   (0.001*column('distance')) yerrors via c_1, c_2, c_3
by_law(gap) = law(gap)/(law(gap) + c_2 + 2*c_3*log(gap))
set logscale x
set xrange [1e-6:0.3]
set format x '10^{%T}'
set xlabel '({/:Italic p̄}_m − '.p_bar.') / '.p_star
set ylabel 'd ln {/:Italic g}_{saddle} / d ln ({/:Italic p̄}_m − '.p_bar.')'
set yrange [1:1.6]
set ytics 0.1 format '%.1f'
set key top left
visible = 0.006   # error bars that are longer than their point is high
plot 1.2 with lines ls 2 title '6/5', \
     exponents using 'distance':(by_law(column('gap'))) with lines ls 31 title 'logarithmic law', \
     '' using 'distance':'exponent':(column('error') > visible ? column('error') : NaN) with yerrorbars ls 12 ps 0.6*mark, \
     '' using 'distance':'exponent' with points ls 12 ps 0.6*mark title 'between neighbouring loads'
EOF
