!> Corrects a pressure whose gap violates the conditions of contact: one inner solution of `solve_on_grid`, in single
!> precision, on the points in and near the contact.
!>
!> Conjugate gradients on the points in contact, whose set is updated in each iteration, after Polonsky & Keer (Wear 231
!> (1999) 206-219), with a preconditioner and Polak & Ribiere's factor. Numbers (C..) are the equations of README.md in
!> this directory. An iteration in which no point leaves the contact has three sums over the grid.
module wavycon_pressure_correction
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_assertion, only: assert
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: longest_chunk
   use wavycon_contact_tuning, only: blocked_part, overlap_part
   use wavycon_correction_preconditioner, only: correction_preconditioner
   use wavycon_correction_state, only: correction_state, gap_sums
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_lapack, only: sdot
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_pressure_load, only: set_load, sum_of_field
   use wavycon_pressure_step, only: take_step
   use wavycon_solver_progress, only: solver_progress
   implicit none (type, external)
   private

   public :: pressure_correction

   type :: pressure_correction
      integer :: iterations = 0
      logical :: is_interrupted = .false.     !! whether `progress` ended the last call of `improve`
      type(correction_preconditioner) :: preconditioner
      type(correction_state), private :: state
   contains
      procedure :: start
      procedure :: improve
      procedure :: add_to
   end type pressure_correction

