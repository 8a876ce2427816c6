!> A contact spot or an open pool as an expansion over the unit disc.
!>
!> Below merging it is the pressure on one spot about a crest, above merging the gap over one pool about a trough:
!>
!>     (1 - |w|^2)^power times the sum over i of c_i P_i(w),
!>
!> README.md (F23), power 1/2 or 3/2, with the disc polynomials P_i orthonormal with this weight, and the disc mapped to
!> the spot or pool. Lengths in s, pressures in pi E* Delta/s, gaps in Delta; places from the centre of the spot or
!> pool.
module wavycon_expansion
   use wavycon_disc_polynomials, only: disc_polynomials, start_disc_polynomials
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: expansion

   type :: expansion
      logical :: pool = .false.            !! the gap over a pool; otherwise the pressure on a spot
      type(disc_polynomials) :: basis
      type(shape_map) :: shape
      real(dp), allocatable :: c(:)          !! coefficients of the basis, shape (N)
      real(dp) :: approach = 0.0_dp          !! delta of a spot, u + h = delta in contact [Delta]
   contains
      procedure :: resized
      procedure :: at
   end type expansion

contains

   !> The same function in a basis of another degree and with another number of shape terms. New coefficients are 0;
   !> what has no place in a smaller basis is dropped. With another clustering the function changes a little.
   function resized(self, degree, shape_terms, clustering) result(copy)
      class(expansion), intent(in) :: self
      integer, intent(in) :: degree           !! of the new basis
      integer, intent(in) :: shape_terms      !! K >= 1
      real(dp), intent(in) :: clustering      !! tau of the shape, close to the one it has
      type(expansion) :: copy

      integer :: i, n

      copy%pool = self%pool
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
      copy%shape%clustering = clustering
      ! README.md (F18): on a circle both changes sum to -2 i tau b_0 w sin(fold phi), which is along the edge.
      copy%shape%b(1) = copy%shape%b(1) + (clustering - self%shape%clustering)*copy%shape%b(0)
      copy%approach = self%approach
   end function resized

   !> The value at a point of the disc, 0 outside; at the centre a spot's peak pressure, or a pool's gap at the trough.
   real(dp) function at(self, w)
      class(expansion), intent(in) :: self
      complex(dp), intent(in) :: w

      real(dp) :: values(1, self%basis%terms)

      call self%basis%evaluate(1, [w], values)
      at = dot_product(values(1, :), self%c)*max((1.0_dp - abs(w))*(1.0_dp + abs(w)), 0.0_dp)**self%basis%power
   end function at

end module wavycon_expansion
