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

end module wavycon_map_tuning