contains

   subroutine start(self, slab, inside, stencil, pressure, gap, residual, hardness)
      class(pressure_correction), intent(out) :: self
      type(grid_slab), intent(in) :: slab         !! this and the others as of `correction_state%start`
      logical(c_bool), intent(in) :: inside(:, :)
      type(local_stiffness), intent(in) :: stencil
      real(dp), intent(in) :: pressure(:, :), gap(:, :), residual, hardness

      call self%state%start(slab, inside, pressure, gap, residual, hardness)
      self%preconditioner%stencil = stencil
   end subroutine start

   !> Iterates by (C3) to (C8) until the residual is below a part of its start, or for a number of iterations. One field
   !> of the grid holds z, d, Sd, and what (C7) changes besides the step, one after another.
   subroutine improve(self, half_space, part, most_iterations, progress)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(in) :: part             !! of the residual at the start, in (0, 1)
      integer, intent(in) :: most_iterations   !! > 0
      class(solver_progress), intent(in), optional :: progress   !! is asked before each iteration

      real(dp) :: blocked, descent, sums(gap_sums)
      real(sp), allocatable :: r(:), d(:)      !! residual and direction of the last iteration, shape (region%points)
      real(sp), allocatable :: field(:, :)     !! own columns, shape (M, columns)
      real(sp) :: step
      logical :: has_met_bounds

      call assert(part > 0.0_dp .and. part < 1.0_dp, '0 < part < 1')
      call assert(most_iterations > 0, 'most_iterations > 0')
      associate (state => self%state)
         allocate (r(state%region%points), d(state%region%points), source=0.0_sp)
         allocate (field(state%slab%points(1), state%slab%columns()))
         descent = 0.0_dp
         sums = state%measure_gap()
         if (state%has_points_at_hardness()) then
            ! The approach of `solve_on_grid` is that of the least residual, whose gap has a mean over the free points.
            state%mean_gap = real(sums(2)/max(sums(1), 1.0_dp), sp)
            sums = state%measure_gap()
         end if
         call state%update_contact(sums)                                             ! (C3)
         ! Smaller overlaps may be rounding: such points would enter and leave the contact without end.
         state%allowance = real(overlap_part*part, sp)
         do
            if (state%residual <= part*state%scale .or. self%iterations >= most_iterations) exit
            if (present(progress)) self%is_interrupted = progress%shall_stop(self%iterations, state%residual)
            if (self%is_interrupted) exit
            self%iterations = self%iterations + 1
            call self%preconditioner%apply(half_space, state, field)                 ! (C4): field = z
            call state%exclude_blocked(field, blocked)                               ! (C4d)
            if (blocked > blocked_part*state%contact_points) &
               call self%preconditioner%apply(half_space, state, field)
            call find_direction(state, field, r, d, descent)                         ! (C5): field = d
            call state%displace(half_space, field)                                   !       field = Sd
            call find_step(state, field, r, d, step)                                 ! (C6)
            call take_step(state, d, step, field, sums, has_met_bounds)              ! (C7): field = other changes
            if (has_met_bounds) call state%add_image(half_space, field, sums)
            call state%update_contact(sums)                                          ! (C8), (C3)
         end do
      end associate
   end subroutine improve

   !> Adds the change to the pressure and restores its mean.
   subroutine add_to(self, pressure)
      class(pressure_correction), intent(in) :: self
      real(dp), intent(inout) :: pressure(:, :)   !! the pressure of `start`; its mean stays

      logical(c_bool), allocatable :: at_hardness(:)
      real(dp) :: total

      associate (state => self%state)
         allocate (at_hardness(state%region%points), source=.false._c_bool)
         if (allocated(state%room)) at_hardness = state%room <= state%change
         total = sum_of_field(state%slab, pressure)
         call state%region%correct(state%change, state%contact, at_hardness, state%scale, state%hardness, pressure)
         call set_load(state%slab, pressure, total, state%hardness)
      end associate
   end subroutine add_to

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
      real(sp), dimension(longest_chunk) :: contact, r, z
      integer :: c, n

      allocate (parts(size(sums), state%region%chunks))
      !$omp parallel do num_threads(state%region%threads) private(contact, n, r, z)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            call state%region%take_chunk(c, field, z)
            contact(:n) = state%contact(a:b)
            r(:n) = contact(:n)*(state%gap(a:b) - state%approach)
            z(:n) = contact(:n)*z(:n)
            parts(:, c) = [sdot(n, r, 1, z, 1), sdot(n, residuals(a:b), 1, z, 1), sdot(n, contact, 1, z, 1), &
                           sdot(n, contact, 1, residuals(a:b), 1), sdot(n, contact, 1, direction(a:b), 1)]
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
      !$omp parallel do num_threads(state%region%threads) private(contact, n, z)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            call state%region%take_chunk(c, field, z)
            contact(:n) = state%contact(a:b)
            residuals(a:b) = contact(:n)*(state%gap(a:b) - state%approach)
            direction(a:b) = contact(:n)*((z(:n) - mean) + beta*(direction(a:b) - mean_before))
            call state%region%put_chunk(c, direction(a:b), field)
         end associate
      end do
   end subroutine find_direction

   !> Computes the step to the least energy along the direction (C6), and the mean gap after it (C8b).
   subroutine find_step(state, field, residuals, direction, step)
      type(correction_state), intent(inout) :: state
      real(sp), intent(in), contiguous :: field(:, :)   !! Sd
      real(sp), intent(in), contiguous :: residuals(:), direction(:)
      real(sp), intent(out) :: step   !! zero for a contact of one point, where d = 0; overlaps may still be added

      real(dp) :: sums(3)
      real(dp), allocatable :: parts(:, :)
      real(sp), dimension(longest_chunk) :: contact, image
      integer :: c, n

      allocate (parts(size(sums), state%region%chunks))
      !$omp parallel do num_threads(state%region%threads) private(contact, image, n)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            call state%region%take_chunk(c, field, image)
            contact(:n) = state%contact(a:b)
            parts(:, c) = [sdot(n, direction(a:b), 1, image, 1), &
                           sdot(n, residuals(a:b), 1, direction(a:b), 1), sdot(n, contact, 1, image, 1)]
         end associate
      end do
      sums = state%totals(parts)
      step = 0.0_sp
      if (sums(1) > 0.0_dp) step = real(sums(2)/sums(1), sp)
      state%mean_gap = real(-step*sums(3)/max(state%contact_points, 1.0_dp), sp)
   end subroutine find_step

end module wavycon_pressure_correction
