!> Files that the program writes, and standard output: interfaces of the C functions in written_file.c.
!>
!> A file is written under a temporary name and renamed when it is complete. What must not be replaced is refused: a file
!> that was read, a directory, a disk. A pipe or another device is written into, and so is the target of a symbolic link.
module wavycon_written_file
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_null_ptr, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_system, only: error_text
   implicit none (type, external)
   private

   public :: look_for_obstacle, look_for_print_trouble, note_input, print_text, remove_leftovers, written_file

   type :: written_file
      private
      type(c_ptr) :: handle = c_null_ptr
   contains
      procedure :: open => open_written
      procedure :: put_text
      procedure :: put_numbers
      procedure :: finish
   end type written_file

   interface
      type(c_ptr) function c_open(path, trouble) bind(c, name='wavycon_open_written')
         import :: c_char, c_int, c_ptr
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), intent(out) :: trouble
      end function c_open

      integer(c_int) function c_put_text(file, text, length) bind(c, name='wavycon_put_bytes')
         import :: c_char, c_int, c_ptr, c_size_t
         type(c_ptr), value :: file
         character(kind=c_char), intent(in) :: text(*)
         integer(c_size_t), value :: length
      end function c_put_text

      integer(c_int) function c_put_numbers(file, numbers, bytes) bind(c, name='wavycon_put_bytes')
         import :: c_int, c_ptr, c_size_t
         type(c_ptr), value :: file
         type(*), intent(in) :: numbers(*)
         integer(c_size_t), value :: bytes
      end function c_put_numbers

      integer(c_int) function c_end(file, is_complete, stays_open) bind(c, name='wavycon_end_written')
         import :: c_int, c_ptr
         type(c_ptr), value :: file
         integer(c_int), value :: is_complete, stays_open
      end function c_end

      integer(c_int) function c_refusal(path, mark) bind(c, name='wavycon_refusal')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*), mark(*)
      end function c_refusal

      subroutine c_note_input(path) bind(c, name='wavycon_note_input')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_note_input

      subroutine c_remove_leftovers(directory) bind(c, name='wavycon_remove_leftovers')
         import :: c_char
         character(kind=c_char), intent(in) :: directory(*)
      end subroutine c_remove_leftovers

      subroutine c_print(text, length) bind(c, name='wavycon_print')
         import :: c_char, c_size_t
         character(kind=c_char), intent(in) :: text(*)
         integer(c_size_t), value :: length
      end subroutine c_print

      integer(c_int) function c_print_trouble() bind(c, name='wavycon_print_trouble')
         import :: c_int
      end function c_print_trouble
   end interface

contains

   !> Opens a file to be written.
   subroutine open_written(self, path, trouble)
      class(written_file), intent(out) :: self
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: trouble   !! what is in the way of it; not allocated on success

      integer(c_int) :: number

      self%handle = c_open(path//c_null_char, number)
      call describe(number, trouble)
   end subroutine open_written

   !> Writes a text.
   subroutine put_text(self, text, trouble)
      class(written_file), intent(in) :: self               !! open
      character(*), intent(in) :: text
      character(:), allocatable, intent(out) :: trouble     !! the first failure; not allocated without one

      call describe(c_put_text(self%handle, text, len(text, kind=c_size_t)), trouble)
   end subroutine put_text

   !> Writes the bytes of numbers of any type.
   subroutine put_numbers(self, numbers, bytes, trouble)
      class(written_file), intent(in) :: self               !! open
      type(*), intent(in) :: numbers(*)
      integer(int64), intent(in) :: bytes                   !! of all the numbers
      character(:), allocatable, intent(out) :: trouble     !! the first failure; not allocated without one

      call describe(c_put_numbers(self%handle, numbers, int(bytes, c_size_t)), trouble)
   end subroutine put_numbers

   !> Writes what is in the buffer and gives a complete file its name; one that is not complete or had trouble is removed.
   !> Then closes it, unless it stays open for more bytes.
   subroutine finish(self, is_complete, stays_open, trouble)
      class(written_file), intent(in) :: self               !! open
      logical, intent(in) :: is_complete, stays_open
      character(:), allocatable, intent(out) :: trouble     !! the first failure; not allocated without one

      call describe(c_end(self%handle, merge(1_c_int, 0_c_int, is_complete), merge(1_c_int, 0_c_int, stays_open)), &
                    trouble)
   end subroutine finish

   !> Why a file must not be written or cannot be, as far as what has its name now says.
   subroutine look_for_obstacle(path, mark, trouble)
      character(*), intent(in) :: path
      character(*), intent(in) :: mark   !! how a file begins that may be replaced, unless it is empty; '': any
      character(:), allocatable, intent(out) :: trouble     !! not allocated if nothing is in the way

      call describe(c_refusal(path//c_null_char, mark//c_null_char), trouble)
   end subroutine look_for_obstacle

   !> Notes a file that is read: it will not be replaced.
   subroutine note_input(path)
      character(*), intent(in) :: path

      call c_note_input(path//c_null_char)
   end subroutine note_input

   !> Removes from a directory the unfinished files of processes of this machine that were killed.
   subroutine remove_leftovers(directory)
      character(*), intent(in) :: directory   !! nothing is done if it does not exist

      call c_remove_leftovers(directory//c_null_char)
   end subroutine remove_leftovers

   !> Writes to standard output, at once.
   subroutine print_text(text)
      character(*), intent(in) :: text

      call c_print(text, len(text, kind=c_size_t))
   end subroutine print_text

   !> The first failure to write to standard output; not allocated without one, or if standard output is closed.
   subroutine look_for_print_trouble(trouble)
      character(:), allocatable, intent(out) :: trouble

      call describe(c_print_trouble(), trouble)
   end subroutine look_for_print_trouble

   !> The words for a reason of written_file.c or an errno; none for 0.
   subroutine describe(number, trouble)
      integer(c_int), intent(in) :: number
      character(:), allocatable, intent(out) :: trouble

      select case (number)
      case (0)
      case (-1)
         trouble = 'it is read by this run and is not replaced'
      case (-2)
         trouble = 'it is a disk, not a file'
      case (-3)
         trouble = 'it is a symbolic link to nothing'
      case (-4)
         trouble = 'there is a file that is no such table; it is not replaced'
      case default
         trouble = error_text(number)
      end select
   end subroutine describe

end module wavycon_written_file
