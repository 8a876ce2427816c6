!> The &material group: how stiff the two bodies are.
module wavycon_material_group
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: material_group_type

   !> What &material says. `e_star` holds in either form of the group.
   type :: material_group_type
      real(dp) :: e_star = 1               !! plane-strain modulus, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [pressure]
      logical :: from_moduli = .false.     !! whether e1, nu1 (and e2, nu2) were given
      logical :: second_is_rigid = .true.  !! with from_moduli: whether e2, nu2 were left out
      real(dp) :: e1 = 0, e2 = 0           !! Young's moduli [pressure]; 0 where not given
      real(dp) :: nu1 = 0, nu2 = 0         !! Poisson's ratios [-]; 0 where not given
   end type material_group_type

end module wavycon_material_group
