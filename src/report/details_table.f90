!> <case>.details.dat: numbers that the summary does not have, with error estimates, from solvers that compute them.
!>
!> The table has a row for each load. What a load without details (no load, full contact, no solution) does not have is
!> NaN, its degree 0.
module wavycon_details_table
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_solver, only: solver_traits
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_solution_record, only: solver_names
   use wavycon_surface, only: surface_type
   use wavycon_method_list, only: solvers_with
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: details_table

   !> The energy is per nominal area. The perimeter is that of one contact spot or, above merging, of one open pool;
   !> the paper's cell has two of each.
   character(45), parameter :: columns(*) = [character(45) :: &
      'load[-]', 'pbar_over_pstar[-]', 'mean_gap_over_amplitude[-]', 'mean_gap_over_amplitude_error[-]', &
      'contact_area_fraction[-]', 'contact_area_fraction_error[-]', 'peak_pressure_over_pstar[-]', &
      'peak_pressure_over_pstar_error[-]', 'trough_gap_over_amplitude[-]', 'trough_gap_over_amplitude_error[-]', &
      'saddle_gap_over_amplitude[-]', 'saddle_gap_over_amplitude_error[-]', 'saddle_pressure_over_pstar[-]', &
      'saddle_pressure_over_pstar_error[-]', 'elastic_energy_over_pstar_amplitude[-]', &
      'elastic_energy_over_pstar_amplitude_error[-]', 'perimeter[length]', 'perimeter_error[length]', 'degree[-]', &
      'status_code[-]', 'status[-]']

   !> Columns from trough gap to perimeter_error, which only some solutions have.
   integer, parameter :: numbers_of_details = 10

contains

   type(table_type) function details_table() result(table)
      table%file = 'details'
      table%key = 'details'
      table%meaning = 'Gaps at trough and saddle, strain energy, perimeter and the numbers of the summary, '// &
                      'each with its error estimate.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%refuse => refuse
      table%put_load => put_details
   end function details_table

   subroutine refuse(traits, surface, words)
      type(solver_traits), intent(in) :: traits
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      associate (unused => surface); end associate
      words = ''
      if (.not. traits%has_details) words = "solver = '"//trim(solver_names(traits%solver))// &
         "' does not compute them for every load; "//solvers_with('details')//' does'
   end subroutine refuse

   subroutine put_details(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(contact_details) :: details
      real(dp) :: numbers(numbers_of_details)
      logical :: found

      associate (solution => results%loads(load), measures => results%loads(load)%measures)
         call solution%details(details, found)
         numbers = not_a_number()
         if (found) numbers = [details%trough_gap, details%trough_gap_error, &
                               details%saddle_gap, details%saddle_gap_error, &
                               details%saddle_pressure, details%saddle_pressure_error, &
                               details%energy, details%energy_error, details%perimeter, details%perimeter_error]
         call file%add(load)
         call file%add([solution%pbar_over_pstar, measures%mean_gap_over_amplitude, measures%mean_gap_error, &
                        measures%contact_area_fraction, measures%contact_area_error, &
                        measures%peak_pressure_over_pstar, measures%peak_pressure_error, numbers])
         call file%add(details%degree)
      end associate
      call results%end_row(file, load)
   end subroutine put_details

end module wavycon_details_table
