!> The &scene group: what the case is called.
module wavycon_scene_group
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_group_input, only: group_input_type
   use wavycon_key_table, only: key_group, key_group_type, text_key
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: scene_group_type, scene_table, read_scene_group, write_scene_group

   integer, parameter :: longest_name = 200

   !> What &scene says.
   type :: scene_group_type
      character(longest_name) :: title = ''  !! one line for the heads of tables and for plots
      character(longest_name) :: case = ''   !! stem of the result files' names; never empty in a deck read
   end type scene_group_type

   character(*), parameter :: plain = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.'
   character(*), parameter :: plain_in_words = &
      "letters, digits, '_', '-' and '.', the first neither '-' nor '.'"

contains

   function scene_table() result(table)
      type(key_group_type) :: table

      table = key_group('scene', 'what the case is called', [ &
         text_key('title', "''", 'One line for the heads of tables and for plots.', longest_name, &
            may_be_blank=.true.), &
         text_key('case', "the deck's name", &
            'Stem of the names of the result files: '//plain_in_words// &
            ". The deck's name is that of its file without '.nml'.", longest_name)])
   end function scene_table

   !> Reads the group; a case that is not given takes its name from the deck's file.
   subroutine read_scene_group(input, path, group, problems)
      type(group_input_type), intent(in) :: input
      character(*), intent(in) :: path  !! of the deck
      type(scene_group_type), intent(out) :: group
      type(problem_list_type), intent(inout) :: problems

      character(longest_name) :: title, case, message
      integer :: status
      namelist /scene/ title, case

      title = group%title
      case = group%case
      read (input%record, nml=scene, iostat=status, iomsg=message)
      if (status /= 0) call problems%add(input%place, trim(message))
      group%title = title
      group%case = case

      if (input%is_bad('case')) return
      if (input%has('case')) then
         if (.not. is_plain_name(trim(case))) call problems%add(input%place_of('case'), &
            'case must be a plain file name of '//plain_in_words)
      else if (is_plain_name(stem(path))) then
         group%case = stem(path)
      else
         call problems%add(input%place, "the deck's file name cannot serve as the name of the case ("// &
            plain_in_words//"): give case in &scene")
      end if
   end subroutine read_scene_group

   subroutine write_scene_group(group, writer)
      type(scene_group_type), intent(in) :: group
      type(deck_writer_type), intent(inout) :: writer

      call writer%open_group(scene_table())
      call writer%put('title', group%title)
      call writer%put('case', group%case)
      call writer%close_group()
   end subroutine write_scene_group

   pure logical function is_plain_name(name)
      character(*), intent(in) :: name

      is_plain_name = len(name) > 0 .and. len(name) <= longest_name .and. verify(name, plain) == 0
      if (is_plain_name) is_plain_name = scan(name(1:1), '-.') == 0
   end function is_plain_name

   !> The last part of a path, without '.nml'.
   pure function stem(path)
      character(*), intent(in) :: path
      character(:), allocatable :: stem

      character(*), parameter :: suffix = '.nml'

      stem = path(index(path, '/', back=.true.) + 1:)
      if (len(stem) <= len(suffix)) return
      if (stem(len(stem) - len(suffix) + 1:) == suffix) stem = stem(:len(stem) - len(suffix))
   end function stem

end module wavycon_scene_group
