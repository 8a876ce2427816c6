!> The smaller cell of a surface: a square turned by 45 degrees that repeats it, with half the area.
module wavycon_smaller_cell
   use wavycon_constants, only: sqrt2
   use wavycon_rotated_series, only: to_sum_angles
   use wavycon_surface, only: shape_rounding, surface_type
   implicit none (type, external)
   private

   public :: has_smaller_cell, smaller_cell

contains

   !> Whether the surface is periodic on a square of half the area, rotated by 45 degrees, and there even and symmetric
   !> under exchange of the directions. A height map is taken as it is.
   pure logical function has_smaller_cell(surface)
      type(surface_type), intent(in) :: surface

      integer :: i, j, n

      has_smaller_cell = .false.
      if (surface%is_height_map() .or. surface%has_free_edges .or. surface%dimension == 1) return
      if (.not. (surface%shape%is_even() .and. surface%is_square())) return
      associate (c => surface%shape%c)
         n = ubound(c, 1)
         if (n /= ubound(c, 2)) return
         has_smaller_cell = all(abs(c - transpose(c)) <= shape_rounding)
         do j = 0, n
            do i = 0, n
               if (mod(i + j, 2) == 1) has_smaller_cell = has_smaller_cell .and. abs(c(i, j)) <= shape_rounding
            end do
         end do
      end associate
   end function has_smaller_cell

   !> The same surface on its smaller cell, see has_smaller_cell: the angles of that cell are X + Y and X - Y.
   type(surface_type) function smaller_cell(whole) result(surface)
      type(surface_type), intent(in) :: whole   !! has_smaller_cell

      surface = whole
      surface%shape = to_sum_angles(whole%shape)
      surface%length = whole%length/sqrt2
      surface%crest = [whole%crest(1) + whole%crest(2), whole%crest(1) - whole%crest(2)]
   end function smaller_cell

end module wavycon_smaller_cell
