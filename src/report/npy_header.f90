!> The header of numpy's file format, version 1.0, for arrays of double precision numbers or of records of them.
!>
!> The format is defined in numpy's documentation, numpy.lib.format. The header has the same length for all maps of a
!> kind, so that readers that do not know the format skip it.
module wavycon_npy_header
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_plain_text, only: integer_text, newline
   implicit none (type, external)
   private

   public :: npy_header

   !> The header is a multiple of so many bytes. Readers that do not know the format skip it.
   integer, parameter, public :: npy_header_step = 256

contains

   !> The bytes before the elements. These follow with the last index changing fastest.
   pure function npy_header(elements, names) result(header)
      integer, intent(in) :: elements(:)     !! their number along each index
      !> Names of the numbers of a record, short enough for the header; absent: the elements are numbers.
      character(*), intent(in), optional :: names(:)
      character(:), allocatable :: header

      !> Followed by two bytes for the length of the rest, the lower one first.
      character(*), parameter :: magic = char(147)//'NUMPY'//char(1)//char(0)
      integer, parameter :: before_words = len(magic) + 2
      character(:), allocatable :: number, words
      integer :: i, length

      number = "'"//byte_order()//"f8'"
      words = number
      if (present(names)) then
         words = '['
         do i = 1, size(names)
            words = words//"('"//trim(names(i))//"', "//number//'), '
         end do
         words = words//']'
      end if
      words = "{'descr': "//words//", 'fortran_order': False, 'shape': ("
      do i = 1, size(elements)
         words = words//integer_text(elements(i))//', '
      end do
      words = words//'), }'
      length = npy_header_step*((before_words + len(words) + npy_header_step)/npy_header_step)
      header = magic//char(modulo(length - before_words, 256))//char((length - before_words)/256)//words
      header = header//repeat(' ', length - len(header) - 1)//newline
   end function npy_header

   !> '<' where the lowest byte of a number is the first, '>' elsewhere.
   pure character function byte_order()
      byte_order = merge('<', '>', transfer(1, 1_int8) == 1_int8)
   end function byte_order

end module wavycon_npy_header
