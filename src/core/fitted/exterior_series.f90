!> What one spot or pool adds to the displacement or the pressure outside of it, as a series in coordinates that
!> follow its edge:
!>
!>     sum over j, k of I_jk cos(fold j arg v) T_k(X),   X = 2 (1 - 1/|v|)^(1/2) - 1,   README.md (F49), (F50),
!>
!> v the preimage of the place under the exterior map, T Chebyshev's polynomials. It holds from the edge to infinity. Of
!> a pool with adhesion, next to which the pressure is singular, it is the pressure times (1 - 1/|v|)^(1/2).
module wavycon_exterior_series
   use wavycon_chebyshev_table, only: chebyshev_nodes, chebyshev_table
   use wavycon_constants, only: pi
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   use wavycon_stress_kernel, only: stress_fields, surface_field
   use wavycon_stress_rays, only: start_stress_rays, stress_rays
   implicit none (type, external)
   private

   public :: exterior_series, start_exterior_series

   type :: exterior_series
      type(chebyshev_table), private :: table     !! in cos(fold arg v) and X
      logical, private :: is_singular = .false.   !! at the edge
   contains
      procedure :: at
   end type exterior_series

   !> Terms in the angle: of the first series, and most.
   integer, parameter :: first_angles = 5, most_angles = 256
   !> Fall of the terms in X of a round disc, README.md (F50): the logarithm of the factor.
   real(dp), parameter :: round_fall = 1.22_dp
   !> Accuracy of the values over that of the series.
   real(dp), parameter :: values_share = 0.05_dp
   !> What is left out over the sum of the last two terms: at sharp tips terms fall slowly.
   real(dp), parameter :: rest = 3.0_dp
   !> Range of the factor on the number of terms from one fit to the next.
   real(dp), parameter :: least_factor = 1.15_dp, largest_factor = 2.5_dp

contains

   !> Makes the series, with more terms until the last ones are below the accuracy.
   subroutine start_exterior_series(series, solution, accuracy, most_places, found)
      type(exterior_series), intent(out) :: series
      type(expansion), intent(in) :: solution
      real(dp), intent(in) :: accuracy              !! over the largest term, > 0
      integer, intent(in) :: most_places            !! most places that values may be taken at
      logical, intent(out) :: found                 !! whether they were enough

      type(stress_rays) :: rays
      integer :: places, terms(2)

      series%is_singular = solution%pool .and. solution%work > 0.0_dp
      call start_stress_rays(rays, solution%basis%degree, -log(values_share*accuracy), surface_field)
      terms = [first_angles, 2 + ceiling(-log(accuracy)/round_fall)]
      places = 0
      do
         places = places + product(terms)
         found = places <= most_places .and. terms(1) <= most_angles
         if (.not. found) return
         call fit_terms()
         associate (c => abs(series%table%c(:, :, 1))/maxval(abs(series%table%c)))
            associate (last => rest*[sum(c(terms(1) - 1:, :)), sum(c(:, terms(2) - 1:))])
               if (all(last <= accuracy)) return
               ! As many as bring the last ones below the accuracy if they go on to fall as they did.
               terms = merge(terms, ceiling(terms*min(max(log(accuracy)/min(log(last), -0.1_dp), least_factor), &
                                                      largest_factor)), last <= accuracy)
            end associate
         end associate
      end do

   contains

      !> Fits as many terms as values. Places with the same arg v take the same rays from the edge.
      subroutine fit_terms()
         complex(dp) :: edge, v(terms(2))
         real(dp) :: fields(stress_fields, terms(2)), values(terms(1), terms(2), 1)
         integer :: i, j

         do i = 1, terms(1)
            edge = exp(cmplx(0.0_dp, pi*(i - 0.5_dp)/(terms(1)*solution%shape%fold), dp))
            v = edge/(1.0_dp - (0.5_dp*(1.0_dp + chebyshev_nodes(terms(2))))**2)
            fields = 0.0_dp
            call rays%add_at(solution, edge, [(solution%shape%place_outside(v(j)), j=1, terms(2))] &
                             - solution%shape%place(edge), spread(0.0_dp, 1, terms(2)), fields)
            values(i, :, 1) = fields(1, :)
            if (series%is_singular) values(i, :, 1) = fields(1, :)*sqrt(1.0_dp - 1.0_dp/abs(v))
         end do
         call series%table%set(values)
      end subroutine fit_terms

   end subroutine start_exterior_series

   !> The field at a place.
   pure real(dp) function at(self, fold, v)
      class(exterior_series), intent(in) :: self
      integer, intent(in) :: fold                   !! of the shape
      complex(dp), intent(in) :: v                  !! preimage of the place, |v| >= 1

      complex(dp) :: power
      real(dp) :: inverse, value(1)
      integer :: k

      inverse = 1.0_dp/sqrt(v%re**2 + v%im**2)
      power = inverse*v
      do k = 2, fold
         power = power*(inverse*v)
      end do
      value = self%table%at(power%re, 2*sqrt(max(1.0_dp - inverse, 0.0_dp)) - 1.0_dp)
      at = value(1)
      if (self%is_singular) at = at/sqrt(max(1.0_dp - inverse, epsilon(inverse)))
   end function at

end module wavycon_exterior_series
