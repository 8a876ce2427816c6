!> The last lines of the log: what a user should know of the solutions, and how many loads were solved.
module wavycon_closing_notes
   use wavycon_contact_measures, only: is_known
   use wavycon_contact_status, only: converged, not_found, unresolved
   use wavycon_contact_tuning, only: border, least_concentration
   use wavycon_error, only: exit_fine, exit_not_converged
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, integer_text, listed, percent, short_number
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_scene, only: by_contact_area, by_yield
   implicit none (type, external)
   private

   public :: sum_up

contains

   !> Writes the last lines of the log and finds the exit status.
   subroutine sum_up(results, log, status)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log
      integer, intent(out) :: status

      character(:), allocatable :: loads
      integer :: bad, i, unreached, without_area

      bad = count([(.not. results%loads(i)%is_good(), i=1, size(results%loads))])
      without_area = count(results%loads%status == converged .and. &
                           results%loads%measures%contact_area_fraction <= 0.0_dp)
      unreached = count(results%loads%status == not_found)
      loads = integer_text(size(results%loads))
      associate (scene => results%scene)
         call note_unresolved(results, log)
         if (scene%loads_by /= by_yield) call note_unreached(results, log)
         call note_images(results, log)
         call note_free_edges(results, log)
         if (without_area > 0) then
            call log%say('note: at '//integer_text(without_area)//' loads no pressure reaches edge_level = '// &
                         short_number(scene%method%real('edge_level'))//' p*, so that their contact area shows as 0')
         end if
         if (scene%loads_by == by_yield .and. .not. results%traits%has_errors) call log%say( &
            "note: solver = '"//scene%method%text('solver')// &
            "' estimates no errors; a light load of first yield may "// &
            "be wrong by a factor of 2. solver = 'auto' estimates them")
         if (scene%loads_by == by_yield .and. unreached > 0) call log%say('note: for '//integer_text(unreached)// &
            ' loads no mean pressure was found that brings the stresses to the given part of the yield stress')
         if (scene%p_star <= 0.0_dp) call log%say('the surface is flat: there is only a summary')
         call log%say('results: '//escaped(scene%directory)//'/'//scene%case//'.summary.dat')
         if (bad == 0) then
            call log%say(scene%case//': all '//loads//' loads solved')
         else
            call log%say(scene%case//': '//integer_text(bad)//' of '//loads// &
                         ' loads NOT solved as requested, see the status column')
         end if
      end associate
      status = merge(exit_fine, exit_not_converged, bad == 0)
   end subroutine sum_up

   !> Says that the periodic images of a single spot on a measured map change its approach.
   subroutine note_images(results, log)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log

      integer :: spots

      associate (scene => results%scene, surface => results%solver%surface)
         if (.not. allocated(scene%map) .or. surface%dimension == 1 .or. surface%mirrored) return
         if (scene%map%path == '') return
         spots = count(results%loads%measures%load_concentration >= least_concentration)
         if (spots > 0) call log%say('note: at '//integer_text(spots)//' of '//integer_text(size(results%loads))// &
            " loads the contact is one spot, whose approach its periodic images change: edges = 'free' leaves them out")
      end associate
   end subroutine note_images

   !> Says how much of the load lies at the border of a map with free edges, and that a profile has no approach.
   subroutine note_free_edges(results, log)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log

      real(dp) :: largest

      if (.not. results%solver%surface%has_free_edges) return
      largest = maxval(results%loads%measures%load_at_border)
      if (largest > 0.0_dp) call log%say('note: contact reaches the border: up to '//percent(largest)// &
         ' of the load is within '//percent(border)//' of the sides from it, where a larger map might carry more')
      if (results%solver%surface%dimension == 1) call log%say('note: the approach of a profile with free edges is '// &
         'not defined and shows as NaN: it grows with the logarithm of the length over which it is measured')
   end subroutine note_free_edges

   !> Says how many contact areas or mean gaps no load has on the grid, and what helps.
   subroutine note_unreached(results, log)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log

      character(:), allocatable :: limit
      integer :: i, unreached

      unreached = 0
      do i = 1, size(results%loads)
         associate (solution => results%loads(i), measures => results%loads(i)%measures)
            if (solution%status /= not_found .or. solution%pbar_over_pstar > 0.0_dp) cycle
            unreached = unreached + 1
            limit = ' mean gaps are above the largest that the grid shows, '// &
                    short_number(measures%mean_gap_over_amplitude)
            if (results%scene%loads_by == by_contact_area) limit = &
               ' contact areas are below the least that the grid shows, '//short_number(measures%contact_area_fraction)
         end associate
      end do
      if (unreached > 0) call log%say('note: '//integer_text(unreached)//' of '//integer_text(size(results%loads))// &
         limit//' where its highest points just touch: no load has them. Give more grid_points or a smaller '// &
         "accuracy; solver = 'fitted' has no such limit")
   end subroutine note_unreached

   !> Says which values have no error estimate and which are no larger than theirs, and what helps.
   subroutine note_unresolved(results, log)
      type(results_type), intent(in) :: results
      type(run_log), intent(inout) :: log

      character(32) :: values(3)
      character(:), allocatable :: loads
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
      loads = ' of '//integer_text(size(results%loads))//' loads'
      if (unknown > 0) call log%say('note: the errors of '//integer_text(unknown)//loads//' are unknown: a grid has'// &
         ' error estimates from 64 points a side on. Give more grid_points, or an accuracy')
      if (all(coarse == 0)) return
      do i = 1, size(values)
         values(i) = trim(values(i))//' at '//integer_text(coarse(i))
      end do
      call log%say('note: the grid is too coarse for '//listed(pack(values, coarse > 0), ' and ')//loads// &
                   ': the error is as large as the value, or unknown. Give an accuracy, or more grid_points')
   end subroutine note_unresolved

end module wavycon_closing_notes
