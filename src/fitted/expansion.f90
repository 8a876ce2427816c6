!> A contact spot or an open island as sums over the unit disc, and what integrates over it.
!>
!> Below merging the pressure on one spot about a crest, above it the gap over one island about a trough: (1 -
!> |w|^2)^power, power 1/2 or 3/2, times disc polynomials, the disc mapped by a shape. Lengths in s, pressures
!> in pi E* Delta/s, gaps in Delta; places from the centre of the spot or island.
module wavycon_expansion
   use wavycon_disc_polynomials, only: disc_polynomials, start_disc_polynomials
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: expansion

   type :: expansion
      logical :: island = .false.            !! the gap over an island; otherwise the pressure on a spot
      type(disc_polynomials) :: basis
      type(shape_map) :: shape
      real(dp), allocatable :: c(:)          !! coefficients of the basis, shape (N)
      real(dp) :: approach = 0.0_dp          !! delta below merging: u + h = delta in contact
   contains
      procedure :: raised
      procedure :: at
      procedure :: at_centre
   end type expansion

contains

   !> The same function in a basis of another degree, with another number of shape terms; what does not fit is
   !> dropped. With another crowding it is nearly the same.
   function raised(self, degree, shape_terms, crowding) result(copy)
      class(expansion), intent(in) :: self
      integer, intent(in) :: degree       !! of the new basis
      integer, intent(in) :: shape_terms  !! K >= 1
      real(dp), intent(in) :: crowding    !! of the shape, near the one it has
      type(expansion) :: copy

      integer :: i, n

      copy%island = self%island
      call start_disc_polynomials(copy%basis, self%basis%fold, degree, self%basis%power)
      allocate (copy%c(copy%basis%terms), source=0.0_dp)
      do i = 1, copy%basis%terms
         associate (angular => copy%basis%angular(i), radial => copy%basis%radial(i))
            n = findloc(self%basis%angular == angular .and. self%basis%radial == radial, .true., dim=1)
         end associate
         if (n > 0) copy%c(i) = self%c(n)
      end do
      copy%shape%fold = self%shape%fold
      allocate (copy%shape%b(0:shape_terms), source=0.0_dp)
      n = min(shape_terms, ubound(self%shape%b, 1))
      copy%shape%b(:n) = self%shape%b(:n)
      copy%shape%crowding = crowding
      copy%shape%b(1) = copy%shape%b(1) + (crowding - self%shape%crowding)*copy%shape%b(0)
      copy%approach = self%approach
   end function raised

   !> The value at the centre: a spot's peak pressure, an island's gap at the trough.
   real(dp) function at_centre(self)
      class(expansion), intent(in) :: self

      real(dp) :: values(1, self%basis%terms)

      call self%basis%evaluate(1, [(0.0_dp, 0.0_dp)], values)
      at_centre = dot_product(values(1, :), self%c)
   end function at_centre

   !> The value at a point of the disc, with its weight; 0 outside.
   real(dp) function at(self, w)
      class(expansion), intent(in) :: self
      complex(dp), intent(in) :: w

      real(dp) :: values(1, self%basis%terms)

      call self%basis%evaluate(1, [w], values)
      at = dot_product(values(1, :), self%c) &
         *max((1.0_dp - abs(w))*(1.0_dp + abs(w)), 0.0_dp)**self%basis%power
   end function at

end module wavycon_expansion
