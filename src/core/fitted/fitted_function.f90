!> A fitted function: the pressure on a contact spot, or the gap over an open pool, as a sum of polynomials on the unit
!> disc.
!>
!> Where spots are separate the fitted function is the pressure on one spot around a crest. Where pools are separate it
!> is the gap over one pool around a trough. Both are
!>
!>     (1 - |w|^2)^power times the sum over i of c_i Psi_i(w),
!>
!> README.md (F23), with the polynomials Psi_i that are orthonormal with this weight. The disc is mapped to the spot or
!> pool. The power is 1/2 for a spot and 3/2 for a pool. With adhesion it is less by 1, because pressures and slopes are
!> singular at the edge (F65). Lengths are in s, pressures in pi E* Delta/s, gaps in Delta. Positions are measured from
!> the centre of the spot or pool.
!>
!> Without adhesion the load is given and the size follows. With adhesion the area is given and the load follows.
module wavycon_fitted_function
   use wavycon_disc_polynomials, only: disc_polynomials, start_disc_polynomials
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: fitted_function

   type :: fitted_function
      logical :: pool = .false.              !! true: the gap over a pool; false: the pressure on a spot
      type(disc_polynomials) :: basis        !! the polynomials Psi_i
      type(shape_map) :: shape               !! the map of the disc to the spot or pool
      real(dp), allocatable :: c(:)          !! coefficients c_i, shape (N) [pi E* Delta/s, for a pool Delta]
      real(dp) :: approach = 0.0_dp          !! for a spot: approach delta, u + h = delta in contact [Delta]
      real(dp) :: load = 0.0_dp              !! mean pressure P; < 0 is a tension [pi E* Delta/s]
      real(dp) :: work = 0.0_dp              !! work of adhesion W >= 0 [pi E* Delta^2/s]
      real(dp) :: area = 0.0_dp              !! with adhesion only: given area of the spot or pool [s^2]
   contains
      procedure :: resized, at
   end type fitted_function

contains

   !> The same function in a basis of another degree and with another number of shape terms. New coefficients are 0, and
   !> those of polynomials that a smaller basis lacks are dropped. With another clustering the function changes a
   !> little.
   function resized(self, degree, shape_terms, clustering) result(copy)
      class(fitted_function), intent(in) :: self
      integer, intent(in) :: degree           !! degree of the new basis
      integer, intent(in) :: shape_terms      !! number K of the new shape's terms, >= 1
      real(dp), intent(in) :: clustering      !! tau of the new shape, close to that of the old one
      type(fitted_function) :: copy

      integer :: i, n

      copy = self
      call start_disc_polynomials(copy%basis, self%basis%fold, degree, self%basis%power)
      copy%c = [(0.0_dp, i=1, copy%basis%terms)]
      do i = 1, copy%basis%terms
         n = findloc(self%basis%angular == copy%basis%angular(i) .and. self%basis%radial == copy%basis%radial(i), &
                     .true., dim=1)
         if (n > 0) copy%c(i) = self%c(n)
      end do
      deallocate (copy%shape%b)
      allocate (copy%shape%b(0:shape_terms), source=0.0_dp)
      n = min(shape_terms, ubound(self%shape%b, 1))
      copy%shape%b(:n) = self%shape%b(:n)
      copy%shape%clustering = clustering
      ! README.md (F18): on a circle the changes of tau and b_1 together move a point of the edge by
      ! -2 i tau b_0 w sin(fold phi), which is along the edge.
      copy%shape%b(1) = copy%shape%b(1) + (clustering - self%shape%clustering)*copy%shape%b(0)
   end function resized

   !> The pressure or gap at a point of the disc; 0 outside and on the edge. The value at the centre is a spot's peak
   !> pressure or a pool's gap at the trough.
   real(dp) function at(self, w)
      class(fitted_function), intent(in) :: self
      complex(dp), intent(in) :: w

      real(dp) :: inside, values(1, self%basis%terms)

      at = 0.0_dp
      inside = (1.0_dp - abs(w))*(1.0_dp + abs(w))
      if (inside <= 0.0_dp) return
      call self%basis%evaluate(1, [w], values)
      at = dot_product(values(1, :), self%c)*inside**self%basis%power
   end function at

end module wavycon_fitted_function
