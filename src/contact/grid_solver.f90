!> Minimises the complementary energy 1/2 (p, Sp) + (p, h) over the pressures p >= 0 of given mean on a grid.
!>
!> The method is that of Polonsky & Keer (Wear 231 (1999) 206-219): conjugate gradients on the points in contact,
!> whose set is updated in each iteration. There are three changes: the residual is preconditioned by the inverse of
!> S, restricted to the contact; the search is not restarted when the set changes, but uses Polak & Ribiere's factor
!> where that is positive (restarts take up to 1.5 times the iterations on rough surfaces); and points enter the
!> contact at zero pressure. On a regular wave about seven iterations, started from the solution on a coarser grid,
!> are enough.
!>
!> Numbers (C..) are the equations of README.md in this directory.
!>
!> Sums are taken column by column and then over the columns, so that they do not depend on the number of threads.
module wavycon_grid_solver
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_tuning, only: overlap_part
   use wavycon_kinds, only: dp
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: grid_state, solve_on_grid

   !> Residuals below this, over Delta, are rounding: gaps are differences of numbers of the order of Delta.
   real(dp), parameter :: rounding = 32*epsilon(1.0_dp)

   type :: grid_state
      real(dp), allocatable :: pressure(:, :)   !! p/p*, >= 0, shape (m, n)
      real(dp), allocatable :: gap(:, :)        !! gap/Delta; in contact its deviation from zero, shape (m, n)
      real(dp) :: mean_gap = 1.0_dp             !! G
      real(dp) :: residual = huge(1.0_dp)       !! root mean square of the violated conditions on the gap, over G (C9)
      integer :: iterations = 0
      logical :: converged = .false.
   end type grid_state

   !> The fields of the iteration, all of shape (m, n), and its numbers.
   type :: contact_iteration
      logical(c_bool), allocatable :: contact(:, :)   !! K, the points in contact
      real(dp), allocatable :: residual(:, :)    !! r: the gap in contact, zero outside
      real(dp), allocatable :: direction(:, :)   !! d, of the pressure: zero mean, zero outside the contact
      real(dp), allocatable :: image(:, :)       !! in turn r, z (the preconditioned residual), d and Sd
      integer :: contact_points = 0
      real(dp) :: approach = 1.0_dp              !! of the mean planes, over Delta
      real(dp) :: descent = 1.0_dp               !! (gap, z) of the last direction
      real(dp), allocatable :: sums(:), more_sums(:)   !! sums over each column, shape (n)
      integer :: threads = 1
   contains
      procedure :: start
      procedure :: compute_gap
      procedure :: mean_gap_in_contact
      procedure :: shift_gap
      procedure :: precondition
      procedure :: update_direction
      procedure :: find_step
      procedure :: move_pressure
      procedure :: move_gap
      procedure :: add_overlaps
   end type contact_iteration

