!> Reads height maps in Gwyddion's simple field format, .gsf,
!> https://gwyddion.net/documentation/user-guide-en/gsf.html, and the heads of texts that Gwyddion exports and of ESRI's
!> ASCII grids, https://desktop.arcgis.com/en/arcmap/latest/manage-data/raster-and-images/esri-ascii-raster-format.htm.
!> Each line of these heads has a key and the key's entry.
module wavycon_gwyddion_map
   use wavycon_binary_file, only: binary_file
   use wavycon_decimal_number, only: read_decimal
   use wavycon_error, only: error_type
   use wavycon_file_bytes, only: byte_order_mark
   use wavycon_kinds, only: dp, int64, largest_number, smallest_number
   use wavycon_length_unit, only: find_factor
   use wavycon_measured_map, only: laid_along_x, measured_map
   use wavycon_plain_text, only: excerpt, integer_text, lower_case, newline, replaced, short_number
   use wavycon_units, only: angstrom, micro_sign
   implicit none (type, external)
   private

   public :: entry_of, in_english, read_gsf_map, take_esri_head, take_text_head

   !> First bytes of a .gsf file.
   character(*), parameter, public :: gsf_magic = 'Gwyddion Simple Field 1.'
   !> In a .gsf file the head is followed by one to four null characters, so that the numbers begin at a multiple of
   !> this number of bytes.
   integer, parameter :: alignment = 4
   !> Characters that may stand around keys and entries.
   character(*), parameter, public :: blanks = ' '//achar(9)
   character(*), parameter :: line_ends = newline//achar(13)

