!> What the log says of a run before its loads are solved, and what a user should know of the solutions.
module wavycon_notes
   use wavycon_contact_measures, only: is_known
   use wavycon_contact_status, only: converged, not_found, unresolved
   use wavycon_contact_tuning, only: border, least_concentration
   use wavycon_error, only: exit_fine, exit_not_converged
   use wavycon_head_lines, only: head_lines
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: escaped, integer_text, listed, percent, short_number
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_scene, only: by_contact_area, by_yield, scene_type, target_words
   implicit none (type, external)
   private

   public :: show_scene, sum_up

contains

   !> Writes the input in effect: deck, surface, material, method and loads, and what is suspicious of it.
   subroutine show_scene(results, log)
      type(results_type), intent(in) :: results   !! started
      type(run_log), intent(inout) :: log

      character(:), allocatable :: words
      real(dp) :: loads(size(results%scene%target))

      associate (scene => results%scene, surface => results%solver%surface)
         call log%say(head_lines(scene, surface, results%method, '', 'some'))
         loads = scene%target
         words = trim(target_words(scene%loads_by))
         if (surface%has_free_edges .and. allocated(scene%mean_pressure)) then
            loads = surface%nominal_area()*scene%mean_pressure
            words = 'force'
         end if
         call log%say('loads: '//integer_text(size(loads))//', '//words//' from '//short_number(minval(loads))// &
                      ' to '//short_number(maxval(loads)))
         if (results%sharing%words() /= '') call log%say('ranks: '//results%sharing%words())
         if (allocated(scene%map)) call note_map(scene, scene%map, log)
         call note_slopes(scene, log)
      end associate
   end subroutine show_scene

   !> Says what is suspicious of a height map.
   subroutine note_map(scene, map, log)
      type(scene_type), intent(in) :: scene
      type(map_statistics), intent(in) :: map   !! of the scene
      type(run_log), intent(inout) :: log

      !> Least slope by differences over that of the series. Noise that lowers it to 0.9 takes a quarter or more of the
      !> contact area at light loads: see the table of src/map/README.md.
      real(dp), parameter :: least_ratio = 0.9_dp
      character(:), allocatable :: remedies
      integer :: direction

      if (map%lacks_missing_value) call log%say('note: no height of the file has the missing_value of the deck')
      if (map%spikes > 0) call log%say('note: '//integer_text(map%spikes)//' of the heights are far from all '// &
         'around them (kurtosis '//short_number(map%kurtosis)//'): spikes of an instrument carry load that the '// &
         'surface does not. Remedy: despike = .true.')
      remedies = "edges = 'mirror', edges = 'window'"
      if (map%changes%detrend /= 'plane' .and. map%changes%detrend /= 'quadratic') &
         remedies = "detrend = 'plane', "//remedies
      do direction = 1, 2
         if (map%is_broken_along(direction)) call log%say('note: along '//'xy'(direction:direction)// &
            ' the last heights differ from the first by '//short_number(map%border_step(direction))//' ['// &
            scene%length_unit//'] (rms), neighbours inside by at most '//short_number(map%largest_step(direction))// &
            '; such steps carry load. Remedies: '//remedies)
      end do
      ! A broken border is a step between two points.
      if (map%slope_by_differences >= least_ratio*scene%roughness%slope .or. any(map%is_broken_along([1, 2]))) return
      call log%say('note: the rms slope is '//short_number(scene%roughness%slope)// &
                   ', by differences of neighbours only '//short_number(map%slope_by_differences)// &
                   ': much of it is in waves of two or three points. If these are noise, smooth the map: '// &
                   'they make contact areas smaller')
   end subroutine note_map

   !> Warns of a surface that is too steep for the theory, if the deck has units, and of one that is all but flat: most
   !> likely by a mistake of units.
   subroutine note_slopes(scene, log)
      type(scene_type), intent(in) :: scene
      type(run_log), intent(inout) :: log

      !> The theory of small slopes is off by the order of their square, here a tenth.
      real(dp), parameter :: steepest = 0.3_dp
      !> Heights in m beside sides in um make slopes of 1e-4 (polished silicon) to 10 a million times smaller.
      real(dp), parameter :: flattest = 1e-5_dp
      character(:), allocatable :: borders, cause, verdict
      logical :: is_flat

      is_flat = scene%roughness%slope > 0.0_dp .and. scene%roughness%slope < flattest
      if (.not. (is_flat .or. (scene%has_units .and. scene%roughness%slope > steepest))) return
      verdict = '; the theory needs small ones.'
      if (is_flat) verdict = '; those of real surfaces are larger.'
      borders = ''
      cause = 'Are amplitudes and wavelengths in one unit?'
      if (allocated(scene%map)) then
         if (scene%map%path /= '') cause = 'Do height_scale, and the sides of the cell, suit the units of the file?'
         if (any(scene%map%is_broken_along([1, 2]))) borders = ', with the steps across its borders'
      end if
      call log%say('note: the slopes of the surface are '//short_number(scene%roughness%slope)//' (rms)'//borders// &
                   verdict//' '//cause)
   end subroutine note_slopes

   !> Writes the last lines of the log and finds the exit status.
   subroutine sum_up(results, log, status)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log
      integer, intent(out) :: status

      character(:), allocatable :: loads
      integer :: bad, i, without_area

      loads = integer_text(size(results%loads))
      associate (scene => results%scene, surface => results%solver%surface, all_measures => results%loads%measures)
         call note_unresolved(results, ' of '//loads//' loads', log)
         if (scene%loads_by == by_yield) then
            call note(count(results%loads%status == not_found), 'for ', ' loads no mean pressure was found that '// &
                      'brings the stresses to the given part of the yield stress')
            if (.not. results%traits%has_errors) call log%say("note: solver = '"//scene%method%text('solver')// &
               "' estimates no errors; a light load of first yield may be wrong by a factor of 2. solver = 'auto' "// &
               'estimates them')
         else
            call note_unreached(results, log)
         end if
         if (is_measured()) call note(count(all_measures%load_concentration >= least_concentration), 'at ', ' of '// &
            loads//' loads the contact is one spot, whose approach its periodic images change: '// &
            "edges = 'free' leaves them out")
         if (surface%has_free_edges) then
            if (any(all_measures%load_at_border > 0.0_dp)) call log%say( &
               'note: contact reaches the border: up to '//percent(maxval(all_measures%load_at_border))// &
               ' of the load is within '//percent(border)// &
               ' of the sides from it, where a larger map might carry more')
            if (surface%dimension == 1) call log%say('note: the approach of a profile with free edges is not '// &
               'defined and shows as NaN: it grows with the logarithm of the length over which it is measured')
         end if
         without_area = count(results%loads%status == converged .and. all_measures%contact_area_fraction <= 0.0_dp)
         if (without_area > 0) call note(without_area, 'at ', ' loads no pressure reaches edge_level = '// &
            short_number(scene%method%real('edge_level'))//' p*, so that their contact area shows as 0')
         if (scene%p_star <= 0.0_dp) call log%say('the surface is flat: there is only a summary')
         call log%say('results: '//escaped(scene%directory)//'/'//scene%case//'.summary.dat')
         bad = count([(.not. results%loads(i)%is_good(), i=1, size(results%loads))])
         if (bad == 0) then
            call log%say(scene%case//': all '//loads//' loads solved')
         else
            call log%say(scene%case//': '//integer_text(bad)//' of '//loads// &
                         ' loads NOT solved as requested, see the status column')
         end if
      end associate
      status = merge(exit_fine, exit_not_converged, bad == 0)

   contains

      !> Says something of some loads, if there are any.
      subroutine note(number, before, behind)
         integer, intent(in) :: number
         character(*), intent(in) :: before, behind   !! words before and behind the number

         if (number > 0) call log%say('note: '//before//integer_text(number)//behind)
      end subroutine note

      !> Whether the surface is a map from a file that is continued periodically.
      logical function is_measured()
         is_measured = allocated(results%scene%map) .and. results%solver%surface%dimension == 2 &
                       .and. .not. results%solver%surface%mirrored
         if (is_measured) is_measured = results%scene%map%path /= ''
      end function is_measured

   end subroutine sum_up

   !> Says how many contact areas or mean gaps no load has on the grid, and what helps.
   subroutine note_unreached(results, log)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log

      character(:), allocatable :: limit
      integer :: last
      logical :: is_unreached(size(results%loads))

      is_unreached = results%loads%status == not_found .and. .not. results%loads%pbar_over_pstar > 0.0_dp
      last = findloc(is_unreached, .true., dim=1, back=.true.)
      if (last == 0) return
      associate (measures => results%loads(last)%measures)
         limit = ' mean gaps are above the largest that the grid shows, '// &
                 short_number(measures%mean_gap_over_amplitude)
         if (results%scene%loads_by == by_contact_area) limit = &
            ' contact areas are below the least that the grid shows, '//short_number(measures%contact_area_fraction)
      end associate
      call log%say('note: '//integer_text(count(is_unreached))//' of '//integer_text(size(is_unreached))// &
         limit//' where its highest points just touch: no load has them. Give more grid_points or a smaller '// &
         "accuracy; solver = 'fitted' has no such limit")
   end subroutine note_unreached

   !> Says which values have no error estimate and which are no larger than theirs, and what helps.
   subroutine note_unresolved(results, of_loads, log)
      type(results_type), intent(in) :: results
      character(*), intent(in) :: of_loads       !! such as ' of 3 loads'
      type(run_log), intent(inout) :: log

      character(32) :: values(3)
      integer :: coarse(3), i, unknown

      values = [character(32) :: 'the mean gap', 'the contact area', 'the peak pressure']
      coarse = 0
      unknown = 0
      do i = 1, size(results%loads)
         associate (solution => results%loads(i))
            if (solution%status /= unresolved) cycle
            if (any(is_known(solution%measures%errors()))) then
               coarse = coarse + merge(0, 1, solution%measures%are_resolved())
            else
               unknown = unknown + 1
            end if
         end associate
      end do
      if (unknown > 0) call log%say('note: the errors of '//integer_text(unknown)//of_loads//' are unknown: a grid '// &
         'has error estimates from 64 points a side on. Give more grid_points, or an accuracy')
      if (all(coarse == 0)) return
      do i = 1, size(values)
         values(i) = trim(values(i))//' at '//integer_text(coarse(i))
      end do
      call log%say('note: the grid is too coarse for '//listed(pack(values, coarse > 0), ' and ')//of_loads// &
                   ': the error is as large as the value, or unknown. Give an accuracy, or more grid_points')
   end subroutine note_unresolved

end module wavycon_notes
