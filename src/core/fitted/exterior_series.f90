!> The displacement that one spot causes outside of itself, or the pressure that one pool causes, as a series in
!> coordinates that follow its edge:
!>
!>     sum over j, k of I_jk cos(fold j arg v) T_k(X),   X = 2 (1 - 1/|v|)^(1/2) - 1,   README.md (F49), (F50),
!>
!> with the preimage v of the position under the exterior map and Chebyshev's polynomials T. The series holds from the
!> edge to infinity. The pressure beside a pool with adhesion is singular at the edge: there the series is that of the
!> pressure times (1 - 1/|v|)^(1/2).
module wavycon_exterior_series
   use wavycon_chebyshev_table, only: chebyshev_nodes, chebyshev_table
   use wavycon_fitted_function, only: fitted_function
   use wavycon_kinds, only: dp, pi
   use wavycon_stress_kernel, only: stress_field_count, surface_field
   use wavycon_stress_rays, only: start_stress_rays, stress_rays
   implicit none (type, external)
   private

   public :: exterior_series, start_exterior_series

   type :: exterior_series
      type(chebyshev_table), private :: table     !! the series, in the variables cos(fold arg v) and X
      logical, private :: is_singular = .false.   !! whether the field is singular at the edge
   contains
      procedure :: at
   end type exterior_series

   !> Number of terms in the angle: in the first fit, and the largest one.
   integer, parameter :: first_angles = 5, most_angles = 256
   !> For a round disc the terms in X fall by the factor exp(-1.22) from one to the next, README.md (F50).
   real(dp), parameter :: round_fall = 1.22_dp
   !> Error of the fitted values over the accuracy of the series.
   real(dp), parameter :: values_share = 0.05_dp
   !> Estimate of all terms left out over the sum of the last two. At sharp tips terms fall slowly.
   real(dp), parameter :: rest = 3.0_dp
   !> Bounds of the factor on the number of terms from one fit to the next.
   real(dp), parameter :: least_factor = 1.15_dp, largest_factor = 2.5_dp

contains

   !> Makes the series. The number of terms is raised until the last ones are below the accuracy.
   subroutine start_exterior_series(series, solution, accuracy, most_places, found)
      type(exterior_series), intent(out) :: series
      type(fitted_function), intent(in) :: solution       !! the spot or pool
      real(dp), intent(in) :: accuracy                    !! error of the series over its largest coefficient, > 0
      integer, intent(in) :: most_places                  !! most points at which the field may be integrated
      logical, intent(out) :: found                       !! whether this number was enough; if not there is no series

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
               ! So many terms that the last ones are below the accuracy if the terms keep falling at the same rate.
               terms = merge(terms, ceiling(terms*min(max(log(accuracy)/min(log(last), -0.1_dp), least_factor), &
                                                      largest_factor)), last <= accuracy)
            end associate
         end associate
      end do

   contains

      !> Determines the terms from as many values. Points with the same arg v share the rays from the edge.
      subroutine fit_terms()
         complex(dp) :: edge, v(terms(2))
         real(dp) :: fields(stress_field_count, terms(2)), values(terms(1), terms(2), 1)
         integer :: i, j

         do i = 1, terms(1)
            edge = exp(cmplx(0.0_dp, pi*(i - 0.5_dp)/(terms(1)*solution%shape%fold), dp))
            v = edge/(1.0_dp - (0.5_dp*(1.0_dp + chebyshev_nodes(terms(2))))**2)
            fields = 0.0_dp
            call rays%add_at(solution, edge, [(solution%shape%position_outside(v(j)), j=1, terms(2))] &
                             - solution%shape%position_of(edge), spread(0.0_dp, 1, terms(2)), fields)
            values(i, :, 1) = fields(1, :)
            if (series%is_singular) values(i, :, 1) = fields(1, :)*sqrt(1.0_dp - 1.0_dp/abs(v))
         end do
         call series%table%set(values)
      end subroutine fit_terms

   end subroutine start_exterior_series

   !> The field at a position outside.
   pure real(dp) function at(self, fold, v)
      class(exterior_series), intent(in) :: self
      integer, intent(in) :: fold                   !! order of the shape's rotational symmetry
      complex(dp), intent(in) :: v                  !! preimage of the position, |v| >= 1

      complex(dp) :: power
      real(dp) :: inverse, value(1)

      inverse = 1.0_dp/sqrt(v%re**2 + v%im**2)
      power = (inverse*v)**fold
      value = self%table%at(power%re, 2*sqrt(max(1.0_dp - inverse, 0.0_dp)) - 1.0_dp)
      at = value(1)
      if (self%is_singular) at = at/sqrt(max(1.0_dp - inverse, epsilon(inverse)))
   end function at

end module wavycon_exterior_series
