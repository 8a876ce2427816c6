!> <case>.coefficients.dat: the Fourier coefficients of the pressure, A_i of eq. (12) or A_ij of eq. (25), a block for
!> each load.
module wavycon_coefficients_table
   use wavycon_contact_solver, only: solver_traits
   use wavycon_fourier_series, only: fourier_series
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: solver_names
   use wavycon_surface, only: surface_type
   use wavycon_method_list, only: solvers_with
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: coefficients_table

   !> In 1-D j = 0.
   character(40), parameter :: columns(*) = [character(40) :: 'load[-]', 'i[-]', 'j[-]', 'pressure_over_pstar[-]']

contains

   type(table_type) function coefficients_table() result(table)
      table%file = 'coefficients'
      table%key = 'coefficients'
      table%meaning = 'The Fourier coefficients of the pressure.'
      call table%set_columns(columns)
      table%refuse => refuse
      table%put_load => put_coefficients
   end function coefficients_table

   subroutine refuse(traits, surface, words)
      type(solver_traits), intent(in) :: traits
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      associate (unused => surface); end associate
      words = ''
      if (.not. traits%has_coefficients) words = "solver = '"//trim(solver_names(traits%solver))// &
         "' has no series of given length; "//solvers_with('coefficients')//' has'
   end subroutine refuse

   subroutine put_coefficients(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(fourier_series) :: pressure
      integer :: i, j

      call results%begin_block(file, load)
      call results%loads(load)%coefficients(results%solver%surface, pressure)
      if (.not. allocated(pressure%c)) return
      do i = 0, ubound(pressure%c, 1)
         do j = 0, ubound(pressure%c, 2)
            if (i + j == 0) cycle
            call file%add([load, i, j])
            call file%add(pressure%c(i, j))
            call file%end_row()
         end do
      end do
   end subroutine put_coefficients

end module wavycon_coefficients_table
