!> <case>.summary.dat: mean gap, contact area, pressures, iterations, residual and status, a line for each load.
module wavycon_summary_table
   use wavycon_error, only: error_type
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: summary_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'pbar_over_pstar[-]', 'mean_pressure[pressure]', 'mean_gap_over_amplitude[-]', 'approach_over_amplitude[-]', &
      'contact_area_fraction[-]', 'peak_pressure_over_pstar[-]', 'min_pressure_over_pstar[-]', &
      'active_constraints[-]', 'iterations[-]', 'residual[-]']
   !> Error estimates and the solver of each load. Written only if the solver estimates errors, which 'beale' does not.
   character(40), parameter :: error_columns(*) = [character(40) :: &
      'mean_gap_error[-]', 'contact_area_error[-]', 'peak_pressure_error[-]', 'solver[-]']

   type, extends(table_type) :: summary_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: is_for_flat_surfaces
      procedure, nopass :: write => write_summary_table
   end type summary_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = ''
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'A line for each load: mean gap, contact area, pressures.'
   end function meaning

   pure logical function is_for_flat_surfaces(self)
      class(summary_table), intent(in) :: self

      associate (unused => self); end associate
      is_for_flat_surfaces = .true.
   end function is_for_flat_surfaces

   !> Errors: exit_file_trouble.
   subroutine write_summary_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      logical :: with_errors
      integer :: i

      call results%open_table('summary', file)
      with_errors = results%solver%has_error_estimates()
      call file%put_columns([character(40) :: columns, error_columns(:merge(size(error_columns), 0, with_errors)), &
                             'status[-]'])
      do i = 1, size(results%loads)
         associate (solution => results%loads(i)%solution, measures => results%loads(i)%solution%measures)
            call file%add([solution%pbar_over_pstar, results%mean_pressure(i), &
                           measures%mean_gap_over_amplitude, measures%approach_over_amplitude, &
                           measures%contact_area_fraction, measures%peak_pressure_over_pstar, &
                           measures%min_pressure_over_pstar])
            call file%add(solution%active_constraints)
            call file%add(solution%iterations)
            call file%add(solution%residual)
            if (with_errors) then
               call file%add([measures%mean_gap_error, measures%contact_area_error, measures%peak_pressure_error])
               call file%add(trim(solution%solver))
            end if
            call file%add(trim(solution%status))
            call file%end_row()
         end associate
      end do
      call file%finish(error)
   end subroutine write_summary_table

end module wavycon_summary_table
