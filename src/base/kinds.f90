!> The kinds of real numbers of the program.
module wavycon_kinds
   use, intrinsic :: iso_fortran_env, only: real32, real64
   implicit none (type, external)
   private

   !> IEEE double precision: the kind of every number of the mechanics.
   integer, parameter, public :: dp = real64
   !> IEEE single precision. Only corrections to fields have it; the fields themselves have double precision.
   integer, parameter, public :: sp = real32
end module wavycon_kinds
