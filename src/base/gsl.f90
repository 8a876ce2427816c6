!> Interfaces of those procedures of the GNU Scientific Library that are used. Names, arguments and return values that
!> begin with gsl are the library's own; its manual describes them in full.
module wavycon_gsl
   use, intrinsic :: iso_c_binding, only: c_double, c_funptr, c_int, c_long, c_ptr, c_size_t
   implicit none (type, external)
   private

   public :: ascending_order
   public :: gsl_sf_legendre_pl_array, gsl_sf_ellint_RD, gsl_sf_ellint_RF
   public :: gsl_integration_fixed_jacobi, gsl_integration_fixed_alloc, gsl_integration_fixed_free
   public :: gsl_integration_fixed_nodes, gsl_integration_fixed_weights
   public :: gsl_rng_mt19937, gsl_rng_alloc, gsl_rng_set, gsl_rng_uniform, gsl_rng_free
   public :: gsl_interp_steffen, gsl_interp_alloc, gsl_interp_init, gsl_interp_eval, gsl_interp_free
   public :: return_gsl_errors

   !> Type of Gauss rule: the Gauss-Jacobi rule, with the weight (b-x)^alpha (x-a)^beta.
   type(c_ptr), protected, bind(c, name='gsl_integration_fixed_jacobi') :: gsl_integration_fixed_jacobi

   !> Type of random number generator: MT19937 (Matsumoto & Nishimura 1998), with its authors' seeding of 2002.
   type(c_ptr), protected, bind(c, name='gsl_rng_mt19937') :: gsl_rng_mt19937

   !> Type of interpolation: piecewise cubic polynomials without extremes between the points (Steffen 1990).
   type(c_ptr), protected, bind(c, name='gsl_interp_steffen') :: gsl_interp_steffen

   interface
      !> Legendre polynomials P_0(x) .. P_lmax(x), -1 <= x <= 1; returns 0 on success.
      integer(c_int) function gsl_sf_legendre_pl_array(lmax, x, values) bind(c, name='gsl_sf_legendre_Pl_array')
         import :: c_double, c_int
         integer(c_int), value :: lmax
         real(c_double), value :: x
         real(c_double), intent(out) :: values(*)
      end function gsl_sf_legendre_pl_array

      !> Carlson's elliptic integrals R_F(x, y, z) and R_D(x, y, z) of positive arguments, of which x may be 0. With
      !> mode = 0 they have the accuracy of double precision.
      pure real(c_double) function gsl_sf_ellint_RF(x, y, z, mode) bind(c, name='gsl_sf_ellint_RF')
         import :: c_double, c_int
         real(c_double), intent(in), value :: x, y, z
         integer(c_int), intent(in), value :: mode
      end function gsl_sf_ellint_RF
      pure real(c_double) function gsl_sf_ellint_RD(x, y, z, mode) bind(c, name='gsl_sf_ellint_RD')
         import :: c_double, c_int
         real(c_double), intent(in), value :: x, y, z
         integer(c_int), intent(in), value :: mode
      end function gsl_sf_ellint_RD

      !> A Gauss rule of n nodes on a..b for one of the library's weights; a null pointer if an argument is out of range
      !> or there is not enough memory.
      type(c_ptr) function gsl_integration_fixed_alloc(t, n, a, b, alpha, beta) &
         bind(c, name='gsl_integration_fixed_alloc')
         import :: c_double, c_ptr, c_size_t
         type(c_ptr), value :: t
         integer(c_size_t), value :: n
         real(c_double), value :: a, b, alpha, beta
      end function gsl_integration_fixed_alloc

      !> Frees a Gauss rule.
      subroutine gsl_integration_fixed_free(w) bind(c, name='gsl_integration_fixed_free')
         import :: c_ptr
         type(c_ptr), value :: w
      end subroutine gsl_integration_fixed_free

      !> The nodes of a Gauss rule, a double[n] that belongs to the rule.
      type(c_ptr) function gsl_integration_fixed_nodes(w) bind(c, name='gsl_integration_fixed_nodes')
         import :: c_ptr
         type(c_ptr), value :: w
      end function gsl_integration_fixed_nodes

      !> The weights of a Gauss rule, a double[n] that belongs to the rule.
      type(c_ptr) function gsl_integration_fixed_weights(w) bind(c, name='gsl_integration_fixed_weights')
         import :: c_ptr
         type(c_ptr), value :: w
      end function gsl_integration_fixed_weights

      !> Allocates an interpolation between `points` pairs; a null pointer if there is not enough memory.
      type(c_ptr) function gsl_interp_alloc(t, points) bind(c, name='gsl_interp_alloc')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: t
         integer(c_size_t), value :: points
      end function gsl_interp_alloc

      !> Computes the interpolation of the points xa, ya; xa must rise. Returns 0 on success.
      integer(c_int) function gsl_interp_init(interp, xa, ya, points) bind(c, name='gsl_interp_init')
         import :: c_double, c_int, c_ptr, c_size_t
         type(c_ptr), value :: interp
         real(c_double), intent(in) :: xa(*), ya(*)
         integer(c_size_t), value :: points
      end function gsl_interp_init

      !> The value of the interpolation at x, xa(1) <= x <= the last xa; acc may be a null pointer.
      real(c_double) function gsl_interp_eval(interp, xa, ya, x, acc) bind(c, name='gsl_interp_eval')
         import :: c_double, c_ptr
         type(c_ptr), value :: interp, acc
         real(c_double), intent(in) :: xa(*), ya(*)
         real(c_double), value :: x
      end function gsl_interp_eval

      !> Frees an interpolation.
      subroutine gsl_interp_free(interp) bind(c, name='gsl_interp_free')
         import :: c_ptr
         type(c_ptr), value :: interp
      end subroutine gsl_interp_free

      !> Allocates a generator of random numbers; a null pointer if there is not enough memory.
      type(c_ptr) function gsl_rng_alloc(t) bind(c, name='gsl_rng_alloc')
         import :: c_ptr
         type(c_ptr), value :: t
      end function gsl_rng_alloc

      !> Starts a generator from a seed, 1 to 2^32 - 1.
      subroutine gsl_rng_set(r, seed) bind(c, name='gsl_rng_set')
         import :: c_long, c_ptr
         type(c_ptr), value :: r
         integer(c_long), value :: seed
      end subroutine gsl_rng_set

      !> The next random number u, uniform in 0 <= u < 1. MT19937 gives multiples of 2^-32.
      real(c_double) function gsl_rng_uniform(r) bind(c, name='gsl_rng_uniform')
         import :: c_double, c_ptr
         type(c_ptr), value :: r
      end function gsl_rng_uniform

      !> Frees a generator of random numbers.
      subroutine gsl_rng_free(r) bind(c, name='gsl_rng_free')
         import :: c_ptr
         type(c_ptr), value :: r
      end subroutine gsl_rng_free

      !> Turns off the error handler, which ends the program; returns the previous handler.
      type(c_funptr) function gsl_set_error_handler_off() bind(c, name='gsl_set_error_handler_off')
         import :: c_funptr
      end function gsl_set_error_handler_off

      !> Indices, from 0, that sort `n` numbers in ascending order.
      pure subroutine gsl_sort_index(places, values, stride, n) bind(c, name='gsl_sort_index')
         import :: c_double, c_size_t
         integer(c_size_t), intent(out) :: places(*)
         real(c_double), intent(in) :: values(*)
         integer(c_size_t), value :: stride, n
      end subroutine gsl_sort_index
   end interface

contains

   !> The indices that sort numbers in ascending order.
   pure function ascending_order(values) result(order)
      real(c_double), intent(in) :: values(:)
      integer :: order(size(values))

      integer(c_size_t) :: places(size(values))

      call gsl_sort_index(places, values, 1_c_size_t, size(values, kind=c_size_t))
      order = int(places) + 1
   end function ascending_order

   !> Makes the library return statuses and null pointers on errors, instead of ending the program, which is its
   !> default. Call this procedure before any procedure of the library that can fail. Further calls change nothing.
   subroutine return_gsl_errors()
      logical, save :: is_off = .false.
      type(c_funptr) :: previous_handler

      ! Several threads may call this procedure at the same time, and the handler is a global variable of GSL.
      !$omp critical (wavycon_gsl_handler)
      if (.not. is_off) previous_handler = gsl_set_error_handler_off()
      is_off = .true.
      !$omp end critical (wavycon_gsl_handler)
   end subroutine return_gsl_errors

end module wavycon_gsl
