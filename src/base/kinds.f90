!> The kinds of numbers of the program, mathematical constants, and the range of numbers that decks and maps may have.
module wavycon_kinds
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only: int64, real32, real64
   implicit none (type, external)
   private

   public :: int64
   public :: ieee_is_finite, ieee_is_nan, not_a_number

   !> IEEE double precision: the kind of every number of the mechanics.
   integer, parameter, public :: dp = real64
   !> IEEE single precision. Only corrections to fields have it; the fields themselves have double precision.
   integer, parameter, public :: sp = real32

   real(dp), parameter, public :: pi = acos(-1.0_dp)
   real(dp), parameter, public :: sqrt2 = sqrt(2.0_dp)
   real(dp), parameter, public :: sqrt3 = sqrt(3.0_dp)

   !> The size of a number of a deck or a map is 0 or lies between these limits. Products of a few such numbers neither
   !> overflow nor underflow.
   real(dp), parameter, public :: smallest_number = 1.0e-90_dp, largest_number = 1.0e90_dp

contains

   !> NaN, for numbers that are not known or not defined.
   pure real(dp) function not_a_number()
      not_a_number = ieee_value(1.0_dp, ieee_quiet_nan)
   end function not_a_number

end module wavycon_kinds
