!> Corrects a pressure whose gap violates the conditions of contact: one inner solution of `solve_on_grid`, in single
!> precision, on the points in and near the contact.
!>
!> Conjugate gradients on the points in contact, whose set is updated in each iteration, after Polonsky & Keer (Wear 231
!> (1999) 206-219), with a preconditioner and Polak & Ribiere's factor. Numbers (C..) are the equations of README.md in
!> this directory.
module wavycon_pressure_correction
   use, intrinsic :: iso_c_binding, only: c_bool
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_extension, only: contact_extension
   use wavycon_contact_region, only: contact_region
   use wavycon_contact_tuning, only: largest_growth, overlap_part, settled_part, stencil_fraction
   use wavycon_kinds, only: dp, sp
   use wavycon_lapack, only: sdot
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_pressure_load, only: bounded_shift, set_load, sum_of_field
   implicit none (type, external)
   private

   public :: pressure_correction

   !> Numbers of a vector that one sum in single precision adds. It bounds the rounding of sums, which do not depend on
   !> the number of threads.
   integer, parameter :: chunk = 4096

   !> Preconditioners: S^-1 of the gap continued to all points, S^-1 restricted to the contact, none.
   integer, parameter :: extended = 1, restricted = 2, none = 3

   !> All vectors have the shape (region%points) and are over `scale`; pressures are in p*, gaps in Delta.
   type :: pressure_correction
      integer :: iterations = 0
      integer :: local_iterations = 0           !! those whose preconditioner was the stencil
      integer :: plain_iterations = 0           !! those without extension
      real(dp) :: residual = huge(1.0_dp)       !! as `solve_on_grid`'s, times G
      type(contact_region), private :: region
      integer, private :: grid(2) = 0           !! M, N
      real(dp), private :: scale = 1.0_dp       !! the residual at the start
      integer, private :: contact_points = 0
      integer, private :: changed_points = 0    !! that left or entered the contact in the last iteration
      integer, private :: preconditioner = extended
      logical, private :: has_resumed = .false. !! whether the preconditioner was `restricted` and is `extended` again
      real(dp), private :: descent = 0.0_dp     !! (gap, z) of the last direction
      real(dp), private :: hardness = huge(1.0_dp)
      real(sp), allocatable, private :: start_pressure(:)
      real(sp), allocatable, private :: room(:)        !! H - p of the start; not allocated without a hardness
      real(sp), allocatable, private :: change(:)      !! of the pressure since the start
      real(sp), allocatable, private :: gap(:)
      real(sp), allocatable, private :: contact(:)     !! 1 at free points, 0 at those with p = 0 or p = H
      real(sp), allocatable, private :: residuals(:)   !! r: the gap at free points, 0 elsewhere, of the last iteration
      real(sp), allocatable, private :: direction(:)   !! d
      real(sp), allocatable, private :: image(:)       !! in turn r, z, d, Sd
      real(sp), allocatable, private :: field(:, :)    !! a vector on the grid, for transforms
      real(sp), allocatable, private :: contact_field(:, :)   !! `contact` on the grid, if the extension is used
      type(local_stiffness), private :: stencil
      type(contact_extension), private :: extension
   contains
      procedure :: start
      procedure :: improve
      procedure :: add_to
      procedure, private :: shift_gap
      procedure, private :: select_preconditioner
      procedure, private :: precondition
      procedure, private :: set_extension
      procedure, private :: update_direction
      procedure, private :: find_step
      procedure, private :: move
      procedure, private :: move_freely
      procedure, private :: move_between_bounds
      procedure, private :: restore_mean
      procedure, private :: add_overlaps
      procedure, private :: displace
      procedure, private :: product_of
      procedure, private :: subtract_mean
   end type pressure_correction

