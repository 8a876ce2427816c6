!> A binary file of heights: its first bytes, and its numbers, of single or double precision and in either byte order.
module wavycon_binary_file
   use, intrinsic :: iso_fortran_env, only: int32, int8
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: open_file
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, int64, sp
   use wavycon_measured_map, only: check_map_size, check_room, measured_map
   use wavycon_plain_text, only: escaped, integer_text, system_words
   implicit none (type, external)
   private

   public :: binary_file

   !> The largest number of bytes at the start of a file that are kept. No program writes a longer head.
   integer, parameter :: longest_head = 65536

   type :: binary_file
      character(:), allocatable :: path    !! as the user named the file
      character(:), allocatable :: head    !! the first bytes, at most 65536
      integer(int64) :: bytes = 0          !! size of the file
      integer :: number_bytes = 4          !! bytes of a number: 4 or 8
      logical :: big_end_first = .false.   !! byte order of the numbers: big-endian if true, little-endian if false
      logical :: in_slabs = .false.        !! whether each process reads only its own columns of a large map
      integer, private :: unit = -1        !! Fortran's unit of the file; -1 if the file is not open
   contains
      procedure :: open => open_binary_file
      procedure :: read_heights, refuse
      procedure, private :: check
      procedure :: close => close_binary_file
   end type binary_file

contains

   !> Opens a file and reads its head. The caller must close the file, also after an error. Errors: exit_file_trouble.
   subroutine open_binary_file(self, path, error)
      class(binary_file), intent(inout) :: self   !! not open
      character(*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      character(200) :: message
      integer :: status

      self%path = path
      call open_file(path, self%unit, error)
      if (allocated(error)) return
      inquire (unit=self%unit, size=self%bytes)
      allocate (character(int(max(0_int64, min(self%bytes, int(longest_head, int64))))) :: self%head)
      if (len(self%head) == 0) return
      read (self%unit, iostat=status, iomsg=message) self%head
      call self%check(status, message, error)
   end subroutine open_binary_file

   !> Closes the file if it is open.
   subroutine close_binary_file(self)
      class(binary_file), intent(inout) :: self

      if (self%unit /= -1) close (self%unit)
      self%unit = -1
   end subroutine close_binary_file

   !> Makes an error of a read statement that failed. Errors: exit_file_trouble.
   pure subroutine check(self, status, message, error)
      class(binary_file), intent(in) :: self
      integer, intent(in) :: status          !! iostat of the read statement
      character(*), intent(in) :: message    !! its iomsg, which is read only if status is not 0
      type(error_type), allocatable, intent(out) :: error

      if (status /= 0) call fatal_error(error, exit_file_trouble, &
                                        escaped(self%path)//': cannot be read: '//system_words(message))
   end subroutine check

   !> Reads the heights of a map, which must fill the file from `start` to its end. Missing heights are NaN. With
   !> in_slabs each process reads only its own columns of a large map, unless the file has it by columns. Errors:
   !> exit_bad_input for a map that is too small or too large, and a file of another length; exit_file_trouble if the
   !> file cannot be read or there is not enough memory.
   subroutine read_heights(self, start, points, by_columns, map, error)
      class(binary_file), intent(in) :: self   !! open
      integer(int64), intent(in) :: start      !! number of bytes before the first height
      integer, intent(in) :: points(2)         !! numbers of points along x and y
      !> The order of the file. True: the heights of one x and all y follow each other. False: those of one y and all x.
      logical, intent(in) :: by_columns
      type(measured_map), intent(inout) :: map   !! on exit with its heights
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: expected         ! number of bytes that the file must have
      integer :: k, length, lines        ! length of a line, heights that follow each other; number of lines to read
      type(grid_slab) :: slab

      call check_map_size(self%path, points, error)
      expected = start + self%number_bytes*product(int(points, int64))
      if (self%bytes /= expected .and. .not. allocated(error)) &
         call self%refuse('its head announces '//integer_text(points(1))//' x '//integer_text(points(2))// &
                          ' heights, which make a file of '//integer_text(expected)//' bytes, but it has '// &
                          integer_text(self%bytes)//': was it copied in full, as binary data?', error)
      call slab%start(points, whole=by_columns .or. .not. self%in_slabs)
      if (.not. allocated(error)) call check_room(self%path, points, error, slab)
      if (.not. allocated(error)) then
         length = merge(points(2), points(1), by_columns)
         lines = merge(points(1), slab%columns(), by_columns)
         allocate (map%height(length, lines))
         do k = 1, lines
            call read_numbers(self, start + self%number_bytes*(slab%first - 2 + k)*int(length, int64), &
                              map%height(:, k), error)
            if (allocated(error)) exit
         end do
         if (by_columns) map%height = transpose(map%height)
      end if
      call slab%share_error(error)
      if (slab%is_distributed .and. .not. allocated(error)) map%slab = slab
   end subroutine read_heights

   !> Reads numbers that follow each other. Callers must switch off traps of invalid operations, because a signalling
   !> NaN in the file is one. Errors: exit_file_trouble.
   subroutine read_numbers(self, start, numbers, error)
      type(binary_file), intent(in) :: self
      integer(int64), intent(in) :: start   !! number of bytes before the first number
      real(dp), intent(out) :: numbers(:)
      type(error_type), allocatable, intent(out) :: error

      integer(int8), allocatable :: bytes(:)   ! those of the file, then in the byte order of this machine
      character(200) :: message
      integer :: i, status

      ! The array has one dimension: gfortran reads a matrix column by column, here number by number, which is slow.
      allocate (bytes(self%number_bytes*size(numbers)))
      read (self%unit, pos=start + 1, iostat=status, iomsg=message) bytes
      call self%check(status, message, error)
      if (allocated(error)) return
      if (self%big_end_first .eqv. transfer(1_int32, 1_int8) == 1_int8) then
         do i = 1, size(bytes), self%number_bytes
            bytes(i:i + self%number_bytes - 1) = bytes(i + self%number_bytes - 1:i:-1)
         end do
      end if
      if (self%number_bytes == 4) then
         numbers = real(transfer(bytes, 0.0_sp, size(numbers)), dp)
      else
         numbers = transfer(bytes, 0.0_dp, size(numbers))
      end if
   end subroutine read_numbers

   !> Makes an error of status exit_bad_input whose message begins with the name of the file.
   pure subroutine refuse(self, words, error)
      class(binary_file), intent(in) :: self
      character(*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_bad_input, escaped(self%path)//': '//words)
   end subroutine refuse

end module wavycon_binary_file
