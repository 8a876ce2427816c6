!> Reads the numbers of one line of a text.
!>
!> Numbers are separated by blanks, tabs, commas or semicolons, and may stand in quotes. Their forms are those that
!> `read_decimal` reads. Words such as `nan` and `--` stand for missing numbers. A number is also missing where two
!> commas, semicolons or tabs follow each other.
module wavycon_number_line
   use wavycon_decimal_number, only: read_decimal
   use wavycon_kinds, only: dp, largest_number, not_a_number
   use wavycon_plain_text, only: decimal_digits, excerpt, lower_case, short_number
   implicit none (type, external)
   private

   public :: is_missing, read_line

   character(*), parameter :: tab = achar(9)
   !> The characters that may stand between numbers.
   character(*), parameter, public :: gaps = ' ,;"'//tab

contains

   !> Reads the numbers of a line. Callers must switch off traps of overflow.
   !>
   !> A decimal comma would make two numbers of one. It is suspected, and refused, where one comma stands without blanks
   !> between two numbers of a line that separates other numbers in another way, or before digits that begin with 0, as
   !> fractions do.
   subroutine read_line(line, values, used, ends_open, trouble)
      character(*), intent(in) :: line         !! without comment and line end
      real(dp), intent(inout) :: values(:)     !! numbers, NaN if missing; its size must exceed the bytes of the line
      integer, intent(out) :: used             !! how many values are set
      logical, intent(out) :: ends_open        !! whether the line ends in a separator: a last number may be missing
      character(:), allocatable, intent(out) :: trouble   !! message of a problem; not allocated if there is none

      integer :: behind           !! position behind the last byte of the previous number; 1 at the start of the line
      integer :: commas, first, holes, last, separators   !! see next_word; holes: missing numbers between separators
      integer :: tight            !! position behind a comma that directly joins two numbers; 0 if there is none
      logical :: are_tabs, is_quoted
      logical :: is_loose         !! whether some numbers of the line are separated without a comma

      ends_open = .false.
      used = 0
      behind = 1
      tight = 0
      is_loose = .false.
      is_quoted = .false.
      do
         call next_word(line, behind, first, last, commas, separators, are_tabs, is_quoted)
         if (first > len(line)) exit
         holes = max(0, separators - 1)
         if (behind == 1) then
            holes = separators
            ! A line with blanks between its numbers may be indented by tabs.
            if (are_tabs .and. index(adjustl(line(last + 1:)), tab) /= 1) holes = 0
         else
            if (commas == 1 .and. first - behind == 1) tight = first
            is_loose = is_loose .or. commas == 0
            if (tight == first .and. last > first) &
               is_loose = is_loose .or. (line(first:first) == '0' .and. verify(line(first:last), decimal_digits) == 0)
            if (tight > 0 .and. is_loose) then
               first = scan(line(:tight - 2), gaps, back=.true.) + 1
               last = scan(line(tight:)//' ', gaps) + tight - 2
               trouble = "is '"//excerpt(line(first:last))// &
                         "' a number with a decimal comma? Write a point, or separate all numbers of a line by "// &
                         'commas alone, without zeros before their digits'
               return
            end if
         end if
         values(used + 1:used + holes) = not_a_number()
         used = used + holes + 1
         call read_number(line(first:last), values(used), trouble)
         if (allocated(trouble)) return
         behind = last + 1
      end do
      if (behind == 1) then
         ! A spreadsheet or an editor may leave one separator on an empty line. More of them stand for missing numbers.
         if (separators > 1) trouble = 'this line has separators and no numbers: write nan for the numbers that '// &
                                       'are missing, or take the line out'
         return
      end if
      ends_open = separators > 0
      holes = max(0, separators - 1)
      values(used + 1:used + holes) = not_a_number()
      used = used + holes
   end subroutine read_line

   !> Finds the next word of a line, and counts the separators before it. Everything between two quotes is one word.
   pure subroutine next_word(line, start, first, last, commas, separators, are_tabs, is_quoted)
      character(*), intent(in) :: line
      integer, intent(in) :: start          !! position from which the word is searched
      integer, intent(out) :: first, last   !! positions of the word's first and last byte; first > len(line) if none
      integer, intent(out) :: commas        !! number of commas before the word
      integer, intent(out) :: separators    !! number of commas and semicolons before the word; without these of tabs
      logical, intent(out) :: are_tabs      !! whether the separators are tabs
      logical, intent(inout) :: is_quoted   !! whether a quote is open: on entry at `start`, on exit at the word

      character(1) :: byte
      integer :: tabs

      commas = 0
      separators = 0
      tabs = 0
      do first = start, len(line)
         byte = line(first:first)
         if (is_quoted .and. byte /= '"' .and. byte /= ' ') exit
         select case (byte)
         case (' ')
         case ('"')
            is_quoted = .not. is_quoted
         case (tab)
            tabs = tabs + 1
         case (',')
            commas = commas + 1
            separators = separators + 1
         case (';')
            separators = separators + 1
         case default
            exit
         end select
      end do
      are_tabs = separators == 0 .and. tabs > 0
      if (are_tabs) separators = tabs
      do last = first, len(line)
         byte = line(last:last)
         if (byte >= '0' .and. byte <= '9') cycle
         if (byte == '"' .or. (is_gap(byte) .and. .not. is_quoted)) exit
      end do
      last = last - 1
      if (is_quoted) last = first - 1 + len_trim(line(first:last))
   end subroutine next_word

   !> Reads a word as a number.
   subroutine read_number(word, value, trouble)
      character(*), intent(in) :: word
      real(dp), intent(out) :: value                       !! NaN if the word stands for a missing number
      character(:), allocatable, intent(out) :: trouble    !! message if the word is not a number; else not allocated

      logical :: is_number

      call read_decimal(word, value, is_number)
      if (is_number .and. abs(value) <= largest_number) return
      if (is_number) then
         trouble = "'"//excerpt(word)//"' is too large: numbers may be up to "//short_number(largest_number)// &
                   ' in size; a number that stands for a missing height must be nan'
         return
      end if
      if (is_missing(word)) then
         value = not_a_number()
         return
      end if
      ! `scan` is 1 if the word has a sign, otherwise 0.
      select case (lower_case(word(1 + scan(word(1:1), '+-'):)))
      case ('inf', 'infinity')
         trouble = "'"//excerpt(word)//"' is not a height: write nan if it is missing"
      case default
         trouble = "'"//excerpt(word)//"' is no number: put # before a line that is a remark, and write nan for a "// &
                   'number that is missing'
         ! Commas stand within words in quotes alone.
         if (index(word, ',') > 0) &
            trouble = "is '"//excerpt(word)//"' a number with a decimal comma? Write a point, or separate the "// &
                      'numbers of a line by semicolons and leave out the quotes'
      end select
   end subroutine read_number

   !> Whether a word stands for a missing number: a form in which programs write NaN, or an error of a spreadsheet.
   !> Older C libraries of Windows write 1.#QNAN and -1.#IND, and 1.#R if few digits are asked for.
   pure logical function is_missing(word)
      character(*), intent(in) :: word   !! not empty

      character(*), parameter :: words(*) = [character(9) :: 'nan', 'nan(ind)', 'nan(snan)', 'na', 'n/a', '#n/a', &
                                             '#num!', '#value!', '#div/0!', '#ref!']
      character(:), allocatable :: unsigned

      unsigned = lower_case(word(1 + scan(word(1:1), '+-'):))
      is_missing = any(unsigned == words) .or. index(unsigned, '1.#') == 1 .or. word == '--'
   end function is_missing

   !> Whether a byte separates numbers, as those of `gaps` do.
   elemental logical function is_gap(byte)
      character(1), intent(in) :: byte

      ! The blank is compared by its code: gfortran 12 compares characters with a blank by a call of its library.
      is_gap = iachar(byte) == iachar(' ') .or. byte == tab .or. byte == ',' .or. byte == ';' .or. byte == '"'
   end function is_gap

end module wavycon_number_line
