!> A binary file: its first bytes, and its numbers of single or double precision in either byte order.
module wavycon_binary_file
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only: int32, int64, int8
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: open_file
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_map_size, only: check_map_size, check_room
   use wavycon_measured_map, only: measured_map
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
      integer, private :: unit = -1
      logical, private :: is_open = .false.
   contains
      procedure :: open => open_binary_file
      procedure :: go_to
      procedure :: read_numbers
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
      self%is_open = .true.
      inquire (unit=self%unit, size=self%bytes)
      allocate (character(int(max(0_int64, min(self%bytes, int(longest_head, int64))))) :: self%head)
      if (len(self%head) == 0) return
      read (self%unit, iostat=status, iomsg=message) self%head
      call self%check(status, message, error)
   end subroutine open_binary_file

   !> Closes the file, if it is open.
   subroutine close_binary_file(self)
      class(binary_file), intent(inout) :: self

      if (self%is_open) close (self%unit)
      self%is_open = .false.
   end subroutine close_binary_file

   !> Makes the next reading start behind so many bytes of the file.
   subroutine go_to(self, bytes, error)
      class(binary_file), intent(in) :: self
      integer(int64), intent(in) :: bytes   !! 0 to self%bytes
      type(error_type), allocatable, intent(out) :: error

      integer :: status
      character(200) :: message

      read (self%unit, pos=bytes + 1, iostat=status, iomsg=message)
      call self%check(status, message, error)
   end subroutine go_to

   !> Reports a read statement that failed. Errors: exit_file_trouble.
   pure subroutine check(self, status, message, error)
      class(binary_file), intent(in) :: self
      integer, intent(in) :: status          !! iostat
      character(*), intent(in) :: message    !! iomsg, if status is not 0
      type(error_type), allocatable, intent(out) :: error

      if (status /= 0) call fatal_error(error, exit_file_trouble, &
                                        escaped(self%path)//': cannot be read: '//system_words(message))
   end subroutine check

   !> Reads the next numbers. A NaN of any kind becomes a quiet one. Errors: exit_file_trouble.
   !>
   !> N.B. Signalling NaNs stop programs that trap invalid operations: bits are tested before they become numbers.
   subroutine read_numbers(self, numbers, infinite, error)
      class(binary_file), intent(in) :: self
      real(dp), intent(out) :: numbers(:)
      integer, intent(out) :: infinite     !! index of the first infinite number, here 0; 0 if there is none
      type(error_type), allocatable, intent(out) :: error

      integer(int32), allocatable :: words(:, :)   ! of each number, of four bytes
      character(200) :: message
      integer :: status

      infinite = 0
      allocate (words(self%number_bytes/4, size(numbers)))
      read (self%unit, iostat=status, iomsg=message) words
      call self%check(status, message, error)
      if (allocated(error)) then
         numbers = 0.0_dp
      else
         call take_numbers(self, words, numbers, infinite)
      end if
   end subroutine read_numbers

   !> The numbers that words of the file are, with the errors of read_numbers.
   pure subroutine take_numbers(self, words, numbers, infinite)
      class(binary_file), intent(in) :: self
      integer(int32), intent(in) :: words(:, :)
      real(dp), intent(out) :: numbers(:)
      integer, intent(out) :: infinite

      !> Bits of the exponent in the first word: all are 1 in a NaN and in an infinity, whose other bits but the sign
      !> are 0.
      integer(int32), parameter :: exponent_sp = int(z'7F800000', int32), exponent_dp = int(z'7FF00000', int32)
      integer(int32) :: exponent, first, last
      integer :: i, place
      logical :: is_double, is_swapped

      infinite = 0
      is_double = size(words, 1) == 2
      exponent = merge(exponent_dp, exponent_sp, is_double)
      is_swapped = self%big_end_first .eqv. transfer(1_int32, 1_int8) == 1_int8
      place = merge(1, size(words, 1), self%big_end_first)
      last = 0
      do i = 1, size(numbers)
         first = words(place, i)
         if (is_swapped) first = swapped(first)
         if (is_double) then
            last = words(3 - place, i)
            if (is_swapped) last = swapped(last)
         end if
         if (iand(first, exponent) == exponent) then
            numbers(i) = ieee_value(numbers(i), ieee_quiet_nan)
            if (infinite == 0 .and. ibclr(first, 31) == exponent .and. last == 0) infinite = i
         else if (is_double) then
            numbers(i) = transfer(ior(shiftl(int(first, int64), 32), ibits(int(last, int64), 0, 32)), 0.0_dp)
         else
            numbers(i) = real(transfer(first, 0.0_sp), dp)
         end if
      end do
   end subroutine take_numbers

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

      real(dp), allocatable :: height(:, :)
      type(grid_slab) :: lines, slab   ! of the file and of the map
      integer :: across(2)             ! points along y and x

      call check_length(self, start, points, error)
      call slab%start(points, whole=.not. self%in_slabs)
      if (.not. allocated(error)) call check_room(self%path, points, error, slab)
      lines = slab
      if (by_columns) then
         across = [points(2), points(1)]
         call lines%start(across, whole=.true.)
         if (slab%is_distributed) call lines%divide(across)
      end if
      if (.not. allocated(error)) call read_lines(self, start, lines, by_columns, map%height, error)
      call slab%share_error(error)
      if (allocated(error) .or. .not. slab%is_distributed) return
      call map%distribute_over(slab)
      if (.not. by_columns) return
      allocate (height(points(1), slab%columns()))
      call slab%exchange_rows(lines, 8, height, map%height, to_rows=.false.)
      call move_alloc(height, map%height)
   end subroutine read_heights

   !> Checks the size of the map and of the file. Errors: exit_bad_input.
   subroutine check_length(self, start, points, error)
      type(binary_file), intent(in) :: self
      integer(int64), intent(in) :: start
      integer, intent(in) :: points(2)
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: expected

      call check_map_size(self%path, points, error)
      if (allocated(error)) return
      expected = start + self%number_bytes*product(int(points, int64))
      if (self%bytes /= expected) then
         call self%refuse('its head announces '//integer_text(points(1))//' x '//integer_text(points(2))// &
                          ' heights, which make a file of '//integer_text(expected)//' bytes, but it has '// &
                          integer_text(self%bytes)//': was it copied in full, as binary data?', error)
      end if
   end subroutine check_length

   !> Reads lines of the file, which are columns or rows of the map. Errors: of this process alone.
   subroutine read_lines(self, start, lines, by_columns, height, error)
      type(binary_file), intent(in) :: self
      integer(int64), intent(in) :: start              !! bytes before the first height
      type(grid_slab), intent(in) :: lines             !! the own lines, as columns
      logical, intent(in) :: by_columns                !! whether a line has heights of one x
      !> Shape (heights of a line, own lines), by_columns (own lines, heights of a line).
      real(dp), allocatable, intent(out) :: height(:, :)
      type(error_type), allocatable, intent(out) :: error

      !> Lines read before they are copied, so that copies fill lines of the processor's cache: 4096 x 4096 heights
      !> by columns take 0.09 s with 16, 0.12 s with 4, 0.28 s with 1 and 0.11 s with 64.
      integer, parameter :: block_lines = 16
      real(dp), allocatable :: block(:, :)
      integer :: i, infinite, j, k, number, place(2)

      place = [lines%points(1), lines%columns()]
      if (by_columns) place = place(2:1:-1)
      allocate (height(place(1), place(2)), block(lines%points(1), block_lines))
      if (size(height) > 0) call self%go_to(start_of_line(self, start, lines), error)
      do i = 1, lines%columns(), block_lines
         number = min(block_lines, lines%columns() - i + 1)
         do k = 1, number
            if (.not. allocated(error)) call self%read_numbers(block(:, k), infinite, error)
            if (allocated(error)) return
            if (infinite == 0) cycle
            place = [infinite, lines%first + i + k - 2]
            if (by_columns) place = place(2:1:-1)
            call self%refuse('the height in row '//integer_text(place(2))//', column '//integer_text(place(1))// &
                             ' is infinite: make it nan if it is missing', error)
         end do
         if (by_columns) then
            do j = 1, size(height, 2)
               height(i:i + number - 1, j) = block(j, :number)
            end do
         else
            height(:, i:i + number - 1) = block(:, :number)
         end if
      end do
   end subroutine read_lines

   !> Bytes before the first of the own lines.
   pure integer(int64) function start_of_line(self, start, lines) result(bytes)
      type(binary_file), intent(in) :: self
      integer(int64), intent(in) :: start
      type(grid_slab), intent(in) :: lines

      bytes = start + (lines%first - 1)*int(lines%points(1), int64)*self%number_bytes
   end function start_of_line

   !> Makes an error with the name of the file and the status exit_bad_input.
   pure subroutine refuse(self, words, error)
      class(binary_file), intent(in) :: self
      character(*), intent(in) :: words
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_bad_input, escaped(self%path)//': '//words)
   end subroutine refuse

   !> A word with its four bytes reversed.
   elemental integer(int32) function swapped(word)
      integer(int32), intent(in) :: word

      integer(int32), parameter :: even = int(z'00FF00FF', int32)   !! the first and the third byte

      swapped = ior(iand(ishftc(word, 8), even), iand(ishftc(word, -8), not(even)))
   end function swapped

end module wavycon_binary_file
