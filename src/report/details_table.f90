!> <case>.details.dat: all that the boundary-fitted expansions know of a load but its fields, with error
!> estimates.
!>
!> A line a load. Loads that have no expansion (none, full contact, no solution found) are left out with a
!> remark.
module wavycon_details_table
   use wavycon_error, only: error_type
   use wavycon_fitted_details, only: fitted_details, find_fitted_details
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: exact_number
   use wavycon_results, only: results_type
   implicit none (type, external)
   private

   public :: write_details_table

   !> The energy is that of a nominal unit area; the perimeter that of one contact spot or, above merging, of
   !> one open island. The paper's cell has two of each.
   character(40), parameter :: columns(*) = [character(40) :: &
      'pbar_over_pstar[-]', 'mean_gap[Delta]', 'mean_gap_error[Delta]', 'contact_area_fraction[-]', &
      'contact_area_error[-]', 'peak_pressure[p*]', 'peak_pressure_error[p*]', 'trough_gap[Delta]', &
      'trough_gap_error[Delta]', 'saddle_gap[Delta]', 'saddle_gap_error[Delta]', 'saddle_pressure[p*]', &
      'saddle_pressure_error[p*]', 'elastic_energy[p*Delta]', 'elastic_energy_error[p*Delta]', &
      'perimeter[length]', 'perimeter_error[length]', 'degree[-]', 'status[-]']

contains

   !> Errors: exit_file_trouble.
   subroutine write_details_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      type(fitted_details) :: details
      type(fitted_frame) :: frame
      integer :: i
      real(dp) :: energy_unit

      call results%open_table('details', file)
      call file%put_columns(columns)
      call find_frame(results%scene%surface, frame)
      energy_unit = frame%pressure_unit/frame%lattice%area
      do i = 1, size(results%states)
         associate (state => results%states(i))
            if (.not. allocated(state%fitted)) then
               call file%put('# no expansion at pbar/p* = '//exact_number(state%pbar_over_pstar)//': '// &
                             trim(state%status))
               cycle
            end if
            associate (answer => state%fitted, measures => state%measures)
               call find_fitted_details(frame%lattice, answer, details)
               call file%add([state%pbar_over_pstar, &
                              measures%mean_gap_over_amplitude, measures%mean_gap_error, &
                              measures%contact_area_fraction, measures%contact_area_error, &
                              measures%peak_pressure_over_pstar, measures%peak_pressure_error, &
                              details%trough_gap, details%trough_gap_error, &
                              details%saddle_gap, details%saddle_gap_error, &
                              details%saddle_pressure*frame%pressure_unit, &
                              details%saddle_pressure_error*frame%pressure_unit, &
                              answer%energy*energy_unit, answer%energy_error*energy_unit, &
                              answer%perimeter*frame%side, answer%perimeter_error*frame%side])
               call file%add(answer%degree)
            end associate
            call file%add(trim(state%status))
            call file%end_row()
         end associate
      end do
      call file%finish(error)
   end subroutine write_details_table

end module wavycon_details_table
