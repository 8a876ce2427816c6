!> Mathematical constants.
module wavycon_constants
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   real(dp), parameter, public :: pi = acos(-1.0_dp)
   real(dp), parameter, public :: sqrt2 = sqrt(2.0_dp)
   real(dp), parameter, public :: sqrt3 = sqrt(3.0_dp)
end module wavycon_constants
