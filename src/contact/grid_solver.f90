!> Minimises the complementary energy 1/2 (p, Sp) + (p, h) over the pressures p >= 0 of given mean on a grid.
!>
!> Each step computes the gap of the present pressure at all points, in double precision, and verifies the conditions of
!> contact there. It then selects the points in and near the contact, and corrects the pressure at these points in single
!> precision (`pressure_correction`). A step reduces the residual by some four digits.
!>
!> Numbers (C..) are the equations of README.md in this directory.
module wavycon_grid_solver
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_tuning, only: correction_limit, correction_margin, correction_part, edge_tolerance, halo
   use wavycon_kinds, only: dp
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_pressure_correction, only: pressure_correction
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: grid_state, solve_on_grid

   !> Residuals below the first, over Delta, are rounding. Those below the second are if a step does not halve them: how
   !> far gaps are rounded depends on the depth of the surface and on its longest wave.
   real(dp), parameter :: rounding = 32*epsilon(1.0_dp), most_rounding = 1e-12_dp

   type :: grid_state
      real(dp), allocatable :: pressure(:, :)   !! p/p*, >= 0, shape (m, n)
      real(dp), allocatable :: gap(:, :)        !! gap/Delta; in contact its deviation from zero, shape (m, n)
      real(dp) :: mean_gap = 1.0_dp             !! G
      real(dp) :: residual = huge(1.0_dp)       !! root mean square of the violated conditions on the gap, over G (C9)
      integer :: corrections = 0                !! steps
      integer :: iterations = 0                 !! of all corrections
      integer :: local_iterations = 0           !! those of them preconditioned by the stencil
      integer :: plain_iterations = 0           !! those without extension of the gap
      logical :: converged = .false.
   end type grid_state

