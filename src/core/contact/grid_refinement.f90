!> Interpolates a pressure to a finer grid, linearly between the points of the coarser grid.
module wavycon_grid_refinement
   use wavycon_grid_edge, only: grid_edge
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: refine, refine_pressure

contains

   !> The pressure, where it is positive, and the gap, times the weight with which (C11) places the edge, as negative
   !> pressures: what is above zero between the points is the pressure there.
   subroutine refine_pressure(edge, fine_slab, fine)
      type(grid_edge), intent(in) :: edge                !! of the coarser grid
      type(grid_slab), intent(in) :: fine_slab           !! of more points; distributed if that of the edge is
      real(dp), allocatable, intent(out) :: fine(:, :)   !! >= 0, own columns, shape (M', fine_slab%columns())

      associate (coarse => edge%pressure_or_gap, weight => edge%rule%gap_weight*maxval(edge%stiffness))
         call refine(merge(1.0_dp, weight, coarse > 0.0_dp)*coarse, edge%slab, edge%even, fine_slab, fine)
      end associate
   end subroutine refine_pressure

   !> Interpolates a field linearly; what is negative between the points becomes zero.
   subroutine refine(coarse, coarse_slab, even, fine_slab, fine)
      real(dp), intent(in), contiguous :: coarse(:, :)   !! own columns, shape (M, coarse_slab%columns())
      type(grid_slab), intent(in) :: coarse_slab         !! of M x N points; N = 1 in 1-D
      logical, intent(in) :: even                        !! whether the points are those of a quarter of the cell
      type(grid_slab), intent(in) :: fine_slab           !! of more points; distributed if coarse_slab is
      real(dp), allocatable, intent(out) :: fine(:, :)   !! own columns, shape (M', fine_slab%columns())

      real(dp), allocatable :: needed(:, :)
      integer :: before(fine_slab%points(1)), column, first, j, last, m
      real(dp) :: line(0:coarse_slab%points(1) + 1), rest, rests(fine_slab%points(1))

      m = coarse_slab%points(1)
      allocate (fine(fine_slab%points(1), fine_slab%columns()), source=0.0_dp)
      call find_place([(j, j=1, fine_slab%points(1))], fine_slab%points(1), m, even, before, rests)
      ! The coarse columns about the own fine ones, or their images.
      call find_place(fine_slab%first, fine_slab%points(2), coarse_slab%points(2), even, first, rest)
      call find_place(fine_slab%last, fine_slab%points(2), coarse_slab%points(2), even, last, rest)
      if (fine_slab%columns() == 0) last = first - 2
      allocate (needed(m, first:last + 1))
      call coarse_slab%fetch(coarse, even, first, needed)
      do j = fine_slab%first, fine_slab%last
         call find_place(j, fine_slab%points(2), coarse_slab%points(2), even, column, rest)
         line(1:m) = (1.0_dp - rest)*needed(:, column) + rest*needed(:, column + 1)
         if (.not. any(line(1:m) > 0.0_dp)) cycle
         line([0, m + 1]) = line(image_of_point([0, m + 1], m, even))
         fine(:, j - fine_slab%first + 1) = max((1.0_dp - rests)*line(before) + rests*line(before + 1), 0.0_dp)
      end do
   end subroutine refine

   !> The coarse point before a fine one, and the rest of the way in coarse steps. Points of a quarter lie midway
   !> between the lines of the grid.
   elemental subroutine find_place(point, fine_points, coarse_points, even, before, rest)
      integer, intent(in) :: point, fine_points, coarse_points
      logical, intent(in) :: even
      integer, intent(out) :: before   !! 0 .. coarse_points
      real(dp), intent(out) :: rest    !! 0 <= rest < 1

      real(dp) :: middle, place

      middle = merge(0.5_dp, 0.0_dp, even)
      place = (point - 1 + middle)*coarse_points/fine_points + 1.0_dp - middle
      before = floor(place)
      rest = place - before
   end subroutine find_place

end module wavycon_grid_refinement
