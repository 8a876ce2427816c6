!> The text of a run's log: the input, the tables of the solved loads and of the largest stresses, and notes on what a
!> user should know of input and solutions.
module wavycon_notes
   use wavycon_series_contact, only: paper_errors
   use wavycon_contact_tuning, only: border, least_concentration
   use wavycon_error, only: exit_fine, exit_not_converged
   use wavycon_head_lines, only: head_lines
   use wavycon_kinds, only: dp, ieee_is_nan, pi
   use wavycon_map_statistics, only: map_statistics
   use wavycon_methods, only: solvers_for
   use wavycon_plain_text, only: escaped, exact_number, in_quotes, integer_text, listed, percent, short_number
   use wavycon_quantities, only: approach, border_load, concentrated_load, contact_area, is_known, last_before, &
      main_quantities, mean_gap, peak_pressure, percolation
   use wavycon_results, only: results_type, status_tables
   use wavycon_run_log, only: run_log
   use wavycon_scene, only: by_approach, by_contact_area, by_percolation, by_pressure, by_yield, scene_type, &
      target_words
   use wavycon_solution_record, only: above_hardness, by_beale, by_grid, by_series, converged, iteration_limit, &
      not_accurate, not_found, solution_record, solver_names, status_name, unresolved
   use wavycon_surface, only: surface_type
   use wavycon_units, only: meant_unit
   implicit none (type, external)
   private

   public :: note_loads, note_scene, outcome, show_loads, show_scene, show_stresses, sum_up

   !> A row of a table of the log, which grows column by column, together with the line of the columns' names.
   type :: log_line
      character(:), allocatable :: names, words   !! the line of names, and the row
   contains
      procedure :: start, add
   end type log_line

