!> Files, memory, signals and the terminal: interfaces of the C functions in system.c and written_file.c. Texts for C
!> functions end in a null character. An errno is the system's number of an error, 0 if there is none.
module wavycon_system
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_int64_t, c_null_char, c_ptr, c_size_t
   use wavycon_kinds, only: dp, int64
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
      !> The kind of file that a path names, one of the values of `path_kind`, and the file's `bytes`.
      integer(c_int) function c_path_kind(path, bytes) bind(c, name='wavycon_path_kind')
         import :: c_char, c_int, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int64_t), intent(out) :: bytes
      end function c_path_kind

      !> Makes a directory. Returns an errno.
      integer(c_int) function c_make_directory(path) bind(c, name='wavycon_make_directory')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
      end function c_make_directory

      !> Removes a file, if it exists.
      subroutine c_remove(path) bind(c, name='wavycon_remove')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_remove

      !> The limit on the stack [byte] (ulimit -s).
      integer(c_int64_t) function stack_limit() bind(c, name='wavycon_stack_limit')
         import :: c_int64_t
      end function stack_limit

      !> Prepares the process, once at its start. A write beyond the limit on file sizes (ulimit -f), or to a pipe from
      !> which nobody reads on, then fails as on a full disk, instead of ending the program. Deallocated memory is kept
      !> for later arrays, instead of being given back to the system. OpenBLAS uses one thread: its default, all
      !> processors, saves no time for the small matrices here.
      !>
      !> N.B. These settings hold for the whole process: programs may call this procedure, a library must not.
      subroutine prepare_process() bind(c, name='wavycon_prepare_process')
      end subroutine prepare_process

      !> The width in characters of the terminal to which standard output goes; 0 if standard output is no terminal, or
      !> if the program runs in the background.
      integer(c_int) function terminal_columns() bind(c, name='wavycon_terminal_columns')
         import :: c_int
      end function terminal_columns

      !> Sets the words that tell a user, if the program is interrupted, which results of the run are kept.
      subroutine note_kept(words) bind(c, name='wavycon_note_kept')
         import :: c_char
         character(kind=c_char), intent(in) :: words(*)
      end subroutine note_kept

      !> Memory that this process may still allocate and use without swapping [byte]; -1 if the system does not say. It
      !> is the memory of the machine that is free or can be freed, but at most the rest of the limits of a container or
      !> a batch job (control groups of Linux) and of the limit on the address space (ulimit -v).
      integer(c_int64_t) function available_memory() bind(c, name='wavycon_available_memory')
         import :: c_int64_t
      end function available_memory

      !> The C library's realpath: the absolute path without symbolic links; null if there is no such file.
      type(c_ptr) function c_realpath(path, full) bind(c, name='realpath')
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: full(*)
      end function c_realpath

      !> Opens a file for writing, as written_file.c describes. If this fails the next call for the file returns the
      !> error. The functions below return 0, or the number of an error for `error_text`.
      type(c_ptr) function open_written(path) bind(c, name='wavycon_open_written')
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*)
      end function open_written

      !> Writes a text to a file. Returns the first error of the file.
      integer(c_int) function put_text(file, text, length) bind(c, name='wavycon_put_bytes')
         import :: c_char, c_int, c_ptr, c_size_t
         type(c_ptr), value :: file
         character(kind=c_char), intent(in) :: text(*)
         integer(c_size_t), value :: length
      end function put_text

      !> Writes numbers to a file as they are in memory. Returns the first error of the file.
      integer(c_int) function put_bytes(file, numbers, bytes) bind(c, name='wavycon_put_bytes')
         import :: c_int, c_ptr, c_size_t
         type(c_ptr), value :: file
         type(*), intent(in) :: numbers(*)           !! of any type
         integer(c_size_t), value :: bytes           !! size of all numbers
      end function put_bytes

      !> Writes the buffer of a file, and gives a complete file its name; a file that is not complete, or had an error,
      !> is removed. Then the file is closed, unless it stays open for more bytes. Returns the first error of the file.
      integer(c_int) function end_written(file, is_complete, stays_open) bind(c, name='wavycon_end_written')
         import :: c_int, c_ptr
         type(c_ptr), value :: file
         integer(c_int), value :: is_complete, stays_open   !! 1 or 0
      end function end_written

      !> The reason why a file cannot be written, as far as the file of its name shows; 0 if there is none.
      integer(c_int) function refusal_to_write(path, mark) bind(c, name='wavycon_refusal')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(in) :: mark(*)      !! first bytes of files that may be replaced; empty: any
      end function refusal_to_write

      !> Notes that a file was read: this run will not replace it.
      subroutine note_input(path) bind(c, name='wavycon_note_input')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine note_input

      !> Removes from a directory the unfinished files of processes of this machine that were killed.
      subroutine remove_leftovers(directory) bind(c, name='wavycon_remove_leftovers')
         import :: c_char
         character(kind=c_char), intent(in) :: directory(*)
      end subroutine remove_leftovers

      !> Writes a text to standard output at once: the buffer is flushed.
      subroutine print_text(text) bind(c, name='wavycon_print')
         import :: c_char
         character(kind=c_char), intent(in) :: text(*)
      end subroutine print_text

      !> The first error of writing to standard output; 0 if there was none.
      integer(c_int) function print_trouble() bind(c, name='wavycon_print_trouble')
         import :: c_int
      end function print_trouble

      !> The message of an error, with a null character at its end.
      subroutine c_error_text(number, text, length) bind(c, name='wavycon_error_text')
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: number
         character(kind=c_char), intent(out) :: text(*)
         integer(c_size_t), value :: length
      end subroutine c_error_text
   end interface

