!> One grid of a surface with free edges. Pressures push the half-space down everywhere, u > 0, so that only the points
!> with h < approach can touch. The contact is solved on the smallest rectangle about these.
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

   !> Points on each side of the rectangle whose gaps place the edge of contact.
   integer, parameter :: beside = 4
   !> Least side of the rectangle, in points.
   integer, parameter :: least_side = 16

contains

   !> Solves (C1) on a grid. The gap outside the rectangle is h - approach, less than the true one: see complete_gap.
   subroutine solve_free_level(surface, undeformed_gap, residual, most_iterations, state, transform_pairs, progress)
      type(surface_type), intent(in) :: surface      !! with free edges
      real(dp), intent(in) :: undeformed_gap(:, :), residual   !! these as of solve_on_grid
      integer, intent(in) :: most_iterations
      !> The approach on entry is that of the coarser grid, or 0.
      type(grid_state), intent(inout) :: state
      real(dp), intent(inout) :: transform_pairs     !! in units of one on the whole grid
      class(solver_progress), intent(in), optional :: progress

      real(dp), allocatable :: pressure(:, :)
      type(compliance_operator) :: half_space
      integer :: high(2), low(2)
      real(dp) :: part, reach, violation
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
         ! Means over the whole grid, on which they are told.
         violation = sqrt(part)*state%residual*max(state%size_of_gaps(), rounding)
         state%residual_indentation = part*state%residual_indentation
         if (surface%dimension == 2) &
            state%mean_gap = mean_gap_of(surface, undeformed_gap, state%approach, state%pressure)
         state%residual = violation/max(state%size_of_gaps(), rounding)
         call move_alloc(state%gap, pressure)
         allocate (state%gap, source=undeformed_gap - state%approach)
         state%gap(low(1):high(1), low(2):high(2)) = pressure
         ! Nothing outside the rectangle touches.
         if (part >= 1.0_dp .or. state%approach <= reach) exit
         reach = (1 + approach_margin)*state%approach
         deallocate (state%gap)
      end do
   end subroutine solve_free_level

   !> The smallest rectangle about some points and those beside them, enlarged to sides whose transforms are fast and on
   !> which the preconditioner has coarser grids.
   pure subroutine find_box(inside, low, high)
      logical, intent(in) :: inside(:, :)
      integer, intent(out) :: low(2), high(2)

      !> Of which a power of two has fast transforms.
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

   !> The mean gap, overlaps where p = H negative [Delta]: (E15b) of the page of src/core/half_space.
   real(dp) function mean_gap_of(surface, undeformed_gap, approach, pressure) result(mean)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: undeformed_gap(:, :), pressure(:, :)   !! h, p on the whole grid
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

   !> The gap at all open points.
   subroutine complete_gap(surface, undeformed_gap, approach, pressure_or_gap)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: undeformed_gap(:, :)                   !! h/Delta
      real(dp), intent(in) :: approach                               !! [Delta]
      real(dp), intent(inout), contiguous :: pressure_or_gap(:, :)   !! of grid_edge

      real(dp), allocatable :: gap(:, :)
      type(compliance_operator) :: half_space

      call half_space%start(surface, shape(pressure_or_gap))
      allocate (gap, source=max(pressure_or_gap, 0.0_dp))
      call half_space%displacement(gap, nonzero=any(gap > 0.0_dp, dim=1))
      where (pressure_or_gap <= 0.0_dp) pressure_or_gap = -max(undeformed_gap + gap - approach, 0.0_dp)
   end subroutine complete_gap

end module wavycon_free_level
