!> Mathematical constants, and the range of numbers that decks and maps may have.
module wavycon_constants
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   real(dp), parameter, public :: pi = acos(-1.0_dp)
   real(dp), parameter, public :: sqrt2 = sqrt(2.0_dp)
   real(dp), parameter, public :: sqrt3 = sqrt(3.0_dp)

   !> The size of a number of a deck or a map is 0 or lies between these limits. Products of a few such numbers neither
   !> overflow nor underflow.
   real(dp), parameter, public :: smallest_number = 1.0e-90_dp, largest_number = 1.0e90_dp
end module wavycon_constants
