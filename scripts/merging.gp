# The load at which neighbouring spots merge, and the values there, from the loads next to it on either side.
#
# usage: gnuplot -d -c scripts/merging.gp SURFACE DETAILS LIGHTEST GUESS HEAVIEST
#    SURFACE: name for the table. DETAILS: the table of details, with Delta = 1. The fits use the loads between LIGHTEST
#    and HEAVIEST, below and above GUESS, a first value of the merging load.
#
# Towards merging the saddle's gap and, above merging, the square of the saddle's pressure vanish in proportion to the
# distance in load, except for a logarithm, because the contact there is a narrow strip. With s for either, P is fitted
# as P_m + s (c_1 + c_2 ln s + c_3 ln^2 s). The values at distances d from the P_m found from below are fitted as
# v_m + d (c_1 + c_2 ln d + c_3 d). Error estimates are the changes for c_3 = 0; those of the values include the effect
# of the load's error.
surface = ARG1
details = ARG2
lightest = real(ARG3)
merging = real(ARG4)
heaviest = real(ARG5)
set fit quiet logfile '/dev/null' limit 1e-13 maxiter 1000
set print '-'

# Unit of s and d, so that the coefficients are of order one.
unit = heaviest - merging
load = "column('pbar_over_pstar')"
max(a, b) = a > b ? a : b
pick(side, p) = side eq 'below' ? p > lightest && p < merging : p > merging && p < heaviest
small(side, gap, pressure) = (side eq 'below' ? gap : pressure**2)/unit
by_saddle(s) = v_m + s*unit*(c_1 + c_2*log(s) + c_3*log(s)**2)
by_load(d) = v_m + d*(c_1 + c_2*log(d) + c_3*d)

# Fits a column without and with c_3, which sets v_m and its error. Rows at small distances have larger weights.
fit_both(formula, chosen, column, distance) = sprintf( \
   'do for [free in "c_1,c_2 c_1,c_2,c_3"] { rough = v_m; c_1 = -1.0; c_2 = 0.1; c_3 = free eq "c_1,c_2" ? 0.0 : 0.01; v_m = 0.5;' \
   .' eval "fit %s details using (%s ? %s : NaN):''%s'':(%s) yerrors via v_m,".free }; error = abs(v_m - rough)', \
   formula, chosen, distance, column, distance)

v_m = 0.0
do for [side in 'below above'] {
   chosen = "pick('".side."', ".load.")"
   eval fit_both('by_saddle(x)', chosen, 'pbar_over_pstar', \
                 "small('".side."', column('saddle_gap_over_amplitude'), column('saddle_pressure_over_pstar'))")
   line = sprintf('%10s %7s %16.9f %21.1e', surface, side, v_m, error)
   if (side eq 'below') { merging_load = v_m; load_error = error }
   do for [name in 'mean_gap_over_amplitude contact_area_fraction peak_pressure_over_pstar'] {
      eval fit_both('by_load(x)', chosen, name, '(abs('.load.' - merging_load)/unit)')
      error = error + load_error/unit*abs(c_1 + c_2*log(load_error/unit))
      line = line.sprintf(' %'.max(23, strlen(name)).'.9f %'.(strlen(name) + 6).'.1e', v_m, error)
   }
   print line
}
