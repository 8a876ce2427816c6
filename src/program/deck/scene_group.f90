!> The &scene group: the name of the case and the labels of its units.
module wavycon_scene_group
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type, text_value
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: check_scene_group

   integer, parameter, public :: longest_name = 200
   !> Bytes of the label of a unit.
   integer, parameter :: longest_unit = 20
   character(*), parameter, public :: name_letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.'
   character(*), parameter :: plain_in_words = "letters, digits, '_', '-' and '.', the first neither '-' nor '.'"

   !> The keys of &scene.
   type(key_type), parameter, public :: scene_keys(*) = [ &
      key_type(text_value, 'title', "''", '', &
         'One line for the log and the heads of tables.', longest=longest_name, may_be_blank=.true.), &
      key_type(text_value, 'case', "the deck's name", '', &
         'Stem of the names of the result files: '//plain_in_words//". The deck's name is that of its file "// &
         "without '.nml', with '_' for other characters.", longest=longest_name), &
      key_type(text_value, 'pressure_unit', "'pressure'", '', &
         "Label of the deck's unit of pressures and moduli in the heads of tables and in pictures, such as "// &
         "'MPa'. No number is converted.", longest=longest_unit), &
      key_type(text_value, 'length_unit', "'length'", '', &
         "Label of the deck's unit of lengths, such as 'mm'. A height map whose file names units is converted "// &
         'to it or, if the deck gives none, sets it.', longest=longest_unit)]

contains

   !> Checks the labels of units and the name of the case, whose default is the name of the deck's file without '.nml'.
   subroutine check_scene_group(values, problems, is_file)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems
      logical, intent(in) :: is_file   !! whether the deck is a file: the default is otherwise 'deck'

      character(13), parameter :: units(*) = ['pressure_unit', 'length_unit  ']
      character(:), allocatable :: name, usual
      integer :: i

      usual = 'deck'
      if (is_file) usual = values%deck_path(index(values%deck_path, '/', back=.true.) + 1:)
      if (len(usual) > 4 .and. index(usual, '.nml', back=.true.) == len(usual) - 3) usual = usual(:len(usual) - 4)
      ! The units of a table stand in one line, in brackets and separated by blanks.
      do i = 1, size(units)
         if (scan(values%text(units(i)), ' []') > 0 .and. .not. values%is_bad(units(i))) call values%complain( &
            problems, units(i), trim(units(i))//" must have no blanks and no brackets, such as 'mm' or 'N/mm^2'")
      end do
      ! One '_' for each character: bytes 128 to 191 of UTF-8 continue one.
      name = ''
      do i = 1, len(usual)
         if (iachar(usual(i:i)) >= 128 .and. iachar(usual(i:i)) < 192) cycle
         name = name//merge(usual(i:i), '_', index(name_letters, usual(i:i)) > 0)
      end do
      usual = name
      if (scan(usual, '-.') == 1) usual(1:1) = '_'
      if (values%is_bad('case')) return
      if (.not. values%has('case') .and. .not. is_plain_name(usual)) then
         call problems%add(values%place, "the deck's file name is too long for the name of the case, at most "// &
            integer_text(longest_name)//' bytes: give case in &scene')
         return
      end if
      call values%set_default('case', text=usual)
      if (.not. is_plain_name(values%text('case'))) call values%complain(problems, 'case', &
         'case must be a plain file name of '//plain_in_words)
   end subroutine check_scene_group

   !> Whether a text can be the stem of file names: as plain_in_words.
   pure logical function is_plain_name(name)
      character(*), intent(in) :: name

      is_plain_name = len(name) > 0 .and. len(name) <= longest_name .and. verify(name, name_letters) == 0 .and. &
                      scan(name, '-.') /= 1
   end function is_plain_name

end module wavycon_scene_group
