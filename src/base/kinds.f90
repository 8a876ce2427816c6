!> The one real kind of the program.
module wavycon_kinds
   use, intrinsic :: iso_fortran_env, only: real64
   implicit none (type, external)
   private

   !> Real kind of every number of the mechanics: IEEE double precision.
   integer, parameter, public :: dp = real64
end module wavycon_kinds
