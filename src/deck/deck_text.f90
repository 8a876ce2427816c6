!> The text of a deck file, and the line of each of its bytes. Options of the command line that set keys of the deck
!> stand behind it, each as a line, so that problems with them have a place too.
module wavycon_deck_text
   use wavycon_error, only: error_type
   use wavycon_file_bytes, only: byte_order_mark, read_file
   use wavycon_ranks, only: is_first_rank, share_error, share_text
   implicit none (type, external)
   private

   public :: deck_text_type, read_deck_text

   !> A text and its lines. A place is the number of a byte of the text, counted from 1.
   type :: deck_text_type
      character(:), allocatable :: path        !! as the user named the file
      character(:), allocatable :: content
      integer, allocatable :: line_start(:)    !! place of the first byte of each line
      integer, private :: options = 0          !! number of the last lines that are options
   contains
      procedure :: add_option
      procedure :: is_in_option
      procedure :: option_at
      procedure :: line_of
      procedure :: line_bounds
   end type deck_text_type

   interface deck_text_type
      module procedure new_deck_text
   end interface deck_text_type

   character(*), parameter :: line_feed = achar(10), carriage_return = achar(13)

   !> Most bytes of a deck. The longest list of loads takes a tenth of this.
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

   !> Whether the byte at a place is the last of a line end: LF, CR LF or CR.
   pure logical function ends_line(content, place)
      character(*), intent(in) :: content
      integer, intent(in) :: place

      ends_line = content(place:place) == line_feed
      if (content(place:place) /= carriage_return) return
      ends_line = .true.
      if (place < len(content)) ends_line = content(place + 1:place + 1) /= line_feed
   end function ends_line

   !> Adds an option of the command line behind the text.
   pure subroutine add_option(self, words)
      class(deck_text_type), intent(inout) :: self
      character(*), intent(in) :: words   !! one line

      self%content = self%content//line_feed//words
      self%line_start = [self%line_start, len(self%content) - len(words) + 1]
      self%options = self%options + 1
   end subroutine add_option

   !> Whether a place is in an option.
   pure logical function is_in_option(self, place)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: place   !! >= 1

      is_in_option = self%line_of(place) > size(self%line_start) - self%options
   end function is_in_option

   !> The option that a place is in.
   pure function option_at(self, place) result(words)
      class(deck_text_type), intent(in) :: self
      integer, intent(in) :: place   !! >= 1
      character(:), allocatable :: words

      integer :: first, last

      call self%line_bounds(self%line_of(place), first, last)
      words = self%content(first:last)
   end function option_at

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

   !> First and last place of a line without its line end; last < first if the line is empty.
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

   !> Reads the text of a deck file. Errors: exit_file_trouble.
   subroutine read_deck_text(path, text, error)
      character(*), intent(in) :: path
      type(deck_text_type), intent(out) :: text
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: content

      if (is_first_rank()) call read_file(path, largest, content, error)
      call share_error(error)
      if (allocated(error)) return
      if (.not. allocated(content)) content = ''
      call share_text(0, content)
      text = deck_text_type(path, content)
   end subroutine read_deck_text

end module wavycon_deck_text
