!> Thin interface to the GNU Scientific Library.
module wavycon_gsl
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   implicit none (type, external)
   private

   public :: gsl_sf_legendre_pl_array

   interface
      !> Legendre polynomials P_0(x) .. P_lmax(x), -1 <= x <= 1; returns 0 if all is well.
      integer(c_int) function gsl_sf_legendre_pl_array(lmax, x, values) bind(c, name='gsl_sf_legendre_Pl_array')
         import :: c_double, c_int
         integer(c_int), value :: lmax
         real(c_double), value :: x
         real(c_double), intent(out) :: values(*)
      end function gsl_sf_legendre_pl_array
   end interface

end module wavycon_gsl
