!> Minimises the complementary energy 1/2 (p, Sp) + (p, h) over the pressures p >= 0 of given mean on a grid.
!>
!> Outer steps compute the gap of the pressure at all points in double precision, verify the conditions of contact there
!> and find the points that may be in contact. Between them the pressure is corrected at these points in single precision
!> (`pressure_correction`), which reduces the residual by some four digits.
!>
!> Numbers (C..) are the equations of README.md in this directory.
module wavycon_grid_solver
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_tuning, only: correction_limit, correction_margin, correction_part, edge_tolerance, halo
   use wavycon_kinds, only: dp
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_pressure_correction, only: pressure_correction
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
      integer :: local_iterations = 0           !! those preconditioned by a stencil in place of transforms
      integer :: corrections = 0
      logical :: converged = .false.
   end type grid_state

contains

   !> Solves (C1) on a grid by the iteration (C3) to (C9). If it does not converge in most_iterations, state%converged
   !> is false.
   subroutine solve_on_grid(half_space, stencil, undeformed_gap, residual, most_iterations, state)
      type(compliance_operator), intent(inout) :: half_space   !! S, started on the grid
      type(local_stiffness), intent(in) :: stencil   !! likewise
      real(dp), intent(in) :: undeformed_gap(:, :)   !! h/Delta, shape (m, n)
      real(dp), intent(in) :: residual               !! (C9) to which it is solved; 0: as the edge needs it (C10)
      integer, intent(in) :: most_iterations
      type(grid_state), intent(inout) :: state       !! on entry `pressure` is the start, >= 0; its mean P in (0, 1) stays

      type(pressure_correction) :: correction
      logical, allocatable :: inside(:, :)
      real(dp) :: allowed

      state%iterations = 0
      state%local_iterations = 0
      state%corrections = 0
      do
         call compute_gap(half_space, undeformed_gap, state)
         allowed = residual*abs(state%mean_gap)
         if (residual <= 0.0_dp) allowed = edge_tolerance*gap_at_edge(state)
         allowed = max(allowed, rounding)
         state%converged = state%residual <= allowed
         if (state%converged .or. state%iterations >= most_iterations) exit
         call find_region(state, inside)
         call correction%start(inside, stencil%even, stencil, state%pressure, state%gap, state%residual)
         call correction%improve(half_space, max(correction_part, correction_margin*allowed/state%residual), &
                                 min(correction_limit, most_iterations - state%iterations))
         call correction%add_to(state%pressure)
         state%iterations = state%iterations + correction%iterations
         state%local_iterations = state%local_iterations + correction%local_iterations
         state%corrections = state%corrections + 1
      end do
      state%residual = state%residual/max(abs(state%mean_gap), rounding)
   end subroutine solve_on_grid

   !> The gap h + Sp - approach (C1), with a mean of zero in contact, and the residual times G.
   subroutine compute_gap(half_space, undeformed_gap, state)
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(in) :: undeformed_gap(:, :)
      type(grid_state), intent(inout) :: state

      real(dp) :: sums(size(undeformed_gap, 2)), approach
      integer :: counts(size(undeformed_gap, 2)), j, threads

      threads = threads_for(size(undeformed_gap))
      if (.not. allocated(state%gap)) allocate (state%gap, mold=undeformed_gap)
      associate (gap => state%gap, p => state%pressure, h => undeformed_gap)
         gap = p
         call half_space%displacement(gap)
         !$omp parallel do num_threads(threads)
         do j = 1, size(gap, 2)
            gap(:, j) = gap(:, j) + h(:, j)
            sums(j) = sum(gap(:, j), p(:, j) > 0.0_dp)
            counts(j) = count(p(:, j) > 0.0_dp)
         end do
         approach = sum(sums)/sum(counts)
         !$omp parallel do num_threads(threads)
         do j = 1, size(gap, 2)
            gap(:, j) = gap(:, j) - approach
            sums(j) = sum(merge(gap(:, j), min(gap(:, j), 0.0_dp), p(:, j) > 0.0_dp)**2)
         end do
         state%mean_gap = 1.0_dp - approach
         state%residual = sqrt(sum(sums)/size(gap))
      end associate
   end subroutine compute_gap

   !> Root mean square of the gap at the points next to the contact, times the square root of the part of the points that
   !> are in contact [Delta]; zero if all are.
   pure real(dp) function gap_at_edge(state) result(gap)
      type(grid_state), intent(in) :: state

      real(dp) :: squares
      integer :: edge_points, i, j, m, n

      m = size(state%gap, 1)
      n = size(state%gap, 2)
      squares = 0.0_dp
      edge_points = 0
      do j = 1, n
         do i = 1, m
            if (state%pressure(i, j) > 0.0_dp) cycle
            if (.not. (any(state%pressure(max(i - 1, 1):min(i + 1, m), j) > 0.0_dp) .or. &
               any(state%pressure(i, max(j - 1, 1):min(j + 1, n)) > 0.0_dp))) cycle
            squares = squares + state%gap(i, j)**2
            edge_points = edge_points + 1
         end do
      end do
      gap = sqrt(squares/max(edge_points, 1)*count(state%pressure > 0.0_dp)/(real(m, dp)*n))
   end function gap_at_edge

   !> The points that may be in contact after the next correction: those in contact or with a negative gap, and their
   !> neighbours.
   subroutine find_region(state, inside)
      type(grid_state), intent(in) :: state
      logical, allocatable, intent(inout) :: inside(:, :)   !! shape (m, n)

      integer :: k, m, n

      inside = state%pressure > 0.0_dp .or. state%gap < 0.0_dp
      m = size(inside, 1)
      n = size(inside, 2)
      do k = 1, halo
         if (m > 1) inside = inside .or. cshift(inside, 1, 1) .or. cshift(inside, -1, 1)
         if (n > 1) inside = inside .or. cshift(inside, 1, 2) .or. cshift(inside, -1, 2)
      end do
   end subroutine find_region

end module wavycon_grid_solver
