!> Reads height maps in Gwyddion's simple field format, .gsf: https://gwyddion.net/documentation/user-guide-en/gsf.html.
module wavycon_gsf_map
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_binary_file, only: binary_file
   use wavycon_error, only: error_type
   use wavycon_file_head, only: entry_of, read_positive
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: laid_along_x
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

      character(*), parameter :: keys(*) = [character(5) :: 'XRes', 'YRes', 'XReal', 'YReal']
      character(:), allocatable :: entry, words
      real(dp) :: numbers(size(keys))   ! 0 if they are not there
      integer :: i, last, points(2)
      logical :: is_number

      if (.not. is_gsf(file%head)) then
         call file%refuse("this is no .gsf file: it does not begin with '"//magic//"0'", error)
         return
      end if
      last = index(file%head, char(0)) - 1
      if (last < 0) then
         call file%refuse('the head of this .gsf file has no end, which is a null character', error)
         return
      end if
      words = file%head(:last)
      numbers = 0.0_dp
      do i = 1, size(keys)
         entry = entry_of(words, trim(keys(i)), '=')
         if (entry == '') cycle
         call read_positive(entry, numbers(i), is_number)
         if (is_number) cycle
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
      map%step = merge(1.0_dp, numbers(3:), map%is_usual_side)/points
      if (points(1) == 1) then
         map%is_usual_side = map%is_usual_side(2:1:-1)
         map%step = map%step(2:1:-1)
      end if
      file%number_bytes = 4
      file%big_end_first = .false.
      call file%read_heights(int(last + alignment - modulo(last, alignment), int64), laid_along_x(points), .false., &
                             map, error)
   end subroutine read_gsf_map

end module wavycon_gsf_map
