!> The complementary-energy problem on a grid: pressures p >= 0 of given mean that minimise 1/2 (p, Sp) + (p, h).
!>
!> Conjugate gradients on the points in contact, whose set follows the solution, in the manner of Polonsky & Keer
!> (Wear 231 (1999) 206-219) with three changes: the residual is preconditioned by the inverse of the half-space's
!> compliance, cut down to the contact; after a change of the set the search starts afresh from the preconditioned
!> residual; and the contact is entered by points at pressure zero. With a start from a coarser grid some seven iterations,
!> whatever the grid, gain six digits.
module wavycon_grid_solver
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: grid_state, solve_on_grid

   !> Residuals of this size over Delta are rounding: gaps are differences of numbers of the order of Delta.
   real(dp), parameter :: rounding = 32*epsilon(1.0_dp)

   type :: grid_state
      real(dp), allocatable :: pressure(:, :)   !! p/p*, >= 0, shape (m, n)
      real(dp), allocatable :: gap(:, :)        !! gap/Delta; in contact its deviation from zero
      real(dp) :: mean_gap = 1.0_dp             !! G
      real(dp) :: residual = huge(1.0_dp)       !! root mean square of the violated conditions on the gap, over G
      integer :: iterations = 0
      logical :: converged = .false.
   end type grid_state

contains

   !> Solves for one mean pressure.
   subroutine solve_on_grid(half_space, undeformed_gap, mean_pressure, tolerance, iteration_limit, state)
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(in) :: undeformed_gap(:, :)   !! h/Delta, shape (m, n)
      real(dp), intent(in) :: mean_pressure          !! P in (0, 1)
      real(dp), intent(in) :: tolerance              !! for the residual
      integer, intent(in) :: iteration_limit
      type(grid_state), intent(inout) :: state       !! `pressure` holds the start, whose mean is P

      real(dp), dimension(size(undeformed_gap, 1), size(undeformed_gap, 2)) :: residual, last_residual, direction, image
      logical :: contact(size(undeformed_gap, 1), size(undeformed_gap, 2)), set_changed
      real(dp) :: approach, shift, descent, last_descent, step, curvature, allowed
      integer :: points

      if (.not. allocated(state%gap)) allocate (state%gap, mold=state%pressure)
      last_residual = 0.0_dp
      direction = 0.0_dp
      last_descent = 1.0_dp
      set_changed = .true.
      state%iterations = 0
      associate (p => state%pressure, gap => state%gap)
         contact = p > 0.0_dp
         approach = 1.0_dp
         call start_gap()
         do
            ! The mean over the contact is taken out step by step: of numbers near zero it is as exact as they are.
            points = count(contact)
            shift = sum(gap, contact)/points
            gap = gap - shift
            approach = approach + shift
            residual = merge(gap, 0.0_dp, contact)
            state%mean_gap = 1.0_dp - approach
            state%residual = sqrt((sum(residual**2) + sum(min(gap, 0.0_dp)**2, .not. contact))/size(gap))
            allowed = max(tolerance*abs(state%mean_gap), rounding)
            state%converged = state%residual <= allowed
            state%residual = state%residual/max(abs(state%mean_gap), rounding)
            if (state%converged .or. state%iterations >= iteration_limit) exit
            state%iterations = state%iterations + 1

            call half_space%pressure(residual, image)
            image = merge(image, 0.0_dp, contact)
            step = sum(image)/points
            where (contact) image = image - step
            descent = sum(residual*image)
            if (set_changed) then
               direction = image
            else
               direction = image + (descent - sum(last_residual*image))/max(last_descent, tiny(last_descent))*direction
            end if
            last_residual = residual
            last_descent = descent

            call half_space%displacement(direction, image)
            ! A contact that leaves nothing to move may still have to grow.
            curvature = sum(direction*image)
            step = 0.0_dp
            if (curvature > 0.0_dp) step = sum(residual*direction)/curvature
            p = p - step*direction
            set_changed = any(contact .and. p <= 0.0_dp)
            if (set_changed) then
               contact = contact .and. p > 0.0_dp
               p = merge(p, 0.0_dp, contact)
               p = p*(mean_pressure*size(p)/sum(p))
               call start_gap()
            else
               gap = gap - step*image
            end if

            ! Overlaps far below the residual allowed are left alone: they may be rounding, and come and go for ever.
            shift = sum(gap, contact)/count(contact) - 0.1_dp*allowed
            if (any(.not. contact .and. gap < shift)) then
               set_changed = .true.
               contact = contact .or. gap < shift
            end if
         end do
      end associate

   contains

      subroutine start_gap()
         call half_space%displacement(state%pressure, state%gap)
         state%gap = state%gap + (undeformed_gap - approach)
      end subroutine start_gap

   end subroutine solve_on_grid

end module wavycon_grid_solver
