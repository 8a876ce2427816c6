#!/bin/sh
# How close the guaranteed bounds of the energy are on grids of 32 to 1024 points a side: the wave and a rough surface,
# beside the error of the grid's own energy and its estimate. outputs/bounds/DECK.width.dat has times too, as measured.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure bounds 'guaranteed bounds on grids' "$@"
mkdir -p outputs/bounds
# measure DECK FINEST POINTS...: a row for each grid; the truth is the middle of the finest grid's bounds.
measure() {
   deck=$1
   shift
   for points in "$@"; do
      # The log says when the load was solved, and when the bounds were written.
      seconds=$("$wavycon" "inputs/$deck.nml" --set "method.grid_points=$points" --set "scene.case=$deck" \
         --output outputs/bounds | awk '/solved and measured|tables written/ { gsub(/[][]/, " "); printf "%s ", $1 }')
      for table in bounds summary; do
         awk -v of=$table '/^#/ { next } !n { for (n = 1; n <= NF; n++) at[$n] = n; next }
            function value(name) { return $at[name] }
            of == "bounds" { printf "%.16e %.16e ", value("energy_lower_over_pstar_amplitude"),
               value("energy_upper_over_pstar_amplitude") }
            of == "summary" { p = value("pbar_over_pstar"); printf "%.16e %.3e ",
               p*value("approach_over_amplitude") - value("elastic_energy_over_pstar_amplitude"),
               p*value("mean_gap_over_amplitude_error") + value("elastic_energy_over_pstar_amplitude_error") }' \
            "outputs/bounds/$deck.$table.dat"
      done
      echo "$points $seconds"
   done >"outputs/bounds/$deck.grids"
   awk '{ lower[NR] = $1; upper[NR] = $2; own[NR] = $3; told[NR] = $4; points[NR] = $5; solved[NR] = $6; all[NR] = $7 }
      END { truth = (lower[NR] + upper[NR])/2
         print "points seconds_solved seconds_all width error told"
         for (i = 1; i < NR; i++) { e = own[i] - truth
            print points[i], solved[i], all[i], (upper[i] - lower[i])/truth, (e < 0 ? -e : e)/truth, told[i]/truth } }' \
      "outputs/bounds/$deck.grids" >"outputs/bounds/$deck.width.dat"
}
measure bounds 32 64 128 256 512 1024 2048
measure bounds_rough 64 128 256 512 1024 2048
draw_figure 620 300 <<'GNUPLOT'
set datafile columnheaders
set logscale x 2
set logscale y
set format y '10^{%T}'
set xlabel 'points a side'
set xrange [25:1300]
set xtics (32, 64, 128, 256, 512, 1024)
set yrange [1e-10:1]
set multiplot layout 1, 2 margins 0.1, 0.965, 0.16, 0.88 spacing 0.1
do for [deck in 'bounds bounds_rough'] {
   table = 'outputs/bounds/'.deck.'.width.dat'
   set title deck eq 'bounds' ? 'wave, '.p_bar.' = 0.2 '.p_star : 'rough, '.p_bar.' = 0.02 '.p_star
   if (deck eq 'bounds') {
      set ylabel 'relative to the energy'
      unset key
   } else {
      unset ylabel
      set key bottom left samplen 2.5 font ',12'
   }
   plot table using 'points':'width' with linespoints ls 11 title 'width of the bounds', \
        '' using 'points':'error' with linespoints ls 12 title 'error of the energy', \
        '' using 'points':'told' with linespoints ls 13 title 'its estimate'
}
GNUPLOT