contains

   !> Solves (C1) on a grid. If it does not converge in most_iterations, state%converged is false.
   subroutine solve_on_grid(half_space, stencil, undeformed_gap, residual, most_iterations, state)
      type(compliance_operator), intent(inout) :: half_space   !! S, started on the grid
      type(local_stiffness), intent(in) :: stencil   !! likewise
      real(dp), intent(in) :: undeformed_gap(:, :)   !! h/Delta, shape (m, n)
      real(dp), intent(in) :: residual               !! the largest allowed (C9), > 0; 0: that of (C10)
      integer, intent(in) :: most_iterations
      type(grid_state), intent(inout) :: state       !! on entry `pressure` is the start, >= 0; its mean P in (0, 1) stays

      type(pressure_correction) :: correction
      logical(c_bool), allocatable :: inside(:, :)
      logical :: touched(size(undeformed_gap, 2))
      real(dp) :: allowed, last_residual

      last_residual = huge(1.0_dp)
      state%corrections = 0
      state%iterations = 0
      state%local_iterations = 0
      state%plain_iterations = 0
      do
         touched = any(state%pressure > 0.0_dp, dim=1)
         call compute_gap(half_space, undeformed_gap, touched, state)
         allowed = residual*abs(state%mean_gap)
         if (residual <= 0.0_dp) allowed = edge_tolerance*gap_at_edge(state, touched)
         allowed = max(allowed, rounding)
         state%converged = state%residual <= allowed .or. &
                           (state%residual <= most_rounding .and. 2*state%residual > last_residual)
         last_residual = state%residual
         if (state%converged .or. state%iterations >= most_iterations) exit
         call find_region(state, inside)
         call correction%start(inside, stencil, state%pressure, state%gap, state%residual)
         ! The correction needs its memory; the next step computes it anew.
         deallocate (state%gap)
         call correction%improve(half_space, max(correction_part, correction_margin*allowed/state%residual), &
                                 min(correction_limit, most_iterations - state%iterations))
         call correction%add_to(state%pressure)
         state%corrections = state%corrections + 1
         ! A correction without iterations corrects the approach alone. It counts, so that the number of steps is limited.
         state%iterations = state%iterations + max(1, correction%iterations)
         state%local_iterations = state%local_iterations + correction%local_iterations
         state%plain_iterations = state%plain_iterations + correction%plain_iterations
      end do
      state%residual = state%residual/max(abs(state%mean_gap), rounding)
   end subroutine solve_on_grid

   !> The gap h + Sp - approach (C1), whose mean in contact is zero (C3), and the residual times G. The approach is that
   !> of the present mean gap and a change: the change is a mean of small gaps and loses no digits.
   subroutine compute_gap(half_space, undeformed_gap, touched, state)
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(in) :: undeformed_gap(:, :)
      logical, intent(in) :: touched(:)   !! whether a column of the grid has points in contact, shape (n)
      type(grid_state), intent(inout) :: state

      real(dp) :: approach, change, sums(size(touched))
      integer :: counts(size(touched)), j, threads

      threads = threads_for(size(undeformed_gap))
      if (.not. allocated(state%gap)) allocate (state%gap, mold=undeformed_gap)
      approach = 1.0_dp - state%mean_gap
      associate (gap => state%gap, p => state%pressure, h => undeformed_gap)
         do j = 1, size(gap, 2)
            if (touched(j)) gap(:, j) = p(:, j)
         end do
         call half_space%displacement(gap, nonzero=touched)
         !$omp parallel do num_threads(threads)
         do j = 1, size(gap, 2)
            gap(:, j) = gap(:, j) + (h(:, j) - approach)
            sums(j) = 0.0_dp
            counts(j) = 0
            if (.not. touched(j)) cycle
            sums(j) = sum(gap(:, j), p(:, j) > 0.0_dp)
            counts(j) = count(p(:, j) > 0.0_dp)
         end do
         change = sum(sums)/sum(counts)
         !$omp parallel do num_threads(threads)
         do j = 1, size(gap, 2)
            gap(:, j) = gap(:, j) - change
            if (touched(j)) then
               sums(j) = sum(merge(gap(:, j), min(gap(:, j), 0.0_dp), p(:, j) > 0.0_dp)**2)
            else
               sums(j) = sum(min(gap(:, j), 0.0_dp)**2)
            end if
         end do
         state%mean_gap = 1.0_dp - (approach + change)
         state%residual = sqrt(sum(sums)/size(gap))
      end associate
   end subroutine compute_gap

   !> Root mean square of the gap at the points next to the contact, times the square root of the part of all points that
   !> are in contact [Delta], (C10); zero if all points are in contact.
   pure real(dp) function gap_at_edge(state, touched) result(gap)
      type(grid_state), intent(in) :: state
      logical, intent(in) :: touched(:)

      logical(c_bool) :: beside(size(state%gap, 1))
      real(dp) :: squares
      integer :: contact_points, edge_points, j, m, n

      m = size(state%gap, 1)
      n = size(state%gap, 2)
      squares = 0.0_dp
      edge_points = 0
      contact_points = 0
      associate (p => state%pressure)
         do j = 1, n
            if (.not. any(touched(max(j - 1, 1):min(j + 1, n)))) cycle
            beside = p(:, max(j - 1, 1)) > 0.0_dp .or. p(:, min(j + 1, n)) > 0.0_dp
            beside(2:) = beside(2:) .or. p(:m - 1, j) > 0.0_dp
            beside(:m - 1) = beside(:m - 1) .or. p(2:, j) > 0.0_dp
            beside = beside .and. .not. p(:, j) > 0.0_dp
            squares = squares + sum(merge(state%gap(:, j)**2, 0.0_dp, beside))
            edge_points = edge_points + count(beside)
            contact_points = contact_points + count(p(:, j) > 0.0_dp)
         end do
      end associate
      gap = sqrt(squares/max(edge_points, 1)*contact_points/(real(m, dp)*n))
   end function gap_at_edge

   !> The points that may be in contact after the next correction: those in contact or with a negative gap, and those
   !> within some steps of them.
   pure subroutine find_region(state, inside)
      type(grid_state), intent(in) :: state
      logical(c_bool), allocatable, intent(inout) :: inside(:, :)   !! shape (m, n)

      logical(c_bool) :: near(size(state%gap, 1), size(state%gap, 2))
      logical :: occupied(size(state%gap, 2))
      integer :: j, k, m, n

      m = size(state%gap, 1)
      n = size(state%gap, 2)
      if (.not. allocated(inside)) allocate (inside(m, n))
      do j = 1, n
         near(:, j) = state%pressure(:, j) > 0.0_dp .or. state%gap(:, j) < 0.0_dp
         occupied(j) = any(near(:, j))
         if (.not. occupied(j)) cycle
         inside(:, j) = near(:, j)
         do k = 1, min(halo, m - 1)
            near(:, j) = near(:, j) .or. cshift(inside(:, j), k) .or. cshift(inside(:, j), -k)
         end do
      end do
      inside = .false.
      do j = 1, n
         if (.not. occupied(j)) cycle
         do k = -min(halo, n - 1), min(halo, n - 1)
            associate (other => modulo(j + k - 1, n) + 1)
               inside(:, other) = inside(:, other) .or. near(:, j)
            end associate
         end do
      end do
   end subroutine find_region

end module wavycon_grid_solver
