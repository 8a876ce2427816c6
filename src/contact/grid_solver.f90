!> Minimises the complementary energy 1/2 (p, Sp) + (p, h) over the pressures 0 <= p <= H of given mean on a grid. H is
!> the hardness; elastic bodies have none.
!>
!> Each step computes the gap of the present pressure at all points, in double precision, and verifies the conditions
!> of contact there. It then selects the points in and near the contact, and corrects the pressure at these points in
!> single precision (`pressure_correction`). A step reduces the residual by some four digits.
!>
!> Numbers (C..) are the equations of README.md in this directory.
module wavycon_grid_solver
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_tuning, only: correction_limit, correction_margin, correction_part, edge_tolerance, halo
   use wavycon_grid_slab, only: grid_slab
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
      type(grid_slab) :: slab                   !! of the grid: the fields are the own columns
      real(dp), allocatable :: pressure(:, :)   !! p/p*, 0 <= p <= H, shape (m, n)
      !> gap/Delta, negative where the surfaces overlap: at free points its deviation from zero, shape (m, n)
      real(dp), allocatable :: gap(:, :)
      real(dp) :: hardness = huge(1.0_dp)       !! H/p*, huge if there is none
      real(dp) :: mean_gap = 1.0_dp             !! 1 - approach; without a hardness G
      real(dp) :: imprint = 0.0_dp              !! mean over the cell of the overlap where p = H [Delta] (C22)
      real(dp) :: residual = huge(1.0_dp)       !! root mean square of the violated conditions on the gap, over G (C9)
      integer :: corrections = 0                !! steps
      integer :: iterations = 0                 !! of all corrections
      integer :: local_iterations = 0           !! those of them preconditioned by the stencil
      integer :: plain_iterations = 0           !! those without extension of the gap
      logical :: converged = .false.
   contains
      procedure :: open_gap
   end type grid_state

