!> Reads height maps in Gwyddion's simple field format, .gsf: https://gwyddion.net/documentation/user-guide-en/gsf.html.
module wavycon_gsf_map
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_overflow, ieee_set_halting_mode, &
      ieee_set_status, ieee_status_type
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_binary_file, only: binary_file
   use wavycon_decimal_number, only: read_decimal
   use wavycon_error, only: error_type
   use wavycon_key_table, only: largest_number, smallest_number
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: excerpt, newline
   implicit none (type, external)
   private

   public :: is_gsf, read_gsf_map

   character(*), parameter :: magic = 'Gwyddion Simple Field 1.'
   !> The numbers begin at a multiple of so many bytes, behind one to so many null characters.
   integer, parameter :: alignment = 4

contains

   !> Whether a file begins as a .gsf file.
   pure logical function is_gsf(head)
      character(*), intent(in) :: head   !! the first bytes of the file

      is_gsf = index(head, magic) == 1
   end function is_gsf

   !> Reads a map. The first row of the file is the first row of the map, as in the other formats: y counts from the top
   !> of Gwyddion's picture downwards, as it does in Gwyddion. Errors: exit_bad_input, exit_file_trouble.
   subroutine read_gsf_map(file, map, error)
      class(binary_file), intent(inout) :: file
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: height_unit, unit
      real(dp) :: points(2), sides(2)
      integer :: last

      if (.not. is_gsf(file%head)) then
         call file%refuse("this is no .gsf file: it does not begin with '"//magic//"0'", error)
         return
      end if
      last = index(file%head, char(0)) - 1
      if (last < 0) then
         call file%refuse('the head of this .gsf file has no end, which is a null character', error)
         return
      end if
      associate (words => file%head(:last))
         call read_number(file, words, 'XRes', points(1), error)
         if (.not. allocated(error)) call read_number(file, words, 'YRes', points(2), error)
         if (allocated(error)) return
         if (any(points <= 0.0_dp) .or. any(points > huge(0)) .or. any(abs(points - anint(points)) > 0.0_dp)) then
            call file%refuse('the head of this .gsf file must give XRes and YRes, the numbers of points', error)
            return
         end if
         call read_number(file, words, 'XReal', sides(1), error)
         if (.not. allocated(error)) call read_number(file, words, 'YReal', sides(2), error)
         if (allocated(error)) return
         unit = entry_of(words, 'XYUnits')
         height_unit = entry_of(words, 'ZUnits')
      end associate
      ! One side alone: the format's default of the other is 1. Without both the deck gives them.
      if (any(sides > 0.0_dp)) map%step = merge(sides, 1.0_dp, sides > 0.0_dp)/points
      if (unit == '') unit = height_unit
      if (height_unit == '') height_unit = unit
      if (unit /= '') then
         map%length_unit = unit
         map%height_unit = height_unit
      end if
      file%number_bytes = 4
      file%big_end_first = .false.
      call file%read_heights(int(last + alignment - modulo(last, alignment), int64), nint(points), .false., map, error)
   end subroutine read_gsf_map

   !> Reads a number of the head; 0 if it is not there. Errors: exit_bad_input for a word that is no number, and for a
   !> number that is negative or out of the range of lengths.
   subroutine read_number(file, words, key, number, error)
      class(binary_file), intent(in) :: file
      character(*), intent(in) :: words, key
      real(dp), intent(out) :: number
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: entry
      type(ieee_status_type) :: floating_point
      logical :: is_number

      number = 0.0_dp
      entry = entry_of(words, key)
      if (entry == '') return
      ! 1e999 must be reported as bad input in builds that trap overflow too.
      call ieee_get_status(floating_point)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      call read_decimal(entry, number, is_number)
      call ieee_set_status(floating_point)
      if (is_number) is_number = number >= smallest_number .and. number <= largest_number
      if (.not. is_number) call file%refuse("in the head of this .gsf file "//key//" = '"//excerpt(entry)// &
                                            "' is no positive number", error)
   end subroutine read_number

   !> The entry of a key in lines of 'key = entry', without the blanks around it; empty if it is not there.
   pure function entry_of(words, key) result(entry)
      character(*), intent(in) :: words, key
      character(:), allocatable :: entry

      character(*), parameter :: blanks = ' '//achar(9)//achar(13)
      integer :: equals, first, last

      entry = ''
      last = index(words, newline)
      do while (last > 0 .and. last < len(words))
         first = last + 1
         last = index(words(first:), newline)
         if (last > 0) last = last + first - 1
         associate (line => words(first:merge(last - 1, len(words), last > 0)))
            equals = index(line, '=')
            if (equals == 0) cycle
            if (without_blanks(line(:equals - 1)) /= key) cycle
            entry = without_blanks(line(equals + 1:))
            return
         end associate
      end do

   contains

      pure function without_blanks(text) result(inner)
         character(*), intent(in) :: text
         character(:), allocatable :: inner

         inner = text(max(1, verify(text, blanks)):verify(text, blanks, back=.true.))
      end function without_blanks

   end function entry_of

end module wavycon_gsf_map
