!> A height map as a file or an array gives it: perhaps with holes, tilted, and not periodic; how large it may be.
module wavycon_measured_map
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, integer_text
   implicit none (type, external)
   private

   public :: check_map_size, check_room, laid_along_x, measured_map

   !> Fewest and most points along a side.
   integer, parameter :: least_points = 3
   integer, parameter, public :: most_points = 1048576

   type :: measured_map
      !> As in the file, 0 where it is missing, shape (M, N): along x, along y; N = 1 for a profile. If the map is
      !> distributed it has the own columns.
      real(dp), allocatable :: height(:, :)
      logical, allocatable :: missing(:, :)        !! shape of `height`; not allocated if no height is missing
      logical :: has_missing_value = .false.       !! whether a height had the value that stands for a missing one
      real(dp) :: step(2) = 0.0_dp                 !! between points along x and y; 0 where the file does not give it
      real(dp), allocatable :: x(:)                !! of a profile until it is resampled, if its steps are not equal
      real(dp) :: uneven_steps(2) = 0.0_dp         !! least and largest of a profile that was resampled, otherwise 0
      real(dp), allocatable :: no_data             !! height that stands for a missing one, if the file names it
      integer :: head_lines = 0                    !! of a text that begin with words and were left out
      logical :: is_usual_side(2) = .false.        !! whether a step is that of the format's default of the side
      character(7) :: format = ''                  !! of the file, as of read_height_map, but not 'auto'
      character(:), allocatable :: length_unit     !! of the steps; not allocated if the file does not name units
      character(:), allocatable :: height_unit     !! of the heights; allocated if length_unit is
      type(grid_slab) :: slab                      !! of the points of a map that is distributed
   contains
      procedure :: set_units
      procedure :: columns
      procedure :: keep_own_columns
   end type measured_map

contains

   !> Sets the units that a file names; if it names one, it is that of both.
   pure subroutine set_units(self, length_unit, height_unit)
      class(measured_map), intent(inout) :: self
      character(*), intent(in) :: length_unit, height_unit   !! empty if the file does not name them

      if (length_unit == '' .and. height_unit == '') return
      self%length_unit = length_unit
      self%height_unit = height_unit
      if (length_unit == '') self%length_unit = height_unit
      if (height_unit == '') self%height_unit = length_unit
   end subroutine set_units

   !> The columns that `height` has: the whole grid, unless the map is distributed.
   pure type(grid_slab) function columns(self)
      class(measured_map), intent(in) :: self

      columns = self%slab
      if (.not. columns%is_distributed) &
         columns = grid_slab(points=shape(self%height), width=size(self%height, 2), last=size(self%height, 2))
   end function columns

   !> Distributes a whole map if it is large.
   subroutine keep_own_columns(self)
      class(measured_map), intent(inout) :: self

      real(dp), allocatable :: own(:, :)

      if (self%slab%is_distributed) return
      call self%slab%start(shape(self%height))
      if (.not. self%slab%is_distributed) return
      allocate (own, source=self%height(:, self%slab%first:self%slab%last))
      call move_alloc(own, self%height)
      if (allocated(self%missing)) self%missing = self%missing(:, self%slab%first:self%slab%last)
   end subroutine keep_own_columns

   !> Checks the number of points. Errors: exit_bad_input for a map that is too small or too large.
   subroutine check_map_size(source, points, error)
      character(*), intent(in) :: source   !! of the map, for the message
      integer, intent(in) :: points(2)     !! along x and y; the second is 1 for a profile
      type(error_type), allocatable, intent(out) :: error

      associate (m => points(1), n => points(2))
         if (m < least_points .or. (n < least_points .and. n /= 1) .or. max(m, n) > most_points) &
            call fatal_error(error, exit_bad_input, escaped(source)//': a map of '//integer_text(m)//' x '// &
                             integer_text(n)//' points: there must be '//integer_text(least_points)//' to '// &
                             integer_text(most_points)//' along each side, or one row or column for a profile')
      end associate
   end subroutine check_map_size

   !> The points of a map; of one column those of a profile along x.
   pure function laid_along_x(points) result(laid)
      integer, intent(in) :: points(2)
      integer :: laid(2)

      laid = points
      if (points(1) == 1) laid = points(2:1:-1)
   end function laid_along_x

   !> Checks that there is memory for a map and its surface besides what is in use, because later allocations have no
   !> error handling. Errors: exit_file_trouble, of this process alone.
   subroutine check_room(source, points, error, slab)
      character(*), intent(in) :: source   !! of the map, for the message
      integer, intent(in) :: points(2)     !! along x and y
      type(error_type), allocatable, intent(out) :: error
      type(grid_slab), intent(in), optional :: slab   !! of a map that may be distributed; absent: of a whole one

      !> Real numbers for each height: the map, the Fourier coefficients, work space of the transforms.
      integer, parameter :: copies = 5
      character(:), allocatable :: words
      type(grid_slab) :: part

      part = grid_slab(points=points, width=points(2))
      if (present(slab)) part = slab
      words = ''
      if (int(points(1), int64)*part%width > huge(0)) then
         words = 'more than 2^31 points on a process: more processes are needed'
      else if (.not. part%has_memory(copies)) then
         words = 'there is not the memory for a map of this size'
      end if
      if (words /= '') call fatal_error(error, exit_file_trouble, escaped(source)//': '//words)
   end subroutine check_room

end module wavycon_measured_map
