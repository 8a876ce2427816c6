!> A height map as a file or an array gives it. It may have holes, be tilted, and not be periodic. This module also
!> checks the size of maps.
module wavycon_measured_map
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, int64
   use wavycon_plain_text, only: escaped, integer_text
   implicit none (type, external)
   private

   public :: check_map_size, check_room, laid_along_x, measured_map

   !> The least and the largest number of points along a side.
   integer, parameter :: least_points = 3
   integer, parameter, public :: most_points = 1048576

   type :: measured_map
      !> The heights as in the file, 0 where a height is missing, shape (M, N): M points along x, N along y; N = 1 for a
      !> profile. If the map is distributed over processes, `height` has the process's own columns.
      real(dp), allocatable :: height(:, :)
      logical, allocatable :: missing(:, :)        !! shape of `height`; not allocated if no height is missing
      logical :: has_missing_value = .false.       !! whether a height had the value that stands for a missing one
      real(dp) :: step(2) = 0.0_dp                 !! steps between points along x and y; 0 where the file gives none
      real(dp), allocatable :: x(:)                !! x of a profile with unequal steps, until the profile is resampled
      real(dp) :: uneven_steps(2) = 0.0_dp         !! least and largest step of a resampled profile; otherwise 0
      real(dp), allocatable :: no_data             !! the height that stands for a missing one, if the file names one
      integer :: head_lines = 0                    !! number of lines of a text that begin with words and were skipped
      logical :: is_usual_side(2) = .false.        !! whether the side, and so the step, is the format's default
      character(7) :: format = ''                  !! format of the file, as of read_height_map, but not 'auto'
      character(:), allocatable :: length_unit     !! unit of the steps; not allocated if the file does not name units
      character(:), allocatable :: height_unit     !! unit of the heights; allocated if length_unit is
      type(grid_slab) :: slab                      !! if the map is distributed, which columns are the own ones
   contains
      procedure :: set_units, columns, keep_own_columns
   end type measured_map

contains

   !> Sets the units that a file names. If the file names only one of the two, this one is taken for both.
   pure subroutine set_units(self, length_unit, height_unit)
      class(measured_map), intent(inout) :: self
      character(*), intent(in) :: length_unit, height_unit   !! empty if the file does not name them

      if (length_unit == '' .and. height_unit == '') return
      self%length_unit = length_unit
      self%height_unit = height_unit
      if (length_unit == '') self%length_unit = height_unit
      if (height_unit == '') self%height_unit = length_unit
   end subroutine set_units

   !> Which columns `height` has: those of the whole grid unless the map is distributed.
   pure type(grid_slab) function columns(self)
      class(measured_map), intent(in) :: self

      columns = self%slab
      if (.not. columns%is_distributed) &
         columns = grid_slab(points=shape(self%height), width=size(self%height, 2), last=size(self%height, 2))
   end function columns

   !> Distributes a whole map over the processes if it is large: each process keeps its own columns.
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
      character(*), intent(in) :: source   !! name of the map, for the message
      integer, intent(in) :: points(2)     !! numbers of points along x and y; the second is 1 for a profile
      type(error_type), allocatable, intent(out) :: error

      associate (m => points(1), n => points(2))
         if (m < least_points .or. (n < least_points .and. n /= 1) .or. max(m, n) > most_points) &
            call fatal_error(error, exit_bad_input, escaped(source)//': a map of '//integer_text(m)//' x '// &
                             integer_text(n)//' points: there must be '//integer_text(least_points)//' to '// &
                             integer_text(most_points)//' along each side, or one row or column for a profile')
      end associate
   end subroutine check_map_size

   !> The numbers of points of a map along x and y. A single column along y is taken as a profile along x.
   pure function laid_along_x(points) result(laid)
      integer, intent(in) :: points(2)   !! as the file gives them
      integer :: laid(2)

      laid = points
      if (points(1) == 1) laid = points(2:1:-1)
   end function laid_along_x

   !> Checks that there is enough free memory for a map and its surface, because later allocations have no error
   !> handling. Errors: exit_file_trouble, in this process alone.
   subroutine check_room(source, points, error, slab)
      character(*), intent(in) :: source   !! name of the map, for the message
      integer, intent(in) :: points(2)     !! numbers of points along x and y
      type(error_type), allocatable, intent(out) :: error
      type(grid_slab), intent(in), optional :: slab   !! the own columns of a map that may be distributed; absent: all

      !> Real numbers for each height: those of the map, of the Fourier coefficients and of the transforms' work space.
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
