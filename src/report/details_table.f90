!> <case>.details.dat: numbers that the summary does not have, with error estimates, from solvers that compute them.
!>
!> The table has a line for each load; for a load without details (no load, full contact, no solution) that line is a
!> comment with the status.
module wavycon_details_table
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_solver, only: contact_solver
   use wavycon_error, only: error_type
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: exact_number
   use wavycon_results, only: results_type
   use wavycon_surface, only: surface_type
   use wavycon_solver_list, only: solvers_with_details
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: details_table

   !> The energy is per nominal area. The perimeter is that of one contact spot or, above merging, of one open island;
   !> the paper's cell has two of each.
   character(40), parameter :: columns(*) = [character(40) :: &
      'pbar_over_pstar[-]', 'mean_gap[Delta]', 'mean_gap_error[Delta]', 'contact_area_fraction[-]', &
      'contact_area_error[-]', 'peak_pressure[p*]', 'peak_pressure_error[p*]', 'trough_gap[Delta]', &
      'trough_gap_error[Delta]', 'saddle_gap[Delta]', 'saddle_gap_error[Delta]', 'saddle_pressure[p*]', &
      'saddle_pressure_error[p*]', 'elastic_energy[p*Delta]', 'elastic_energy_error[p*Delta]', &
      'perimeter[length]', 'perimeter_error[length]', 'degree[-]', 'status[-]']

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

   function refusal(self, solver, surface) result(words)
      class(details_table), intent(in) :: self
      class(contact_solver), intent(in) :: solver
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      associate (unused => self, unused_too => surface); end associate
      words = ''
      if (.not. solver%has_details()) words = "solver = '"//solver%name()// &
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
      integer :: load
      logical :: found

      call results%open_table('details', file)
      call file%put_columns(columns)
      do load = 1, size(results%loads)
         associate (solution => results%loads(load)%solution)
            call solution%details(details, found)
            if (.not. found) then
               call file%put('# no details at pbar/p* = '//exact_number(solution%pbar_over_pstar)//': '// &
                             trim(solution%status))
               cycle
            end if
            associate (measures => solution%measures)
               call file%add([solution%pbar_over_pstar, &
                              measures%mean_gap_over_amplitude, measures%mean_gap_error, &
                              measures%contact_area_fraction, measures%contact_area_error, &
                              measures%peak_pressure_over_pstar, measures%peak_pressure_error, &
                              details%trough_gap, details%trough_gap_error, &
                              details%saddle_gap, details%saddle_gap_error, &
                              details%saddle_pressure, details%saddle_pressure_error, &
                              details%energy, details%energy_error, details%perimeter, details%perimeter_error])
            end associate
            call file%add(details%degree)
            call file%add(trim(solution%status))
            call file%end_row()
         end associate
      end do
      call file%finish(error)
   end subroutine write_details_table

end module wavycon_details_table
