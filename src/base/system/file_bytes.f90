!> Reads whole files.
module wavycon_file_bytes
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: int64
   use wavycon_plain_text, only: escaped, integer_text, system_words
   use wavycon_system, only: path_absent, path_directory, path_kind
   implicit none (type, external)
   private

   public :: make_one_byte, open_file, read_file

   !> Byte order mark of UTF-8, with which some editors start a file.
   character(*), parameter, public :: byte_order_mark = char(239)//char(187)//char(191)

contains

   !> Reads all bytes of a file. Errors: exit_file_trouble.
   subroutine read_file(path, most_bytes, content, error)
      character(*), intent(in) :: path
      integer, intent(in) :: most_bytes   !! limit: a larger file is an error
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

   !> Leaves out the bytes that a text of two bytes a character (UTF-16, with its mark at the beginning) has beside
   !> those of ASCII and Latin-1. Other characters become '?'. Other texts do not change.
   pure subroutine make_one_byte(text)
      character(:), allocatable, intent(inout) :: text

      integer :: high, i   ! position of the upper byte of a character in its two bytes; number of the character

      high = scan(text(:min(2, len(text))), char(254))   ! the mark is 254, 255 if the upper byte is the first
      if (high == 0 .or. index(text(:min(2, len(text))), char(255)) /= 3 - high) return
      do i = 1, (len(text) - 2)/2
         text(i:i) = merge(text(2*i + 3 - high:2*i + 3 - high), '?', text(2*i + high:2*i + high) == char(0))
      end do
      text = text(:(len(text) - 2)/2)
   end subroutine make_one_byte

   !> Opens a file for reading, as a stream of bytes. Errors: exit_file_trouble.
   subroutine open_file(path, unit, error)
      character(*), intent(in) :: path
      integer, intent(out) :: unit   !! to be closed by the caller; -1 in case of an error
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: trouble
      character(200) :: message
      integer :: status

      unit = -1
      select case (path_kind(path))
      case (path_absent)
         trouble = 'there is no such file'
      case (path_directory)
         trouble = 'this is a directory, not a file'
      case default
         open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', &
            iostat=status, iomsg=message)
         if (status /= 0) trouble = 'cannot be opened: '//system_words(message)
      end select
      if (allocated(trouble)) call fatal_error(error, exit_file_trouble, escaped(path)//': '//trouble)
   end subroutine open_file

   !> Reads all bytes of an open file. A pipe, whose size is not known, is read byte by byte.
   subroutine read_bytes(unit, most, content, status, message)
      integer, intent(in) :: unit, most                   !! unit of the file; most bytes
      character(:), allocatable, intent(out) :: content   !! allocated if status is 0
      integer, intent(out) :: status                      !! 0 if there was no error
      character(*), intent(inout) :: message              !! set if status is not 0

      character(1) :: byte
      integer(int64) :: bytes
      integer :: used

      status = 0
      inquire (unit=unit, size=bytes)
      if (bytes > 0 .and. bytes <= most) then
         allocate (character(int(bytes)) :: content, stat=status)
         message = 'there is not enough memory for it'
         if (status == 0) read (unit, iostat=status, iomsg=message) content
         return
      end if
      content = repeat(' ', 4096)
      used = 0
      do while (used <= most .and. bytes <= most)
         read (unit, iostat=status, iomsg=message) byte
         if (status /= 0) exit
         if (used == len(content)) content = content//repeat(' ', used)
         used = used + 1
         content(used:used) = byte
      end do
      if (is_iostat_end(status)) then
         status = 0
         content = content(:used)
      else if (status == 0) then
         status = 1
         message = 'it is larger than the '//integer_text(most/1024**2)//' MB allowed'
      end if
   end subroutine read_bytes

end module wavycon_file_bytes