contains

   subroutine start(self, inside, stencil, pressure, gap, residual, hardness)
      class(pressure_correction), intent(out) :: self
      logical(c_bool), intent(in) :: inside(:, :) !! the points in and near the contact
      type(local_stiffness), intent(in) :: stencil
      real(dp), intent(in) :: pressure(:, :)      !! p/p*, shape (M, N); 0 or H outside the region
      real(dp), intent(in) :: gap(:, :)           !! its gap/Delta, whose mean over the free points is zero
      real(dp), intent(in) :: residual            !! root mean square of the violated conditions [Delta]
      real(dp), intent(in) :: hardness            !! H/p*, > p or huge

      self%hardness = hardness
      self%scale = residual
      self%grid = shape(inside)
      self%stencil = stencil
      call self%region%start(inside)
      associate (n => self%region%points)
         allocate (self%start_pressure(n), self%gap(n), self%contact(n), self%direction(n), self%image(n), &
                   self%residuals(n), self%change(n))
      end associate
      call self%region%gather_scaled(pressure, residual, self%start_pressure)
      call self%region%gather_scaled(gap, residual, self%gap)
      self%contact = merge(1.0_sp, 0.0_sp, self%start_pressure > 0.0_sp)
      if (hardness < huge(hardness)) then
         allocate (self%room, mold=self%gap)
         ! The difference loses no digits where the pressure is close to H.
         call self%region%gather_scaled(hardness - pressure, residual, self%room)
         self%contact = merge(self%contact, 0.0_sp, self%room > 0.0_sp)
      end if
      self%direction = 0.0_sp
      self%residuals = 0.0_sp
      self%change = 0.0_sp
   end subroutine start

   !> Iterates by (C3) to (C8) until the residual is below a part of its start, or for a number of iterations.
   subroutine improve(self, half_space, part, most_iterations)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(dp), intent(in) :: part                !! of the residual at the start
      integer, intent(in) :: most_iterations

      real(dp) :: last_residual
      real(sp) :: step

      allocate (self%field(self%grid(1), self%grid(2)))
      last_residual = huge(1.0_dp)
      do
         call self%shift_gap()
         call self%select_preconditioner(last_residual)
         last_residual = self%residual
         if (self%residual <= part*self%scale .or. self%iterations >= most_iterations) exit
         self%iterations = self%iterations + 1
         call self%precondition(half_space)
         call self%update_direction()
         call self%find_step(half_space, step)
         call self%move(step, half_space)
         call self%add_overlaps(real(overlap_part*part, sp))
      end do
      deallocate (self%field)
   end subroutine improve

   !> Adds the change to the pressure and restores its mean.
   subroutine add_to(self, pressure)
      class(pressure_correction), intent(in) :: self
      real(dp), intent(inout) :: pressure(:, :)   !! the pressure of `start`; its mean stays

      logical, allocatable :: at_hardness(:)
      real(dp) :: total

      allocate (at_hardness(self%region%points), source=.false.)
      if (allocated(self%room)) at_hardness = self%room <= self%change
      total = sum_of_field(pressure)
      call self%region%correct(self%change, self%contact, at_hardness, self%scale, self%hardness, pressure)
      call set_load(pressure, total, self%hardness)
   end subroutine add_to

   !> Changes the approach so that the mean gap over the free points is zero (C3), and computes the residual (C9) times
   !> G.
   subroutine shift_gap(self)
      class(pressure_correction), intent(inout) :: self

      real(sp) :: shift

      self%contact_points = nint(self%product_of(self%contact, self%contact))
      ! Without free points the approach stays: the next step finds it from all points.
      shift = real(self%product_of(self%contact, self%gap)/max(self%contact_points, 1), sp)
      self%gap = self%gap - shift
      self%image = merge(self%gap, min(self%gap, 0.0_sp), self%contact > 0.0_sp)
      if (allocated(self%room)) self%image = merge(max(self%gap, 0.0_sp), self%image, &
                                                   self%contact <= 0.0_sp .and. self%room <= self%change)
      self%residual = self%scale*sqrt(self%product_of(self%image, self%image)/product(real(self%grid, dp)))
   end subroutine shift_gap

   !> Selects a weaker preconditioner when the residual grows: on grids that hardly resolve the surface the extension
   !> reaches so far that the points which then leave the contact undo the step. Once in a correction the extension
   !> resumes when the contact has settled. The search restarts when the preconditioner changes.
   subroutine select_preconditioner(self, last_residual)
      class(pressure_correction), intent(inout) :: self
      real(dp), intent(in) :: last_residual

      if (self%preconditioner /= none .and. self%residual/largest_growth > last_residual) then
         self%preconditioner = merge(restricted, none, self%preconditioner == extended .and. .not. self%has_resumed)
      else if (self%preconditioner /= extended .and. .not. self%has_resumed .and. &
               self%changed_points <= settled_part*self%contact_points) then
         self%preconditioner = extended
         self%has_resumed = .true.
      else
         return
      end if
      self%descent = 0.0_dp
   end subroutine select_preconditioner

   !> Computes z (C4) of the residual r, in `image`.
   subroutine precondition(self, half_space)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space

      self%image = self%contact*self%gap
      if (self%contact_points == 0) return
      if (self%stencil%exists .and. self%contact_points < stencil_fraction*product(real(self%grid, dp))) then
         call self%stencil%apply(self%region, self%grid, self%image)
         self%local_iterations = self%local_iterations + 1
      else if (self%preconditioner == extended) then
         call self%set_extension()
         self%field = 0.0_sp
         call self%region%scatter(self%image, self%field)
         call self%extension%extend(self%contact_field, self%field)
         call half_space%pressure(self%field)
         call self%extension%collect(self%contact_field, self%field)
         call self%region%gather(self%field, self%image)
      else
         self%plain_iterations = self%plain_iterations + 1
         if (self%preconditioner == restricted) then
            call self%region%clear(self%field)
            call self%region%scatter(self%image, self%field)
            call half_space%pressure(self%field, self%region%columns, self%region%columns)
            call self%region%gather(self%field, self%image)
         end if
      end if
      call self%subtract_mean(self%image)
   end subroutine precondition

   !> Starts the extension when it is first needed, and sets the points in contact.
   subroutine set_extension(self)
      class(pressure_correction), intent(inout) :: self

      if (.not. allocated(self%contact_field)) then
         allocate (self%contact_field(self%grid(1), self%grid(2)), source=0.0_sp)
         call self%extension%start(self%grid, self%stencil%even)
      end if
      call self%region%scatter(self%contact, self%contact_field)
      call self%extension%set_contact(self%contact_field)
   end subroutine set_extension

   !> Computes the next direction by Polak & Ribiere's factor (C5).
   subroutine update_direction(self)
      class(pressure_correction), intent(inout) :: self

      real(dp) :: descent
      real(sp) :: beta

      descent = self%product_of(self%gap, self%image)
      ! A contact of one point has no direction and (gap, z) = 0: the search restarts.
      beta = 0.0_sp
      if (self%descent > tiny(self%descent)) beta = real(max( &
         (descent - self%product_of(self%residuals, self%image))/self%descent, 0.0_dp), sp)
      self%descent = descent
      self%direction = self%image + beta*self%direction
      ! If points have left the contact, the mean of the last direction over the others is not zero.
      call self%subtract_mean(self%direction)
      self%residuals = self%contact*self%gap
   end subroutine update_direction

   !> Computes the step to the least energy along the direction (C6); `image` becomes Sd.
   subroutine find_step(self, half_space, step)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(sp), intent(out) :: step   !! zero for a contact of one point, where d = 0; overlaps may still be added

      real(dp) :: curvature

      self%image = self%direction
      call self%displace(half_space)
      curvature = self%product_of(self%direction, self%image)
      step = 0.0_sp
      if (curvature > 0.0_dp) step = real(self%product_of(self%residuals, self%direction)/curvature, sp)
   end subroutine find_step

   !> Moves pressure and gap by a step. Points whose pressure would not stay positive leave the free ones; the others
   !> are then multiplied by a factor that restores the mean pressure (C7). Where points pass H, (C24) takes its place.
   subroutine move(self, step, half_space)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: step
      type(compliance_operator), intent(inout) :: half_space

      logical :: passes_hardness

      passes_hardness = .false.
      if (allocated(self%room)) passes_hardness = any(self%contact > 0.0_sp .and. &
                                                      self%change - step*self%direction >= self%room)
      if (passes_hardness) then
         call self%move_between_bounds(step)
      else
         call self%move_freely(step)
         if (self%changed_points > 0) call self%restore_mean()
      end if
      if (self%changed_points == 0) return
      call self%displace(half_space)
      self%gap = self%gap + self%image
   end subroutine move

   !> A step that no point ends at H; `image` becomes what the pressure changes besides.
   subroutine move_freely(self, step)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: step

      integer :: i, left

      left = 0
      !$omp parallel do num_threads(self%region%threads) reduction(+:left)
      do i = 1, self%region%points
         self%gap(i) = self%gap(i) - step*self%image(i)
         self%change(i) = self%change(i) - step*self%direction(i)
         self%image(i) = 0.0_sp
         if (self%contact(i) > 0.0_sp .and. self%start_pressure(i) + self%change(i) <= 0.0_sp) then
            self%image(i) = -self%start_pressure(i) - self%change(i)
            self%change(i) = -self%start_pressure(i)
            self%contact(i) = 0.0_sp
            left = left + 1
         end if
      end do
      self%changed_points = left
   end subroutine move_freely

   !> A step that ends at H for some points: the pressure at all free points changes by the same that restores the mean,
   !> and then to the nearer bound if it is beyond it (C24). Close to H the step is much longer than what is left of it,
   !> and is computed in double precision.
   subroutine move_between_bounds(self, step)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: step

      real(dp), allocatable :: change(:)
      logical, allocatable :: free(:)
      real(dp) :: shift
      integer :: i

      allocate (change, source=self%change - real(step, dp)*self%direction)
      allocate (free, source=self%contact > 0.0_sp)
      shift = bounded_shift(pack(self%start_pressure + change, free), pack(self%room - change, free), -sum(change))
      self%changed_points = 0
      do i = 1, self%region%points
         self%gap(i) = self%gap(i) - step*self%image(i)
         self%image(i) = 0.0_sp
         if (.not. free(i)) cycle
         self%change(i) = real(min(max(change(i) + shift, real(-self%start_pressure(i), dp)), &
                                   real(self%room(i), dp)), sp)
         self%image(i) = real(self%change(i) - change(i), sp)
         if (self%change(i) > -self%start_pressure(i) .and. self%change(i) < self%room(i)) cycle
         self%contact(i) = 0.0_sp
         self%changed_points = self%changed_points + 1
      end do
   end subroutine move_between_bounds

   !> Multiplies the pressure at the free points by a factor, so that its mean is that of the start, and adds the
   !> changes to `image`.
   subroutine restore_mean(self)
      class(pressure_correction), intent(inout) :: self

      real(dp) :: load
      real(sp) :: excess

      load = self%product_of(self%contact, self%start_pressure + self%change)
      if (.not. load > 0.0_dp) return
      excess = real(-sum_of(self%change)/load, sp)
      if (excess > -1.0_sp) then
         associate (growth => self%contact*excess*(self%start_pressure + self%change))
            self%image = self%image + growth
            self%change = self%change + growth
         end associate
      else
         ! The step is so much longer than the pressure that what is left of it would be rounded to zero.
         associate (rest => real(sum_of(self%start_pressure)/load, sp)*(self%start_pressure + self%change))
            self%image = self%image + self%contact*(rest - self%start_pressure - self%change)
            self%change = merge(rest - self%start_pressure, self%change, self%contact > 0.0_sp)
         end associate
      end if
   end subroutine restore_mean

   !> Adds to the free points those outside whose gap is below the mean gap of the free ones by more than an allowance
   !> (C8), at H above it. Smaller overlaps may be rounding: such points would enter and leave without end.
   subroutine add_overlaps(self, allowance)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: allowance   !! over `scale`

      real(sp) :: least, mean, most
      integer :: entered, i
      logical :: enters, has_hardness

      mean = real(self%product_of(self%contact, self%gap)/max(self%product_of(self%contact, self%contact), 1.0_dp), sp)
      least = mean - allowance
      most = mean + allowance
      has_hardness = allocated(self%room)
      entered = 0
      !$omp parallel do num_threads(self%region%threads) private(enters) reduction(+:entered)
      do i = 1, self%region%points
         if (self%contact(i) > 0.0_sp) cycle
         enters = self%gap(i) < least
         if (has_hardness) enters = merge(self%gap(i) > most, enters, self%room(i) <= self%change(i))
         if (enters) then
            self%contact(i) = 1.0_sp
            entered = entered + 1
         end if
      end do
      self%changed_points = self%changed_points + entered
   end subroutine add_overlaps

   !> Replaces the pressure in `image` by its displacement.
   subroutine displace(self, half_space)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space

      call self%region%clear(self%field)
      call self%region%scatter(self%image, self%field)
      call half_space%displacement(self%field, self%region%columns, self%region%columns)
      call self%region%gather(self%field, self%image)
   end subroutine displace

   !> Subtracts from a vector its mean in contact, and sets it to zero outside.
   subroutine subtract_mean(self, vector)
      class(pressure_correction), intent(in) :: self
      real(sp), intent(inout), contiguous :: vector(:)

      vector = self%contact*(vector - real(self%product_of(self%contact, vector)/max(self%contact_points, 1), sp))
   end subroutine subtract_mean

   !> Sum of a vector.
   pure real(dp) function sum_of(a)
      real(sp), intent(in), contiguous :: a(:)

      real(sp), parameter :: ones(chunk) = 1.0_sp
      integer :: c

      sum_of = 0.0_dp
      do c = 1, size(a), chunk
         associate (n => min(chunk, size(a) - c + 1))
            sum_of = sum_of + sdot(n, a(c:c + n - 1), 1, ones, 1)
         end associate
      end do
   end function sum_of

   !> Scalar product of two vectors.
   real(dp) function product_of(self, a, b)
      class(pressure_correction), intent(in) :: self
      real(sp), intent(in), contiguous :: a(:), b(:)

      real(dp) :: sums((size(a) - 1)/chunk + 1)
      integer :: first, last, s

      !$omp parallel do num_threads(self%region%threads) private(first, last)
      do s = 1, size(sums)
         first = (s - 1)*chunk + 1
         last = min(s*chunk, size(a))
         sums(s) = sdot(last - first + 1, a(first:last), 1, b(first:last), 1)
      end do
      product_of = sum(sums)
   end function product_of

end module wavycon_pressure_correction
