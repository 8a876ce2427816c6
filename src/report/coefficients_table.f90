!> <case>.coefficients.dat: the Fourier coefficients of the pressure, A_i of eq. (12) or A_ij of eq. (25), a block a load.
module wavycon_coefficients_table
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   implicit none (type, external)
   private

   public :: write_coefficients_table

contains

   !> Errors: exit_file_trouble.
   subroutine write_coefficients_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      real(dp), allocatable :: a(:, :)
      character(40) :: numbers
      integer :: load, i, j

      call results%open_table('coefficients', file)
      if (results%scene%surface%dimension == 1) then
         call file%put('#  i        A_i[-]')
      else
         call file%put('#  i  j     A_ij[-]')
      end if
      do load = 1, size(results%states)
         call results%put_load_heading(file, load, first=load == 1)
         call results%contact%terms%coefficients(results%states(load)%x, a)
         do i = 0, ubound(a, 1)
            do j = 0, ubound(a, 2)
               if (i + j == 0) cycle
               if (results%scene%surface%dimension == 1) then
                  write (numbers, '(i4, 1x, es24.15e3)') i, a(i, j)
               else
                  write (numbers, '(i4, i3, 1x, es24.15e3)') i, j, a(i, j)
               end if
               call file%put(trim(numbers))
            end do
         end do
      end do
      call file%finish(error)
   end subroutine write_coefficients_table

end module wavycon_coefficients_table
