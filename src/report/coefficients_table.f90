!> <case>.coefficients.dat: the Fourier coefficients of the pressure, A_i of eq. (12) or A_ij of eq. (25), a block for
!> each load.
module wavycon_coefficients_table
   use wavycon_contact_solver, only: solver_traits
   use wavycon_error, only: error_type
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: solver_names
   use wavycon_surface, only: surface_type
   use wavycon_method_list, only: solvers_with_coefficients
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: coefficients_table

   !> In 1-D j = 0.
   character(40), parameter :: columns(*) = [character(40) :: 'load[-]', 'i[-]', 'j[-]', 'pressure_over_pstar[-]']

   type, extends(table_type) :: coefficients_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: refusal
      procedure, nopass :: write => write_coefficients_table
   end type coefficients_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'coefficients'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'The Fourier coefficients of the pressure.'
   end function meaning

   function refusal(self, traits, surface) result(words)
      class(coefficients_table), intent(in) :: self
      type(solver_traits), intent(in) :: traits
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      associate (unused => self, unused_too => surface); end associate
      words = ''
      if (.not. traits%has_coefficients) words = "solver = '"//trim(solver_names(traits%solver))// &
         "' has no series of given length; "//solvers_with_coefficients()//' has'
   end function refusal

   !> Errors: exit_file_trouble.
   subroutine write_coefficients_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      type(fourier_series) :: pressure
      integer :: load, i, j

      call results%open_table('coefficients', columns, file, in_blocks=.true.)
      do load = 1, size(results%loads)
         call results%begin_block(file, load)
         call results%loads(load)%coefficients(results%solver%surface, pressure)
         if (.not. allocated(pressure%c)) cycle
         do i = 0, ubound(pressure%c, 1)
            do j = 0, ubound(pressure%c, 2)
               if (i + j == 0) cycle
               call file%add(load)
               call file%add(i)
               call file%add(j)
               call file%add(pressure%c(i, j))
               call file%end_row()
            end do
         end do
      end do
      call file%finish(error)
   end subroutine write_coefficients_table

end module wavycon_coefficients_table