contains

   !> Reads a map in the .gsf format. The first row of the file is the first row of the map, as in the other formats. So
   !> y rises from the top of Gwyddion's picture downwards, as in Gwyddion. Errors: exit_bad_input, exit_file_trouble.
   subroutine read_gsf_map(file, map, error)
      class(binary_file), intent(in) :: file
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: keys(*) = [character(5) :: 'XRes', 'YRes', 'XReal', 'YReal']
      character(:), allocatable :: entry, words
      real(dp) :: numbers(size(keys))   ! entries of the keys; 0 if a key is not there
      integer :: i, last, points(2)

      if (index(file%head, gsf_magic) /= 1) then
         call file%refuse("this is no .gsf file: it does not begin with '"//gsf_magic//"0'", error)
         return
      end if
      last = index(file%head, char(0)) - 1
      if (last < 0) call file%refuse('the head of this .gsf file has no end, which is a null character', error)
      if (allocated(error)) return
      words = file%head(:last)
      do i = 1, size(keys)
         entry = entry_of(words, trim(keys(i)), '=')
         numbers(i) = positive_number(entry)
         if (entry == '' .or. numbers(i) > 0.0_dp) cycle
         call file%refuse('in the head of this .gsf file '//trim(keys(i))//" = '"//excerpt(entry)// &
                          "' is no positive number", error)
         return
      end do
      if (any(numbers(:2) < 1) .or. any(numbers(:2) > huge(0)) .or. any(abs(numbers(:2) - anint(numbers(:2))) > 0)) then
         call file%refuse('the head of this .gsf file must give XRes and YRes, the numbers of points', error)
         return
      end if
      call map%set_units(entry_of(words, 'XYUnits', '='), entry_of(words, 'ZUnits', '='))
      points = nint(numbers(:2))
      ! The format's default of a side is 1.
      map%is_usual_side = numbers(3:) <= 0.0_dp
      where (map%is_usual_side) numbers(3:) = 1.0_dp
      map%step = numbers(3:)/points
      if (points(1) == 1) then
         map%is_usual_side = map%is_usual_side(2:1:-1)
         map%step = map%step(2:1:-1)
      end if
      call file%read_heights(int(last + alignment - modulo(last, alignment), int64), laid_along_x(points), .false., &
                             map, error)
   end subroutine read_gsf_map

   !> Takes the sides of a map and the units from the comments of a text. Gwyddion writes these comments when it exports
   !> a matrix,
   !>
   !>     # Width: 10.00 µm
   !>     # Height: 10.00 µm
   !>     # Value units: m
   !>
   !> or points, with `# Lateral units: m` in place of the first two lines. Numbers may have a decimal comma. Width and
   !> height are ignored if they have no unit, because they may then be numbers of points, and if one of them is
   !> missing. Errors: exit_bad_input if the units of the two sides cannot be converted into each other.
   subroutine take_text_head(file, map, error)
      class(binary_file), intent(in) :: file
      type(measured_map), intent(inout) :: map   !! its heights are set; its steps are kept if they are known already
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: head, height_unit, unit, unit_y
      real(dp) :: factor, sides(2)
      logical :: is_known

      head = in_english(file%head)
      call read_length(entry_of(head, 'Width', ':'), sides(1), unit)
      call read_length(entry_of(head, 'Height', ':'), sides(2), unit_y)
      if (any(map%step > 0.0_dp) .or. any(sides <= 0.0_dp)) then
         unit = entry_of(head, 'Lateral units', ':')
      else
         call find_factor(unit_y, unit, factor, is_known)
         if (.not. is_known) call file%refuse("its head gives the width in '"//excerpt(unit)// &
                                              "' and the height in '"//excerpt(unit_y)//"': they must be lengths", &
                                              error)
         map%step = sides*[1.0_dp, factor]/shape(map%height)
      end if
      height_unit = entry_of(head, 'Value units', ':')
      call map%set_units(unit, height_unit)
   end subroutine take_text_head

   !> The lines of a head, the first one empty. Gwyddion writes the names of its lines in the user's language. They
   !> become English if the comments before a matrix are its four lines, of which the channel may be missing, two of
   !> them lengths.
   function in_english(head) result(words)
      character(*), intent(in) :: head
      character(:), allocatable :: words

      character(*), parameter :: names(*) = [character(11) :: 'Channel', 'Width', 'Height', 'Value units']
      character(:), allocatable :: unit
      integer :: colon, first, k, last, missing
      logical :: are_lengths, is_known
      real(dp) :: factor, length

      do missing = 0, 1
         words = ''
         first = 1
         do k = 1 + missing, size(names)
            last = first + scan(head(first:)//newline, line_ends) - 2
            colon = index(head(first:last), ':')
            if (verify(head(first:last), blanks//byte_order_mark) /= index(head(first:last), '#') .or. colon == 0) exit
            words = words//newline//trim(names(k))//head(first + colon - 1:last)
            first = last + 2
            if (head(last + 1:min(last + 2, len(head))) == achar(13)//newline) first = last + 3
         end do
         are_lengths = k > size(names)
         do k = 2, 3
            call read_length(entry_of(words, trim(names(k)), ':'), length, unit)
            call find_factor(unit, 'm', factor, is_known)
            are_lengths = are_lengths .and. is_known
         end do
         if (are_lengths) return
      end do
      words = newline//head
   end function in_english

   !> Takes steps and missing heights from the head of an ESRI ASCII grid; does nothing if the file is not such a grid.
   !> The first row of the file has the largest y. The rows are reversed, so that y of the map rises. Errors:
   !> exit_bad_input if the number of heights is not that of the head.
   subroutine take_esri_head(file, map, error)
      class(binary_file), intent(in) :: file
      !> On entry the heights in the order of the file, in rows of any length. On exit the map of the head's size.
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: keys(*) = [character(8) :: 'ncols', 'nrows', 'dx', 'dy', 'cellsize']
      !> The height that stands for a missing one if the head does not name such a height.
      real(dp), parameter :: usual_no_data = -9999.0_dp
      character(:), allocatable :: head
      integer :: i
      logical :: is_number
      real(dp) :: numbers(size(keys))   ! entries of the keys; 0 if a key is not there

      head = newline//lower_case(file%head)
      numbers = [(positive_number(entry_of(head, trim(keys(i)), blanks)), i=1, size(keys))]
      if (any(numbers(:2) <= 0)) return
      if (abs(product(anint(numbers(:2))) - size(map%height)) > 0.0_dp) then
         call file%refuse('its head announces '//short_number(numbers(1))//' x '//short_number(numbers(2))// &
                          ' heights, but it has '//integer_text(size(map%height)), error)
         return
      end if
      map%height = reshape(map%height, nint(numbers(:2)))
      map%height = map%height(:, size(map%height, 2):1:-1)
      map%step = numbers(3:4)
      if (numbers(5) > 0) map%step = numbers(5)
      map%head_lines = 0
      allocate (map%no_data)
      call read_decimal(entry_of(head, 'nodata_value', blanks), map%no_data, is_number)
      if (.not. is_number) map%no_data = usual_no_data
   end subroutine take_esri_head

   !> Reads a length and its unit, such as '10.00 µm'.
   subroutine read_length(entry, length, unit)
      character(*), intent(in) :: entry
      real(dp), intent(out) :: length                   !! 0 if the entry is not a length
      character(:), allocatable, intent(out) :: unit    !! empty if the entry is not a length or has no unit

      integer :: last

      length = 0.0_dp
      unit = ''
      last = verify(entry, '+-.,0123456789eE') - 1
      if (last < 1) return
      length = positive_number(replaced(entry(:last), ',', '.'))
      if (length > 0.0_dp) unit = trim(adjustl(entry(last + 1:)))
   end subroutine read_length

   !> The positive number that a word is, or 0 if the word is not a positive number in the range of lengths. Callers
   !> must switch off traps of overflow.
   real(dp) function positive_number(word) result(number)
      character(*), intent(in) :: word

      logical :: is_number

      call read_decimal(word, number, is_number)
      if (.not. is_number .or. number < smallest_number .or. number > largest_number) number = 0.0_dp
   end function positive_number

   !> The entry of a key in the lines of a head, without the blanks around the entry; empty if the key is not there. The
   !> first line is skipped. Lines may begin with '#', the mark of a comment. Units µm and Å at the end of the entry
   !> are converted from Latin-1 to UTF-8.
   pure function entry_of(words, key, separator) result(entry)
      character(*), intent(in) :: words       !! the lines of the head
      character(*), intent(in) :: key
      character(*), intent(in) :: separator   !! the characters of which one stands between key and entry
      character(:), allocatable :: entry

      integer :: first, last, middle

      entry = ''
      last = scan(words, line_ends)
      do while (last > 0 .and. last < len(words))
         first = last + 1
         ! `last` is the line's end: of the last line the place behind its last character.
         last = scan(words(first:), line_ends)
         if (last == 0) last = len(words) - first + 2
         last = last + first - 1
         associate (line => words(first:last - 1))
            middle = scan(line, separator)
            if (middle == 0) cycle
            if (between(line(:middle - 1), blanks//'#'//byte_order_mark) /= key) cycle
            entry = between(line(middle + 1:), blanks)
            exit
         end associate
      end do
      first = index(entry, char(181)//'m')
      if (first > 0 .and. index(entry, char(194)) == 0) entry = entry(:first - 1)//micro_sign//entry(first + 2:)
      first = index(entry, char(197), back=.true.)
      if (first > 0 .and. first == len(entry)) entry = entry(:first - 1)//angstrom

   contains

      !> The text without the leading and the trailing characters that are in a set.
      pure function between(text, left_out) result(inner)
         character(*), intent(in) :: text, left_out
         character(:), allocatable :: inner

         inner = text(max(1, verify(text, left_out)):verify(text, left_out, back=.true.))
      end function between

   end function entry_of

end module wavycon_gwyddion_map
