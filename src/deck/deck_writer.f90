!> Writes namelist groups, each key with its value in full and a comment on what else it may be.
module wavycon_deck_writer
   use wavycon_key_table, only: allowed_values, key_group_type, key_index, key_type
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, quoted
   implicit none (type, external)
   private

   public :: deck_writer_type

   !> Open a group, put its keys, close it.
   type :: deck_writer_type
      integer, private :: unit = -1
      type(key_group_type), private :: table
   contains
      procedure :: open_group
      procedure :: close_group
      procedure, private :: put_real
      procedure, private :: put_reals
      procedure, private :: put_integer
      procedure, private :: put_logical
      procedure, private :: put_text
      generic :: put => put_real, put_reals, put_integer, put_logical, put_text
   end type deck_writer_type

   interface deck_writer_type
      module procedure new_deck_writer
   end interface deck_writer_type

   !> 17 significant digits: read back, a number is the same to the last bit.
   character(*), parameter :: real_format = '(es24.16e3)'

contains

   type(deck_writer_type) function new_deck_writer(unit) result(writer)
      integer, intent(in) :: unit  !! open for formatted writing

      writer%unit = unit
   end function new_deck_writer

   subroutine open_group(self, table)
      class(deck_writer_type), intent(inout) :: self
      type(key_group_type), intent(in) :: table

      self%table = table
      write (self%unit, '(a)') '&'//trim(table%name)//'   ! '//trim(table%meaning)
   end subroutine open_group

   subroutine close_group(self)
      class(deck_writer_type), intent(in) :: self

      write (self%unit, '(a)') '/'
   end subroutine close_group

   subroutine put_real(self, key, value)
      class(deck_writer_type), intent(in) :: self
      character(*), intent(in) :: key
      real(dp), intent(in) :: value

      call put_line(self, key, real_text(value))
   end subroutine put_real

   !> One value a line. No commas: gfortran takes one with a comment behind it for a value left out.
   subroutine put_reals(self, key, values)
      class(deck_writer_type), intent(in) :: self
      character(*), intent(in) :: key
      real(dp), intent(in) :: values(:)  !! at least one

      integer :: i

      call put_line(self, key, real_text(values(1)))
      do i = 2, size(values)
         write (self%unit, '(a)') '      '//real_text(values(i))
      end do
   end subroutine put_reals

   subroutine put_integer(self, key, value)
      class(deck_writer_type), intent(in) :: self
      character(*), intent(in) :: key
      integer, intent(in) :: value

      call put_line(self, key, integer_text(value))
   end subroutine put_integer

   subroutine put_logical(self, key, value)
      class(deck_writer_type), intent(in) :: self
      character(*), intent(in) :: key
      logical, intent(in) :: value

      call put_line(self, key, trim(merge('.true. ', '.false.', value)))
   end subroutine put_logical

   subroutine put_text(self, key, value)
      class(deck_writer_type), intent(in) :: self
      character(*), intent(in) :: key
      character(*), intent(in) :: value  !! blanks at its end are left out

      call put_line(self, key, quoted(trim(value)))
   end subroutine put_text

   !> "key = value   ! [unit] allowed"
   subroutine put_line(writer, key, value)
      type(deck_writer_type), intent(in) :: writer
      character(*), intent(in) :: key, value

      character(:), allocatable :: comment

      associate (entry => writer%table%keys(key_index(writer%table%keys, key)))
         comment = allowed_values(entry)
         if (entry%unit /= '') comment = '['//trim(entry%unit)//'] '//comment
      end associate
      write (writer%unit, '(a)') '   '//key//' = '//value//'   ! '//comment
   end subroutine put_line

   function real_text(value) result(text)
      real(dp), intent(in) :: value
      character(:), allocatable :: text

      character(24) :: buffer

      write (buffer, real_format) value
      text = trim(adjustl(buffer))
   end function real_text

end module wavycon_deck_writer
