!> Convolutions on a grid in single precision.
module wavycon_grid_convolution_sp
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_null_ptr, c_ptr
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_assertion, only: assert, assertions_stop
   use wavycon_constants, only: pi
   use wavycon_fftw, only: execute_real_to_waves => fftwf_execute_dft_r2c, execute_waves => fftwf_execute_dft, &
                           execute_waves_to_real => fftwf_execute_dft_c2r
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, wp => sp
   use wavycon_line_plans, only: plan_of_line, real_to_waves, waves_backward, waves_forward, waves_to_real
   implicit none (type, external)
   private

   public :: grid_convolution

   !> Whether rows keep their memory: see the module for double precision.
   logical, parameter :: keeps_lines = .true.

   include 'grid_convolution.inc'
   include 'spectrum_rows.inc'

end module wavycon_grid_convolution_sp