contains

   !> Writes the input in effect: deck, surface, material, method and loads, and notes on suspicious values.
   subroutine show_scene(results, logger)
      type(results_type), intent(in) :: results   !! with the scene and the started solver
      type(run_log), intent(inout) :: logger

      real(dp), parameter :: far_beyond = 10.0_dp
      character(:), allocatable :: words
      real(dp) :: loads(size(results%scene%target))

      associate (scene => results%scene, surface => results%solver%surface)
         call logger%say(head_lines(scene, surface, results%method, ''))
         words = scene%deck_path(index(scene%deck_path, '/', back=.true.) + 1:)
         if (index(words//'.nml', '.nml') > 1) words = words(:index(words//'.nml', '.nml') - 1)
         if (.not. scene%scene_values%case%is_given .and. words /= '-' .and. index(scene%case, words) /= 1) &
            call logger%note('the results have the name '//scene%case// &
                             ", with '_' for characters of the deck's name")
         loads = scene%target
         words = trim(target_words(scene%loads_by))
         if (surface%has_free_edges .and. allocated(scene%mean_pressure)) then
            loads = surface%nominal_area()*scene%mean_pressure
            words = 'force'
         else if (scene%p_star <= 0.0_dp) then
            loads = scene%mean_pressure
            words = 'pbar'
         end if
         if (scene%loads_by == by_percolation) then
            words = words//' of '//scene%load%percolates%text
         else
            words = words//' from '//short_number(minval(loads))//' to '//short_number(maxval(loads))
         end if
         call logger%say('loads: '//integer_text(size(loads))//', '//words)
         if (results%sharing%words() /= '') call logger%say('ranks: '//results%sharing%words())
         if (scene%loads_by == by_pressure .and. scene%p_star > 0.0_dp .and. .not. surface%has_free_edges .and. &
             minval(scene%target) > far_beyond) call logger%note('all loads are more than '// &
            short_number(far_beyond)//' times p*, which closes the gap everywhere. Do the units agree, and are '// &
            'loads over p* no percentages?')
         call note_scene(scene, logger)
      end associate
   end subroutine show_scene

   !> Notes what is suspicious in a scene, before its loads are solved: other words for units; decimal commas; a unit of
   !> pressure without a modulus; a doubtful height map; if the deck has units, a surface that is too steep for the
   !> theory; a surface that is almost flat, most likely by a mistake of units.
   subroutine note_scene(scene, logger)
      type(scene_type), intent(in) :: scene
      type(run_log), intent(inout) :: logger

      !> The relative error of the theory of small slopes is of the order of the slope squared, here a tenth.
      real(dp), parameter :: steepest = 0.3_dp
      !> Heights in m beside sides in um make slopes a million times smaller. Real slopes are 1e-4 (polished silicon) to
      !> 10, so that such a mistake gives slopes up to 1e-5.
      real(dp), parameter :: flattest = 1e-5_dp
      character(:), allocatable :: borders, cause, verdict
      logical :: is_flat

      call note_unit('pressure_unit', scene%pressure_unit)
      call note_unit('length_unit', scene%length_unit)
      if (scene%decimal_commas /= '') call logger%note("a comma separates numbers: '0,2' is 0 and 2. If decimals "// &
         'are meant, write them with a point: '//scene%decimal_commas(3:))
      if (scene%scene_values%pressure_unit%is_given .and. .not. scene%gives_modulus) call logger%note( &
         'no modulus is given: E* is 1 ['//scene%pressure_unit//']')
      if (allocated(scene%map)) call note_map(scene, scene%map, logger)
      is_flat = scene%roughness%slope > 0.0_dp .and. scene%roughness%slope < flattest
      if (.not. (is_flat .or. (scene%has_units .and. scene%roughness%slope > steepest))) return
      verdict = '; the theory needs small ones.'
      if (is_flat) verdict = '; those of real surfaces are larger.'
      borders = ''
      cause = 'Are amplitudes and wavelengths in one unit?'
      if (allocated(scene%map)) then
         if (scene%surface_values%kind%text == 'file') &
            cause = 'Do height_scale, and the sides of the cell, suit the units of the heights?'
         if (any(scene%map%is_broken_along([1, 2]))) borders = ', with the steps across its borders'
      end if
      call logger%note('the slopes of the surface are '//short_number(scene%roughness%slope)//' (rms)'//borders// &
                   verdict//' '//cause)

   contains

      !> Notes that a label is another word for a unit.
      subroutine note_unit(key, label)
         character(*), intent(in) :: key, label

         if (meant_unit(label) /= '') call logger%note(key//" = '"//escaped(label)//"' is no unit that is known: "// &
            'it is shown as it is, and nothing is converted to it. Did you mean '//in_quotes(meant_unit(label))//'?')
      end subroutine note_unit

   end subroutine note_scene

   !> Notes what is suspicious in a height map: sides that seem to be exchanged, unequal steps, filters that leave
   !> nothing out or almost everything, a missing_value that does not occur or is not given, spikes, borders that do not
   !> fit together or stand there twice, noise.
   subroutine note_map(scene, map, logger)
      type(scene_type), intent(in) :: scene
      type(map_statistics), intent(in) :: map   !! statistics of the scene's height map
      type(run_log), intent(inout) :: logger

      !> Least ratio of the rms slope by differences to the rms slope of the Fourier series. Noise that lowers the ratio
      !> to 0.9 takes a quarter or more of the contact area at light loads: see the table of src/core/map/README.md.
      real(dp), parameter :: least_ratio = 0.9_dp
      !> Least rms height over that of the waves that a filter removed.
      real(dp), parameter :: least_left = 1e-3_dp
      !> The same part below which it is rounding that a filter removes.
      real(dp), parameter :: rounding = 1e-12_dp
      character(:), allocatable :: remedies
      integer :: direction, i

      if (scene%has_units .and. index(map%assumed_sides, 'length_x') == 1) call logger%note( &
         'the side length_x = 1 ['//scene%length_unit//'] is assumed: neither the deck nor the file gives it')
      associate (sides => [scene%surface_values%length_x%number, scene%surface_values%length_y%number], &
                 points => max(map%points, map%changes%cropped_from))   ! to which the deck's sides belong
         if (all(map%points > 1) .and. scene%surface_values%length_x%is_given .and. &
             scene%surface_values%length_y%is_given) then
            if (are_near(sides(1)*points(1), sides(2)*points(2)) .and. &
                .not. are_near(sides(1)*points(2), sides(2)*points(1))) call logger%note( &
               'the points are '//short_number(sides(1)/points(1))//' apart along x and '// &
               short_number(sides(2)/points(2))//' along y. With length_x and length_y exchanged both would '// &
               'be alike')
         end if
      end associate
      associate (steps => map%changes%uneven_steps)
         if (steps(2) > 0.0_dp) call logger%note('the profile has unequal steps, from '//short_number(steps(1))// &
            ' to '//short_number(steps(2))//' ['//scene%length_unit//'], and is resampled to equal ones')
      end associate
      if (map%changes%short_wavelength > 0.0_dp .and. &
          map%changes%rms_of_short <= rounding*scene%roughness%height) call logger%note( &
         'no wave of the map is shorter than short_wavelength = '//short_number(map%changes%short_wavelength)// &
         ' ['//scene%length_unit//']. Do the units agree?')
      if (map%lacks_missing_value) call logger%note('no height of the file has the missing_value of the deck')
      if (allocated(map%without_unit)) call logger%note(escaped(map%without_unit)//' names no unit, as the other '// &
         'map does: its heights are taken in ['//scene%length_unit//']. height_scale and file2_scale change that')
      if (map%scales_unit) call logger%note('the file names the unit of its heights, and height_scale or '// &
         'file2_scale multiplies them as well')
      if (allocated(scene%two_maps)) then
         do i = 1, size(scene%two_maps)
            call note_filled(scene%two_maps(i), ' of body '//integer_text(i))
         end do
      else
         call note_filled(map, '')
      end if
      if (map%spikes > 0 .and. map%placeholders == 0) call logger%note( &
         integer_text(map%spikes)//' of the heights are far from all around them (kurtosis '// &
         short_number(map%kurtosis)//'): spikes of an instrument carry load that the surface does not. '// &
         'Remedy: despike = .true.')
      associate (changes => map%changes, height => scene%roughness%height)
         if (height < least_left*hypot(changes%rms_of_short, changes%rms_of_long)) call logger%note( &
            "filter = '"//trim(changes%filter)//"' leaves heights of "//short_number(height)//' ['// &
            scene%length_unit//'] (rms), less than a thousandth of what it removes. Is its cut-off in '// &
            'the unit of the sides?')
      end associate
      remedies = "edges = 'mirror', edges = 'window'"
      if (map%changes%detrend /= 'plane' .and. map%changes%detrend /= 'quadratic') &
         remedies = "detrend = 'plane', "//remedies
      do direction = 1, 2
         if (map%is_broken_along(direction)) call logger%note('along '//'xy'(direction:direction)// &
            ' the last heights differ from the first by '//short_number(map%border_step(direction))//' ['// &
            scene%length_unit//'] (rms), neighbours inside by at most '//short_number(map%largest_step(direction))// &
            '; such steps carry load. Remedies: '//remedies)
         if (map%repeats_ends_along(direction)) call logger%note('along '//'xy'(direction:direction)// &
            ' the last heights are the first ones once more: a periodic map ends a step before. Leave them out')
      end do
      ! A border that does not fit is a step between two points and lowers the ratio too: it was noted above.
      if (map%slope_by_differences >= least_ratio*scene%roughness%slope .or. any(map%is_broken_along([1, 2]))) return
      call logger%note('the rms slope is '//short_number(scene%roughness%slope)// &
                   ', by differences of neighbours only '//short_number(map%slope_by_differences)// &
                   ': much of it is in waves of two or three points. If these are noise, smooth the map: '// &
                   'they make contact areas smaller')

   contains

      !> Whether two products of a side and a number of points differ by 1 % or less.
      pure logical function are_near(one, other)
         real(dp), intent(in) :: one, other

         are_near = abs(one - other) <= 0.01_dp*one
      end function are_near

      !> Notes that much of a map was not measured, or seems not to be.
      subroutine note_filled(map, which)
         type(map_statistics), intent(in) :: map
         character(*), intent(in) :: which   !! ' of body 1' or 2; empty if there is one map

         !> Least part of the heights that is noted. Less is usual: the steep flanks that an instrument does not see.
         real(dp), parameter :: least_filled = 0.1_dp
         real(dp) :: filled

         filled = real(map%changes%filled, dp)/product(real(map%points, dp))
         if (map%placeholders > 0) call logger%note( &
            integer_text(map%placeholders)//' of the heights'//which//' are '//exact_number(map%placeholder)// &
            ', as is often written for missing ones. Remedy: missing_value = '//exact_number(map%placeholder))
         if (filled > least_filled) call logger%note(percent(filled)//' of the heights'//which//' are missing and '// &
            'filled by a smooth surface, which no instrument has seen: areas, gaps and pressures there are a '// &
            'guess, and error estimates do not count this')
      end subroutine note_filled

   end subroutine note_map

   !> Writes a row for each load: mean gap, area and peak pressure, each followed by its error estimate; mean and peak
   !> pressure in the deck's unit if the deck gives a modulus; solver and status. With free edges the row has force,
   !> approach, area and peak pressure in the deck's units.
   subroutine show_loads(results, logger)
      type(results_type), intent(in) :: results   !! with a solution for each load
      type(run_log), intent(inout) :: logger

      character(24) :: columns(3)
      character(9) :: names(3)
      integer :: i, load, solver_width
      type(log_line) :: line

      if (logger%quiet) return
      ! The column of solvers is as wide as the longest name among the loads.
      solver_width = max(len('solver'), maxval(len_trim(solver_names(results%loads%solver))))
      names = [character(9) :: 'gap/Delta', 'area/A0', 'peak/p*']
      columns = [character(24) :: 'mean_gap_over_amplitude', 'contact_area_fraction', 'peak_pressure_over_pstar']
      associate (surface => results%solver%surface, scene => results%scene)
         if (surface%has_free_edges) then
            names = [character(9) :: 'approach', 'area', 'peak']
            columns = [character(24) :: 'approach', 'contact_area', 'peak_pressure']
         end if
         do load = 1, size(results%loads)
            call line%start(results, load)
            do i = 1, size(names)
               call line%add(trim(names(i)), results%number(load, trim(columns(i))))
               call line%add('error', results%number(load, trim(columns(i))//'_error'))
            end do
            if (scene%gives_modulus .and. .not. surface%has_free_edges) &
               call line%add('peak['//scene%pressure_unit//']', results%number(load, 'peak_pressure'))
            if (load == 1) call logger%say(line%names//' solver'//repeat(' ', solver_width - len('solver') + 2)// &
                                           'status')
            call logger%say(line%words//' '//solver_names(results%loads(load)%solver)(:solver_width)//'  '// &
                            trim(status_name(results%loads(load)%status)))
         end do
         if (scene%loads_by == by_percolation) call say_load_of_percolation(results, logger)
      end associate
   end subroutine show_loads

   !> Writes from which load on the contact percolates, or up to which load the gap does; without such a load, whether
   !> it does so at every load or at none.
   subroutine say_load_of_percolation(results, logger)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: logger

      character(:), allocatable :: words
      logical :: is_gap, is_heavy   ! is_heavy: whether the loads that were tried last are above that of the first

      associate (what => results%scene%load%percolates%text, solution => results%loads(1))
         is_gap = index(what, 'gap') == 1
         words = 'percolation: the '//what(:index(what//'_', '_') - 1)//' percolates'
         if (index(what, '_') > 0) words = words//' along '//what(len(what):)
         is_heavy = solution%pbar_over_pstar > 0.5_dp*min(1.0_dp, results%solver%surface%hardness)
         if (.not. is_known(solution%value(percolation))) then
            if (solution%status /= not_found) return
            words = words//trim(merge(' at every load', ' at no load   ', is_gap .eqv. is_heavy))//' that was tried'
         else
            if (is_gap) then
               words = words//' up to pbar/p* = '//in_words(solution%value(last_before))//', no longer at '// &
                       in_words(solution%value(percolation))
            else
               words = words//' from pbar/p* = '//in_words(solution%value(percolation))//' on, not yet at '// &
                       in_words(solution%value(last_before))
            end if
            words = words//'; error '//in_words(solution%error(percolation))
         end if
      end associate
      call logger%say(words)

   contains

      !> A mean pressure in units of p* and, if the deck gives a modulus, in the deck's unit.
      function in_words(pressure) result(words)
         real(dp), intent(in) :: pressure   !! [p*]
         character(:), allocatable :: words

         words = 'unknown'
         if (is_known(pressure)) words = short_number(pressure)
         if (results%scene%gives_modulus .and. is_known(pressure)) words = words//' ('// &
            short_number(results%scene%p_star*pressure)//' '//results%scene%pressure_unit//')'
      end function in_words

   end subroutine say_load_of_percolation

   !> Writes a row for each load and body: the largest von Mises stress and the largest shear stress, each followed by
   !> its error estimate, and the depth of the largest von Mises stress over the side of the cell along x. If the deck
   !> gives a modulus, the von Mises stress follows in the deck's unit; if it gives a yield stress, the ratio to the
   !> yield stress follows. With free edges all values are in the deck's units.
   subroutine show_stresses(results, logger)
      type(results_type), intent(in) :: results   !! with the largest stresses
      type(run_log), intent(inout) :: logger

      character(40) :: names(3)
      character(:), allocatable :: in_unit
      integer :: body, load
      real(dp) :: depth_unit, sides(2), stress_unit
      type(log_line) :: line

      associate (scene => results%scene, surface => results%solver%surface)
         in_unit = '['//scene%pressure_unit//']'
         stress_unit = 1.0_dp
         sides = surface%sides()
         depth_unit = surface%length(1)/sides(1)
         names = [character(40) :: 'vMises/p*', 'depth/cell', 'shear/p*']
         if (surface%has_free_edges) then
            stress_unit = scene%p_star
            depth_unit = surface%length(1)
            names = [character(40) :: 'vMises'//in_unit, 'depth['//scene%length_unit//']', 'shear'//in_unit]
         end if
         do load = 1, size(results%loads)
            do body = 1, size(results%largest_stresses, 2)
               associate (yielding => results%largest_stresses(1, body, load), &
                          shear => results%largest_stresses(2, body, load))
                  call line%start(results, load)
                  call line%add('body', real(body, dp))
                  call line%add(trim(names(1)), stress_unit*yielding%value)
                  call line%add('error', stress_unit*yielding%error)
                  call line%add(trim(names(2)), depth_unit*yielding%position(3)/(2*pi))
                  call line%add(trim(names(3)), stress_unit*shear%value)
                  call line%add('error', stress_unit*shear%error)
                  if (scene%gives_modulus .and. .not. surface%has_free_edges) &
                     call line%add('vMises'//in_unit, scene%p_star*yielding%value)
                  if (allocated(scene%stress_setting%yield_stress)) call line%add( &
                     'over yield', scene%stress_setting%over_yield_stress(body, yielding%value, shear%value))
               end associate
               if (load == 1 .and. body == 1) call logger%say(line%names)
               call logger%say(line%words)
            end do
         end do
      end associate
   end subroutine show_stresses

   !> Starts the row of a load with its mean pressure or, with free edges, its force.
   subroutine start(self, results, load)
      class(log_line), intent(out) :: self
      type(results_type), intent(in) :: results
      integer, intent(in) :: load

      self%names = ''
      self%words = ''
      if (results%solver%surface%has_free_edges) then
         call self%add('force', results%solver%surface%nominal_area()*results%mean_pressure(load))
      else
         call self%add('pbar/p*', results%number(load, 'pbar_over_pstar'))
         if (results%scene%gives_modulus) &
            call self%add('pbar['//results%scene%pressure_unit//']', results%mean_pressure(load))
      end if
   end subroutine start

   !> Adds a column with a number at its right. An error estimate has two digits, an unknown one is '-'.
   subroutine add(self, name, number)
      class(log_line), intent(inout) :: self
      character(*), intent(in) :: name   !! name of the column; 'error' for an error estimate
      real(dp), intent(in) :: number

      character(12) :: buffer
      character(:), allocatable :: words
      integer :: width
      real(dp) :: rounded

      width = max(13, len(name) + 2)
      words = short_number(number)
      if (name == 'error') then
         width = 9
         write (buffer, '(es12.1e3)') number
         read (buffer, *) rounded
         words = short_number(rounded)
         if (ieee_is_nan(number)) words = '-'
      end if
      self%names = self%names//repeat(' ', max(0, width - len(name)))//name
      self%words = self%words//repeat(' ', max(0, width - len(words)))//words
   end subroutine add

   !> Writes the last lines of the log and sets the exit status: exit_fine if all loads were solved as requested,
   !> otherwise exit_not_converged.
   subroutine sum_up(results, logger, status)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: logger
      integer, intent(out) :: status

      integer :: load

      associate (scene => results%scene)
         call note_loads(results, scene%loads_by, results%loads%solution_record, logger)
         if (scene%p_star <= 0.0_dp) call logger%say('the surface is flat: there is only a summary')
         call logger%say('results: '//escaped(scene%directory)//'/'//scene%case//'.summary.dat')
      end associate
      call logger%say(outcome(results))
      status = exit_fine
      if (.not. all([(results%is_solved_in(load), load=1, size(results%loads))])) status = exit_not_converged
   end subroutine sum_up

   !> A line that says how many loads of a run were solved as requested, and which tables have the bad statuses.
   function outcome(results) result(words)
      type(results_type), intent(in) :: results   !! with a solution for each load
      character(:), allocatable :: words

      integer :: load
      logical :: solved(size(status_tables), size(results%loads))

      solved = reshape([(results%is_solved_in(load), load=1, size(results%loads))], shape(solved))
      words = results%scene%case//': all '//integer_text(size(results%loads))//' loads solved'
      if (size(results%loads) == 1) words = results%scene%case//': the load is solved'
      if (.not. all(solved)) words = results%scene%case//': '//integer_text(count(.not. all(solved, 1)))//' of '// &
         integer_text(size(results%loads))//' loads NOT solved as requested, see the status in '// &
         listed(pack(status_tables, .not. all(solved, 2)), ' and ')
   end function outcome

   !> Notes what a user should know of solutions: what is not resolved, not reached, not defined or doubtful.
   subroutine note_loads(results, loads_by, loads, logger)
      type(results_type), intent(in) :: results       !! with the scene and the started solver
      integer, intent(in) :: loads_by                 !! how the loads were given: by_pressure or another of the scene
      type(solution_record), intent(in) :: loads(:)   !! the solutions
      type(run_log), intent(inout) :: logger

      character(:), allocatable :: of_loads
      logical :: is_series(size(loads))

      associate (scene => results%scene, surface => results%solver%surface)
         of_loads = ' of '//integer_text(size(loads))//' loads'
         call note_unresolved()
         call note_inaccurate()
         call note_some(count(loads%status == above_hardness), &
                        'the mean pressure is not below the hardness: the values are those of no contact')
         is_series = loads%solver == by_beale .or. loads%solver == by_series
         if (any(is_series)) call logger%note( &
            "the errors of the paper's truncated series are not estimated: with the paper's harmonics and points "// &
            'they are up to '//short_number(paper_errors(1))//' in gap/Delta, '//short_number(paper_errors(2))// &
            ' in area/A0 and '//short_number(paper_errors(3))//' in peak/p* from 0.05 to 0.9 p*, more at other '// &
            "loads. solver = 'auto' gives digits, with error estimates")
         call note_some(count(is_series .and. loads%value(mean_gap) < 0.0_dp), &
                        'the mean gap is below 0, where no gap can be: this is an error of the series')
         call note_some(count(loads%solver == by_beale .and. loads%status == iteration_limit), &
            "Beale's exchanges did not come to an end. solver = 'series' finds the minimum of the same series")
         if (loads_by == by_yield) then
            call note_some(count(loads%status == not_found), 'no mean pressure was found that brings the '// &
                           'stresses to the given part of the yield stress')
            if (.not. results%traits%has_errors) call logger%note("solver = '"//scene%method%solver%text// &
               "' estimates no errors; a light load of first yield may be wrong by a factor of 2. solver = 'auto' "// &
               'estimates them')
         else if (loads_by == by_percolation) then
            call note_some(count(loads%status == not_found), 'no load was found at which the percolation begins '// &
               'or ends: every load that was tried is on the same side')
         else
            call note_unreached()
         end if
         if (scene%surface_values%kind%text == 'file' .and. surface%dimension == 2 .and. .not. surface%mirrored) &
            call note_some(count(loads%value(concentrated_load) >= least_concentration), &
            "the contact is one spot, whose approach its periodic images change: edges = 'free' leaves them out")
         if (surface%has_free_edges) call note_free_edges(surface, loads, logger)
         call note_some(count(loads%status == converged .and. loads%value(contact_area) <= 0.0_dp), &
            'no pressure reaches edge_level = '// &
            short_number(scene%method%edge_level%number)//' p*, so that the contact area shows as 0')
      end associate

   contains

      !> Notes what holds for a number of the loads, unless this number is 0.
      subroutine note_some(number, words)
         integer, intent(in) :: number       !! how many loads the words hold for
         character(*), intent(in) :: words

         if (number > 0) call logger%note('at '//integer_text(number)//of_loads//' '//words)
      end subroutine note_some

      !> Notes how many of the given contact areas, mean gaps or approaches the grid cannot have at any load, and what
      !> helps.
      subroutine note_unreached()
         character(:), allocatable :: limit
         integer :: last
         logical :: is_unreached(size(loads))

         is_unreached = loads%status == not_found .and. .not. loads%pbar_over_pstar > 0.0_dp
         last = findloc(is_unreached, .true., dim=1, back=.true.)
         if (last == 0) return
         associate (solution => loads(last))
            limit = ' mean gaps are above the largest that the grid shows, '//short_number(solution%value(mean_gap))
            if (loads_by == by_approach) limit = ' approaches are below the least that the grid shows, '// &
               short_number(results%solver%surface%amplitude*solution%value(approach))// &
               ' ['//results%scene%length_unit//'],'
            if (loads_by == by_contact_area) limit = &
               ' contact areas are below the least that the grid shows, '//short_number(solution%value(contact_area))
         end associate
         call logger%note(integer_text(count(is_unreached))//' of '//integer_text(size(loads))//limit// &
            ' where its highest points just touch: no load has them. Give more grid_points or a smaller accuracy')
      end subroutine note_unreached

      !> Notes how many loads have no error estimates, how many loads have values that are no larger than their errors,
      !> and what helps.
      subroutine note_unresolved()
         character(32) :: values(3)
         integer :: coarse(3), i, unknown

         values = [character(32) :: 'the mean gap', 'the contact area', 'the peak pressure']
         if (results%solver%surface%has_free_edges) values(1) = 'the approach'
         coarse = 0
         unknown = 0
         do i = 1, size(loads)
            associate (solution => loads(i))
               if (solution%status /= unresolved) cycle
               if (any(is_known(solution%error(main_quantities)))) then
                  where (.not. solution%are_resolved(results%solver%surface)) coarse = coarse + 1
               else
                  unknown = unknown + 1
               end if
            end associate
         end do
         if (unknown > 0) call logger%note('the errors of '//integer_text(unknown)//of_loads//' are unknown: '// &
            'a grid has error estimates from 64 points a side on, if each wave of the surface has two points '// &
            'or more, and a map has waves as short as two of its own steps; shorter waves are left out. Give more '// &
            'grid_points, or an accuracy')
         if (all(coarse == 0)) return
         do i = 1, size(values)
            values(i) = trim(values(i))//' at '//integer_text(coarse(i))
         end do
         call logger%note('the grid is too coarse for '//listed(pack(values, coarse > 0), ' and ')//of_loads// &
                      ': the error is as large as the value, or unknown. Give an accuracy, or more grid_points')
      end subroutine note_unresolved

      !> Notes how many loads have errors above the accuracy, the largest of these, and what helps.
      subroutine note_inaccurate()
         character(:), allocatable :: better, remedy   ! better: solvers with smaller errors
         integer :: i
         real(dp) :: worst(size(loads))   ! largest known error of each load

         worst = [(maxval(loads(i)%error(main_quantities), is_known(loads(i)%error(main_quantities))), &
                   i=1, size(loads))]
         associate (accuracy => results%scene%method%accuracy)
            where (loads%status /= not_accurate .or. .not. worst > accuracy%number) worst = 0.0_dp
            if (.not. accuracy%in_effect) return
         end associate
         better = ''
         remedy = 'a larger accuracy takes less time'
         if (results%traits%solver == by_grid) then
            remedy = remedy//', grid_points in its place may give a finer grid'
            ! Only 'fitted' has details.
            better = solvers_for(results%solver%surface, 'details')
         end if
         if (better /= '') remedy = "solver = 'auto' has smaller ones on this surface"
         call note_some(count(worst > 0.0_dp), 'errors are above the accuracy, up to '// &
                        short_number(maxval(worst))//'; '//remedy)
      end subroutine note_inaccurate

   end subroutine note_loads

   !> Notes what a user should know of solutions on a surface with free edges.
   subroutine note_free_edges(surface, loads, logger)
      type(surface_type), intent(in) :: surface
      type(solution_record), intent(in) :: loads(:)
      type(run_log), intent(inout) :: logger

      if (any(loads%value(border_load) > 0.0_dp)) call logger%note('contact reaches the border: up to '// &
         percent(maxval(loads%value(border_load)))//' of the load is within '//percent(border)// &
         ' of the sides from it, where a larger map might carry more')
      if (surface%has_steps) call logger%note( &
         'a map of two heights at most is taken as blocks, the cells of its points, as a punch is')
      if (.not. all(is_known(loads%value(peak_pressure)))) call logger%note('where contact ends at a border or at '// &
         'a step the peak pressure is infinite, as at the edge of a punch: it shows as NaN')
      if (surface%dimension == 1) call logger%note('approach and elastic energy of a profile with free edges are '// &
         'not defined and show as NaN: they grow with the logarithm of the length over which they are measured')
   end subroutine note_free_edges

end module wavycon_notes
