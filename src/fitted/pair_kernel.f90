!> What a unit source does at a target, as a function of the vector from one to the other.
module wavycon_pair_kernel
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: pair_kernel

   type, abstract :: pair_kernel
   contains
      procedure(evaluate_pairs), deferred :: evaluate
   end type pair_kernel

   abstract interface
      !> The kernel and, if its slopes are given room, its gradient at n places.
      pure subroutine evaluate_pairs(self, n, x, y, value, slope_x, slope_y)
         import :: dp, pair_kernel
         class(pair_kernel), intent(in) :: self
         integer, intent(in) :: n
         real(dp), intent(in) :: x(n), y(n)                             !! from source to target [s]
         real(dp), intent(out) :: value(n)                              !! [s^-power], power 1 or 3
         real(dp), intent(out), optional :: slope_x(n), slope_y(n)      !! both or none [s^-(power+1)]
      end subroutine evaluate_pairs
   end interface

end module wavycon_pair_kernel
