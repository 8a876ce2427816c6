!> Tuned constants of this directory, each with its reason. `scripts/constants` measures what a change of each one does.
module wavycon_map_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   !> Default width of a taper, over the side: the distance over which the heights rise from the mean to their own
   !> values. A wider taper changes more of the map, a narrower one adds slopes of its own: README.md in this directory
   !> has a table.
   real(dp), parameter, public :: usual_window_width = 0.05_dp

   !> A map counts as not periodic if the differences of heights across its border exceed this multiple of those across
   !> any line inside (both root mean squares). For 200 periodic self-affine maps of each Hurst exponent H, 0.3 and 0.8,
   !> the ratio is at most 1.24 from 16 x 16 points on, and 1.37 for profiles of 64 points. A tilt by the rms height
   !> makes the ratio 2.4 or more for H = 0.8 on 256 x 256 points.
   real(dp), parameter, public :: border_ratio = 1.5_dp

   !> A height is a spike if its distance from the median of its neighbours is more than this multiple of the range of
   !> the middle two thirds of them, (M8). In a million independent Gaussian heights, the roughest possible map, no
   !> multiple is above 3.4; that of a single wrong height of an instrument is above 10.
   real(dp), parameter, public :: reach_of_spike = 4.0_dp

   !> Maps with a lower kurtosis are not searched for spikes. The search takes 0.8 s for 1024 x 1024 points. The
   !> kurtosis of Gaussian heights is 3, that of exponential ones 9.
   real(dp), parameter, public :: spiky_kurtosis = 10.0_dp

   !> Numbers that programs often write for a missing height, the last one the least integer of two bytes; and the least
   !> of the huge ones, such as the largest number of single precision. No surface is so high in any unit of length.
   real(dp), parameter, public :: placeholders(*) = [-999.0_dp, -9999.0_dp, -99999.0_dp, 9999.0_dp, 99999.0_dp, &
      -32768.0_dp], least_placeholder = 1e30_dp

end module wavycon_map_tuning
