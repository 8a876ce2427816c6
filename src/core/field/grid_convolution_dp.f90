!> Convolutions on a grid in double precision.
module wavycon_grid_convolution_dp
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_null_ptr, c_ptr
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_assertion, only: assert, assertions_stop
   use wavycon_constants, only: pi
   use wavycon_fftw, only: execute_real_to_waves => fftw_execute_dft_r2c, execute_waves => fftw_execute_dft, &
                           execute_waves_to_real => fftw_execute_dft_c2r
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, wp => dp
   use wavycon_line_plans, only: plan_of_line, real_to_waves, waves_backward, waves_forward, waves_to_real
   implicit none (type, external)
   private

   public :: grid_convolution

   !> Whether the rows of a spectrum that is distributed over ranks keep their memory between convolutions. A solution
   !> applies those in double precision between its corrections, which need the memory, and those in single precision
   !> many times in each correction.
   logical, parameter :: keeps_lines = .false.

   include 'grid_convolution.inc'
   include 'spectrum_rows.inc'

end module wavycon_grid_convolution_dp
