!> Definite integrals, with algebraic singularities at the ends where there are any, by GSL's QAWS.
module wavycon_quadrature
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, c_funptr, c_int, c_loc, &
      c_null_funptr, c_null_ptr, c_ptr, c_size_t
   use wavycon_error, only: error_type, exit_not_converged, fatal_error
   use wavycon_gsl, only: return_gsl_errors
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: integrate, integrand

   abstract interface
      !> The integrand f(x) for given parameters.
      !>
      !> The parameters are an argument so that no internal procedure is passed, which would need an executable stack.
      pure real(dp) function integrand(x, parameters)
         import :: dp
         real(dp), intent(in) :: x
         real(dp), intent(in) :: parameters(:)
      end function integrand
   end interface

   !> A real function of one real variable, with its parameters.
   type, bind(c) :: gsl_function
      type(c_funptr) :: function = c_null_funptr  !! double (*)(double x, void *params)
      type(c_ptr) :: params = c_null_ptr
   end type gsl_function

   interface
      !> Workspace for n intervals of an adaptive quadrature; a null pointer if there is not enough memory.
      type(c_ptr) function gsl_integration_workspace_alloc(n) bind(c, name='gsl_integration_workspace_alloc')
         import :: c_ptr, c_size_t
         integer(c_size_t), value :: n
      end function gsl_integration_workspace_alloc

      subroutine gsl_integration_workspace_free(w) bind(c, name='gsl_integration_workspace_free')
         import :: c_ptr
         type(c_ptr), value :: w
      end subroutine gsl_integration_workspace_free

      !> The weight (x-a)^alpha (b-x)^beta log^mu(x-a) log^nu(b-x), alpha, beta > -1, mu, nu = 0 or 1;
      !> a null pointer if an argument is out of range or there is not enough memory.
      type(c_ptr) function gsl_integration_qaws_table_alloc(alpha, beta, mu, nu) &
         bind(c, name='gsl_integration_qaws_table_alloc')
         import :: c_double, c_int, c_ptr
         real(c_double), value :: alpha, beta
         integer(c_int), value :: mu, nu
      end function gsl_integration_qaws_table_alloc

      subroutine gsl_integration_qaws_table_free(t) bind(c, name='gsl_integration_qaws_table_free')
         import :: c_ptr
         type(c_ptr), value :: t
      end subroutine gsl_integration_qaws_table_free

      !> Integral of f times the weight t over a..b, a < b; returns 0 on success.
      integer(c_int) function gsl_integration_qaws(f, a, b, t, epsabs, epsrel, limit, workspace, &
         result, abserr) bind(c, name='gsl_integration_qaws')
         import :: c_double, c_int, c_ptr, c_size_t, gsl_function
         type(gsl_function), intent(in) :: f
         real(c_double), value :: a, b, epsabs, epsrel
         type(c_ptr), value :: t, workspace
         integer(c_size_t), value :: limit
         real(c_double), intent(out) :: result, abserr
      end function gsl_integration_qaws
   end interface

   !> The data of the C callback.
   type :: callback_data
      procedure(integrand), pointer, nopass :: f => null()
      real(dp), allocatable :: parameters(:)
   end type callback_data

   !> Tolerances of the integral: the looser of the two holds. The absolute one is for integrals that vanish.
   real(dp), parameter :: absolute_tolerance = 1.0e-13_dp, relative_tolerance = 1.0e-11_dp
   integer(c_size_t), parameter :: most_intervals = 500

contains

   !> Integral of (x - a)^left_power (b - x)^right_power f(x) over a <= x <= b.
   subroutine integrate(f, parameters, a, b, integral, error, left_power, right_power)
      procedure(integrand) :: f                 !! finite on the whole of a..b, ends included
      real(dp), intent(in) :: parameters(:)     !! passed to f
      real(dp), intent(in) :: a, b              !! a < b
      real(dp), intent(out) :: integral         !! 0 if it failed
      type(error_type), allocatable, intent(out) :: error
         !! exit_not_converged: the accuracy was not reached, or a power is not above -1
      real(dp), intent(in), optional :: left_power, right_power  !! > -1; 0 if absent

      type(callback_data), target :: data
      type(gsl_function) :: function
      type(c_ptr) :: table, workspace
      real(c_double) :: alpha, beta, error_estimate
      integer(c_int) :: status
      character(80) :: message

      integral = 0
      alpha = 0
      beta = 0
      if (present(left_power)) alpha = left_power
      if (present(right_power)) beta = right_power
      ! GSL accepts a power of -1 and divides by zero.
      if (min(alpha, beta) <= -1) then
         call fatal_error(error, exit_not_converged, 'quadrature of a weight that has no integral')
         return
      end if
      data%f => f
      data%parameters = parameters
      function%function = c_funloc(evaluate)
      function%params = c_loc(data)

      call return_gsl_errors()
      table = gsl_integration_qaws_table_alloc(alpha, beta, 0_c_int, 0_c_int)
      workspace = gsl_integration_workspace_alloc(most_intervals)
      if (c_associated(table) .and. c_associated(workspace)) then
         status = gsl_integration_qaws(function, a, b, table, absolute_tolerance, relative_tolerance, &
            most_intervals, workspace, integral, error_estimate)
         if (status /= 0) then
            write (message, '(a, i0, a, es9.2)') 'quadrature stopped with GSL status ', status, &
               ', estimated error ', error_estimate
            integral = 0
            call fatal_error(error, exit_not_converged, trim(message))
         end if
      else
         call fatal_error(error, exit_not_converged, 'quadrature could not start: no memory')
      end if
      ! GSL's free takes null pointers.
      call gsl_integration_workspace_free(workspace)
      call gsl_integration_qaws_table_free(table)
   end subroutine integrate

   !> The function that GSL calls.
   real(c_double) function evaluate(x, params) bind(c, name='wavycon_evaluate_integrand')
      real(c_double), value :: x
      type(c_ptr), value :: params  !! of a callback_data

      type(callback_data), pointer :: data

      call c_f_pointer(params, data)
      evaluate = data%f(x, data%parameters)
   end function evaluate

end module wavycon_quadrature
