!> The density of values over an area, in bins of equal width.
module wavycon_histogram
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: histogram, make_histogram

   type :: histogram
      real(dp) :: first = 0.0_dp, width = 0.0_dp   !! lower end of the first bin, and the width of each
      real(dp), allocatable :: fraction(:)         !! of the area with values in the bin
      real(dp), allocatable :: mean(:)             !! of these values; the middle of the bin if there are none
   contains
      procedure :: middle
      procedure :: density
   end type histogram

contains

   !> Sorts the values of equal parts of the area that are selected into bins between the lowest, but at most 0, and the
   !> highest. The sum of fraction*mean is exactly their part of the mean over the whole area.
   pure subroutine make_histogram(values, selected, bins, answer)
      real(dp), intent(in) :: values(:, :)
      logical, intent(in) :: selected(:, :)      !! of the same shape
      integer, intent(in) :: bins                !! >= 1
      type(histogram), intent(out) :: answer

      integer :: bin, k, l

      answer%first = min(0.0_dp, minval(values, mask=selected))
      answer%width = (max(0.0_dp, maxval(values, mask=selected)) - answer%first)/bins
      allocate (answer%fraction(bins), answer%mean(bins), source=0.0_dp)
      if (.not. answer%width > 0.0_dp) answer%width = 0.0_dp
      do l = 1, size(values, 2)
         do k = 1, size(values, 1)
            if (.not. selected(k, l)) cycle
            bin = 1
            if (answer%width > 0.0_dp) bin = min(int((values(k, l) - answer%first)/answer%width), bins - 1) + 1
            answer%fraction(bin) = answer%fraction(bin) + 1.0_dp
            answer%mean(bin) = answer%mean(bin) + values(k, l)
         end do
      end do
      where (answer%fraction > 0.0_dp)
         answer%mean = answer%mean/answer%fraction
      elsewhere
         answer%mean = answer%middle([(k, k=1, bins)])
      end where
      answer%fraction = answer%fraction/size(values)
   end subroutine make_histogram

   !> The value in the middle of a bin.
   elemental real(dp) function middle(self, bin)
      class(histogram), intent(in) :: self
      integer, intent(in) :: bin   !! 1 .. bins

      middle = self%first + (bin - 0.5_dp)*self%width
   end function middle

   !> Fraction of the area over width of a bin; 0 if all values are 0.
   elemental real(dp) function density(self, bin)
      class(histogram), intent(in) :: self
      integer, intent(in) :: bin   !! 1 .. bins

      density = 0.0_dp
      if (self%width > 0.0_dp) density = self%fraction(bin)/self%width
   end function density

end module wavycon_histogram
