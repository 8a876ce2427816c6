#!/bin/sh
# Contacts on layers: the area of a coated rough surface against the thickness of its coating, between that of the body
# below and that of the coating's material; and of a gasket against the pressure, for sheets of several thicknesses.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure layers 'contact areas on a coating and under a gasket' "$@"
mkdir -p outputs/layers
# areas DECK THICKNESS...: the columns thickness, load, pressure and area for each thickness.
areas() {
   deck=$1
   shift
   echo 'thickness load pressure area'
   for thickness in "$@"; do
      "$wavycon" --quiet "inputs/$deck.nml" --set "material.layer_thickness=$thickness" \
         --set "scene.case=$deck" --set output.contours=F --set output.histograms=F --output outputs/layers
      awk -v thickness="$thickness" '/^#/ { next } !n { for (n = 1; n <= NF; n++) at[$n] = n; next }
         { print thickness, $at["load"], $at["mean_pressure"], $at["contact_area_fraction"] }' \
         "outputs/layers/$deck.summary.dat"
   done
}
areas coating 0.002 0.005 0.01 0.02 0.05 0.1 0.2 0.5 1 2 5 10 20 50 >outputs/layers/coating.areas.dat
areas gasket 0.1 0.2 0.5 10 >outputs/layers/gasket.areas.dat
draw_figure 640 300 <<'GNUPLOT'
set datafile columnheaders
n(t) = t eq '0.1' ? 0 : t eq '0.2' ? 1 : t eq '0.5' ? 2 : -20
set datafile missing NaN
set multiplot layout 1, 2
set logscale x
set ylabel 'contact area fraction'
set yrange [0:0.8]
set xlabel 'thickness of the coating [µm]'
set format x '%g'
set title 'carbon on aluminium'
set key center left samplen 1.5
plot for [k = 0:2] 'outputs/layers/coating.areas.dat' \
   using (column('load') == 3 - k ? column('thickness') : NaN):'area' with linespoints ls 31 + k \
   title word('500 100 20', k + 1).' MPa'
unset ylabel
set xlabel 'mean pressure [MPa]'
set title 'rubber sheet, thickness [mm]'
set key top left samplen 1.5
plot for [t in '0.1 0.2 0.5 10'] 'outputs/layers/gasket.areas.dat' \
   using (column('thickness') == real(t) ? column('pressure') : NaN):'area' with linespoints ls 31 + n(t) title t
unset multiplot
GNUPLOT
