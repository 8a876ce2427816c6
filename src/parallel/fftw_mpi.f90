!> The Fortran interface of FFTW's MPI library.
module wavycon_fftw_mpi
   use, intrinsic :: iso_c_binding
   implicit none (type, external)
   public
   include 'fftw3-mpi.f03'
end module wavycon_fftw_mpi
