!> Coordinates outside of a spot or island that follow its edge: the plane outside as a map of the plane outside the
!> unit disc.
!>
!>     z(v) = b_0 v (1 - tau/conj(v)^fold) + sum over k = 1..K of b_k v^(1 - fold k),   |v| >= 1,   README.md (F48).
!>
!> On the circle it is the map of the disc, wavycon_shape_map. It does not fold where that one's continuation does: with
!> tau = 0 it is conformal.
module wavycon_exterior_map
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   use wavycon_shape_search, only: find_edge_in_direction
   implicit none (type, external)
   private

   public :: exterior_place, find_exterior, linearise_exterior

   !> Safety limit: most steps of Newton's iteration. At the limit no preimage is found.
   integer, parameter :: most_steps = 40

contains

   !> z(v) [s] and its derivatives dz/dv and dz/d conj(v) [s].
   pure subroutine linearise_exterior(shape, v, z, slope, conjugate_slope)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: v               !! not 0
      complex(dp), intent(out) :: z, slope, conjugate_slope

      complex(dp) :: inverse, power, sum_of_terms, sum_of_slopes
      integer :: k

      inverse = 1.0_dp/v
      power = inverse**shape%fold
      ! By Horner's scheme: b_0 + b_1 v^-fold + ..., and the same with the factors 1 - fold k.
      sum_of_terms = 0.0_dp
      sum_of_slopes = 0.0_dp
      do k = ubound(shape%b, 1), 0, -1
         sum_of_terms = sum_of_terms*power + shape%b(k)
         sum_of_slopes = sum_of_slopes*power + (1 - shape%fold*k)*shape%b(k)
      end do
      z = v*sum_of_terms
      slope = sum_of_slopes
      conjugate_slope = 0.0_dp
      if (shape%clustering > 0.0_dp) then
         power = shape%clustering*shape%b(0)*conjg(power)
         z = z - v*power
         slope = slope - power
         conjugate_slope = shape%fold*v*power*conjg(inverse)
      end if
   end subroutine linearise_exterior

   !> z(v) [s].
   pure complex(dp) function exterior_place(shape, v) result(z)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: v         !! |v| >= 1

      complex(dp) :: slope, conjugate_slope

      call linearise_exterior(shape, v, z, slope, conjugate_slope)
   end function exterior_place

   !> The preimage of a place, by Newton's method (F19) from the edge in the direction of the place.
   pure subroutine find_exterior(shape, z, v, found)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: z                !! [s], not 0
      complex(dp), intent(out) :: v
      logical, intent(out) :: found               !! whether v is a preimage with |v| >= 1: whether z is outside

      !> Relative step after which the next one would be below rounding, as convergence is quadratic.
      real(dp), parameter :: small_step = 1e-9_dp
      !> Longest step over |v|.
      real(dp), parameter :: longest_step = 0.3_dp
      !> Least Jacobian over b_0^2 on the way: at a tip the map folds next to the edge.
      real(dp), parameter :: least_jacobian = 1e-6_dp
      integer, parameter :: most_cuts = 5
      complex(dp) :: at_v, conjugate_slope, edge, left, slope, step
      real(dp) :: jacobian
      integer :: cuts, i

      call find_edge_in_direction(shape, z, v, edge)
      v = v*max(abs(z)/abs(edge), 1.0_dp)
      found = .false.
      cuts = 0
      do i = 1, most_steps
         call linearise_exterior(shape, v, at_v, slope, conjugate_slope)
         left = z - at_v
         jacobian = slope%re**2 + slope%im**2 - (conjugate_slope%re**2 + conjugate_slope%im**2)
         if (.not. jacobian > least_jacobian*shape%b(0)**2) exit
         step = (conjg(slope)*left - conjugate_slope*conjg(left))/jacobian
         if (abs(step) > longest_step*abs(v)) step = step*(longest_step*abs(v)/abs(step))
         v = v + step
         found = abs(v) >= 1.0_dp
         if (abs(step) <= small_step*abs(v)) return
         if (found) cycle
         ! Steps from the edge inwards are cut there. To go that way again and again is the sign of a place inside.
         cuts = cuts + 1
         if (cuts > most_cuts) return
         v = v/abs(v)
      end do
      found = .false.
   end subroutine find_exterior

end module wavycon_exterior_map
