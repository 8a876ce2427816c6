!> Reads height maps in numpy's format .npy: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html.
module wavycon_npy_map
   use wavycon_binary_file, only: binary_file
   use wavycon_error, only: error_type
   use wavycon_kinds, only: int64
   use wavycon_measured_map, only: laid_along_x, measured_map
   use wavycon_plain_text, only: excerpt, replaced
   implicit none (type, external)
   private

   public :: read_npy_map

   !> First bytes of an .npy file.
   character(*), parameter, public :: npy_magic = char(147)//'NUMPY'
   !> The head of an .npy file: the magic bytes, two bytes of the version, the length of the words, and the words. These
   !> are the numbers of bytes before the version and before the length. The length has two bytes in version 1, later
   !> four.
   integer, parameter :: before_version = len(npy_magic), before_length = before_version + 2

contains

   !> Reads a map in the .npy format. The array is heights[j, i], i the number of the point along x and j that along y,
   !> or a profile heights[i]. Errors: exit_bad_input, exit_file_trouble.
   subroutine read_npy_map(file, map, error)
      class(binary_file), intent(inout) :: file
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: order, shape_words, type_words
      integer :: first, last, number, points(2), sides(3)

      if (index(file%head, npy_magic) /= 1) then
         call file%refuse('this is no .npy file: it does not begin with \x93NUMPY', error)
         return
      end if
      call find_words(file%head, first, last)
      if (last < first) then
         call file%refuse('the head of this .npy file is cut off, longer than 65000 bytes, or of a version above 3'// &
                          ': write it by numpy.save', error)
         return
      end if
      type_words = entry_of(file%head(first:last), 'descr')
      order = entry_of(file%head(first:last), 'fortran_order')
      shape_words = entry_of(file%head(first:last), 'shape')
      select case (type_words)
      case ("'<f4'", "'>f4'", "'<f8'", "'>f8'")
         file%big_end_first = type_words(2:2) == '>'
         file%number_bytes = 8
         if (type_words(4:4) == '4') file%number_bytes = 4
      case ('')
         call file%refuse("the head of this .npy file does not give 'descr', the type of its numbers: write it by "// &
                          'numpy.save', error)
         return
      case default
         call file%refuse('numbers of type '//excerpt(type_words)//': heights must be float64 or float32; write '// &
                          'them by numpy.save(file, heights.astype(float))', error)
         return
      end select
      call read_shape(shape_words, sides, number)
      if (number < 1 .or. number > 2 .or. (order /= 'True' .and. order /= 'False')) then
         call file%refuse('an array of shape '//excerpt(shape_words)//", 'fortran_order' "//excerpt(order)// &
                          ': a map is heights[j, i] at x number i and y number j, a profile heights[i]', error)
         return
      end if
      ! The last index of the array is the one along x.
      points = laid_along_x([sides(2), sides(1)])
      if (number == 1) points = [sides(1), 1]
      call file%read_heights(int(last, int64), points, points(2) > 1 .and. order == 'True', map, error)
   end subroutine read_npy_map

   !> Finds the words of a head, which are a Python dictionary.
   pure subroutine find_words(head, first, last)
      character(*), intent(in) :: head        !! first bytes of the file, longer than the magic bytes
      integer, intent(out) :: first, last     !! positions of the first and the last byte; last < first if none

      integer :: bytes, i, version
      integer(int64) :: length

      first = 1
      last = 0
      if (len(head) < before_length + 4) return
      version = iachar(head(before_version + 1:before_version + 1))
      if (version < 1 .or. version > 3) return
      bytes = 4
      if (version == 1) bytes = 2
      length = sum([(iachar(head(before_length + i:before_length + i))*256_int64**(i - 1), i=1, bytes)])
      if (length > len(head) - before_length - bytes) return
      first = before_length + bytes + 1
      last = before_length + bytes + int(length)
   end subroutine find_words

   !> The entry of a key in a Python dictionary, without the blanks around the entry; empty if the key is not there.
   pure function entry_of(words, key) result(entry)
      character(*), intent(in) :: words   !! such as {'descr': '<f8', 'shape': (3, 4), }
      character(*), intent(in) :: key
      character(:), allocatable :: entry

      integer :: first

      ! Python may write double quotes, and Python 2 writes an L behind some numbers.
      entry = replaced(replaced(words, '"', "'"), 'L', ' ')
      first = index(entry, "'"//key//"'")
      entry = adjustl(entry(first + len(key) + 2:))
      if (first == 0 .or. index(entry, ':') /= 1) entry = ' '
      entry = adjustl(entry(2:))
      select case (entry(1:min(1, len(entry))))
      case ('(')
         entry = entry(:index(entry, ')'))
      case ('[')
         entry = entry(:index(entry, ']'))
      case default
         entry = trim(entry(:scan(entry//',', ',}') - 1))
      end select
   end function entry_of

   !> Reads a Python tuple of whole numbers, such as (3, 4).
   pure subroutine read_shape(words, sides, number)
      character(*), intent(in) :: words
      integer, intent(out) :: sides(3)   !! the first three numbers of the tuple, -1 where it has fewer
      integer, intent(out) :: number     !! how many numbers the tuple has, at most 3; 0 if this is not such a tuple

      character(:), allocatable :: inner
      integer :: status

      number = 0
      sides = -1
      if (len(words) < 2) return
      if (words(1:1) /= '(' .or. verify(words(2:len(words) - 1), '0123456789, ') > 0) return
      ! The slash ends list-directed reading, so that fewer than three numbers are no error.
      inner = words(2:len(words) - 1)//' /'
      read (inner, *, iostat=status) sides
      if (status == 0) number = count(sides >= 0)
   end subroutine read_shape

end module wavycon_npy_map
