!> The groups of a deck: the tables of their keys, and the messages for names that are none of theirs.
module wavycon_deck_groups
   use wavycon_interface_group, only: list_interface_keys
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: key_index
   use wavycon_load_group, only: list_load_keys
   use wavycon_material_group, only: list_material_keys
   use wavycon_methods, only: list_method_keys
   use wavycon_nearest_name, only: did_you_mean, nearest_slip
   use wavycon_output_group, only: list_output_keys
   use wavycon_plain_text, only: excerpt, listed
   use wavycon_scene, only: scene_type
   use wavycon_scene_group, only: list_scene_keys
   use wavycon_stress_group, only: list_stress_keys
   use wavycon_surface_group, only: list_surface_keys
   implicit none (type, external)
   private

   public :: list_keys, unknown_group, unknown_key

   integer, parameter, public :: number_of_groups = 8

contains

   !> The keys of all groups, in the order in which they are documented and written.
   subroutine list_keys(scene, lists)
      type(scene_type), intent(in), target :: scene            !! the records of the groups, to which the lists point
      type(key_list), intent(out) :: lists(number_of_groups)

      integer :: i

      call list_scene_keys(scene%scene_values, lists(1))
      call list_material_keys(scene%material, lists(2))
      call list_surface_keys(scene%surface_values, lists(3))
      call list_load_keys(scene%load, lists(4))
      call list_stress_keys(scene%stress, lists(5))
      call list_interface_keys(scene%interface, lists(6))
      call list_method_keys(scene%method, lists(7))
      call list_output_keys(scene%output, lists(8))
      do i = 1, size(lists)
         call lists(i)%close()
      end do
   end subroutine list_keys

   !> The message for an unknown group.
   pure function unknown_group(name, lists) result(words)
      character(*), intent(in) :: name  !! in lower case, without '&'
      type(key_list), intent(in) :: lists(:)
      character(:), allocatable :: words

      words = "there is no group '"//excerpt('&'//name)//"'"//did_you_mean(name, lists%name, "'&", "'", &
                                                                         '; the groups are '//listed(lists%name))
      if (name == '') words = "expected the name of a group right behind the '&'"
   end function unknown_group

   !> The message for a key that the group does not have.
   pure function unknown_key(key, list, lists) result(words)
      character(*), intent(in) :: key                !! in lower case
      type(key_list), intent(in) :: list, lists(:)   !! keys of the group; keys of all groups
      character(:), allocatable :: words

      character(:), allocatable :: otherwise   ! words for a key that is near to none of the group
      integer :: bracket, i, slip
      logical :: has_key(size(lists)), is_given(size(list%keys))

      bracket = index(key//'(', '(')
      is_given = [(list%keys(i)%value%is_given, i=1, size(list%keys))]
      has_key = [(key_index(lists(i)%rows, key) > 0, i=1, size(lists))]
      if (any(has_key)) then
         words = key//' belongs to &'//listed(pack(lists%name, has_key), ' and &')//', not to &'//trim(list%name)// &
                 did_you_mean(key, pack(list%rows%name, .not. is_given), "'", "'")
      else if (key_index(list%rows, key(:bracket - 1)) > 0) then
         words = "elements are not given one by one: write '"//key(:bracket - 1)//" = value, value, ...'"
      else
         otherwise = did_you_mean(key, list%rows%name, "'", "'", '; its keys are '//listed(list%rows%name), &
                                  meanings=list%rows%meaning)
         do i = size(lists), 1, -1
            slip = nearest_slip(key, lists(i)%rows%name)
            if (slip > 0) otherwise = "; did you mean '"//trim(lists(i)%rows(slip)%name)//"' of &"// &
                                      trim(lists(i)%name)//'?'
         end do
         words = "there is no key '"//excerpt(key)//"' in &"//trim(list%name)// &
                 did_you_mean(key, list%rows%name, "'", "'", otherwise, is_given)
      end if
   end function unknown_key

end module wavycon_deck_groups
