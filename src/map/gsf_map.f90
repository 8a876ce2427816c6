!> Reads height maps in Gwyddion's simple field format, .gsf: https://gwyddion.net/documentation/user-guide-en/gsf.html.
module wavycon_gsf_map
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_binary_file, only: binary_file
   use wavycon_error, only: error_type
   use wavycon_file_head, only: entry_of, read_positive
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: excerpt
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
         call map%set_units(entry_of(words, 'XYUnits', '='), entry_of(words, 'ZUnits', '='))
      end associate
      if (nint(points(1)) == 1) then
         points = points(2:1:-1)
         sides = sides(2:1:-1)
      end if
      ! The format's default of a side is 1.
      map%is_usual_side = sides <= 0.0_dp
      map%step = merge(1.0_dp, sides, map%is_usual_side)/points
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
      logical :: is_number

      number = 0.0_dp
      entry = entry_of(words, key, '=')
      if (entry == '') return
      call read_positive(entry, number, is_number)
      if (.not. is_number) call file%refuse("in the head of this .gsf file "//key//" = '"//excerpt(entry)// &
                                            "' is no positive number", error)
   end subroutine read_number

end module wavycon_gsf_map
