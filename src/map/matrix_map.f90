!> Makes height maps from lines with a row of heights each.
module wavycon_matrix_map
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: check_map_size, laid_along_x
   use wavycon_measured_map, only: measured_map
   use wavycon_number_table, only: number_table
   use wavycon_plain_text, only: integer_text
   implicit none (type, external)
   private

   public :: take_matrix

contains

   !> Makes a map; missing heights are NaN. Errors: exit_bad_input for rows of unequal length and for too few or too
   !> many points.
   subroutine take_matrix(table, map, error)
      type(number_table), intent(in) :: table
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      integer :: columns, j, length

      ! A separator at the end of the first row may end it, or stand before a last height that is missing there.
      columns = table%length(1)
      if (table%ends_open(1) .and. any(table%first(2:) - table%first(:table%rows()) == columns + 1)) &
         columns = columns + 1
      do j = 2, table%rows()
         length = table%length(j)
         if (length == columns .or. (length == columns - 1 .and. table%ends_open(j))) cycle
         call table%refuse(j, 'this row has '//integer_text(length)//' heights, the first has '// &
                           integer_text(table%length(1))//': all must have the same number (write nan for a height '// &
                           "that is missing). Is it file_format = 'xyz'?", error)
         return
      end do
      call check_map_size(table%path, laid_along_x([columns, table%rows()]), error)
      if (allocated(error)) return
      allocate (map%height(columns, table%rows()))
      do j = 1, table%rows()
         length = table%length(j)
         map%height(:length, j) = table%values(table%first(j):table%first(j + 1) - 1)
         map%height(length + 1:, j) = ieee_value(0.0_dp, ieee_quiet_nan)
      end do
   end subroutine take_matrix

end module wavycon_matrix_map
