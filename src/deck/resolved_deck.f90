!> The resolved deck: every key that applies, with the value in effect. To run it repeats the run.
module wavycon_resolved_deck
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: allowed_values, choice_value, text_value
   use wavycon_plain_text, only: escaped, newline, quoted
   use wavycon_scene, only: scene_type
   implicit none (type, external)
   private

   public :: resolved_deck_text

contains

   !> The resolved deck: lines, the last without a newline.
   function resolved_deck_text(scene) result(text)
      type(scene_type), intent(in) :: scene
      character(:), allocatable :: text

      text = '! '//escaped(scene%deck_path)//' with the value in effect of every key that applies.'
      text = text//group_text(scene%scene_values)//group_text(scene%material)//group_text(scene%surface_values)
      if (scene%load%place > 0) text = text//group_text(scene%load)
      ! The groups themselves ask for stresses and for what the interface does.
      if (scene%stress%place > 0) text = text//group_text(scene%stress)
      if (scene%interface%place > 0) text = text//group_text(scene%interface)
      text = text//group_text(scene%method)//group_text(scene%output)
   end function resolved_deck_text

   !> A group, each line with a newline before it: "key = value   ! [unit] allowed values", and a line for each further
   !> value.
   !>
   !> N.B. Without commas between the values: gfortran's NAMELIST reads a comma before a comment as an omitted value.
   function group_text(values) result(text)
      type(group_values), intent(in) :: values
      character(:), allocatable :: text

      character(*), parameter :: next_line = newline//'      '
      character(:), allocatable :: comment, words
      integer :: first, k

      text = newline//'&'//trim(values%table%name)//'   ! '//trim(values%table%meaning)
      do k = 1, size(values%table%keys)
         associate (key => values%table%keys(k))
            if (.not. values%in_effect(trim(key%name))) cycle
            comment = '   ! '
            if (key%unit /= '') comment = comment//'['//trim(key%unit)//'] '
            comment = comment//allowed_values(key)
            words = values%words(trim(key%name), next_line)
            if (any(key%kind == [text_value, choice_value])) words = quoted(words)
            first = index(words//newline, newline) - 1
            text = text//newline//'   '//trim(key%name)//' = '//words(:first)//comment//words(first + 1:)
         end associate
      end do
      text = text//newline//'/'
   end function group_text

end module wavycon_resolved_deck
