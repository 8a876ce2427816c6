!> The complementary-energy problem on a grid: pressures p >= 0 of given mean that minimise 1/2 (p, Sp) + (p, h).
!>
!> Conjugate gradients on the points in contact, whose set follows the solution, in the manner of Polonsky & Keer
!> (Wear 231 (1999) 206-219) with three changes: the residual is preconditioned by the inverse of the half-space's
!> compliance, cut down to the contact; the search goes on through changes of the set, with Polak & Ribiere's factor
!> where that is positive, as starting afresh takes twice the iterations on rough surfaces; and the contact is
!> entered by points at pressure zero. On a regular wave some seven iterations from a coarser grid's answer,
!> whatever the grid, gain six digits.
!>
!> Sums are taken column by column and then over the columns, so that they do not depend on the number of threads.
module wavycon_grid_solver
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_kinds, only: dp
   use wavycon_threads, only: threads_for
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

      real(dp), allocatable :: direction(:, :), image(:, :), last_residual(:, :)
      logical(c_bool), allocatable :: contact(:, :)
      real(dp), dimension(size(undeformed_gap, 2)) :: sums, more_sums
      integer :: counts(size(undeformed_gap, 2))
      logical :: changes(size(undeformed_gap, 2))
      real(dp) :: allowed, approach, beta, curvature, descent, factor, last_descent, mean, shift, step
      integer :: j, m, n, points, threads

      m = size(undeformed_gap, 1)
      n = size(undeformed_gap, 2)
      threads = threads_for(m*n)
      if (.not. allocated(state%gap)) allocate (state%gap(m, n))
      allocate (direction(m, n), image(m, n), last_residual(m, n), contact(m, n))
      direction = 0.0_dp
      last_residual = 0.0_dp
      last_descent = 1.0_dp
      state%iterations = 0
      associate (p => state%pressure, gap => state%gap)
         contact = p > 0.0_dp
         approach = 1.0_dp
         call start_gap()
         do
            ! The mean over the contact is taken out step by step: of numbers near zero it is as exact as they are.
            shift = mean_gap_in_contact()
            approach = approach + shift
            !$omp parallel do num_threads(threads)
            do j = 1, n
               gap(:, j) = gap(:, j) - shift
               image(:, j) = merge(gap(:, j), 0.0_dp, contact(:, j))
               sums(j) = sum(merge(gap(:, j), min(gap(:, j), 0.0_dp), contact(:, j))**2)
            end do
            state%mean_gap = 1.0_dp - approach
            state%residual = sqrt(sum(sums)/size(gap))
            allowed = max(tolerance*abs(state%mean_gap), rounding)
            state%converged = state%residual <= allowed
            state%residual = state%residual/max(abs(state%mean_gap), rounding)
            if (state%converged .or. state%iterations >= iteration_limit) exit
            state%iterations = state%iterations + 1

            call half_space%pressure(image)
            !$omp parallel do num_threads(threads)
            do j = 1, n
               sums(j) = sum(image(:, j), contact(:, j))
            end do
            mean = sum(sums)/points
            !$omp parallel do num_threads(threads)
            do j = 1, n
               image(:, j) = merge(image(:, j) - mean, 0.0_dp, contact(:, j))
               sums(j) = dot_product(gap(:, j), image(:, j))
               more_sums(j) = dot_product(last_residual(:, j), image(:, j))
            end do
            descent = sum(sums)
            beta = max((descent - sum(more_sums))/max(last_descent, tiny(last_descent)), 0.0_dp)
            last_descent = descent
            !$omp parallel do num_threads(threads)
            do j = 1, n
               direction(:, j) = merge(image(:, j) + beta*direction(:, j), 0.0_dp, contact(:, j))
               sums(j) = sum(direction(:, j))
            end do
            ! Of the direction before, only what lies in the contact now is left: it is to move no load again.
            mean = sum(sums)/points
            !$omp parallel do num_threads(threads)
            do j = 1, n
               direction(:, j) = merge(direction(:, j) - mean, 0.0_dp, contact(:, j))
               last_residual(:, j) = merge(gap(:, j), 0.0_dp, contact(:, j))
               image(:, j) = direction(:, j)
            end do

            call half_space%displacement(image)
            !$omp parallel do num_threads(threads)
            do j = 1, n
               sums(j) = dot_product(direction(:, j), image(:, j))
               more_sums(j) = dot_product(last_residual(:, j), direction(:, j))
            end do
            curvature = sum(sums)
            ! A contact that leaves nothing to move may still have to grow.
            step = 0.0_dp
            if (curvature > 0.0_dp) step = sum(more_sums)/curvature
            !$omp parallel do num_threads(threads)
            do j = 1, n
               p(:, j) = p(:, j) - step*direction(:, j)
               changes(j) = any(contact(:, j) .and. p(:, j) <= 0.0_dp)
               contact(:, j) = contact(:, j) .and. p(:, j) > 0.0_dp
               p(:, j) = merge(p(:, j), 0.0_dp, contact(:, j))
               sums(j) = sum(p(:, j))
            end do
            if (any(changes)) then
               factor = mean_pressure*size(p)/sum(sums)
               p = factor*p
               call start_gap()
            else
               !$omp parallel do num_threads(threads)
               do j = 1, n
                  gap(:, j) = gap(:, j) - step*image(:, j)
               end do
            end if

            ! Overlaps far below the residual allowed are left alone: they may be rounding, and come and go for
            ! ever.
            shift = mean_gap_in_contact() - 0.1_dp*allowed
            !$omp parallel do num_threads(threads)
            do j = 1, n
               contact(:, j) = contact(:, j) .or. gap(:, j) < shift
            end do
         end do
      end associate

   contains

      subroutine start_gap()
         integer :: k

         state%gap = state%pressure
         call half_space%displacement(state%gap)
         !$omp parallel do num_threads(threads)
         do k = 1, n
            state%gap(:, k) = state%gap(:, k) + (undeformed_gap(:, k) - approach)
         end do
      end subroutine start_gap

      !> It counts the points in contact too.
      real(dp) function mean_gap_in_contact()
         integer :: k

         !$omp parallel do num_threads(threads)
         do k = 1, n
            sums(k) = sum(state%gap(:, k), contact(:, k))
            counts(k) = count(contact(:, k))
         end do
         points = sum(counts)
         mean_gap_in_contact = sum(sums)/points
      end function mean_gap_in_contact

   end subroutine solve_on_grid

end module wavycon_grid_solver
