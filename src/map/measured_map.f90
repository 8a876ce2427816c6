!> A height map as a file or an array gives it: perhaps with holes, tilted, and not periodic.
module wavycon_measured_map
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: measured_map

   type :: measured_map
      !> As in the file, 0 where it is missing, shape (M, N): along x, along y; N = 1 for a profile. If the map is
      !> distributed it has the own columns.
      real(dp), allocatable :: height(:, :)
      logical, allocatable :: missing(:, :)        !! shape of `height`; not allocated if no height is missing
      logical :: has_missing_value = .false.       !! whether a height had the value that stands for a missing one
      real(dp) :: step(2) = 0.0_dp                 !! between points along x and y; 0 where the file does not give it
      real(dp), allocatable :: x(:)                !! of a profile until it is resampled, if its steps are not equal
      real(dp) :: uneven_steps(2) = 0.0_dp         !! least and largest of a profile that was resampled, otherwise 0
      integer :: head_lines = 0                    !! of a text that begin with words and were left out
      logical :: is_usual_side(2) = .false.        !! whether a step is that of the format's default of the side
      character(7) :: format = ''                  !! of the file, as of read_height_map, but not 'auto'
      character(:), allocatable :: length_unit     !! of the steps; not allocated if the file does not name units
      character(:), allocatable :: height_unit     !! of the heights; allocated if length_unit is
      type(grid_slab), private :: slab             !! of the points of a map that is distributed
   contains
      procedure :: set_units
      procedure :: distribute_over
      procedure :: columns
      procedure :: points
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

   !> Declares that `height` has, or will have, the own columns of a map.
   pure subroutine distribute_over(self, slab)
      class(measured_map), intent(inout) :: self
      type(grid_slab), intent(in) :: slab

      self%slab = slab
   end subroutine distribute_over

   !> The columns that `height` has: the whole grid, unless the map is distributed.
   pure type(grid_slab) function columns(self)
      class(measured_map), intent(in) :: self

      columns = self%slab
      if (columns%is_distributed) return
      associate (n => size(self%height, 2))
         columns = grid_slab(points=shape(self%height), is_distributed=.false., width=n, first=1, last=n)
      end associate
   end function columns

   !> M, N of the map.
   pure function points(self)
      class(measured_map), intent(in) :: self
      integer :: points(2)

      points = shape(self%height)
      if (self%slab%is_distributed) points = self%slab%points
   end function points

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

end module wavycon_measured_map
