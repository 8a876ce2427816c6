!> The &scene group: the name of the case and the labels of its units.
module wavycon_scene_group
   use wavycon_key_group, only: key_list, key_value
   use wavycon_key_table, only: key_type, text_value
   use wavycon_plain_text, only: integer_text
   use wavycon_scene_groups, only: scene_group
   implicit none (type, external)
   private

   public :: check_scene_group, list_scene_keys

   !> Most bytes of the name of a case, and of the label of a unit.
   integer, parameter, public :: longest_name = 200
   integer, parameter :: longest_unit = 20
   !> Characters of which the name of a case may consist, and the same in words for messages.
   character(*), parameter, public :: name_letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.'
   character(*), parameter :: letters_in_words = "letters, digits, '_', '-' and '.', the first neither '-' nor '.'"

contains

   !> The keys of &scene.
   subroutine list_scene_keys(values, keys)
      type(scene_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      keys = key_list('scene', 'what the case is called', values%key_group)
      call keys%add(values%title, key_type(text_value, 'title', "''", '', &
         'One line for the log and the heads of tables.', longest=longest_name, may_be_blank=.true.))
      call keys%add(values%case, key_type(text_value, 'case', "the deck's name", '', &
         'Stem of the names of the result files: '//letters_in_words//". The deck's name is that of its file "// &
         "without '.nml', with '_' for other characters.", longest=longest_name))
      call keys%add(values%pressure_unit, key_type(text_value, 'pressure_unit', "'pressure'", '', &
         "Label of the deck's unit of pressures and moduli in the heads of tables and in pictures, such as "// &
         "'MPa'. No number is converted.", longest=longest_unit))
      call keys%add(values%length_unit, key_type(text_value, 'length_unit', "'length'", '', &
         "Label of the deck's unit of lengths, such as 'mm'. A height map whose file names units is converted "// &
         'to it or, if the deck gives none, sets it.', longest=longest_unit))
   end subroutine list_scene_keys

   !> Checks the labels of units and the name of the case. The default name is that of the deck's file without '.nml',
   !> with '_' for characters that a name may not have.
   subroutine check_scene_group(values, is_file)
      type(scene_group), intent(inout) :: values
      logical, intent(in) :: is_file   !! whether the deck is a file; if not, the default name is 'deck'

      character(:), allocatable :: name, usual, words
      integer :: i

      usual = 'deck'
      if (is_file .and. values%deck_path /= '-') &
         usual = values%deck_path(index(values%deck_path, '/', back=.true.) + 1:)
      if (len(usual) > 4 .and. index(usual, '.nml', back=.true.) == len(usual) - 3) usual = usual(:len(usual) - 4)
      call check_unit(values%pressure_unit, 'pressure_unit')
      call check_unit(values%length_unit, 'length_unit')
      ! One '_' for each character: in UTF-8 bytes 128 to 191 continue a character and are skipped.
      name = ''
      do i = 1, len(usual)
         if (iachar(usual(i:i)) >= 128 .and. iachar(usual(i:i)) < 192) cycle
         name = name//usual(i:i)
         if (index(name_letters, usual(i:i)) == 0) name(len(name):) = '_'
      end do
      if (scan(name, '-.') == 1) name(1:1) = '_'
      words = "the deck's file name is too long for the name of the case, at most "//integer_text(longest_name)// &
              ' bytes: give case in &scene'
      if (values%case%is_given) name = values%case%text
      if (values%case%is_given) words = 'case must be a plain file name of '//letters_in_words
      if (values%case%is_bad) return
      if (name == '' .or. len(name) > longest_name .or. verify(name, name_letters) > 0 .or. scan(name, '-.') == 1) then
         call values%complain(values%case, words)
      else
         call values%case%set_default(text=name)
      end if

   contains

      !> Reports a label of a unit that has blanks or brackets: tables have all units in one line, in brackets and
      !> separated by blanks. Tables in memory mark columns of integers by '#' and of words by 'word'.
      subroutine check_unit(unit, name)
         type(key_value), intent(in) :: unit
         character(*), intent(in) :: name

         if ((scan(unit%text, ' []') > 0 .or. unit%text == '#' .or. unit%text == 'word') .and. .not. unit%is_bad) &
            call values%complain(unit, name//" must have no blanks and no brackets and be neither '#' nor 'word', "// &
                                 "such as 'mm' or 'N/mm^2'")
      end subroutine check_unit

   end subroutine check_scene_group

end module wavycon_scene_group
