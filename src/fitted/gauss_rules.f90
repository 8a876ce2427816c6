!> Gauss quadrature with the weights of Jacobi's polynomials.
module wavycon_gauss_rules
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_ptr, c_size_t
   use wavycon_gsl, only: gsl_integration_fixed_alloc, gsl_integration_fixed_free, &
      gsl_integration_fixed_jacobi, gsl_integration_fixed_nodes, gsl_integration_fixed_weights, return_gsl_errors
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: gauss_jacobi

contains

   !> Nodes and weights for the weight (1 - x)^right_power (1 + x)^left_power on -1 <= x <= 1, by GSL.
   !>
   !> Without such a rule, or without memory for it, both are NaN. The solver then finds no finite step.
   subroutine gauss_jacobi(right_power, left_power, nodes, weights)
      real(dp), intent(in) :: right_power, left_power        !! > -1
      real(dp), intent(out) :: nodes(:), weights(:)          !! shape (n), n >= 1

      type(c_ptr) :: workspace
      real(dp), pointer :: values(:)

      call return_gsl_errors()
      workspace = gsl_integration_fixed_alloc(gsl_integration_fixed_jacobi, size(nodes, kind=c_size_t), &
         -1.0_dp, 1.0_dp, right_power, left_power)
      if (.not. c_associated(workspace)) then
         nodes = ieee_value(nodes, ieee_quiet_nan)
         weights = nodes
         return
      end if
      call c_f_pointer(gsl_integration_fixed_nodes(workspace), values, shape(nodes))
      nodes = values
      call c_f_pointer(gsl_integration_fixed_weights(workspace), values, shape(weights))
      weights = values
      call gsl_integration_fixed_free(workspace)
   end subroutine gauss_jacobi

end module wavycon_gauss_rules
