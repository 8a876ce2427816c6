!> Histogram of the values of a field over an area, in bins of equal width.
module wavycon_histogram
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: histogram, make_histogram

   type :: histogram
      real(dp) :: first = 0.0_dp, width = 0.0_dp   !! lower end of the first bin, and the width of each bin
      real(dp), allocatable :: fraction(:)         !! for each bin, part of the whole area with values in the bin
      real(dp), allocatable :: mean(:)             !! mean of the values in the bin; its middle if there are none
   contains
      procedure :: middle, density
   end type histogram

contains

   !> Makes a histogram of selected values of a field, such as the pressures at the points in contact.
   !>
   !> The bins reach from the least selected value, or 0 if that is less, to the largest one. Each value stands for an
   !> equal part of the area, or the field is linear between selected points, (A7). In both cases the sum of
   !> fraction*mean over the bins is the sum of the selected values over the number of all values.
   pure subroutine make_histogram(values, selected, bins, is_continuous, answer)
      real(dp), intent(in) :: values(:, :)
      logical, intent(in) :: selected(:, :)      !! which values to take, of the same shape
      integer, intent(in) :: bins                !! number of bins, >= 1
      !> False: each value stands for an equal part of the area. True: the values are those at the points of a periodic
      !> grid, and between selected points the field is linear, (A7).
      logical, intent(in) :: is_continuous
      type(histogram), intent(out) :: answer

      integer :: k, l

      answer%first = min(0.0_dp, minval(values, mask=selected))
      answer%width = (max(0.0_dp, maxval(values, mask=selected)) - answer%first)/bins
      allocate (answer%fraction(bins), answer%mean(bins), source=0.0_dp)
      if (.not. any(selected)) answer%width = 0.0_dp
      do l = 1, size(values, 2)
         do k = 1, size(values, 1)
            if (is_continuous) then
               call add_cell(answer, values, selected, k, l)
            else if (selected(k, l)) then
               call add_value(answer, values(k, l), 1.0_dp)
            end if
         end do
      end do
      where (answer%fraction > 0.0_dp)
         answer%mean = answer%mean/answer%fraction
      elsewhere
         answer%mean = answer%middle([(k, k=1, bins)])
      end where
      answer%fraction = answer%fraction/size(values)
   end subroutine make_histogram

   !> Adds one grid cell. A cell can be divided into two triangles in two ways. All four triangles are added, each with
   !> half of its area, so that no diagonal is preferred.
   pure subroutine add_cell(answer, values, selected, k, l)
      type(histogram), intent(inout) :: answer
      real(dp), intent(in) :: values(:, :)
      logical, intent(in) :: selected(:, :)
      integer, intent(in) :: k, l   !! lower left corner of the cell

      real(dp) :: corner(4)
      logical :: inside(4)
      integer :: i, k_next, l_next, three(3)

      k_next = mod(k, size(values, 1)) + 1
      l_next = mod(l, size(values, 2)) + 1
      inside = [selected(k, l), selected(k_next, l), selected(k_next, l_next), selected(k, l_next)]
      if (.not. any(inside)) return
      corner = [values(k, l), values(k_next, l), values(k_next, l_next), values(k, l_next)]
      do i = 1, 4
         three = [i, mod(i, 4) + 1, mod(i + 1, 4) + 1]
         call add_triangle(answer, corner(three), inside(three), 0.25_dp)
      end do
   end subroutine add_cell

   !> Adds a triangle. If all corners are selected, each bin gets the part of the triangle in which the linear function
   !> through the corners has values in the bin. Otherwise each selected corner gets a third of the weight.
   pure subroutine add_triangle(answer, corner, inside, weight)
      type(histogram), intent(inout) :: answer
      real(dp), intent(in) :: corner(3)    !! values at the corners
      logical, intent(in) :: inside(3)     !! whether each corner is selected
      real(dp), intent(in) :: weight       !! area of the triangle that counts, in grid cells

      real(dp) :: high, least, middle, most, up_to_high(2), up_to_last(2)
      integer :: bin, i, lowest, highest

      least = minval(corner)
      most = maxval(corner)
      lowest = bin_of(answer, least)
      highest = bin_of(answer, most)
      if (.not. all(inside) .or. lowest == highest) then
         do i = 1, 3
            if (inside(i)) call add_value(answer, corner(i), weight/3)
         end do
         return
      end if
      middle = max(min(corner(1), corner(2)), min(max(corner(1), corner(2)), corner(3)))
      up_to_last = 0.0_dp
      do bin = lowest, highest
         ! Rounding may put the end of the bin of the least value below this value.
         high = max(answer%first + bin*answer%width, least)
         if (bin == highest) high = most
         up_to_high = below(high, least, middle, most)
         answer%fraction(bin) = answer%fraction(bin) + weight*(up_to_high(1) - up_to_last(1))
         answer%mean(bin) = answer%mean(bin) + weight*(up_to_high(2) - up_to_last(2))
         up_to_last = up_to_high
      end do
   end subroutine add_triangle

   !> The part of a triangle in which a linear function is below a value, (A7), and the integral of the function over
   !> this part, both over the area of the triangle.
   pure function below(value, least, middle, most) result(part)
      real(dp), intent(in) :: value                   !! least <= value <= most
      real(dp), intent(in) :: least, middle, most     !! the function at the corners, ascending, least < most
      real(dp) :: part(2)

      real(dp) :: rest   ! the part in which the function is above the value

      if (value < middle) then
         part(1) = (value - least)**2/((middle - least)*(most - least))
         part(2) = part(1)*(least + 2*(value - least)/3)
      else
         rest = 0.0_dp
         if (value < most) rest = (most - value)**2/((most - least)*(most - middle))
         part(1) = 1.0_dp - rest
         part(2) = (least + middle + most)/3 - rest*(most - 2*(most - value)/3)
      end if
   end function below

   !> Adds a value to its bin.
   pure subroutine add_value(answer, value, weight)
      type(histogram), intent(inout) :: answer
      real(dp), intent(in) :: value
      real(dp), intent(in) :: weight   !! area that has the value, in grid cells

      associate (bin => bin_of(answer, value))
         answer%fraction(bin) = answer%fraction(bin) + weight
         answer%mean(bin) = answer%mean(bin) + weight*value
      end associate
   end subroutine add_value

   !> The number of a value's bin; for a value outside all bins the number of the nearest bin.
   pure integer function bin_of(answer, value) result(bin)
      type(histogram), intent(in) :: answer
      real(dp), intent(in) :: value

      bin = 1
      if (answer%width > 0.0_dp) &
         bin = int(max(0.0_dp, min((value - answer%first)/answer%width, size(answer%fraction) - 0.5_dp))) + 1
   end function bin_of

   !> The value in the middle of a bin.
   elemental real(dp) function middle(self, bin)
      class(histogram), intent(in) :: self
      integer, intent(in) :: bin   !! 1 .. bins

      middle = self%first + (bin - 0.5_dp)*self%width
   end function middle

   !> The density (A6) in a bin: the fraction of the area over the bin's width; 0 if all values are 0.
   elemental real(dp) function density(self, bin)
      class(histogram), intent(in) :: self
      integer, intent(in) :: bin   !! 1 .. bins

      density = 0.0_dp
      if (self%width > 0.0_dp) density = self%fraction(bin)/self%width
   end function density

end module wavycon_histogram
