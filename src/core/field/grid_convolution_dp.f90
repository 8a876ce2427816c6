!> Convolutions of fields on a grid by fast Fourier transforms, in double precision.
module wavycon_grid_convolution_dp
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
   use wavycon_assertion, only: assert
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, pi, wp => dp
   use wavycon_line_plans, only: line_plan, plan_of_line, real_to_waves, waves_backward, waves_forward, waves_to_real
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: grid_convolution

   include 'grid_convolution.inc'

end module wavycon_grid_convolution_dp
