!> Files, memory, signals and the terminal: interfaces of the C functions in system.c and written_file.c.
module wavycon_system
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_int64_t, c_null_char, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: available_memory, has_memory_for
   public :: end_written, error_text, note_input, open_written, print_text, print_trouble, put_bytes, put_text, &
      refusal_to_write, remove_leftovers, say
   public :: file_size, full_path, path_kind, make_directories, remove_file
   public :: note_kept, prepare_process, stack_limit, terminal_columns

   !> Values of `path_kind`.
   integer, parameter, public :: path_absent = 0, path_directory = 1, path_file = 2, path_device = 3, path_unknown = 4

   interface
      integer(c_int) function c_path_kind(path, size) bind(c, name='wavycon_path_kind')
         import :: c_char, c_int, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int64_t), intent(out) :: size
      end function c_path_kind

      integer(c_int) function c_make_directory(path) bind(c, name='wavycon_make_directory')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
      end function c_make_directory

      subroutine c_remove(path) bind(c, name='wavycon_remove')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_remove

      !> The limit on the stack [byte] (ulimit -s).
      integer(c_int64_t) function stack_limit() bind(c, name='wavycon_stack_limit')
         import :: c_int64_t
      end function stack_limit

      !> Makes a write beyond the limit on file sizes (ulimit -f) fail as on a full disk; otherwise it ends the program.
      !> Keeps memory that is deallocated for later arrays, instead of giving it back to the system. Makes BLAS and
      !> LAPACK use one thread, if they are OpenBLAS, which by default uses all processors, also for the small matrices
      !> here, where more threads save no time.
      !>
      !> N.B. It acts on the whole process: programs may call it, procedures of a library must not.
      subroutine prepare_process() bind(c, name='wavycon_prepare_process')
      end subroutine prepare_process

      !> The width of the terminal that standard output is; 0 if it is none, or not the one of this program.
      integer(c_int) function terminal_columns() bind(c, name='wavycon_terminal_columns')
         import :: c_int
      end function terminal_columns

      !> What is told if the program is interrupted: what of the run is kept, with a null character at its end.
      subroutine note_kept(words) bind(c, name='wavycon_note_kept')
         import :: c_char
         character(kind=c_char), intent(in) :: words(*)
      end subroutine note_kept

      !> Memory that this process may still allocate and use without swapping [byte]: memory of the machine that is free
      !> or can be freed, but at most what is left by the limits of a container or a batch job (control groups of Linux)
      !> and by that on the address space (ulimit -v). -1 if the system does not say.
      integer(c_int64_t) function available_memory() bind(c, name='wavycon_available_memory')
         import :: c_int64_t
      end function available_memory

      type(c_ptr) function c_realpath(path, full) bind(c, name='realpath')
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: full(*)
      end function c_realpath

      !> Opens a file to be written, as written_file.c says; paths end in a null character. What is in the way of it is
      !> told by the next call. The errors that the following return have words by `error_text`; 0: there is none.
      type(c_ptr) function open_written(path) bind(c, name='wavycon_open_written')
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*)
      end function open_written

      integer(c_int) function put_text(file, text, length) bind(c, name='wavycon_put_bytes')
         import :: c_char, c_int, c_ptr, c_size_t
         type(c_ptr), value :: file
         character(kind=c_char), intent(in) :: text(*)
         integer(c_size_t), value :: length
      end function put_text

      integer(c_int) function put_bytes(file, numbers, bytes) bind(c, name='wavycon_put_bytes')
         import :: c_int, c_ptr, c_size_t
         type(c_ptr), value :: file
         type(*), intent(in) :: numbers(*)           !! of any type
         integer(c_size_t), value :: bytes
      end function put_bytes

      !> Writes what is in the buffer and gives a complete file its name; one that is not complete, or had an error, is
      !> removed. Then closes it, unless it stays open for more.
      integer(c_int) function end_written(file, is_complete, stays_open) bind(c, name='wavycon_end_written')
         import :: c_int, c_ptr
         type(c_ptr), value :: file
         integer(c_int), value :: is_complete, stays_open   !! 1 or 0
      end function end_written

      !> Why a file cannot be written, as far as what has its name says.
      integer(c_int) function refusal_to_write(path, mark) bind(c, name='wavycon_refusal')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(in) :: mark(*)      !! how a file begins that may be replaced; empty: any
      end function refusal_to_write

      !> Notes a file that is read: it will not be replaced.
      subroutine note_input(path) bind(c, name='wavycon_note_input')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine note_input

      !> Removes from a directory the unfinished files of processes of this machine that were killed.
      subroutine remove_leftovers(directory) bind(c, name='wavycon_remove_leftovers')
         import :: c_char
         character(kind=c_char), intent(in) :: directory(*)
      end subroutine remove_leftovers

      !> Writes a text, which ends in a null character, to standard output, at once.
      subroutine print_text(text) bind(c, name='wavycon_print')
         import :: c_char
         character(kind=c_char), intent(in) :: text(*)
      end subroutine print_text

      !> The first error in doing so.
      integer(c_int) function print_trouble() bind(c, name='wavycon_print_trouble')
         import :: c_int
      end function print_trouble

      subroutine c_error_text(number, text, length) bind(c, name='wavycon_error_text')
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: number
         character(kind=c_char), intent(out) :: text(*)
         integer(c_size_t), value :: length
      end subroutine c_error_text
   end interface