contains

   !> Solves (C1) on a grid. If it does not converge in most_iterations, state%converged is false.
   subroutine solve_on_grid(half_space, stencil, undeformed_gap, residual, most_iterations, state)
      type(compliance_operator), intent(inout) :: half_space   !! S, started on the grid
      type(local_stiffness), intent(in) :: stencil   !! likewise
      real(dp), intent(in) :: undeformed_gap(:, :)   !! h/Delta, shape (m, n)
      real(dp), intent(in) :: residual               !! the largest allowed (C9), > 0; 0: that of (C10)
      integer, intent(in) :: most_iterations
      !> On entry `hardness` is set and `pressure` is the start, 0 <= p <= H; its mean P in (0, H) stays.
      type(grid_state), intent(inout) :: state

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
         allowed = residual*size_of_gaps(state)
         if (residual <= 0.0_dp) allowed = edge_tolerance*gap_at_edge(state, touched)
         allowed = max(allowed, rounding)
         state%converged = state%residual <= allowed .or. &
                           (state%residual <= most_rounding .and. 2*state%residual > last_residual)
         last_residual = state%residual
         if (state%converged .or. state%iterations >= most_iterations) exit
         call find_region(state, inside)
         call correction%start(inside, stencil, state%pressure, state%gap, state%residual, state%hardness)
         ! The correction needs its memory; the next step computes it anew.
         deallocate (state%gap)
         call correction%improve(half_space, max(correction_part, correction_margin*allowed/state%residual), &
                                 min(correction_limit, most_iterations - state%iterations))
         call correction%add_to(state%pressure)
         state%corrections = state%corrections + 1
         ! A correction without iterations corrects the approach alone. It counts, so that the number of steps is
         ! limited.
         state%iterations = state%iterations + max(1, correction%iterations)
         state%local_iterations = state%local_iterations + correction%local_iterations
         state%plain_iterations = state%plain_iterations + correction%plain_iterations
      end do
      state%residual = state%residual/max(size_of_gaps(state), rounding)
   end subroutine solve_on_grid

   !> The mean gap of surfaces that touch where they overlap, G [Delta]: zero if no point is open.
   pure real(dp) function open_gap(self)
      class(grid_state), intent(in) :: self   !! solved

      open_gap = self%mean_gap + self%imprint
      if (self%hardness >= huge(self%hardness)) return
      if (.not. any(self%pressure <= 0.0_dp)) open_gap = 0.0_dp
   end function open_gap

   !> The mean of |gap| [Delta]: G without a hardness.
   pure real(dp) function size_of_gaps(state)
      type(grid_state), intent(in) :: state

      size_of_gaps = abs(state%open_gap() + state%imprint)
   end function size_of_gaps

   !> Whether a pressure lies between its bounds: the gap is zero there.
   elemental logical function is_free(pressure, hardness)
      real(dp), intent(in) :: pressure, hardness

      is_free = pressure > 0.0_dp .and. pressure < hardness
   end function is_free

   !> By how much a gap violates (C1) or (C21).
   elemental real(dp) function violation(gap, pressure, hardness)
      real(dp), intent(in) :: gap, pressure, hardness

      violation = merge(merge(gap, max(gap, 0.0_dp), pressure < hardness), min(gap, 0.0_dp), pressure > 0.0_dp)
   end function violation

   !> The gap h + Sp - approach (C1), whose mean over the free points is zero (C3), and the residual times G. The
   !> approach is that of the present mean gap and a change: the change is a mean of small gaps and loses no digits.
   subroutine compute_gap(half_space, undeformed_gap, touched, state)
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(in) :: undeformed_gap(:, :)
      logical, intent(in) :: touched(:)   !! whether a column of the grid has points in contact, shape (n)
      type(grid_state), intent(inout) :: state

      real(dp) :: approach, change, overlaps(size(touched)), sums(size(touched))
      integer :: counts(size(touched)), j, threads

      threads = threads_for(size(undeformed_gap))
      if (.not. allocated(state%gap)) allocate (state%gap, mold=undeformed_gap)
      approach = 1.0_dp - state%mean_gap
      associate (gap => state%gap, p => state%pressure, h => undeformed_gap, hardness => state%hardness)
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
            sums(j) = sum(gap(:, j), is_free(p(:, j), hardness))
            counts(j) = count(is_free(p(:, j), hardness))
         end do
         if (hardness >= huge(hardness) .or. any(counts > 0)) then
            change = sum(sums)/sum(counts)
         else
            change = middle_between(minval(gap, p <= 0.0_dp), maxval(gap, p >= hardness))
         end if
         if (hardness < huge(hardness)) call reduce_violation(gap, p, hardness, change)
         !$omp parallel do num_threads(threads)
         do j = 1, size(gap, 2)
            gap(:, j) = gap(:, j) - change
            overlaps(j) = 0.0_dp
            if (touched(j)) then
               sums(j) = sum(violation(gap(:, j), p(:, j), hardness)**2)
               if (hardness < huge(hardness)) overlaps(j) = sum(max(-gap(:, j), 0.0_dp), p(:, j) >= hardness)
            else
               sums(j) = sum(min(gap(:, j), 0.0_dp)**2)
            end if
         end do
         state%imprint = sum(overlaps)/size(gap)
         state%mean_gap = 1.0_dp - (approach + change)
         state%residual = sqrt(sum(sums)/size(gap))
      end associate
   end subroutine compute_gap

   !> Changes the approach to that of the least residual: the mean over the free points and those that it violates. A
   !> few free points alone may have a gap that makes many others violate their conditions.
   pure subroutine reduce_violation(gap, pressure, hardness, change)
      real(dp), intent(in) :: gap(:, :), pressure(:, :), hardness
      real(dp), intent(inout) :: change   !! of the approach [Delta]

      !> The residual is a piecewise quadratic function of the approach; Newton's method ends in a few steps.
      integer, parameter :: most_steps = 20
      real(dp) :: next, total
      integer :: j, points, step

      do step = 1, most_steps
         total = 0.0_dp
         points = 0
         do j = 1, size(gap, 2)
            associate (counts => abs(violation(gap(:, j) - change, pressure(:, j), hardness)) > 0.0_dp &
                       .or. is_free(pressure(:, j), hardness))
               total = total + sum(gap(:, j), counts)
               points = points + count(counts)
            end associate
         end do
         if (points == 0) exit
         next = total/points
         if (abs(next - change) <= epsilon(change)*abs(change)) exit
         change = next
      end do
   end subroutine reduce_violation

   !> Where no point is free, the approach may lie anywhere between the least gap at points that are open and the
   !> largest at points at the hardness.
   pure real(dp) function middle_between(open, capped) result(middle)
      real(dp), intent(in) :: open     !! huge if no point is open
      real(dp), intent(in) :: capped

      middle = capped
      if (open < huge(open)) middle = 0.5_dp*(open + capped)
   end function middle_between

   !> Root mean square of the gap at the points next to the free ones, times the square root of the part of all points
   !> that are free [Delta], (C10); zero if all points are.
   pure real(dp) function gap_at_edge(state, touched) result(gap)
      type(grid_state), intent(in) :: state
      logical, intent(in) :: touched(:)

      logical(c_bool), allocatable :: free(:, :)
      logical(c_bool) :: beside(size(state%gap, 1))
      real(dp) :: squares
      integer :: contact_points, edge_points, j, m, n

      m = size(state%gap, 1)
      n = size(state%gap, 2)
      squares = 0.0_dp
      edge_points = 0
      contact_points = 0
      allocate (free(m, n))
      do j = 1, n
         free(:, j) = .false.
         if (touched(j)) free(:, j) = is_free(state%pressure(:, j), state%hardness)
      end do
      do j = 1, n
         if (.not. any(touched(max(j - 1, 1):min(j + 1, n)))) cycle
         beside = free(:, max(j - 1, 1)) .or. free(:, min(j + 1, n))
         beside(2:) = beside(2:) .or. free(:m - 1, j)
         beside(:m - 1) = beside(:m - 1) .or. free(2:, j)
         beside = beside .and. .not. free(:, j)
         squares = squares + sum(merge(state%gap(:, j)**2, 0.0_dp, beside))
         edge_points = edge_points + count(beside)
         contact_points = contact_points + count(free(:, j))
      end do
      gap = sqrt(squares/max(edge_points, 1)*contact_points/(real(m, dp)*n))
   end function gap_at_edge

   !> The points that may be free after the next correction: those that are free or whose gap has the wrong sign, and
   !> those within some steps of them.
   pure subroutine find_region(state, inside)
      type(grid_state), intent(in) :: state
      logical(c_bool), allocatable, intent(inout) :: inside(:, :)   !! shape (m, n)

      logical(c_bool) :: near(size(state%gap, 1), size(state%gap, 2))
      logical :: has_hardness, occupied(size(state%gap, 2))
      integer :: j, k, m, n

      m = size(state%gap, 1)
      n = size(state%gap, 2)
      has_hardness = state%hardness < huge(state%hardness)
      if (.not. allocated(inside)) allocate (inside(m, n))
      do j = 1, n
         near(:, j) = state%pressure(:, j) > 0.0_dp .or. state%gap(:, j) < 0.0_dp
         if (has_hardness) then
            where (state%pressure(:, j) >= state%hardness) near(:, j) = state%gap(:, j) > 0.0_dp
         end if
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