contains

   !> The absolute path of a file without symbolic links and dots, so that two paths of the same file give the same
   !> text. The file need not exist.
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
         ! A path that does not exist cannot be a link: resolve its directory, and add its last part.
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

   !> Whether a path names nothing, a directory, a file or a pipe or device; path_unknown if the system reports an
   !> error. A null character, at which the system would cut the path, is in no name.
   integer function path_kind(path)
      character(*), intent(in) :: path

      integer(c_int64_t) :: ignored

      path_kind = path_absent
      if (index(path, c_null_char) == 0) path_kind = int(c_path_kind(path//c_null_char, ignored))
   end function path_kind

   !> Size of a file [byte]; -1 if there is no file.
   !>
   !> N.B. For an open file `inquire` of gfortran 12 includes bytes that are not written yet.
   integer(int64) function file_size(path)
      character(*), intent(in) :: path

      integer(c_int) :: ignored

      ignored = c_path_kind(path//c_null_char, file_size)
   end function file_size

   !> Makes a directory and all directories above it. Directories that exist are no failure.
   subroutine make_directories(path, failure)
      character(*), intent(in) :: path
      !> Message that says which part of the path failed, and why; not allocated on success.
      character(:), allocatable, intent(out) :: failure

      integer :: i, number

      ! The loop runs once for an empty path, which fails: there is no such directory.
      do i = min(2, len(path) + 1), len(path) + 1
         ! Go on only at the end of a part of the path.
         if (index(path(i:)//'/', '/') > 1) cycle
         number = int(c_make_directory(path(:i - 1)//c_null_char))
         if (number == 0) cycle
         failure = path(:i - 1)//': '//error_text(number)
         ! The system's message would be 'File exists'.
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

   !> Whether there is enough memory for a number of double precision numbers.
   logical function has_memory_for(numbers)
      integer(int64), intent(in) :: numbers   !! how many

      !> For so few numbers, 8 MB, the result is .true. without asking the system. To ask means to read a dozen files of
      !> the system, and takes as long as solving a grid of 32 x 32 points.
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
         ! The system does not say how much memory there is: try. The allocation fails if a limit is reached, but it may
         ! succeed although memory is short.
         allocate (probe(numbers), stat=status)
         has_memory_for = status == 0
      end if
   end function has_memory_for

   !> Writes a line to standard output at once: the buffer is flushed.
   subroutine say(line)
      character(*), intent(in) :: line

      call print_text(line//new_line('a')//c_null_char)
   end subroutine say

   !> The message of an error.
   function error_text(number) result(text)
      integer, intent(in) :: number  !! an errno, or a negative number of written_file.c
      character(:), allocatable :: text

      character(256) :: buffer

      call c_error_text(int(number, c_int), buffer, len(buffer, kind=c_size_t))
      text = buffer(:index(buffer, c_null_char) - 1)
   end function error_text

end module wavycon_system
