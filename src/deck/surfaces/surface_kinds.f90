!> The list of all kinds of surface. A new kind adds its line to `get_surface_kinds`.
module wavycon_surface_kinds
   use wavycon_ball_kind, only: ball_kind
   use wavycon_group_values, only: group_values
   use wavycon_height_map_kind, only: height_map_kind
   use wavycon_self_affine_kind, only: self_affine_kind
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_kinds, only: get_wave_kinds, number_of_wave_kinds
   use wavycon_wave_sum_kind, only: wave_sum_kind
   implicit none (type, external)
   private

   public :: get_surface_kinds, kind_of

   integer, parameter, public :: number_of_kinds = 8

contains

   !> All kinds, in the order of the key reference.
   subroutine get_surface_kinds(kinds)
      type(surface_kind), intent(out) :: kinds(number_of_kinds)

      call get_wave_kinds(kinds(:number_of_wave_kinds))
      kinds(5) = wave_sum_kind()
      kinds(6) = height_map_kind()
      kinds(7) = self_affine_kind()
      kinds(8) = ball_kind()
   end subroutine get_surface_kinds

   !> The kind that &surface names. Its pointers are null if there is none of that name.
   type(surface_kind) function kind_of(values) result(kind)
      type(group_values), intent(in) :: values   !! of &surface

      type(surface_kind) :: kinds(number_of_kinds)
      integer :: i

      call get_surface_kinds(kinds)
      i = findloc(kinds%name == values%text('kind'), .true., dim=1)
      if (i > 0) kind = kinds(i)
   end function kind_of

end module wavycon_surface_kinds
