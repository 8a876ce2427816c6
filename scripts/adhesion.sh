#!/bin/sh
# Adhesion of the two-dimensional wave: contact area against the load for five works of adhesion, and pull-off and jumps
# against the work of adhesion, beside an approximate theory.
#
# M. Ciavarella, J. Mech. Phys. Solids 114 (2018) 78: under the load P1 - sqrt(2 w' A'(P1)/G''(P1)) the contact is taken
# for that without adhesion under P1; w' = w/(p* Delta), A is the contact area fraction, G the mean gap over Delta.
set -eu
# shellcheck source=scripts/figure_common.sh
. "$(dirname "$0")/figure_common.sh"
start_figure adhesion 'contact area, pull-off and jumps of the two-dimensional wave with adhesion' "$@"
run_decks adhesion_superposition
curves='0.01 0.05 0.1 0.2 0.5'
all='0.002 0.005 0.01 0.015 0.02 0.03 0.04 0.05 0.06 0.07 0.08 0.1 0.12 0.15 0.18 0.2 0.202 0.22 0.25 0.3 0.35 0.4 0.5'
mkdir -p outputs/adhesion
points=outputs/adhesion/critical.dat
approximate=outputs/adhesion/superposition.dat
echo 'w branch point pbar_over_pstar contact_area_fraction' >"$points"
echo 'w pbar_over_pstar contact_area_fraction' >"$approximate"
for w in $all; do
   # Critical points do not depend on the deck's areas; p* = sqrt(2) pi. Status 2: the smallest areas are not solved.
   areas=0.5
   for curve in $curves; do
      [ "$w" != "$curve" ] || areas=
   done
   work=$(LC_ALL=C awk "BEGIN { printf \"%.17g\", $w*sqrt(2)*atan2(0, -1) }")
   said=$("$wavycon" --quiet inputs/adhesion.nml --set scene.case="adhesion_$w" \
      --set interface.work_of_adhesion="$work" ${areas:+--set load.contact_area_fraction=$areas} 2>&1) || {
      status=$?
      [ "$status" -eq 2 ] || { echo "$said" >&2; exit "$status"; }
   }
   LC_ALL=C awk -v w="$w" '
      /^#/ { next }
      $1 == "load" { for (i = 1; i <= NF; i++) place[$i] = i; block++; next }
      block == 2 && NF > 0 {
         print w, $place["branch"], $place["point"], $place["pbar_over_pstar"], $place["contact_area_fraction"]
      }' "outputs/adhesion_$w/adhesion_$w.adhesion.dat" >>"$points"
   # The approximate theory's curve, and its extremes between both ends of spots and of pools.
   LC_ALL=C awk -v w="$w" -v curve="$approximate" '
      FNR == 1 { found = 0; file++ }
      /^#/ { next }
      !found { for (i = found = 1; i <= NF; i++) place[$i] = i; next }
      file == 1 { area[$place["load"]] = $place["contact_area_fraction"]; next }
      $place["mean_gap_curvature"] > 0 {
         unloaded = $place["pbar_over_pstar"]
         p = unloaded - sqrt(2*w*$place["contact_area_slope"]/$place["mean_gap_curvature"])
         if (unloaded > 0.2286 && pools == 0) print "" >>curve
         print w, p, area[$place["load"]] >>curve
         if (unloaded < 0.2286) { of_spots[++spots] = p; next }
         load[++pools] = p
         if (pools == 1 || p > load[most]) most = pools
      }
      END {
         print "" >>curve
         for (i = 2; i < spots; i++) {
            if (!least && of_spots[i] < of_spots[i - 1] && of_spots[i] < of_spots[i + 1]) least = i
            if (least && of_spots[i] > of_spots[i - 1] && of_spots[i] > of_spots[i + 1]) largest = i
         }
         if (least) print w, "superposition_spots", "pull_off", of_spots[least], "NaN"
         if (largest) print w, "superposition_spots", "jump_to_pools", of_spots[largest], "NaN"
         print w, "superposition", "jump_to_full_contact", load[most], "NaN"
         for (i = 2; i < most; i++) if (load[i] < load[i - 1] && load[i] < load[i + 1])
            print w, "superposition_pools", "pull_off", load[i], "NaN"
      }' outputs/adhesion_superposition/adhesion_superposition.summary.dat \
      outputs/adhesion_superposition/adhesion_superposition.interface.dat >>"$points"
