!> The isobar p = level as closed curves.
module wavycon_isobar_curves
   use wavycon_isobar_cell, only: edge_point, isobar_grid
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: isobar_curve, trace_isobars

   !> A curve, the pressure above the level on its left. Its last point repeats the first, but for a curve that runs
   !> through the whole plane: that ends one period on.
   type :: isobar_curve
      real(dp), allocatable :: phi(:), theta(:)   !! [rad]; not reduced to one cell, so that the curve is of one piece
   end type isobar_curve

contains

   !> All curves of one period of phi and theta.
   subroutine trace_isobars(grid, curves)
      type(isobar_grid), intent(in) :: grid
      type(isobar_curve), allocatable, intent(out) :: curves(:)

      logical :: seen(4, -grid%intervals:grid%intervals - 1, -grid%intervals:grid%intervals - 1)
      type(isobar_curve) :: curve
      integer :: k, l, number

      allocate (curves(0))
      seen = .false.
      do l = -grid%intervals, grid%intervals - 1
         do k = -grid%intervals, grid%intervals - 1
            do number = 1, 4
               if (seen(number, k, l) .or. .not. leaves_level(grid, k, l, number)) cycle
               call trace(grid, k, l, number, seen, curve)
               curves = [curves, curve]
            end do
         end do
      end do
   end subroutine trace_isobars

   !> Follows one curve from an edge of a cell back to it.
   subroutine trace(grid, first_k, first_l, first_number, seen, curve)
      type(isobar_grid), intent(in) :: grid
      integer, intent(in) :: first_k, first_l, first_number
      logical, intent(inout) :: seen(:, -grid%intervals:, -grid%intervals:)
      type(isobar_curve), intent(out) :: curve

      integer, parameter :: step_k(4) = [0, 1, 0, -1], step_l(4) = [-1, 0, 1, 0]
      integer, parameter :: opposite(4) = [3, 4, 1, 2]
      real(dp), allocatable :: phi(:), theta(:)
      type(edge_point) :: point
      integer :: k, l, number, count, wrapped_k, wrapped_l

      allocate (phi(size(seen) + 1), theta(size(seen) + 1))
      k = first_k
      l = first_l
      number = first_number
      count = 0
      do
         point = grid%edge(k, l, number)
         count = count + 1
         phi(count) = point%phi
         theta(count) = point%theta
         wrapped_k = modulo(k + grid%intervals, 2*grid%intervals) - grid%intervals
         wrapped_l = modulo(l + grid%intervals, 2*grid%intervals) - grid%intervals
         if (seen(number, wrapped_k, wrapped_l)) exit
         seen(number, wrapped_k, wrapped_l) = .true.

         ! Inside the cell the curve ends on the next edge with a crossing, against the clock (see cell_area).
         do
            number = mod(number, 4) + 1
            point = grid%edge(k, l, number)
            if (point%exists) exit
         end do
         k = k + step_k(number)
         l = l + step_l(number)
         number = opposite(number)
      end do
      allocate (curve%phi, source=phi(:count))
      allocate (curve%theta, source=theta(:count))
   end subroutine trace

   !> Whether the pressure falls below the level along an edge of a cell, followed against the clock: a curve with the
   !> pressure above the level on its left enters the cell there.
   pure logical function leaves_level(grid, k, l, number)
      type(isobar_grid), intent(in) :: grid
      integer, intent(in) :: k, l, number

      integer, parameter :: dk(5) = [0, 1, 1, 0, 0], dl(5) = [0, 0, 1, 1, 0]

      leaves_level = grid%node(k + dk(number), l + dl(number)) >= 0.0_dp .and. &
                     grid%node(k + dk(number + 1), l + dl(number + 1)) < 0.0_dp
   end function leaves_level

end module wavycon_isobar_curves
