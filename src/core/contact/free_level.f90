!> Solves the contact of a surface with free edges on one grid of a sequence. Pressures push the half-space down
!> everywhere, u > 0, so that only points with h < approach can touch. So the problem is solved on the smallest
!> rectangle about these points: the rest of the grid does not influence the solution.
!>
!> Numbers (C..) are the equations of README.md in this directory.
module wavycon_free_level
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_tuning, only: approach_margin
   use wavycon_free_kernel, only: integral_to_corner
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_solver, only: rounding, solve_on_grid
   use wavycon_grid_state, only: grid_state
   use wavycon_kinds, only: dp
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: solve_free_level, complete_gap

   !> Points that the rectangle has beyond those that can touch, on each side: the gaps there determine the place of the
   !> edge of contact.
   integer, parameter :: beside = 4
   !> Least side of the rectangle, in points.
   integer, parameter :: least_side = 16

contains

   !> Solves (C1) on a grid. Outside the rectangle the gap is set to h - approach, which is less than the true gap
   !> because the displacement is left out; `complete_gap` adds the displacement. The rectangle is that of the points
   !> with h below `reach`, the approach of the coarser grid and a little more. If the approach found exceeds `reach`,
   !> points outside the rectangle may touch, and the grid is solved again on a larger rectangle.
   subroutine solve_free_level(surface, undeformed_gap, residual, most_iterations, state, transform_pairs, progress)
      type(surface_type), intent(in) :: surface      !! has free edges
      real(dp), intent(in) :: undeformed_gap(:, :), residual   !! as in solve_on_grid
      integer, intent(in) :: most_iterations
      !> On entry as in solve_on_grid; the approach is that of the coarser grid, or 0 if there is none.
      type(grid_state), intent(inout) :: state
      real(dp), intent(inout) :: transform_pairs     !! is increased; in units of one pair on the whole grid
      class(solver_progress), intent(in), optional :: progress

      real(dp), allocatable :: pressure(:, :)
      type(compliance_operator) :: half_space
      integer :: high(2), low(2)   ! last and first row and column of the rectangle
      real(dp) :: part, reach, violation   ! part: points of the rectangle over those of the grid
      type(grid_slab) :: whole

      whole = state%slab
      reach = (1 + approach_margin)*state%approach
      do
         low = 1
         high = whole%points
         if (surface%dimension == 2 .and. reach > 0.0_dp) &
            call find_box(undeformed_gap <= reach .or. state%pressure > 0.0_dp, low, high)
         call move_alloc(state%pressure, pressure)
         associate (inner => pressure(low(1):high(1), low(2):high(2)), points => high - low + 1)
            allocate (state%pressure, source=inner)
            call state%slab%start(points, whole=.true.)
            call half_space%start(surface, whole%points, points)
            call solve_on_grid(half_space, undeformed_gap(low(1):high(1), low(2):high(2)), residual, &
                               most_iterations, state, progress)
            inner = state%pressure
            part = product(real(points, dp)/whole%points)
         end associate
         state%slab = whole
         call move_alloc(pressure, state%pressure)
         transform_pairs = transform_pairs + part*half_space%transform_pairs
         if (state%interrupted) return
         ! solve_on_grid takes means over the rectangle. Tables have means over the whole grid.
         violation = sqrt(part)*state%residual*max(state%size_of_gaps(), rounding)
         state%residual_indentation = part*state%residual_indentation
         if (surface%dimension == 2) &
            state%mean_gap = mean_gap_of(surface, undeformed_gap, state%approach, state%pressure)
         state%residual = violation/max(state%size_of_gaps(), rounding)
         call move_alloc(state%gap, pressure)
         allocate (state%gap, source=undeformed_gap - state%approach)
         state%gap(low(1):high(1), low(2):high(2)) = pressure
         ! Either the rectangle is the grid, or no point outside the rectangle touches.
         if (part >= 1.0_dp .or. state%approach <= reach) exit
         reach = (1 + approach_margin)*state%approach
         deallocate (state%gap)
      end do
   end subroutine solve_free_level

   !> The smallest rectangle about some points and `beside` more on each side, enlarged to a number of points whose
   !> transforms are fast and which can be halved, so that the preconditioner has coarser grids.
   pure subroutine find_box(inside, low, high)
      logical, intent(in) :: inside(:, :)       !! points that the rectangle must contain, shape (M, N)
      integer, intent(out) :: low(2), high(2)   !! first and last row and column of the rectangle

      !> Sides have one of these numbers of points times a power of two.
      integer, parameter :: lengths(*) = [8, 9, 10, 12, 15, 16]
      integer :: d, length, unit

      do d = 1, 2
         low(d) = max(findloc(any(inside, dim=3 - d), .true., dim=1) - beside, 1)
         high(d) = min(findloc(any(inside, dim=3 - d), .true., dim=1, back=.true.) + beside, size(inside, d))
         length = max(high(d) - low(d) + 1, least_side)
         unit = 2**(exponent(real(length - 1)) - 4)
         length = min(unit*minval(lengths, lengths*unit >= length), size(inside, d))
         low(d) = min(low(d), size(inside, d) - length + 1)
         high(d) = low(d) + length - 1
      end do
   end subroutine find_box

   !> The mean gap over the map [Delta], in which overlaps where p = H count as negative gaps. The mean displacement is
   !> that of (E15b) on the page of src/core/half_space, so that displacements outside the rectangle are not needed.
   real(dp) function mean_gap_of(surface, undeformed_gap, approach, pressure) result(mean)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: undeformed_gap(:, :), pressure(:, :)   !! h [Delta] and p [p*] on the whole grid
      real(dp), intent(in) :: approach                               !! [Delta]

      real(dp) :: side(2), x, y
      integer :: i, j

      associate (n => shape(pressure))
         side = surface%length/2
         mean = 0.0_dp
         do j = 1, n(2)
            if (.not. any(pressure(:, j) > 0.0_dp)) cycle
            y = side(2)*(j - 0.5_dp)/n(2)
            do i = 1, n(1)
               if (.not. pressure(i, j) > 0.0_dp) cycle
               x = side(1)*(i - 0.5_dp)/n(1)
               mean = mean + pressure(i, j)*sum(integral_to_corner([x, side(1) - x, x, side(1) - x], &
                                                                   [y, y, side(2) - y, side(2) - y]))
            end do
         end do
         mean = sum(sum(undeformed_gap, dim=1))/product(n) - approach + mean/(surface%stiffness*product(n))
      end associate
   end function mean_gap_of

   !> Computes the gap at all open points of the grid, those outside the rectangle included, by one more transform.
   subroutine complete_gap(surface, undeformed_gap, approach, pressure_or_gap)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: undeformed_gap(:, :)                   !! h/Delta
      real(dp), intent(in) :: approach                               !! [Delta]
      real(dp), intent(inout), contiguous :: pressure_or_gap(:, :)   !! p, or -gap at open points, as in grid_edge

      real(dp), allocatable :: gap(:, :)
      type(compliance_operator) :: half_space

      call half_space%start(surface, shape(pressure_or_gap))
      allocate (gap, source=max(pressure_or_gap, 0.0_dp))
      call half_space%displacement(gap, nonzero=any(gap > 0.0_dp, dim=1))
      where (pressure_or_gap <= 0.0_dp) pressure_or_gap = -max(undeformed_gap + gap - approach, 0.0_dp)
   end subroutine complete_gap

end module wavycon_free_level