contains

   !> Solves (C1) on a grid by the iteration (C3) to (C9). If it does not converge in most_iterations, state%converged
   !> is false.
   subroutine solve_on_grid(half_space, undeformed_gap, mean_pressure, tolerance, most_iterations, state)
      type(compliance_operator), intent(inout) :: half_space   !! S, started on the grid
      real(dp), intent(in) :: undeformed_gap(:, :)   !! h/Delta, shape (m, n)
      real(dp), intent(in) :: mean_pressure          !! P in (0, 1)
      real(dp), intent(in) :: tolerance              !! for the residual (C9), > 0
      integer, intent(in) :: most_iterations
      type(grid_state), intent(inout) :: state       !! on entry `pressure` is the start, >= 0, with the mean P

      type(contact_iteration) :: work
      real(dp) :: allowed, step
      logical :: points_left

      call work%start(state)
      call work%compute_gap(half_space, undeformed_gap, state)
      do
         call work%shift_gap(state)
         allowed = max(tolerance*abs(state%mean_gap), rounding)
         state%converged = state%residual <= allowed
         state%residual = state%residual/max(abs(state%mean_gap), rounding)
         if (state%converged .or. state%iterations >= most_iterations) exit
         state%iterations = state%iterations + 1

         call work%precondition(half_space)
         call work%update_direction(state%gap)
         call work%find_step(half_space, step)
         call work%move_pressure(step, mean_pressure, state%pressure, points_left)
         if (points_left) then
            call work%compute_gap(half_space, undeformed_gap, state)
         else
            call work%move_gap(step, state%gap)
         end if
         call work%add_overlaps(overlap_part*allowed, state%gap)
      end do
   end subroutine solve_on_grid

   !> Allocates the fields. Points of positive pressure are in contact.
   subroutine start(self, state)
      class(contact_iteration), intent(out) :: self
      type(grid_state), intent(inout) :: state   !! with the pressure; the gap is allocated here

      integer :: m, n

      m = size(state%pressure, 1)
      n = size(state%pressure, 2)
      if (.not. allocated(state%gap)) allocate (state%gap(m, n))
      allocate (self%direction(m, n), self%image(m, n), self%residual(m, n), self%contact(m, n))
      allocate (self%sums(n), self%more_sums(n))
      self%threads = threads_for(m*n)
      self%direction = 0.0_dp
      self%residual = 0.0_dp
      self%contact = state%pressure > 0.0_dp
      state%iterations = 0
   end subroutine start

   !> Computes the gap h + Sp - approach (C1) of the present pressure.
   subroutine compute_gap(self, half_space, undeformed_gap, state)
      class(contact_iteration), intent(in) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(in) :: undeformed_gap(:, :)
      type(grid_state), intent(inout) :: state

      integer :: j

      state%gap = state%pressure
      call half_space%displacement(state%gap)
      !$omp parallel do num_threads(self%threads)
      do j = 1, size(undeformed_gap, 2)
         state%gap(:, j) = state%gap(:, j) + (undeformed_gap(:, j) - self%approach)
      end do
   end subroutine compute_gap

   !> Counts the points in contact and computes the mean of the gap over them.
   subroutine mean_gap_in_contact(self, gap, mean)
      class(contact_iteration), intent(inout) :: self
      real(dp), intent(in) :: gap(:, :)
      real(dp), intent(out) :: mean

      integer :: counts(size(gap, 2)), j

      !$omp parallel do num_threads(self%threads)
      do j = 1, size(gap, 2)
         self%sums(j) = sum(gap(:, j), self%contact(:, j))
         counts(j) = count(self%contact(:, j))
      end do
      self%contact_points = sum(counts)
      mean = sum(self%sums)/self%contact_points
   end subroutine mean_gap_in_contact

   !> Changes the approach so that the mean gap in contact is zero (C3), and computes the residual (C9) times G. The
   !> approach is the sum of small changes: each is a mean of small gaps and loses no digits.
   subroutine shift_gap(self, state)
      class(contact_iteration), intent(inout) :: self
      type(grid_state), intent(inout) :: state

      real(dp) :: shift
      integer :: j

      call self%mean_gap_in_contact(state%gap, shift)
      self%approach = self%approach + shift
      associate (gap => state%gap)
         !$omp parallel do num_threads(self%threads)
         do j = 1, size(gap, 2)
            gap(:, j) = gap(:, j) - shift
            self%image(:, j) = merge(gap(:, j), 0.0_dp, self%contact(:, j))
            self%sums(j) = sum(merge(gap(:, j), min(gap(:, j), 0.0_dp), self%contact(:, j))**2)
         end do
         state%mean_gap = 1.0_dp - self%approach
         state%residual = sqrt(sum(self%sums)/size(gap))
      end associate
   end subroutine shift_gap

   !> Computes z (C4) from the residual r, both in `image`: the pressure S^-1 r, restricted to the contact, less its
   !> mean there.
   subroutine precondition(self, half_space)
      class(contact_iteration), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space

      real(dp) :: mean
      integer :: j

      call half_space%pressure(self%image)
      !$omp parallel do num_threads(self%threads)
      do j = 1, size(self%image, 2)
         self%sums(j) = sum(self%image(:, j), self%contact(:, j))
      end do
      mean = sum(self%sums)/self%contact_points
      !$omp parallel do num_threads(self%threads)
      do j = 1, size(self%image, 2)
         self%image(:, j) = merge(self%image(:, j) - mean, 0.0_dp, self%contact(:, j))
      end do
   end subroutine precondition

   !> Computes the next direction by Polak & Ribiere's factor (C5), in `direction` and `image`, and sets `residual` to
   !> the present one.
   subroutine update_direction(self, gap)
      class(contact_iteration), intent(inout) :: self
      real(dp), intent(in) :: gap(:, :)

      real(dp) :: beta, descent, mean
      integer :: j

      !$omp parallel do num_threads(self%threads)
      do j = 1, size(gap, 2)
         self%sums(j) = dot_product(gap(:, j), self%image(:, j))
         self%more_sums(j) = dot_product(self%residual(:, j), self%image(:, j))
      end do
      descent = sum(self%sums)
      ! A contact of one point has no direction and (gap, z) = 0: the search restarts.
      beta = 0.0_dp
      if (self%descent > tiny(self%descent)) beta = max((descent - sum(self%more_sums))/self%descent, 0.0_dp)
      self%descent = descent
      !$omp parallel do num_threads(self%threads)
      do j = 1, size(gap, 2)
         self%direction(:, j) = merge(self%image(:, j) + beta*self%direction(:, j), 0.0_dp, self%contact(:, j))
         self%sums(j) = sum(self%direction(:, j))
      end do
      ! If points have left the contact, the mean of the last direction over the others is not zero.
      mean = sum(self%sums)/self%contact_points
      !$omp parallel do num_threads(self%threads)
      do j = 1, size(gap, 2)
         self%direction(:, j) = merge(self%direction(:, j) - mean, 0.0_dp, self%contact(:, j))
         self%residual(:, j) = merge(gap(:, j), 0.0_dp, self%contact(:, j))
         self%image(:, j) = self%direction(:, j)
      end do
   end subroutine update_direction

   !> Computes the step to the least energy along the direction (C6); `image` becomes Sd.
   subroutine find_step(self, half_space, step)
      class(contact_iteration), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(out) :: step   !! zero for a contact of one point, where d = 0; overlaps may still be added

      real(dp) :: curvature
      integer :: j

      call half_space%displacement(self%image)
      !$omp parallel do num_threads(self%threads)
      do j = 1, size(self%image, 2)
         self%sums(j) = dot_product(self%direction(:, j), self%image(:, j))
         self%more_sums(j) = dot_product(self%residual(:, j), self%direction(:, j))
      end do
      curvature = sum(self%sums)
      step = 0.0_dp
      if (curvature > 0.0_dp) step = sum(self%more_sums)/curvature
   end subroutine find_step

   !> Moves the pressure by a step. Points whose pressure would not stay positive leave the contact; the others are
   !> then multiplied by a factor that restores the mean pressure (C7).
   subroutine move_pressure(self, step, mean_pressure, pressure, points_left)
      class(contact_iteration), intent(inout) :: self
      real(dp), intent(in) :: step, mean_pressure
      real(dp), intent(inout) :: pressure(:, :)
      logical, intent(out) :: points_left   !! whether any point has left the contact

      logical :: left(size(pressure, 2))
      real(dp) :: factor
      integer :: j

      associate (p => pressure, contact => self%contact)
         !$omp parallel do num_threads(self%threads)
         do j = 1, size(p, 2)
            p(:, j) = p(:, j) - step*self%direction(:, j)
            left(j) = any(contact(:, j) .and. p(:, j) <= 0.0_dp)
            contact(:, j) = contact(:, j) .and. p(:, j) > 0.0_dp
            p(:, j) = merge(p(:, j), 0.0_dp, contact(:, j))
            self%sums(j) = sum(p(:, j))
         end do
         points_left = any(left)
         if (.not. points_left) return
         factor = mean_pressure*size(p)/sum(self%sums)
         p = factor*p
      end associate
   end subroutine move_pressure

   !> Updates the gap after a step in which no point left the contact.
   subroutine move_gap(self, step, gap)
      class(contact_iteration), intent(in) :: self
      real(dp), intent(in) :: step
      real(dp), intent(inout) :: gap(:, :)

      integer :: j

      !$omp parallel do num_threads(self%threads)
      do j = 1, size(gap, 2)
         gap(:, j) = gap(:, j) - step*self%image(:, j)
      end do
   end subroutine move_gap

   !> Adds to the contact the points outside whose gap is below the mean gap in contact by more than an allowance (C8).
   !> Smaller overlaps may be rounding: such points would enter and leave without end.
   subroutine add_overlaps(self, allowance, gap)
      class(contact_iteration), intent(inout) :: self
      real(dp), intent(in) :: allowance   !! [Delta]
      real(dp), intent(in) :: gap(:, :)

      real(dp) :: least
      integer :: j

      call self%mean_gap_in_contact(gap, least)
      least = least - allowance
      !$omp parallel do num_threads(self%threads)
      do j = 1, size(gap, 2)
         self%contact(:, j) = self%contact(:, j) .or. gap(:, j) < least
      end do
   end subroutine add_overlaps

end module wavycon_grid_solver
