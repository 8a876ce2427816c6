!> The Fortran interface that comes with FFTW.
module wavycon_fftw
   use, intrinsic :: iso_c_binding
   implicit none (type, external)
   public
   include 'fftw3.f03'
end module wavycon_fftw
