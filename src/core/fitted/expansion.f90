!> A contact spot or an open pool as an expansion over the unit disc.
!>
!> Below merging it is the pressure on one spot about a crest, above merging the gap over one pool about a trough:
!>
!>     (1 - |w|^2)^power times the sum over i of c_i Psi_i(w),
!>
!> README.md (F23), with the disc polynomials Psi_i orthonormal with this weight, and the disc mapped to the spot or
!> pool. The power is 1/2 of a spot and 3/2 of a pool; with adhesion it is less by 1, as pressures and slopes are
!> singular at the edge (F65). Lengths in s, pressures in pi E* Delta/s, gaps in Delta; places from the centre of the
!> spot or pool.
!>
!> Without adhesion the load is given and the size follows; with adhesion the area is given and the load follows.
module wavycon_expansion
   use wavycon_disc_polynomials, only: disc_polynomials, start_disc_polynomials
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: edge_power, expansion

   type :: expansion
      logical :: pool = .false.            !! the gap over a pool; otherwise the pressure on a spot
      type(disc_polynomials) :: basis
      type(shape_map) :: shape
      real(dp), allocatable :: c(:)          !! coefficients of the basis, shape (N)
      real(dp) :: approach = 0.0_dp          !! delta of a spot, u + h = delta in contact [Delta]
      real(dp) :: load = 0.0_dp              !! P, the mean pressure; < 0 is a tension [pi E* Delta/s]
      real(dp) :: work = 0.0_dp              !! W, the work of adhesion, >= 0 [pi E* Delta^2/s]
      real(dp) :: area = 0.0_dp              !! given with adhesion: of the spot or pool [s^2]
   contains
      procedure :: resized
      procedure :: at
   end type expansion

contains

   !> The power of 1 - |w|^2: of a spot's pressure or a pool's gap at the edge, without or with adhesion.
   pure real(dp) function edge_power(pool, adhesive)
      logical, intent(in) :: pool, adhesive

      edge_power = 0.5_dp
      if (pool) edge_power = edge_power + 1.0_dp
      if (adhesive) edge_power = edge_power - 1.0_dp
   end function edge_power

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
      copy%load = self%load
      copy%work = self%work
      copy%area = self%area
   end function resized

   !> The value at a point of the disc, 0 outside and on the edge; at the centre a spot's peak pressure, or a pool's gap
   !> at the trough.
   real(dp) function at(self, w)
      class(expansion), intent(in) :: self
      complex(dp), intent(in) :: w

      real(dp) :: inside, values(1, self%basis%terms)

      at = 0.0_dp
      inside = (1.0_dp - abs(w))*(1.0_dp + abs(w))
      if (inside <= 0.0_dp) return
      call self%basis%evaluate(1, [w], values)
      at = dot_product(values(1, :), self%c)*inside**self%basis%power
   end function at

end module wavycon_expansion
