!> A file read whole.
module wavycon_file_bytes
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_plain_text, only: escaped, integer_text, system_words
   use wavycon_system, only: path_absent, path_directory, path_kind
   implicit none (type, external)
   private

   public :: open_file, read_file

   !> Byte order mark of UTF-8, with which some editors start a file.
   character(*), parameter, public :: byte_order_mark = char(239)//char(187)//char(191)

   character(*), parameter :: no_memory = 'there is not the memory for it'

contains

   !> Reads a file; all its errors have the status `exit_file_trouble`.
   subroutine read_file(path, most_bytes, content, error)
      character(*), intent(in) :: path
      integer, intent(in) :: most_bytes   !! a larger file is not read
      character(:), allocatable, intent(out) :: content
      type(error_type), allocatable, intent(out) :: error

      character(200) :: message
      integer :: status, unit

      call open_file(path, unit, error)
      if (allocated(error)) return
      call read_bytes(unit, most_bytes, content, status, message)
      close (unit)
      if (status /= 0) call fatal_error(error, exit_file_trouble, &
                                        escaped(path)//': cannot be read: '//system_words(message))
   end subroutine read_file

   !> Opens a file for reading, as a stream of bytes. Errors: exit_file_trouble.
   subroutine open_file(path, unit, error)
      character(*), intent(in) :: path
      integer, intent(out) :: unit   !! to be closed by the caller; -1 in case of an error
      type(error_type), allocatable, intent(out) :: error

      character(200) :: message
      integer :: status

      unit = -1
      select case (path_kind(path))
      case (path_absent)
         call trouble('there is no such file')
         return
      case (path_directory)
         call trouble('this is a directory, not a file')
         return
      end select
      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', &
         iostat=status, iomsg=message)
      if (status /= 0) call trouble('cannot be opened: '//system_words(message))

   contains

      subroutine trouble(words)
         character(*), intent(in) :: words

         call fatal_error(error, exit_file_trouble, escaped(path)//': '//words)
      end subroutine trouble

   end subroutine open_file

   !> All the bytes of a file. A pipe is read byte by byte: its size is not known.
   subroutine read_bytes(unit, most, content, status, message)
      integer, intent(in) :: unit, most
      character(:), allocatable, intent(out) :: content   !! allocated if status is 0
      integer, intent(out) :: status
      character(*), intent(inout) :: message

      character(1) :: byte
      integer(int64) :: size_of_file
      integer :: used

      inquire (unit=unit, size=size_of_file)
      if (size_of_file > most) then
         call too_large()
      else if (size_of_file > 0) then
         allocate (character(int(size_of_file)) :: content, stat=status)
         if (status == 0) then
            read (unit, iostat=status, iomsg=message) content
         else
            message = no_memory
         end if
      else
         content = repeat(' ', 4096)
         used = 0
         do
            read (unit, iostat=status, iomsg=message) byte
            if (is_iostat_end(status)) exit
            if (status /= 0) return
            if (used == most) then
               call too_large()
               return
            end if
            if (used == len(content)) content = content//repeat(' ', used)
            used = used + 1
            content(used:used) = byte
         end do
         content = content(:used)
         status = 0
      end if

   contains

      subroutine too_large()
         status = 1
         message = 'it is larger than the '//integer_text(most/1024**2)//' MB allowed'
      end subroutine too_large

   end subroutine read_bytes

end module wavycon_file_bytes
