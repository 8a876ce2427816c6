!> The header of numpy's file format, version 1.0, for arrays of records of double precision numbers.
!>
!> The format is defined in numpy's documentation, numpy.lib.format. The header always has the same length, so that
!> readers that do not know the format skip it.
module wavycon_npy_header
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_plain_text, only: integer_text, newline
   implicit none (type, external)
   private

   public :: npy_header

   !> Bytes of the header, a multiple of 64.
   integer, parameter, public :: npy_header_length = 256

contains

   !> The bytes before the records. These follow with the last index changing fastest.
   pure function npy_header(names, numbers) result(header)
      character(*), intent(in) :: names(:)   !! of the fields of a record; short enough for the header
      integer, intent(in) :: numbers(:)      !! of records along each index
      character(npy_header_length) :: header

      !> Two bytes for the version and two for the length of the rest, below 256, the lower one first.
      character(*), parameter :: magic = char(147)//'NUMPY'//char(1)//char(0)//char(npy_header_length - 10)//char(0)
      character(:), allocatable :: words
      integer :: i

      words = "{'descr': ["
      do i = 1, size(names)
         words = words//"('"//trim(names(i))//"', '"//byte_order()//"f8'), "
      end do
      words = words//"], 'fortran_order': False, 'shape': ("
      do i = 1, size(numbers)
         words = words//integer_text(numbers(i))//', '
      end do
      header = magic//words//'), }'
      header(npy_header_length:) = newline
   end function npy_header

   !> '<' where the lowest byte of a number is the first, '>' elsewhere.
   pure character function byte_order()
      byte_order = merge('<', '>', transfer(1, 1_int8) == 1_int8)
   end function byte_order

end module wavycon_npy_header
