!> <case>.details.dat: numbers that the summary does not have, with error estimates, from solvers that compute them.
!>
!> The table has a row for each load. What a load without details (no load, full contact, no solution) does not have is
!> NaN, its degree 0.
module wavycon_details_table
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_solver, only: solver_traits
   use wavycon_contact_status, only: status_code, status_name
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_solution_record, only: solver_names
   use wavycon_surface, only: surface_type
   use wavycon_method_list, only: solvers_with_details
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: details_table

   !> The energy is per nominal area. The perimeter is that of one contact spot or, above merging, of one open island;
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

   type, extends(table_type) :: details_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: refusal
      procedure :: needs_fields
      procedure, nopass :: write => write_details_table
   end type details_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'details'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'Gaps at trough and saddle, strain energy, perimeter and the numbers of the summary, each with its '// &
              'error estimate.'
   end function meaning

   function refusal(self, traits, surface) result(words)
      class(details_table), intent(in) :: self
      type(solver_traits), intent(in) :: traits
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      associate (unused => self, unused_too => surface); end associate
      words = ''
      if (.not. traits%has_details) words = "solver = '"//trim(solver_names(traits%solver))// &
         "' does not compute them for every load; "//solvers_with_details()//' does'
   end function refusal

   pure logical function needs_fields(self)
      class(details_table), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .true.
   end function needs_fields

   !> Errors: exit_file_trouble.
   subroutine write_details_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      type(contact_details) :: details
      real(dp) :: numbers(numbers_of_details)
      integer :: load
      logical :: found

      call results%open_table('details', columns, file, in_blocks=.false.)
      do load = 1, size(results%loads)
         associate (solution => results%loads(load))
            call solution%details(details, found)
            numbers = not_a_number()
            if (found) numbers = [details%trough_gap, details%trough_gap_error, &
                                  details%saddle_gap, details%saddle_gap_error, &
                                  details%saddle_pressure, details%saddle_pressure_error, &
                                  details%energy, details%energy_error, details%perimeter, details%perimeter_error]
            call file%add(load)
            associate (measures => solution%measures)
               call file%add([solution%pbar_over_pstar, measures%mean_gap_over_amplitude, measures%mean_gap_error, &
                              measures%contact_area_fraction, measures%contact_area_error, &
                              measures%peak_pressure_over_pstar, measures%peak_pressure_error, numbers])
            end associate
            call file%add(details%degree)
            call file%add(status_code(solution%status))
            call file%add(trim(status_name(solution%status)))
            call file%end_row()
         end associate
      end do
      call file%finish(error)
   end subroutine write_details_table

end module wavycon_details_table
