!> The text of a deck file, and where in it a byte stands.
module wavycon_deck_text
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_plain_text, only: escaped, integer_text, system_words
   use wavycon_system, only: path_absent, path_directory, path_kind
   implicit none (type, external)
   private

   public :: deck_text_type, read_deck_text

   !> A text and its lines. A place in it is the number of a byte, counted from 1.
   type :: deck_text_type
      character(:), allocatable :: path        !! as the user named the file
      character(:), allocatable :: content
      integer, allocatable :: line_start(:)    !! place of the first byte of each line
   contains
      procedure :: line_of
      procedure :: line_bounds
   end type deck_text_type

   interface deck_text_type
      module procedure new_deck_text
   end interface deck_text_type

   character(*), parameter :: line_feed = achar(10), carriage_return = achar(13)
   character(*), parameter :: byte_order_mark = char(239)//char(187)//char(191)

   !> A file larger than this is no deck [byte]; the fullest deck allowed is a tenth of it.
   integer, parameter :: largest = 64*1024*1024

contains

   !> A text from memory. Lines end in LF, CR LF or CR; a byte order mark is left out.
   pure function new_deck_text(path, content) result(text)
      character(*), intent(in) :: path, content
      type(deck_text_type) :: text

      integer :: i, lines, mark, pass

      mark = min(len(content), len(byte_order_mark))
      if (content(:mark) /= byte_order_mark) mark = 0
      text%path = path
      text%content = content(mark + 1:)
      do pass = 1, 2
         lines = 1
         if (pass == 2) text%line_start(1) = 1
         do i = 1, len(text%content)
            if (.not. ends_line(text%content, i)) cycle
            lines = lines + 1
            if (pass == 2) text%line_start(lines) = i + 1
         end do
         if (pass == 1) allocate (text%line_start(lines))
      end do
   end function new_deck_text

   pure logical function ends_line(content, place)
      character(*), intent(in) :: content
      integer, intent(in) :: place

      ends_line = content(place:place) == line_feed
      if (content(place:place) /= carriage_return) return
      ends_line = .true.
      if (place < len(content)) ends_line = content(place + 1:place + 1) /= line_feed
   end function ends_line

   !> The number of the line that a place is in.
   pure integer function line_of(self, place)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: place  !! >= 1

      integer :: above, middle

      line_of = 1
      above = size(self%line_start) + 1
      do while (above - line_of > 1)
         middle = (line_of + above)/2
         if (self%line_start(middle) <= place) then
            line_of = middle
         else
            above = middle
         end if
      end do
   end function line_of

   !> First and last place of a line, without what ends it; last < first if the line is empty.
   pure subroutine line_bounds(self, line, first, last)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: line
      integer, intent(out) :: first, last

      first = self%line_start(line)
      last = len(self%content)
      if (line < size(self%line_start)) last = self%line_start(line + 1) - 1
      do while (last >= first)
         if (self%content(last:last) /= line_feed .and. self%content(last:last) /= carriage_return) exit
         last = last - 1
      end do
   end subroutine line_bounds

   !> Reads a file whole; all its errors have the status `exit_file_trouble`.
   subroutine read_deck_text(path, text, error, most_bytes)
      character(*), intent(in) :: path
      type(deck_text_type), intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in), optional :: most_bytes   !! of a file that is no deck

      character(:), allocatable :: content
      character(200) :: message
      integer :: status, unit

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
      if (status /= 0) then
         call trouble('cannot be opened: '//system_words(message))
         return
      end if
      content = ''
      if (present(most_bytes)) then
         call read_bytes(unit, most_bytes, content, status, message)
      else
         call read_bytes(unit, largest, content, status, message)
      end if
      close (unit)
      if (status /= 0) then
         call trouble('cannot be read: '//system_words(message))
         return
      end if
      text = deck_text_type(path, content)

   contains

      subroutine trouble(words)
         character(*), intent(in) :: words

         call fatal_error(error, exit_file_trouble, escaped(path)//': '//words)
      end subroutine trouble

   end subroutine read_deck_text

   !> All the bytes of a file; a pipe, whose size is not known, is read a byte at a time.
   subroutine read_bytes(unit, most, content, status, message)
      integer, intent(in) :: unit, most
      character(:), allocatable, intent(inout) :: content
      integer, intent(out) :: status
      character(*), intent(inout) :: message

      character(1) :: byte
      integer(int64) :: size_of_file
      integer :: used

      status = 0
      inquire (unit=unit, size=size_of_file)
      if (size_of_file > most) then
         call too_large()
      else if (size_of_file > 0) then
         content = repeat(' ', int(size_of_file))
         read (unit, iostat=status, iomsg=message) content
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

end module wavycon_deck_text