contains

   !> The absolute path of a file, which need not exist, without symbolic links and dots, so that equal files have equal
   !> texts.
   recursive function full_path(path) result(full)
      character(*), intent(in) :: path
      character(:), allocatable :: full

      integer, parameter :: longest = 4096
      character(longest) :: buffer
      integer :: slash

      full = path
      slash = index(path, '/', back=.true.)
      if (c_associated(c_realpath(path//c_null_char, buffer))) then
         full = buffer(:index(buffer, c_null_char) - 1)
      else if (path /= '.') then
         ! What does not exist is no link.
         full = '.'
         if (slash > 0) full = path(:max(slash - 1, 1))
         full = full_path(full)
         if (full == '/') full = ''
         if (path(slash + 1:) == '..') then
            full = full(:index(full, '/', back=.true.) - 1)
         else if (path(slash + 1:) /= '' .and. path(slash + 1:) /= '.') then
            full = full//'/'//path(slash + 1:)
         end if
      end if
   end function full_path

   !> Whether a path names nothing, a directory, a file or something else (a pipe, a device); unknown if the system
   !> reports an error.
   integer function path_kind(path)
      character(*), intent(in) :: path

      integer(c_int64_t) :: ignored

      path_kind = int(c_path_kind(path//c_null_char, ignored))
   end function path_kind

   !> Size of a file [byte]; -1 if there is no file.
   !>
   !> N.B. For an open file `inquire` of gfortran 12 includes bytes that are not written yet.
   integer(int64) function file_size(path)
      character(*), intent(in) :: path

      integer(c_int) :: ignored

      ignored = c_path_kind(path//c_null_char, file_size)
   end function file_size

   !> Makes a directory and those above it; directories that exist are no failure.
   subroutine make_directories(path, failure)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: failure
         !! which part of the path failed, and why; not allocated on success

      integer :: i, number

      ! An empty path fails too: there is no such directory.
      do i = min(2, len(path) + 1), len(path) + 1
         ! At the end of each part of the path.
         if (index(path(i:)//'/', '/') > 1) cycle
         number = int(c_make_directory(path(:i - 1)//c_null_char))
         if (number == 0) cycle
         failure = path(:i - 1)//': '//error_text(number)
         ! The system would say 'File exists'.
         if (any(path_kind(path(:i - 1)) == [path_file, path_device])) &
            failure = path(:i - 1)//' is a file and no directory'
         return
      end do
   end subroutine make_directories

   !> Removes a file, if it exists.
   subroutine remove_file(path)
      character(*), intent(in) :: path

      call c_remove(path//c_null_char)
   end subroutine remove_file

   !> Whether there is memory for so many numbers of double precision.
   logical function has_memory_for(numbers)
      integer(int64), intent(in) :: numbers

      !> So few numbers, 8 MB, are granted without asking the system, which means to read a dozen of its files and takes
      !> as long as to solve a grid of 32 x 32 points.
      integer(int64), parameter :: few = 1000000_int64
      integer(int64) :: available
      real(dp), allocatable :: probe(:)
      integer :: status

      has_memory_for = numbers <= few
      if (has_memory_for) return
      available = available_memory()
      if (available >= 0) then
         has_memory_for = numbers <= available/(storage_size(1.0_dp)/8)
      else
         ! The system gives no figure. An allocation fails where memory is limited, but may succeed where it is short.
         allocate (probe(numbers), stat=status)
         has_memory_for = status == 0
      end if
   end function has_memory_for

   !> Writes a line to standard output, at once.
   subroutine say(line)
      character(*), intent(in) :: line

      call print_text(line//new_line('a')//c_null_char)
   end subroutine say

   !> The system's message of an error.
   function error_text(number) result(text)
      integer, intent(in) :: number  !! an errno
      character(:), allocatable :: text

      character(256) :: buffer

      call c_error_text(int(number, c_int), buffer, len(buffer, kind=c_size_t))
      text = buffer(:index(buffer, c_null_char) - 1)
   end function error_text

end module wavycon_system
