!> Writes namelist groups, each key with its value in full and a comment on what else it may be.
module wavycon_deck_writer
   use wavycon_key_table, only: allowed_values, key_group_type, key_index, key_type
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: exact_number, integer_text, quoted
   implicit none (type, external)
   private

   public :: deck_writer_type

   !> Open a group, put its keys, close it. After a write that failed nothing more is written.
   type :: deck_writer_type
      integer :: status = 0                      !! iostat of the first write that failed
      character(200) :: message = ''             !! its iomsg
      integer, private :: unit = -1
      type(key_group_type), private :: table
   contains
      procedure :: put_comment
      procedure :: open_group
      procedure :: close_group
      procedure, private :: put_real
      procedure, private :: put_reals
      procedure, private :: put_integer
      procedure, private :: put_integers
      procedure, private :: put_logical
      procedure, private :: put_text
      generic :: put => put_real, put_reals, put_integer, put_integers, put_logical, put_text
   end type deck_writer_type

   interface deck_writer_type
      module procedure new_deck_writer
   end interface deck_writer_type

contains

   type(deck_writer_type) function new_deck_writer(unit) result(writer)
      integer, intent(in) :: unit  !! open for formatted writing

      writer%unit = unit
   end function new_deck_writer

   subroutine put_comment(self, words)
      class(deck_writer_type), intent(inout) :: self
      character(*), intent(in) :: words

      call write_line(self, '! '//words)
   end subroutine put_comment

   subroutine open_group(self, table)
      class(deck_writer_type), intent(inout) :: self
      type(key_group_type), intent(in) :: table

      self%table = table
      call write_line(self, '&'//trim(table%name)//'   ! '//trim(table%meaning))
   end subroutine open_group

   subroutine close_group(self)
      class(deck_writer_type), intent(inout) :: self

      call write_line(self, '/')
   end subroutine close_group

   subroutine put_real(self, key, value)
      class(deck_writer_type), intent(inout) :: self
      character(*), intent(in) :: key
      real(dp), intent(in) :: value

      call put_line(self, key, exact_number(value))
   end subroutine put_real

   !> One value a line. No commas: gfortran takes one with a comment behind it for a value left out.
   subroutine put_reals(self, key, values)
      class(deck_writer_type), intent(inout) :: self
      character(*), intent(in) :: key
      real(dp), intent(in) :: values(:)  !! at least one

      integer :: i

      call put_line(self, key, exact_number(values(1)))
      do i = 2, size(values)
         call write_line(self, '      '//exact_number(values(i)))
      end do
   end subroutine put_reals

   subroutine put_integer(self, key, value)
      class(deck_writer_type), intent(inout) :: self
      character(*), intent(in) :: key
      integer, intent(in) :: value

      call put_line(self, key, integer_text(value))
   end subroutine put_integer

   subroutine put_integers(self, key, values)
      class(deck_writer_type), intent(inout) :: self
      character(*), intent(in) :: key
      integer, intent(in) :: values(:)  !! at least one

      integer :: i

      call put_line(self, key, integer_text(values(1)))
      do i = 2, size(values)
         call write_line(self, '      '//integer_text(values(i)))
      end do
   end subroutine put_integers

   subroutine put_logical(self, key, value)
      class(deck_writer_type), intent(inout) :: self
      character(*), intent(in) :: key
      logical, intent(in) :: value

      call put_line(self, key, trim(merge('.true. ', '.false.', value)))
   end subroutine put_logical

   subroutine put_text(self, key, value)
      class(deck_writer_type), intent(inout) :: self
      character(*), intent(in) :: key
      character(*), intent(in) :: value  !! blanks at its end are left out

      call put_line(self, key, quoted(trim(value)))
   end subroutine put_text

   !> "key = value   ! [unit] allowed"
   subroutine put_line(writer, key, value)
      type(deck_writer_type), intent(inout) :: writer
      character(*), intent(in) :: key, value

      character(:), allocatable :: comment

      associate (entry => writer%table%keys(key_index(writer%table%keys, key)))
         comment = allowed_values(entry)
         if (entry%unit /= '') comment = '['//trim(entry%unit)//'] '//comment
      end associate
      call write_line(writer, '   '//key//' = '//value//'   ! '//comment)
   end subroutine put_line

   subroutine write_line(writer, line)
      type(deck_writer_type), intent(inout) :: writer
      character(*), intent(in) :: line

      if (writer%status == 0) write (writer%unit, '(a)', iostat=writer%status, iomsg=writer%message) line
   end subroutine write_line

end module wavycon_deck_writer
