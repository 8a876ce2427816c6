!> The &load group: the mean pressures to solve for.
module wavycon_load_group
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: load_group_type

   !> What &load says. Exactly one of the two lists is allocated once the deck is read.
   type :: load_group_type
      real(dp), allocatable :: pbar_over_pstar(:)   !! mean pressures over p* [-]; a sweep fills it too
      real(dp), allocatable :: mean_pressure(:)     !! mean pressures [unit of e_star]
      integer :: sweep_steps = 0                    !! number of loads of a sweep; 0 where none was given
      real(dp) :: sweep_from = 0, sweep_to = 0      !! its ends, over p* [-]
   end type load_group_type

end module wavycon_load_group
