!> Interpolates the solution on one grid linearly to a finer grid, on which it is the start.
module wavycon_grid_refinement
   use wavycon_grid_edge, only: grid_edge
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: refine_pressure

contains

   !> Interpolates the pressure to a finer grid. The field that is interpolated is the pressure in contact and minus the
   !> gap at open points, where the gap is converted to a pressure with the weight of (C11). The fine pressure is this
   !> field where it is positive, so that it ends where (C11) places the edge of contact. The pressure alone would end
   !> up to a step farther out. If the grids are distributed, each process first fetches the coarse columns about its
   !> fine ones.
   subroutine refine_pressure(edge, fine_slab, fine)
      type(grid_edge), intent(in) :: edge                !! pressures and gaps on the coarser grid
      type(grid_slab), intent(in) :: fine_slab           !! the finer grid; distributed if the coarser one is
      real(dp), allocatable, intent(out) :: fine(:, :)   !! pressure, >= 0, shape (M', fine_slab%columns())

      real(dp), allocatable :: needed(:, :)
      integer :: before(fine_slab%points(1)), column, first, j, last, m
      real(dp) :: line(0:edge%slab%points(1) + 1), rest, rests(fine_slab%points(1))

      associate (coarse => edge%pressure_or_gap, even => edge%even, points => edge%slab%points, &
                 fine_points => fine_slab%points, weight => edge%rule%gap_weight*maxval(edge%stiffness))
         m = points(1)
         allocate (fine(fine_points(1), fine_slab%columns()), source=0.0_dp)
         call find_place([(j, j=1, fine_points(1))], fine_points(1), m, even, before, rests)
         ! The first and last coarse columns that the fine columns of this process need; those beyond the grid are
         ! images.
         call find_place(fine_slab%first, fine_points(2), points(2), even, first, rest)
         call find_place(fine_slab%last, fine_points(2), points(2), even, last, rest)
         if (fine_slab%columns() == 0) last = first - 2
         allocate (needed(m, first:last + 1))
         call edge%slab%fetch(merge(1.0_dp, weight, coarse > 0.0_dp)*coarse, even, first, needed)
         do j = fine_slab%first, fine_slab%last
            call find_place(j, fine_points(2), points(2), even, column, rest)
            line(1:m) = (1.0_dp - rest)*needed(:, column) + rest*needed(:, column + 1)
            if (.not. any(line(1:m) > 0.0_dp)) cycle
            line([0, m + 1]) = line(image_of_point([0, m + 1], m, even))
            fine(:, j - fine_slab%first + 1) = max((1.0_dp - rests)*line(before) + rests*line(before + 1), 0.0_dp)
         end do
      end associate
   end subroutine refine_pressure

   !> Finds the coarse point before a fine one along one axis, and the distance between both in coarse steps. The points
   !> of a quarter of the cell begin half a step from its border, those of a whole cell at the border.
   elemental subroutine find_place(point, fine_points, coarse_points, even, before, rest)
      integer, intent(in) :: point, fine_points, coarse_points   !! number of the fine point; points of both grids
      logical, intent(in) :: even      !! whether the points are those of a quarter of the cell
      integer, intent(out) :: before   !! number of the coarse point, 0 .. coarse_points
      real(dp), intent(out) :: rest    !! distance, 0 <= rest < 1 [coarse step]

      real(dp) :: first_step, position   ! first_step: distance of the first point from the border [step]

      first_step = 0.0_dp
      if (even) first_step = 0.5_dp
      position = (point - 1 + first_step)*coarse_points/fine_points + 1.0_dp - first_step
      before = floor(position)
      rest = position - before
   end subroutine find_place

end module wavycon_grid_refinement
