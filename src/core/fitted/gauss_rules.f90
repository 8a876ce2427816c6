!> Gauss quadrature with the weights of Jacobi's polynomials, and quadrature over the disc of functions with the
!> symmetry of a contact, which needs points in one half sector only.
module wavycon_gauss_rules
   use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_size_t
   use wavycon_gsl, only: gsl_integration_fixed_alloc, gsl_integration_fixed_free, &
      gsl_integration_fixed_jacobi, gsl_integration_fixed_nodes, gsl_integration_fixed_weights, return_gsl_errors
   use wavycon_kinds, only: dp, not_a_number, pi
   implicit none (type, external)
   private

   public :: disc_rule, gauss_jacobi, start_disc_rule

   !> For a function f with the symmetry the sum of weight f(point) is the integral over the disc of (1 - |w|^2)^power
   !> f.
   type :: disc_rule
      complex(dp), allocatable :: point(:)   !! points of the sector 0 < arg w < pi/fold, shape (n)
      real(dp), allocatable :: weight(:)     !! their weights > 0, shape (n)
   end type disc_rule

contains

   !> Nodes and weights of the Gauss rule for the weight (1 - x)^right_power (1 + x)^left_power on -1 <= x <= 1, by GSL.
   !>
   !> If GSL has no such rule or no memory for it, both are NaN. The solver then finds no finite step.
   subroutine gauss_jacobi(right_power, left_power, nodes, weights)
      real(dp), intent(in) :: right_power, left_power        !! > -1
      real(dp), intent(out) :: nodes(:), weights(:)          !! shape (n); n >= 1 is the number of points

      type(c_ptr) :: workspace
      real(dp), pointer :: values(:)

      call return_gsl_errors()
      workspace = gsl_integration_fixed_alloc(gsl_integration_fixed_jacobi, size(nodes, kind=c_size_t), &
         -1.0_dp, 1.0_dp, right_power, left_power)
      if (.not. c_associated(workspace)) then
         nodes = not_a_number()
         weights = nodes
         return
      end if
      call c_f_pointer(gsl_integration_fixed_nodes(workspace), values, shape(nodes))
      nodes = values
      call c_f_pointer(gsl_integration_fixed_weights(workspace), values, shape(weights))
      weights = values
      call gsl_integration_fixed_free(workspace)
   end subroutine gauss_jacobi

   !> Makes a rule over the disc: the Gauss rule in |w|^2 and the midpoint rule in the angle. The rule is exact for
   !> products of disc polynomials if the sum of their degrees is at most 4 radii - 2 and less than 2 fold angles.
   subroutine start_disc_rule(rule, power, fold, radii, angles)
      type(disc_rule), intent(out) :: rule
      real(dp), intent(in) :: power   !! power of 1 - |w|^2 in the weight, > -1
      integer, intent(in) :: fold     !! order of the rotational symmetry, >= 1
      integer, intent(in) :: radii    !! number of points on a radius, >= 1
      integer, intent(in) :: angles   !! number of angles in the half sector, >= 1

      real(dp) :: node(radii), weight(radii), phi
      integer :: i, j, k

      allocate (rule%point(radii*angles), rule%weight(radii*angles))
      call gauss_jacobi(power, 0.0_dp, node, weight)
      k = 0
      do j = 1, angles
         phi = pi*(j - 0.5_dp)/(fold*angles)
         do i = 1, radii
            k = k + 1
            rule%point(k) = sqrt(0.5_dp*(1.0_dp + node(i)))*cmplx(cos(phi), sin(phi), dp)
            ! With rho = |w|: rho d rho = d(rho^2)/2, and the weights of GSL are for an interval of the length 2.
            rule%weight(k) = pi/angles*weight(i)*0.5_dp**(power + 1)
         end do
      end do
   end subroutine start_disc_rule

end module wavycon_gauss_rules
