!> Tuned constants of the room `map`, each with its reason. `scripts/constants` shows what changing them does.
module wavycon_map_tuning
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   !> Usual part of a side over which a taper rises from the mean to the heights. A wider taper changes more of the map,
   !> a narrower one adds slopes of its own: README.md in this directory has a table.
   real(dp), parameter, public :: usual_window_width = 0.05_dp

   !> Steps across the border are too large above this multiple of those across any line inside, both root mean square.
   !> For 200 periodic self-affine maps of each Hurst exponent, 0.3 and 0.8, the ratio is at most 1.24 from 16 x 16
   !> points on, 1.37 for profiles of 64 points. A tilt by the rms height makes it 2.4 or more for H = 0.8 on 256 x 256
   !> points.
   real(dp), parameter, public :: border_ratio = 1.5_dp

   !> A height is a spike if it is so many times as far from the median of its neighbours as two thirds of them are from
   !> each other. In a million independent Gaussian heights, the roughest map there is, none is beyond 3.4; a lone point
   !> of an instrument's error is beyond 10.
   real(dp), parameter, public :: reach_of_spike = 4.0_dp

   !> Maps of a lower kurtosis are not searched for spikes, which takes 0.8 s for 1024 x 1024 points: that of Gaussian
   !> heights is 3, of exponential ones 9.
   real(dp), parameter, public :: spiky_kurtosis = 10.0_dp

end module wavycon_map_tuning
