!> The &scene group: what the case is called.
module wavycon_scene_group
   implicit none (type, external)
   private

   public :: scene_group_type

   !> What &scene says.
   type :: scene_group_type
      character(200) :: title = ''  !! one line for the heads of tables and for plots
      character(200) :: case = ''   !! stem of the names of the result files; never empty once the deck is read
   end type scene_group_type

end module wavycon_scene_group
