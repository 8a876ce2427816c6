!> Corrects a pressure whose gap violates the conditions of contact. `solve_on_grid` calls this once in each step. The
!> correction is computed in single precision, at the points in and near the contact.
!>
!> The method is conjugate gradients on the points in contact, whose set is updated in each iteration, after Polonsky &
!> Keer (Wear 231 (1999) 206-219), with a preconditioner and the factor of Polak & Ribiere. Numbers (C..) are the
!> equations of README.md in this directory.
module wavycon_pressure_correction
   use wavycon_assertion, only: assert
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: longest_chunk
   use wavycon_contact_tuning, only: believed_overlap, blocked_part, first_step, least_foreseen, overlap_part, &
      plate_order, stencil_fraction, wandering_growth, whole_step
   use wavycon_correction_state, only: correction_state
   use wavycon_grid_state, only: grid_state
   use wavycon_kinds, only: dp, sp
   use wavycon_lapack, only: sdot
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_multilevel_preconditioner, only: multilevel_preconditioner
   use wavycon_pressure_load, only: bounded_shift
   use wavycon_solver_progress, only: solver_progress
   implicit none (type, external)
   private

   public :: correct_pressure

   real(sp), parameter :: ones(longest_chunk) = 1.0_sp

contains

   !> Iterates (C3) to (C8) until the residual is at most a given part of the residual at the start, or for a given
   !> number of iterations. To save memory one field of the grid holds z and S d, one after another.
   subroutine correct_pressure(half_space, inside, part, most_iterations, grid, progress)
      type(compliance_operator), intent(inout) :: half_space
      !> > 0 at the points whose pressure may change, shape of the pressure; not allocated afterwards.
      real(sp), allocatable, intent(inout) :: inside(:, :)
      real(dp), intent(in) :: part             !! part of the residual to be reached, in (0, 1)
      integer, intent(in) :: most_iterations   !! largest number of iterations, > 0
      !> On entry pressure, gap and residual [Delta] of one pressure. On return the pressure is corrected and the gap is
      !> not allocated, because the correction needs its memory.
      type(grid_state), intent(inout) :: grid
      class(solver_progress), intent(in), optional :: progress   !! `shall_stop` is called before each iteration

      type(correction_state) :: state
      type(local_stiffness) :: stencil
      type(multilevel_preconditioner) :: extension
      real(dp) :: blocked, descent
      real(dp) :: curvature                    !! (d, S d)
      real(sp), allocatable :: r(:), d(:)      !! residual and direction of the last iteration, shape (region%points)
      real(sp), allocatable :: change(:)       !! minus the change of the pressure in a step that meets a bound
      real(sp), allocatable :: field(:, :)     !! shape of the pressure
      real(sp) :: expected_step                !! of the next iteration; 0: unknown
      real(sp) :: step                         !! tau of (C6), nu of (C7a)
      integer :: iterations
      logical :: is_foreseen                   !! whether d is minus the change of the pressure (C7a)
      logical :: is_plate                      !! whether a stiff layer bends like a plate (C8c)

      call assert(part > 0.0_dp .and. part < 1.0_dp, '0 < part < 1')
      call assert(most_iterations > 0, 'most_iterations > 0')
      call state%start(grid, inside)                                                 ! (C3)
      allocate (field, mold=inside)
      deallocate (inside, grid%gap)
      allocate (r(state%region%points), d(state%region%points), source=0.0_sp)
      descent = 0.0_dp
      ! A smaller overlap may be rounding: a point that has it would enter and leave the contact again and again.
      state%allowance = real(overlap_part*part, sp)
      expected_step = real(first_step, sp)
      is_plate = half_space%steepest_order < plate_order
      if (is_plate) state%part_of_free_gap = real(believed_overlap, sp)
      iterations = 0
      do while (state%residual > part*state%scale .and. iterations < most_iterations)
         if (present(progress)) grid%interrupted = progress%shall_stop(iterations, &
            state%residual/max(state%residual, grid%size_of_gaps() - state%scale*state%approach))   ! (C9)
         if (grid%interrupted) return
         iterations = iterations + 1
         if (state%residual > wandering_growth*state%scale) state%part_of_free_gap = real(believed_overlap, sp)
         call precondition(extension, stencil, half_space, state, field)                      ! (C4): field = z
         call state%exclude_blocked(field, blocked)                                  ! (C4d)
         if (blocked > blocked_part*state%contact_points) &
            call precondition(extension, stencil, half_space, state, field)
         call find_direction(state, field, r, d, descent)                            ! (C5)
         if (is_plate) expected_step = 0.0_sp                                        ! no (C7a)
         call bound_step(state, expected_step, .true., d, change)                    ! (C7a)
         is_foreseen = allocated(change)
         if (is_foreseen) call move_alloc(change, d)
         call state%displace(half_space, d, field)                                   !       field = Sd
         call find_least_energy(state, r, d, field, step, curvature)                 ! (C6)
         if (is_foreseen) then
            expected_step = expected_step*step
            if (step < least_foreseen) expected_step = 0.0_sp
            step = max(step, 0.0_sp)
            if (step > whole_step) step = 1.0_sp
            descent = step*curvature                                                 ! (C7b)
         else
            expected_step = step
            call bound_step(state, step, .false., d, change)                         ! (C7), (C24)
         end if
         if (allocated(change)) then
            call state%displace(half_space, change, field)
            call state%take_step(1.0_sp, change, field)                              ! (C8), (C3)
         else
            call state%take_step(step, d, field)
         end if
      end do
      call state%add_to(grid)
      ! A correction without iterations changes the approach alone. It counts as one iteration, because otherwise the
      ! number of steps in `solve_on_grid` would not be limited.
      grid%iterations = grid%iterations + max(1, iterations)
   end subroutine correct_pressure

   !> Computes z = B r of (C4) from the residual r; the mean of z is not subtracted. B is the multilevel preconditioner
   !> J' T J, or at light loads a stencil.
   subroutine precondition(extension, stencil, half_space, state, field)
      type(multilevel_preconditioner), intent(inout) :: extension   !! J; is started when it is first needed
      type(local_stiffness), intent(inout) :: stencil               !! is started when it is first needed
      type(compliance_operator), intent(inout) :: half_space        !! T = S^-1, started on the grid
      type(correction_state), intent(inout) :: state
      real(sp), intent(inout), contiguous :: field(:, :)   !! becomes z, shape (M, slab%columns())

      integer :: c

      if (state%contact_points < stencil_fraction*product(real(state%slab%points, dp))) then
         if (.not. stencil%is_started) call stencil%start(half_space, state%slab)
         if (stencil%exists) then
            call state%put_residual(stencil%field(1:state%slab%points(1), 1:state%slab%columns()))
            call stencil%apply(state%slab, state%region, field)
            return
         end if
      end if
      field = 0.0_sp
      call state%put_residual(field)
      if (.not. allocated(extension%contact)) &
         call extension%start(state%slab, half_space%even, half_space%kernel, half_space%frequency_of_step)
      if (state%contact_is_new) then
         !$omp parallel do num_threads(state%region%threads)
         do c = 1, state%region%chunks
            call state%region%put_chunk(c, state%contact(state%region%chunk(c):state%region%chunk(c + 1) - 1), &
                                        extension%contact)
         end do
         call extension%average_contact()
         state%contact_is_new = .false.
      end if
      call extension%extend(field)
      call half_space%pressure(field)
      call extension%collect(field)
   end subroutine precondition

   !> Computes the next direction (C5) from z, with the factor of Polak & Ribiere.
   !>
   !> One pass and one message compute the five sums of (C8a), from which both means and the factor follow. The mean of
   !> z is not subtracted from z in (gap, z): the gap has no mean over the free points, so that the product does not
   !> change. In (r_old, z) it matters, because r_old has a mean when points have left the contact.
   subroutine find_direction(state, field, residuals, direction, descent)
      type(correction_state), intent(in) :: state
      real(sp), intent(in), contiguous :: field(:, :)       !! z, shape (M, slab%columns())
      real(sp), intent(inout), contiguous :: residuals(:)   !! on entry r_old, on return r; shape (region%points)
      real(sp), intent(inout), contiguous :: direction(:)   !! on entry d_old, on return d; shape (region%points)
      !> On entry (gap_old, z_old), after a change (C7a) that of (C7b); on return (gap, z). Zero on entry restarts the
      !> search with beta = 0.
      real(dp), intent(inout) :: descent

      real(dp) :: sums(5)
      real(dp), allocatable :: chunk_sums(:, :)
      real(sp) :: beta, mean, mean_before   ! means of z and of d_old over the free points
      real(sp), dimension(longest_chunk) :: r, z
      integer :: c, n

      allocate (chunk_sums(size(sums), state%region%chunks))
      !$omp parallel do num_threads(state%region%threads) private(n, r, z)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1, contact => state%contact)
            n = b - a + 1
            call state%region%take_chunk(c, field, z)
            r(:n) = contact(a:b)*(state%gap(a:b) - state%approach)
            z(:n) = contact(a:b)*z(:n)
            chunk_sums(:, c) = [sdot(n, r, 1, z, 1), sdot(n, residuals(a:b), 1, z, 1), &
                                sdot(n, contact(a:b), 1, z, 1), sdot(n, contact(a:b), 1, residuals(a:b), 1), &
                                sdot(n, contact(a:b), 1, direction(a:b), 1)]
         end associate
      end do
      sums = state%totals(chunk_sums)
      associate (points => max(state%contact_points, 1.0_dp))
         mean = real(sums(3)/points, sp)
         mean_before = real(sums(5)/points, sp)
         ! If only one point is free its direction is zero, and (gap, z) = 0: the search restarts.
         beta = 0.0_sp
         if (descent > tiny(descent)) &
            beta = real(max((sums(1) - (sums(2) - sums(3)*sums(4)/points))/descent, 0.0_dp), sp)
      end associate
      descent = sums(1)
      !$omp parallel do num_threads(state%region%threads) private(n, z)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1, contact => state%contact)
            n = b - a + 1
            call state%region%take_chunk(c, field, z)
            residuals(a:b) = contact(a:b)*(state%gap(a:b) - state%approach)
            direction(a:b) = contact(a:b)*((z(:n) - mean) + beta*(direction(a:b) - mean_before))
         end associate
      end do
   end subroutine find_direction

   !> If a step along the direction would take points to a bound: computes the change of the pressure that keeps it
   !> within its bounds and keeps its mean, (C7), (C7a) or (C24). The factor of the mean is 1 + excess. A step that is
   !> only foreseen is left as it is if it may be a bad one, or takes points to a hardness.
   subroutine bound_step(state, step, is_foreseen, direction, change)
      type(correction_state), intent(in) :: state
      real(sp), intent(in) :: step                              !! tau, or tau_e, 0: unknown
      logical, intent(in) :: is_foreseen                        !! whether the step is tau_e of (C7a)
      real(sp), intent(in), contiguous :: direction(:)          !! d, shape (region%points)
      !> Minus the change, shape (region%points); not allocated if the step is left as it is.
      real(sp), allocatable, intent(out) :: change(:)

      real(dp) :: sums(4)
      real(sp) :: after(longest_chunk), excess, factor
      integer :: c, n

      if (is_foreseen .and. step <= 0.0_sp) return
      sums = sums_after(state, direction, step)
      if (sums(1) >= state%contact_points .and. sums(4) <= 0.0_dp) return
      ! A step after which the sum of the pressures is more than twice the right one is foreseen badly.
      if (is_foreseen .and. (sums(1) <= 0.0_dp .or. sums(3) >= 0.5_dp*sums(2) .or. sums(4) > 0.0_dp)) return
      allocate (change(size(direction)))
      if (sums(4) > 0.0_dp) then
         call project(state, step, direction, change)
         return
      end if
      excess = 0.0_sp
      factor = 0.0_sp
      if (sums(2) > 0.0_dp) excess = real(-sums(3)/sums(2), sp)
      ! The step may be so much longer than the pressure that the factor 1 + excess would be rounded to zero or less.
      ! The factor is then computed from the sum of the pressures at the start.
      if (excess <= -1.0_sp) factor = real(state%sum_of(real(state%start_pressure, dp))/sums(2), sp)
      !$omp parallel do num_threads(state%region%threads) private(after, n)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1, start => state%start_pressure)
            n = b - a + 1
            after(:n) = max(state%change(a:b) - step*direction(a:b), -start(a:b))
            if (excess > -1.0_sp) then
               after(:n) = after(:n) + state%contact(a:b)*(excess*(start(a:b) + after(:n)))
            else
               where (after(:n) > -start(a:b)) after(:n) = factor*(start(a:b) + after(:n)) - start(a:b)
            end if
            change(a:b) = state%change(a:b) - after(:n)
         end associate
      end do
   end subroutine bound_step

   !> The step to the least energy along the direction (C6).
   subroutine find_least_energy(state, residuals, direction, field, step, curvature)
      type(correction_state), intent(in) :: state
      real(sp), intent(in), contiguous :: residuals(:), direction(:)   !! r and d, shape (region%points)
      real(sp), intent(in), contiguous :: field(:, :)   !! S d, shape (M, slab%columns())
      real(sp), intent(out) :: step                     !! tau of (C6)
      real(dp), intent(out) :: curvature                !! (d, S d)

      real(dp), allocatable :: chunk_sums(:, :)
      real(dp) :: sums(2)
      real(sp) :: image(longest_chunk)
      integer :: c, n

      allocate (chunk_sums(size(sums), state%region%chunks))
      !$omp parallel do num_threads(state%region%threads) private(image, n)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            call state%region%take_chunk(c, field, image)
            chunk_sums(:, c) = [sdot(n, direction(a:b), 1, image, 1), sdot(n, residuals(a:b), 1, direction(a:b), 1)]
         end associate
      end do
      sums = state%totals(chunk_sums)
      ! If only one point is free the direction and the step are zero, but points may still enter the contact.
      step = 0.0_sp
      if (sums(1) > 0.0_dp) step = real(sums(2)/sums(1), sp)
      curvature = sums(1)
   end subroutine find_least_energy

   !> Sums over the grid after a step that keeps the pressure at zero or above: number of the free points whose pressure
   !> stays above zero, sum of their pressures, sum of the changes since the start, and number of the points that
   !> reach H.
   function sums_after(state, direction, step) result(sums)
      type(correction_state), intent(in) :: state
      real(sp), intent(in), contiguous :: direction(:)     !! d, shape (region%points)
      real(sp), intent(in) :: step                         !! what the direction is multiplied by
      real(dp) :: sums(4)

      real(dp), allocatable :: chunk_sums(:, :)
      real(sp), dimension(longest_chunk) :: change, free
      integer :: c, n

      allocate (chunk_sums(size(sums), state%region%chunks), source=0.0_dp)
      !$omp parallel do num_threads(state%region%threads) private(change, free, n)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1, start => state%start_pressure)
            n = b - a + 1
            change(:n) = max(state%change(a:b) - step*direction(a:b), -start(a:b))
            free(:n) = merge(1.0_sp, 0.0_sp, change(:n) > -start(a:b))
            free(:n) = state%contact(a:b)*free(:n)
            chunk_sums(1, c) = sdot(n, free, 1, free, 1)
            chunk_sums(2, c) = sdot(n, free, 1, start(a:b), 1) + sdot(n, free, 1, change, 1)
            chunk_sums(3, c) = sdot(n, change, 1, ones, 1)
            if (.not. allocated(state%below_hardness)) cycle
            free(:n) = merge(1.0_sp, 0.0_sp, change(:n) >= state%below_hardness(a:b))
            free(:n) = state%contact(a:b)*free(:n)
            chunk_sums(4, c) = sdot(n, free, 1, free, 1)
         end associate
      end do
      sums = state%totals(chunk_sums)
   end function sums_after

   !> The change of the pressure by a step that takes points to H, projected on the allowed pressures (C24): all free
   !> points get the same shift, and a pressure beyond a bound becomes this bound. The shift is that which restores the
   !> mean. Close to H only a small part of a long step is left after this, so that the change is computed in double
   !> precision.
   subroutine project(state, step, direction, change)
      type(correction_state), intent(in) :: state
      real(sp), intent(in) :: step                              !! tau of (C6)
      real(sp), intent(in), contiguous :: direction(:)          !! d, shape (region%points)
      real(sp), intent(out), contiguous :: change(:)            !! minus the change, shape (region%points)

      real(dp), allocatable, dimension(:) :: above, after, below
      real(dp) :: shift

      associate (start => state%start_pressure, contact => state%contact)
         allocate (after, source=state%change - real(step, dp)*direction)
         above = contact*(start + after)
         below = contact*(state%below_hardness - after)
         shift = bounded_shift(state%slab, state%region%chunk(state%region%strip_chunk), above, below, &
                               -state%sum_of(after))
         after = min(max(after + contact*shift, -real(start, dp)), real(state%below_hardness, dp))
         change = real(state%change - after, sp)
         ! With this addition rounding does not leave the pressure below H.
         where (contact > 0.0_sp .and. after >= state%below_hardness) &
            change = change - 2*spacing(max(abs(state%change), state%below_hardness))
      end associate
   end subroutine project

end module wavycon_pressure_correction
