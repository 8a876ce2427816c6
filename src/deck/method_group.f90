!> The &method group: how the contact is computed.
module wavycon_method_group
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: method_group_type

   !> What &method says. The two counts are 0 until the surface's dimension settles their defaults.
   type :: method_group_type
      character(12) :: solver = 'beale'    !! 'beale'
      integer :: harmonics = 0             !! n, highest harmonic of the pressure, in each direction
      integer :: constraint_points = 0     !! points on 0..pi, ends included, in each direction
      character(12) :: symmetry = 'full'   !! 'full', 'diagonal' or 'none'; of no meaning in 1-D
      real(dp) :: edge_level = 0.1_dp      !! the isobar taken as the edge of contact [p*]
   end type method_group_type

end module wavycon_method_group
