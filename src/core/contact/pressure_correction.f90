!> Corrects a pressure whose gap violates the conditions of contact: one inner solution of `solve_on_grid`, in single
!> precision, on the points in and near the contact.
!>
!> Conjugate gradients on the points in contact, whose set is updated in each iteration, after Polonsky & Keer (Wear 231
!> (1999) 206-219), with a preconditioner and Polak & Ribiere's factor. Numbers (C..) are the equations of README.md in
!> this directory.
module wavycon_pressure_correction
   use wavycon_assertion, only: assert
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: longest_chunk
   use wavycon_contact_tuning, only: blocked_part, overlap_part, reach_of_layer, stencil_fraction
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

   !> Iterates by (C3) to (C8) until the residual is below a part of its start, or for a number of iterations. One field
   !> of the grid holds z, d, Sd, and what (C7) changes besides the step, one after another.
   subroutine correct_pressure(half_space, inside, part, most_iterations, grid, progress)
      type(compliance_operator), intent(inout) :: half_space
      !> > 0 at the points in and near the contact, shape of the pressure; not allocated afterwards.
      real(sp), allocatable, intent(inout) :: inside(:, :)
      real(dp), intent(in) :: part             !! of the residual at the start, in (0, 1)
      integer, intent(in) :: most_iterations   !! > 0
      !> On entry with pressure, gap and residual [Delta]; on return the gap is not allocated, as the correction needs
      !> its memory.
      type(grid_state), intent(inout) :: grid
      class(solver_progress), intent(in), optional :: progress   !! is asked before each iteration

      type(correction_state) :: state
      type(local_stiffness) :: stencil
      type(multilevel_preconditioner) :: extension
      real(dp) :: blocked, descent
      real(sp), allocatable :: r(:), d(:)      !! residual and direction of the last iteration, shape (region%points)
      real(sp), allocatable :: field(:, :)     !! own columns, shape (M, columns)
      integer :: iterations

      call assert(part > 0.0_dp .and. part < 1.0_dp, '0 < part < 1')
      call assert(most_iterations > 0, 'most_iterations > 0')
      call state%start(grid, inside)                                                 ! (C3)
      allocate (field, mold=inside)
      deallocate (inside, grid%gap)
      allocate (r(state%region%points), d(state%region%points), source=0.0_sp)
      descent = 0.0_dp
      ! Smaller overlaps may be rounding: such points would enter and leave the contact without end.
      state%allowance = real(overlap_part*part, sp)
      iterations = 0
      do while (state%residual > part*state%scale .and. iterations < most_iterations)
         if (present(progress)) grid%interrupted = progress%shall_stop(iterations, state%residual)
         if (grid%interrupted) return
         iterations = iterations + 1
         call precondition(extension, stencil, half_space, state, field)                      ! (C4): field = z
         call state%exclude_blocked(field, blocked)                                  ! (C4d)
         if (blocked > blocked_part*state%contact_points) &
            call precondition(extension, stencil, half_space, state, field)
         call find_direction(state, field, r, d, descent)                            ! (C5): field = d
         call state%displace(half_space, field)                                      !       field = Sd
         call take_step(state, half_space, r, d, field)                              ! (C6) to (C8), (C3)
      end do
      call state%add_to(grid)
      grid%corrections = grid%corrections + 1
      ! A correction without iterations corrects the approach alone. It counts, so that the number of steps is limited.
      grid%iterations = grid%iterations + max(1, iterations)
   end subroutine correct_pressure

   !> Computes z of (C4) from the residual r, without subtracting its mean: by the multilevel preconditioner, or at
   !> light loads by a stencil.
   subroutine precondition(extension, stencil, half_space, state, field)
      type(multilevel_preconditioner), intent(inout) :: extension   !! both are started when they are first needed
      type(local_stiffness), intent(inout) :: stencil
      type(compliance_operator), intent(inout) :: half_space
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
      if (.not. allocated(extension%contact)) call extension%start(state%slab%points, half_space%even, &
         reach=reach_of_layer*half_space%kernel%layer%thickness*maxval(half_space%stiffness_per_step))
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

   !> Computes the next direction by Polak & Ribiere's factor (C5), from z.
   !>
   !> The means of z and d over the contact follow from the sums of z and of the last direction. The gap has no mean
   !> there, so that that of z does not change (gap, z). That of r_old is zero as long as no point leaves.
   subroutine find_direction(state, field, residuals, direction, descent)
      type(correction_state), intent(in) :: state
      real(sp), intent(inout), contiguous :: field(:, :)    !! z, then d
      real(sp), intent(inout), contiguous :: residuals(:)   !! r_old, then r
      real(sp), intent(inout), contiguous :: direction(:)   !! d_old, then d
      real(dp), intent(inout) :: descent                    !! (gap_old, z_old), then (gap, z); zero: d = z

      real(dp) :: sums(5)
      real(dp), allocatable :: parts(:, :)
      real(sp) :: beta, mean, mean_before
      real(sp), dimension(longest_chunk) :: r, z
      integer :: c, n

      allocate (parts(size(sums), state%region%chunks))
      !$omp parallel do num_threads(state%region%threads) private(n, r, z)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1, contact => state%contact)
            n = b - a + 1
            call state%region%take_chunk(c, field, z)
            r(:n) = contact(a:b)*(state%gap(a:b) - state%approach)
            z(:n) = contact(a:b)*z(:n)
            parts(:, c) = [sdot(n, r, 1, z, 1), sdot(n, residuals(a:b), 1, z, 1), sdot(n, contact(a:b), 1, z, 1), &
                           sdot(n, contact(a:b), 1, residuals(a:b), 1), sdot(n, contact(a:b), 1, direction(a:b), 1)]
         end associate
      end do
      sums = state%totals(parts)
      associate (points => max(state%contact_points, 1.0_dp))
         mean = real(sums(3)/points, sp)
         mean_before = real(sums(5)/points, sp)
         ! A contact of one point has no direction and (gap, z) = 0: the search restarts.
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
            call state%region%put_chunk(c, direction(a:b), field)
         end associate
      end do
   end subroutine find_direction

   !> Moves pressure and gap by the step to the least energy along the direction (C6), within the bounds of the pressure
   !> and with its mean (C7), and updates the contact (C8).
   subroutine take_step(state, half_space, residuals, direction, field)
      type(correction_state), intent(inout) :: state
      type(compliance_operator), intent(inout) :: half_space
      real(sp), intent(in), contiguous :: residuals(:), direction(:)
      real(sp), intent(inout), contiguous :: field(:, :)   !! Sd; of no use afterwards

      real(dp) :: sums(4)
      real(dp), allocatable :: parts(:, :)
      real(sp) :: mean, step
      real(sp), dimension(longest_chunk) :: change, free, image
      integer :: c, n

      allocate (parts(size(sums), state%region%chunks), source=0.0_dp)
      !$omp parallel do num_threads(state%region%threads) private(image, n)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            call state%region%take_chunk(c, field, image)
            parts(:3, c) = [sdot(n, direction(a:b), 1, image, 1), sdot(n, residuals(a:b), 1, direction(a:b), 1), &
                            sdot(n, state%contact(a:b), 1, image, 1)]
         end associate
      end do
      sums = state%totals(parts)
      ! A contact of one point has no direction; overlaps may still be added.
      step = 0.0_sp
      if (sums(1) > 0.0_dp) step = real(sums(2)/sums(1), sp)
      mean = real(-step*sums(3)/max(state%contact_points, 1.0_dp), sp)
      ! The points that stay above zero and their pressures, the changes since the start, and the points that pass H.
      !$omp parallel do num_threads(state%region%threads) private(change, free, n)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1, start => state%start_pressure)
            n = b - a + 1
            change(:n) = max(state%change(a:b) - step*direction(a:b), -start(a:b))
            free(:n) = merge(state%contact(a:b), 0.0_sp, change(:n) > -start(a:b))
            parts(1, c) = sdot(n, free, 1, free, 1)
            parts(2, c) = sdot(n, free, 1, start(a:b), 1) + sdot(n, free, 1, change, 1)
            parts(3, c) = sdot(n, change, 1, ones, 1)
            if (.not. allocated(state%room)) cycle
            free(:n) = merge(state%contact(a:b), 0.0_sp, change(:n) >= state%room(a:b))
            parts(4, c) = sdot(n, free, 1, free, 1)
         end associate
      end do
      sums = state%totals(parts)
      if (sums(1) >= state%contact_points .and. sums(4) <= 0.0_dp) then
         call state%update_contact(mean, step, direction, field)
         return
      end if
      if (sums(4) > 0.0_dp) then
         call project(state, direction, step, field)
      else
         call restore_mean(state, direction, step, sums(2), sums(3), field)
      end if
      state%contact_is_new = .true.
      call state%displace(half_space, field)
      call state%update_contact(state%mean_gap(field))
   end subroutine take_step

   !> Moves the pressure by a step with which points leave the contact, and then multiplies it by the factor that
   !> restores its mean (C7).
   subroutine restore_mean(state, direction, step, load, change_sum, field)
      type(correction_state), intent(inout) :: state
      real(sp), intent(in), contiguous :: direction(:)
      real(sp), intent(in) :: step
      real(dp), intent(in) :: load                         !! sum of the pressures after the step
      real(dp), intent(in) :: change_sum                   !! of the changes since the start
      real(sp), intent(inout), contiguous :: field(:, :)   !! becomes what the pressure changes

      real(sp) :: excess, factor
      real(sp), dimension(longest_chunk) :: change, delta
      integer :: c, n

      excess = 0.0_sp
      factor = 0.0_sp
      if (load > 0.0_dp) excess = real(-change_sum/load, sp)
      ! The step may be so much longer than the pressure that what is left of it would be rounded to zero.
      if (excess <= -1.0_sp) factor = real(state%sum_of(real(state%start_pressure, dp))/load, sp)
      !$omp parallel do num_threads(state%region%threads) private(change, delta, n)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1, start => state%start_pressure)
            n = b - a + 1
            change(:n) = max(state%change(a:b) - step*direction(a:b), -start(a:b))
            state%contact(a:b) = merge(state%contact(a:b), 0.0_sp, change(:n) > -start(a:b))
            if (excess > -1.0_sp) then
               change(:n) = change(:n) + state%contact(a:b)*(excess*(start(a:b) + change(:n)))
            else
               change(:n) = merge(factor*(start(a:b) + change(:n)) - start(a:b), change(:n), &
                                  state%contact(a:b) > 0.0_sp)
            end if
            delta(:n) = change(:n) - state%change(a:b)
            state%change(a:b) = change(:n)
            call state%region%put_chunk(c, delta, field)
         end associate
      end do
   end subroutine restore_mean

   !> Moves the pressure at all free points by a step and the same shift that restores the mean, and then to the nearer
   !> bound if it is beyond it (C24). Close to H the step is much longer than what is left of it, and is computed in
   !> double precision.
   subroutine project(state, direction, step, field)
      type(correction_state), intent(inout) :: state
      real(sp), intent(in), contiguous :: direction(:)
      real(sp), intent(in) :: step
      real(sp), intent(inout), contiguous :: field(:, :)   !! becomes what the pressure changes

      real(dp), allocatable, dimension(:) :: above, below, change
      real(dp) :: shift
      real(sp) :: delta(longest_chunk)
      integer :: c, n

      associate (start => state%start_pressure, contact => state%contact)
         allocate (change, source=state%change - real(step, dp)*direction)
         above = contact*(start + change)
         below = contact*(state%room - change)
         shift = bounded_shift(state%slab, state%region%strip_places(), above, below, -state%sum_of(change))
         change = min(max(change + contact*shift, -real(start, dp)), real(state%room, dp))
      end associate
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            delta(:n) = real(change(a:b), sp) - state%change(a:b)
            state%change(a:b) = real(change(a:b), sp)
            where (state%change(a:b) <= -state%start_pressure(a:b) .or. state%change(a:b) >= state%room(a:b)) &
               state%contact(a:b) = 0.0_sp
            call state%region%put_chunk(c, delta, field)
         end associate
      end do
   end subroutine project

end module wavycon_pressure_correction