done
draw_figure 720 345 "curves = '$curves'" "points = '$points'" "approximate = '$approximate'" <<'END'
set datafile columnheaders
# Rows of the other branch do not interrupt a curve.
set datafile missing NaN
set multiplot
set border 3 lw 0.7
set tics out nomirror
P = 'pbar_over_pstar'
A = 'contact_area_fraction'
w = '{/:Italic w}/('.p_star.' '.Delta.')'

# Left: area against load. Under the largest work of adhesion no spots are stable.
eval margins(0.07, 0.455, 0.155, 0.915)
set xlabel load offset 0, 0.3
set ylabel '{/:Italic A} / {/:Italic A}_0' offset 0.6, 0
set xrange [-0.4:1.05]
set yrange [0:1]
set xtics 0.2 format '%.1f'
set ytics 0.2 format '%.1f'
set title 'contact area' offset 0, -0.5
set key bottom right samplen 2.2 font ',12'
array colours[5] = [violet, blue, green, '#a67c00', red]
curve(i) = table('adhesion_'.word(curves, i), 'adhesion')
is(branch, stable) = strcol('branch') eq branch && (!stable || strcol('point') eq 'stable') ? column(A) : NaN
chosen(i) = column('w') == real(word(curves, i))
plot for [i = 1:5] approximate using (chosen(i) ? column(P) : NaN):A with lines ls 5, \
     for [i = 1:5] for [branch in 'spots pools'] curve(i) index 2 using P:(is(branch, 0)) \
        with lines lc rgb colours[i] lw 1.1 dt (3, 2), \
     for [i = 1:4] curve(i) index 2 using P:(is('spots', 1)) with lines lc rgb colours[i] lw 1.6, \
     for [i = 1:5] curve(i) index 2 using P:(is('pools', 1)) with lines lc rgb colours[i] lw 1.6, \
     for [i = 1:5] points using (chosen(i) && strcol('point') eq 'end_of_branch' ? column(P) : NaN):A \
        with points pt 2 ps 0.6*mark lw 1.3 lc rgb colours[i], \
     for [i = 1:5] NaN with lines lc rgb colours[i] lw 1.6 title w.' = '.word(curves, i), \
     NaN with lines lc rgb black lw 1.1 dt (3, 2) title 'unstable under a load', \
     NaN with points pt 2 ps 0.6*mark lw 1.3 lc rgb black title 'end of a branch', \
     NaN with lines ls 5 title 'superposition'

# Right: pull-off and jumps.
eval margins(0.57, 0.975, 0.155, 0.915)
set xlabel w
set ylabel load offset 0.6, 0
set xrange [0:0.5]
set yrange [-0.4:0.6]
set xtics 0.1
set title 'pull-off and jumps' offset 0, -0.5
set key top right samplen 2.2
of(branch, point) = strcol('branch') eq branch && strcol('point') eq point ? column(P) : NaN
plot for [branch in 'spots pools'] points using 'w':(of('superposition_'.branch, 'pull_off')) with lines ls 5, \
     points using 'w':(of('superposition_spots', 'jump_to_pools')) with lines ls 5, \
     points using 'w':(of('superposition', 'jump_to_full_contact')) with lines ls 5 title 'superposition', \
     points using 'w':(of('pools', 'jump_to_full_contact')) with linespoints ls 31 dt solid \
        title 'jump into full contact', \
     points using 'w':(of('spots', 'jump_to_pools')) with linespoints ls 33 dt solid title 'jump from spots to pools', \
     points using 'w':(of('pools', 'jump_to_spots')) with linespoints ls 35 dt solid title 'jump from pools to spots', \
     points using 'w':(of('pools', 'pull_off')) with linespoints ls 32 dt solid title 'pull-off from pools', \
     points using 'w':(of('spots', 'pull_off')) with linespoints ls 34 dt solid title 'pull-off from spots'
unset multiplot
END
