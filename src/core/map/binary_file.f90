!> A binary file: its first bytes, and its numbers of single or double precision in either byte order.
module wavycon_binary_file
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: open_file
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_measured_map, only: check_map_size, check_room, measured_map
   use wavycon_plain_text, only: escaped, integer_text, system_words
   implicit none (type, external)
   private

   public :: binary_file

   !> Bytes at the start of a file that are kept: more than any head that programs write.
   integer, parameter :: longest_head = 65536

   type :: binary_file
      character(:), allocatable :: path    !! as the user named the file
      character(:), allocatable :: head    !! the first bytes, at most 65536
      integer(int64) :: bytes = 0          !! size of the file
      integer :: number_bytes = 4          !! of a number: 4 or 8
      logical :: big_end_first = .false.   !! the byte order of the numbers
      logical :: in_slabs = .false.        !! whether a large map is read in slabs
      integer, private :: unit = -1        !! -1: it is not open
   contains
      procedure :: open => open_binary_file
      procedure :: read_heights
      procedure :: refuse
      procedure, private :: check
      procedure :: close => close_binary_file
   end type binary_file

contains

   !> Opens a file, to be closed by the caller, and reads its head. Errors: exit_file_trouble.
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

   !> Closes the file, if it is open.
   subroutine close_binary_file(self)
      class(binary_file), intent(inout) :: self

      if (self%unit /= -1) close (self%unit)
      self%unit = -1
   end subroutine close_binary_file

   !> Reports a read statement that failed. Errors: exit_file_trouble.
   pure subroutine check(self, status, message, error)
      class(binary_file), intent(in) :: self
      integer, intent(in) :: status          !! iostat
      character(*), intent(in) :: message    !! iomsg, if status is not 0
      type(error_type), allocatable, intent(out) :: error

      if (status /= 0) call fatal_error(error, exit_file_trouble, &
                                        escaped(self%path)//': cannot be read: '//system_words(message))
   end subroutine check

   !> Reads the heights of a map: from `start` to the end of the file there must be nothing else. Missing heights are
   !> NaN. With in_slabs only the own columns of a large map are read. Errors: exit_bad_input for a map that is too
   !> small or too large, a file of another length, and infinite heights; exit_file_trouble.
   subroutine read_heights(self, start, points, by_columns, map, error)
      class(binary_file), intent(in) :: self
      integer(int64), intent(in) :: start   !! bytes before the first height
      integer, intent(in) :: points(2)      !! along x and y
      logical, intent(in) :: by_columns     !! whether heights of one x and all y follow each other
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      real(dp), allocatable :: line(:)   ! heights of one x or one y
      integer(int64) :: before           ! heights of the file before these
      integer(int64) :: expected         ! bytes of the file
      integer :: infinite, k, lines, place(2)
      type(grid_slab) :: slab

      call check_map_size(self%path, points, error)
      expected = start + self%number_bytes*product(int(points, int64))
      if (self%bytes /= expected .and. .not. allocated(error)) &
         call self%refuse('its head announces '//integer_text(points(1))//' x '//integer_text(points(2))// &
                          ' heights, which make a file of '//integer_text(expected)//' bytes, but it has '// &
                          integer_text(self%bytes)//': was it copied in full, as binary data?', error)
      call slab%start(points, whole=.not. self%in_slabs)
      if (.not. allocated(error)) call check_room(self%path, points, error, slab)
      lines = 0
      if (.not. allocated(error) .and. slab%columns() > 0) lines = merge(points(1), slab%columns(), by_columns)
      if (.not. allocated(error)) &
         allocate (map%height(points(1), slab%columns()), line(merge(slab%columns(), points(1), by_columns)))
      do k = 1, lines
         place = merge([k, slab%first], [1, slab%first - 1 + k], by_columns)
         before = merge((place(1) - 1)*int(points(2), int64) + place(2) - 1, &
                        (place(2) - 1)*int(points(1), int64), by_columns)
         call read_numbers(self, start + self%number_bytes*before, line, error)
         if (allocated(error)) exit
         infinite = findloc(abs(line) > huge(line), .true., dim=1)
         if (infinite > 0) then
            place = place + (infinite - 1)*merge([0, 1], [1, 0], by_columns)
            call self%refuse('the height in row '//integer_text(place(2))//', column '//integer_text(place(1))// &
                             ' is infinite: make it nan if it is missing', error)
            exit
         end if
         if (by_columns) map%height(k, :) = line
         if (.not. by_columns) map%height(:, k) = line
      end do
      call slab%share_error(error)
      if (slab%is_distributed .and. .not. allocated(error)) map%slab = slab
   end subroutine read_heights

   !> Reads numbers. Callers must switch off traps of invalid operations, which signalling NaNs are. Errors:
   !> exit_file_trouble.
   subroutine read_numbers(self, start, numbers, error)
      type(binary_file), intent(in) :: self
      integer(int64), intent(in) :: start   !! bytes before the first
      real(dp), intent(out) :: numbers(:)
      type(error_type), allocatable, intent(out) :: error

      integer(int8), allocatable :: bytes(:)   ! in the order of this machine
      character(200) :: message
      integer :: i, status

      ! Of one dimension: gfortran reads a matrix column by column, which would be number by number.
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

   !> Makes an error with the name of the file and the status exit_bad_input.
   pure subroutine refuse(self, words, error)
      class(binary_file), intent(in) :: self
      character(*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_bad_input, escaped(self%path)//': '//words)
   end subroutine refuse

end module wavycon_binary_file
