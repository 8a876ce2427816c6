!> Corrects a pressure whose gap violates the conditions of contact: one inner solution of `solve_on_grid`, in single
!> precision, on the points in and near the contact.
!>
!> Conjugate gradients on the points in contact, whose set is updated in each iteration, after Polonsky & Keer (Wear 231
!> (1999) 206-219), with a preconditioner and Polak & Ribiere's factor. Numbers (C..) are the equations of README.md in
!> this directory.
!>
!> Vectors have the points of this rank's columns. A pass over them goes chunk by chunk (`contact_region`) and computes
!> all its sums; one message then adds those of the ranks. An iteration in which no point leaves the contact has three.
module wavycon_pressure_correction
   use, intrinsic :: iso_c_binding, only: c_bool
   use, intrinsic :: iso_fortran_env, only: int8, int64
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_extension, only: contact_extension
   use wavycon_contact_region, only: contact_region, longest_chunk
   use wavycon_contact_tuning, only: largest_growth, overlap_part, settled_part, stencil_fraction
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_lapack, only: sdot
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_pressure_load, only: bounded_shift, set_load, sum_of_field
   implicit none (type, external)
   private

   public :: pressure_correction

   !> Preconditioners: S^-1 of the gap continued to all points, S^-1 restricted to the contact, none.
   integer, parameter :: extended = 1, restricted = 2, none = 3

   !> Sums of a pass over the gap: the free points, their gaps and squares of gaps, the squares of violations at the
   !> others, and the points that enter the contact.
   integer, parameter :: gap_sums = 5

   real(sp), parameter :: ones(longest_chunk) = 1.0_sp

   !> All vectors have the shape (region%points) and are over `scale`; pressures are in p*, gaps in Delta.
   type :: pressure_correction
      integer :: iterations = 0
      integer :: local_iterations = 0           !! those whose preconditioner was the stencil
      integer :: plain_iterations = 0           !! those without extension
      real(dp) :: residual = huge(1.0_dp)       !! as `solve_on_grid`'s, times G
      type(grid_slab), private :: slab
      type(contact_region), private :: region
      real(dp), private :: scale = 1.0_dp       !! the residual at the start
      real(dp), private :: contact_points = 0.0_dp
      real(dp), private :: changed_points = 0.0_dp   !! that left or entered the contact in the last iteration
      integer, private :: preconditioner = extended
      logical, private :: has_resumed = .false. !! whether the preconditioner was `restricted` and is `extended` again
      real(dp), private :: descent = 0.0_dp     !! (gap, z) of the last direction
      real(dp), private :: hardness = huge(1.0_dp)
      real(sp), private :: approach = 0.0_sp    !! what is to be subtracted from `gap`
      real(sp), allocatable, private :: start_pressure(:)
      real(sp), allocatable, private :: room(:)        !! H - p of the start; not allocated without a hardness
      real(sp), allocatable, private :: change(:)      !! of the pressure since the start
      real(sp), allocatable, private :: gap(:)
      integer(int8), allocatable, private :: contact(:)   !! 1 at free points, 0 at those with p = 0 or p = H
      real(sp), allocatable, private :: residuals(:)   !! r of the last direction: the gap at free points, 0 elsewhere
      real(sp), allocatable, private :: direction(:)   !! d
      real(sp), allocatable, private :: field(:, :)    !! in turn r, z, d, Sd on the grid
      real(sp), allocatable, private :: contact_field(:, :)   !! `contact` on the grid, if the extension is used
      type(local_stiffness), private :: stencil
      type(contact_extension), private :: extension
   contains
      procedure :: start
      procedure :: improve
      procedure :: add_to
      procedure, private :: select_preconditioner
      procedure, private :: precondition
      procedure, private :: put_residual
      procedure, private :: set_extension
      procedure, private :: update_direction
      procedure, private :: find_step
      procedure, private :: move
      procedure, private :: passes_hardness
      procedure, private :: move_freely
      procedure, private :: move_between_bounds
      procedure, private :: restore_mean
      procedure, private :: add_image
      procedure, private :: measure_gap
      procedure, private :: measure_chunk
      procedure, private :: set_approach
      procedure, private :: displace
      procedure, private :: totals
   end type pressure_correction

contains

   subroutine start(self, slab, inside, stencil, pressure, gap, residual, hardness)
      class(pressure_correction), intent(out) :: self
      type(grid_slab), intent(in) :: slab         !! of the grid
      logical(c_bool), intent(in) :: inside(:, :) !! the points in and near the contact
      type(local_stiffness), intent(in) :: stencil
      real(dp), intent(in) :: pressure(:, :)      !! p/p*, shape (M, slab%columns()); 0 or H outside the region
      real(dp), intent(in) :: gap(:, :)           !! its gap/Delta, whose mean over the free points is zero
      real(dp), intent(in) :: residual            !! root mean square of the violated conditions [Delta]
      real(dp), intent(in) :: hardness            !! H/p*, > p or huge

      self%hardness = hardness
      self%scale = residual
      self%slab = slab
      self%stencil = stencil
      call self%region%start(inside)
      associate (n => self%region%points)
         allocate (self%start_pressure(n), self%gap(n), self%contact(n), self%direction(n), self%residuals(n), &
                   self%change(n))
      end associate
      call self%region%gather_scaled(pressure, residual, self%start_pressure)
      call self%region%gather_scaled(gap, residual, self%gap)
      self%contact = merge(1_int8, 0_int8, self%start_pressure > 0.0_sp)
      if (hardness < huge(hardness)) then
         allocate (self%room, mold=self%gap)
         ! The difference loses no digits where the pressure is close to H.
         call self%region%gather_scaled(hardness - pressure, residual, self%room)
         self%contact = merge(self%contact, 0_int8, self%room > 0.0_sp)
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
      real(sp) :: allowance, mean, step

      allocate (self%field(self%slab%points(1), self%slab%columns()))
      ! Smaller overlaps may be rounding: such points would enter and leave the contact without end.
      allowance = real(overlap_part*part, sp)
      call self%measure_gap(0.0_sp, huge(allowance), 0.0_dp)
      last_residual = huge(1.0_dp)
      do
         call self%select_preconditioner(last_residual)
         last_residual = self%residual
         if (self%residual <= part*self%scale .or. self%iterations >= most_iterations) exit
         self%iterations = self%iterations + 1
         call self%precondition(half_space)
         call self%update_direction()
         call self%find_step(half_space, step, mean)
         call self%move(half_space, step, mean, allowance)
      end do
      deallocate (self%field)
   end subroutine improve

   !> Adds the change to the pressure and restores its mean.
   subroutine add_to(self, pressure)
      class(pressure_correction), intent(in) :: self
      real(dp), intent(inout) :: pressure(:, :)   !! the pressure of `start`; its mean stays

      logical(c_bool), allocatable :: at_hardness(:)
      real(dp) :: total

      allocate (at_hardness(self%region%points), source=.false._c_bool)
      if (allocated(self%room)) at_hardness = self%room <= self%change
      total = sum_of_field(self%slab, pressure)
      call self%region%correct(self%change, self%contact, at_hardness, self%scale, self%hardness, pressure)
      call set_load(self%slab, pressure, total, self%hardness)
   end subroutine add_to

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

   !> Computes z of the residual r, but for its mean (C4), in `field`.
   subroutine precondition(self, half_space)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space

      real(sp), allocatable :: vector(:)

      if (self%contact_points <= 0.0_dp) then
         call self%put_residual()
      else if (self%stencil%exists .and. &
               self%contact_points < stencil_fraction*product(real(self%slab%points, dp))) then
         call self%put_residual()
         allocate (vector(self%region%points))
         call self%region%gather(self%field, vector)
         call self%stencil%apply(self%region, self%slab%points, vector)
         call self%region%scatter(vector, self%field)
         self%local_iterations = self%local_iterations + 1
      else if (self%preconditioner == extended) then
         call self%set_extension()
         self%field = 0.0_sp
         call self%put_residual()
         call self%extension%extend(self%contact_field, self%field)
         call half_space%pressure(self%field)
         call self%extension%collect(self%contact_field, self%field)
      else
         self%plain_iterations = self%plain_iterations + 1
         call self%put_residual()
         if (self%preconditioner == none) return
         call self%region%clear_outside(self%field)
         call half_space%pressure(self%field, self%region%columns, self%region%columns)
      end if
   end subroutine precondition

   !> Writes the residual r, the gap at free points and zero at others, to the points of the region in `field`.
   subroutine put_residual(self)
      class(pressure_correction), intent(inout) :: self

      real(sp) :: r(longest_chunk)
      integer :: c

      !$omp parallel do num_threads(self%region%threads) private(r)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            r(:b - a + 1) = self%contact(a:b)*(self%gap(a:b) - self%approach)
         end associate
         call self%region%put_chunk(c, r, self%field)
      end do
   end subroutine put_residual

   !> Starts the extension when it is first needed, and sets the points in contact.
   subroutine set_extension(self)
      class(pressure_correction), intent(inout) :: self

      real(sp) :: contact(longest_chunk)
      integer :: c

      if (.not. allocated(self%contact_field)) then
         allocate (self%contact_field, mold=self%field)
         self%contact_field = 0.0_sp
         call self%extension%start(self%slab%points, self%stencil%even)
      end if
      !$omp parallel do num_threads(self%region%threads) private(contact)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            contact(:b - a + 1) = self%contact(a:b)
         end associate
         call self%region%put_chunk(c, contact, self%contact_field)
      end do
      call self%extension%set_contact(self%contact_field)
   end subroutine set_extension

   !> Computes the next direction by Polak & Ribiere's factor (C5), from z in `field`; `field` becomes the direction.
   !>
   !> The means of z and d over the contact follow from the sums of z and of the last direction. The gap has no mean
   !> there, so that that of z does not change (gap, z). That of r_old is zero as long as no point leaves.
   subroutine update_direction(self)
      class(pressure_correction), intent(inout) :: self

      real(dp) :: descent, sums(5)
      real(dp), allocatable :: parts(:, :)
      real(sp) :: beta, mean, mean_before
      real(sp), dimension(longest_chunk) :: contact, r, z
      integer :: c, n

      allocate (parts(size(sums), self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact, n, r, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, self%field, z)
            contact(:n) = self%contact(a:b)
            r(:n) = contact(:n)*(self%gap(a:b) - self%approach)
            z(:n) = contact(:n)*z(:n)
            parts(:, c) = [sdot(n, r, 1, z, 1), sdot(n, self%residuals(a:b), 1, z, 1), sdot(n, contact, 1, z, 1), &
                           sdot(n, contact, 1, self%residuals(a:b), 1), sdot(n, contact, 1, self%direction(a:b), 1)]
         end associate
      end do
      sums = self%totals(parts)
      associate (points => max(self%contact_points, 1.0_dp))
         mean = real(sums(3)/points, sp)
         mean_before = real(sums(5)/points, sp)
         descent = sums(1)
         ! A contact of one point has no direction and (gap, z) = 0: the search restarts.
         beta = 0.0_sp
         if (self%descent > tiny(self%descent)) &
            beta = real(max((descent - (sums(2) - sums(3)*sums(4)/points))/self%descent, 0.0_dp), sp)
      end associate
      self%descent = descent
      !$omp parallel do num_threads(self%region%threads) private(contact, n, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, self%field, z)
            contact(:n) = self%contact(a:b)
            self%residuals(a:b) = contact(:n)*(self%gap(a:b) - self%approach)
            self%direction(a:b) = contact(:n)*((z(:n) - mean) + beta*(self%direction(a:b) - mean_before))
            call self%region%put_chunk(c, self%direction(a:b), self%field)
         end associate
      end do
   end subroutine update_direction

   !> Computes the step to the least energy along the direction (C6); `field` becomes Sd.
   subroutine find_step(self, half_space, step, mean)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(sp), intent(out) :: step   !! zero for a contact of one point, where d = 0; overlaps may still be added
      real(sp), intent(out) :: mean   !! of the gap over the contact after the step, if no point leaves

      real(dp) :: sums(3)
      real(dp), allocatable :: parts(:, :)
      real(sp), dimension(longest_chunk) :: contact, image
      integer :: c, n

      call self%displace(half_space)
      allocate (parts(size(sums), self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact, image, n)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, self%field, image)
            contact(:n) = self%contact(a:b)
            parts(:, c) = [sdot(n, self%direction(a:b), 1, image, 1), &
                           sdot(n, self%residuals(a:b), 1, self%direction(a:b), 1), sdot(n, contact, 1, image, 1)]
         end associate
      end do
      sums = self%totals(parts)
      step = 0.0_sp
      if (sums(1) > 0.0_dp) step = real(sums(2)/sums(1), sp)
      mean = real(-step*sums(3)/max(self%contact_points, 1.0_dp), sp)
   end subroutine find_step

   !> Moves pressure and gap by a step. Points whose pressure would not stay positive leave the free ones; the others
   !> are then multiplied by a factor that restores the mean pressure (C7). Where points pass H, (C24) takes its place.
   !> Then overlapping points enter the contact (C8), and the residual follows.
   subroutine move(self, half_space, step, mean, allowance)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(sp), intent(in) :: step, mean   !! of `find_step`
      real(sp), intent(in) :: allowance    !! the least overlap of points that enter, over `scale`

      real(dp) :: left, sums(gap_sums + 3)
      real(sp) :: new_mean

      if (self%passes_hardness(step)) then
         call self%move_between_bounds(step)
      else
         call self%move_freely(step, mean, allowance, sums)
         left = sums(gap_sums + 1)
         if (left <= 0.0_dp) then
            call self%set_approach(mean, allowance, sums(:gap_sums), left)
            return
         end if
         call self%restore_mean(sums(gap_sums + 2), sums(gap_sums + 3))
      end if
      call self%displace(half_space)
      call self%add_image(new_mean, left)
      call self%measure_gap(new_mean, allowance, left)
   end subroutine move

   !> Whether a step takes free points to H or beyond.
   logical function passes_hardness(self, step) result(passes)
      class(pressure_correction), intent(in) :: self
      real(sp), intent(in) :: step

      integer(int64) :: ranks(1)

      passes = .false.
      if (self%hardness >= huge(self%hardness)) return
      ranks = merge(1, 0, any(self%contact > 0 .and. self%change - step*self%direction >= self%room))
      call self%slab%add(ranks)
      passes = ranks(1) > 0
   end function passes_hardness

   !> A step that no point ends at H. What points that leave the contact pass zero by stays in `change`; if there are
   !> any, `restore_mean` follows.
   subroutine move_freely(self, step, mean, allowance, sums)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: step, mean, allowance
      !> Those of `measure_gap`, which hold if no point leaves; the points that leave, the sum of the pressures at the
      !> others, and that of the changes since the start.
      real(dp), intent(out) :: sums(gap_sums + 3)

      real(dp), allocatable :: parts(:, :)
      real(sp), dimension(longest_chunk) :: contact, image, pressure
      integer :: c, n

      allocate (parts(size(sums), self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact, image, n, pressure)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, self%field, image)
            self%gap(a:b) = (self%gap(a:b) - self%approach) - step*image(:n)
            self%change(a:b) = self%change(a:b) - step*self%direction(a:b)
            pressure(:n) = self%start_pressure(a:b) + self%change(a:b)
            contact(:n) = self%contact(a:b)
            image(:n) = merge(contact(:n), 0.0_sp, pressure(:n) <= 0.0_sp)
            contact(:n) = contact(:n) - image(:n)
            parts(gap_sums + 1, c) = sdot(n, image, 1, image, 1)
            if (parts(gap_sums + 1, c) > 0.0_dp) self%contact(a:b) = int(contact(:n), int8)
            parts(gap_sums + 2, c) = sdot(n, contact, 1, pressure, 1)
            image(:n) = max(self%change(a:b), -self%start_pressure(a:b))
            parts(gap_sums + 3, c) = sdot(n, image, 1, ones, 1)
            call self%measure_chunk(c, mean, allowance, contact, parts(:gap_sums, c))
         end associate
      end do
      self%approach = 0.0_sp
      sums = self%totals(parts)
   end subroutine move_freely

   !> A step that ends at H for some points: the pressure at all free points changes by the same that restores the mean,
   !> and then to the nearer bound if it is beyond it (C24). Close to H the step is much longer than what is left of it,
   !> and is computed in double precision. `field` becomes what the pressure changes besides the step.
   subroutine move_between_bounds(self, step)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: step

      real(dp), allocatable :: change(:), parts(:, :)
      real(dp) :: shift, total(1)
      real(sp) :: image(longest_chunk)
      logical, allocatable :: free(:)
      integer, allocatable :: first(:)
      integer :: c, i, s

      allocate (change, source=self%change - real(step, dp)*self%direction)
      allocate (free, source=self%contact > 0)
      allocate (first(self%slab%strips() + 1), parts(1, self%slab%strips()))
      first(1) = 1
      do s = 1, size(parts, 2)
         associate (a => self%region%strip(s), b => self%region%strip(s + 1) - 1)
            first(s + 1) = first(s) + count(free(a:b))
            parts(1, s) = sum(change(a:b))
         end associate
      end do
      total = self%slab%strip_totals(parts)
      shift = bounded_shift(self%slab, first, pack(self%start_pressure + change, free), &
                            pack(self%room - change, free), -total(1))
      do c = 1, self%region%chunks
         call self%region%take_chunk(c, self%field, image)
         associate (before => self%region%chunk(c) - 1)
            do i = self%region%chunk(c), self%region%chunk(c + 1) - 1
               self%gap(i) = (self%gap(i) - self%approach) - step*image(i - before)
               image(i - before) = 0.0_sp
               if (.not. free(i)) cycle
               self%change(i) = real(min(max(change(i) + shift, real(-self%start_pressure(i), dp)), &
                                         real(self%room(i), dp)), sp)
               image(i - before) = real(self%change(i) - change(i), sp)
               if (self%change(i) <= -self%start_pressure(i) .or. self%change(i) >= self%room(i)) self%contact(i) = 0
            end do
         end associate
         call self%region%put_chunk(c, image, self%field)
      end do
      self%approach = 0.0_sp
   end subroutine move_between_bounds

   !> Sets the pressure of the points that have left to zero and multiplies that at the free points by a factor, so that
   !> its mean is that of the start. `field` becomes what changes by both.
   subroutine restore_mean(self, load, change)
      class(pressure_correction), intent(inout) :: self
      real(dp), intent(in) :: load     !! sum of the pressures at the free points
      real(dp), intent(in) :: change   !! sum of the changes since the start, with those that have left at zero

      real(dp), allocatable :: parts(:, :)
      real(dp) :: start(1)
      real(sp) :: excess, factor
      real(sp), dimension(longest_chunk) :: contact, growth, image, pressure
      integer :: c, n
      logical :: shrinks

      excess = 0.0_sp
      factor = 0.0_sp
      if (load > 0.0_dp) excess = real(-change/load, sp)
      ! The step may be so much longer than the pressure that what is left of it would be rounded to zero.
      shrinks = excess <= -1.0_sp
      if (shrinks) then
         allocate (parts(1, self%region%chunks))
         do c = 1, self%region%chunks
            associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
               parts(1, c) = sdot(b - a + 1, self%start_pressure(a:b), 1, ones, 1)
            end associate
         end do
         start = self%totals(parts)
         factor = real(start(1)/load, sp)
      end if
      !$omp parallel do num_threads(self%region%threads) private(contact, growth, image, n, pressure)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            pressure(:n) = self%start_pressure(a:b) + self%change(a:b)
            contact(:n) = self%contact(a:b)
            ! Of points that have left; at others the pressure is not negative.
            image(:n) = max(-pressure(:n), 0.0_sp)
            if (shrinks) then
               growth(:n) = contact(:n)*(factor*pressure(:n) - self%start_pressure(a:b) - self%change(a:b))
               self%change(a:b) = merge(factor*pressure(:n) - self%start_pressure(a:b), &
                                        max(self%change(a:b), -self%start_pressure(a:b)), contact(:n) > 0.0_sp)
            else
               growth(:n) = contact(:n)*(excess*pressure(:n))
               self%change(a:b) = max(self%change(a:b), -self%start_pressure(a:b)) + growth(:n)
            end if
            image(:n) = image(:n) + growth(:n)
            call self%region%put_chunk(c, image, self%field)
         end associate
      end do
   end subroutine restore_mean

   !> Adds to the gap the displacement in `field`.
   subroutine add_image(self, mean, left)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(out) :: mean    !! of the gap over the contact
      real(dp), intent(out) :: left    !! the points that have left since the last `set_approach`

      real(dp) :: sums(2)
      real(dp), allocatable :: parts(:, :)
      real(sp), dimension(longest_chunk) :: contact, image
      integer :: c, n

      allocate (parts(size(sums), self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact, image, n)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, self%field, image)
            self%gap(a:b) = self%gap(a:b) + image(:n)
            contact(:n) = self%contact(a:b)
            parts(:, c) = [sdot(n, contact, 1, contact, 1), sdot(n, contact, 1, self%gap(a:b), 1)]
         end associate
      end do
      sums = self%totals(parts)
      mean = real(sums(2)/max(sums(1), 1.0_dp), sp)
      left = self%contact_points - sums(1)
   end subroutine add_image

   !> Adds to the free points those that overlap (C8), changes the approach so that the mean gap over the free points is
   !> zero (C3), and computes the residual (C9) times G.
   subroutine measure_gap(self, mean, allowance, left)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: mean        !! of the gap over the contact
      real(sp), intent(in) :: allowance   !! the least overlap of points that enter, over `scale`
      real(dp), intent(in) :: left        !! the points that have left the contact

      real(dp), allocatable :: parts(:, :)
      real(sp) :: contact(longest_chunk)
      integer :: c

      allocate (parts(gap_sums, self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            contact(:b - a + 1) = self%contact(a:b)
         end associate
         call self%measure_chunk(c, mean, allowance, contact, parts(:, c))
      end do
      call self%set_approach(mean, allowance, self%totals(parts), left)
   end subroutine measure_gap

   !> The part of one chunk in the sums of `measure_gap`.
   subroutine measure_chunk(self, c, mean, allowance, contact, sums)
      class(pressure_correction), intent(in) :: self
      integer, intent(in) :: c
      real(sp), intent(in) :: mean, allowance
      real(sp), intent(inout) :: contact(longest_chunk)   !! 1 at free points, 0 at others; then those that enter too
      real(dp), intent(out) :: sums(gap_sums)

      real(sp), dimension(longest_chunk) :: enter, gap, outside, violation
      real(sp) :: least
      integer :: n

      associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
         n = b - a + 1
         least = -allowance
         gap(:n) = self%gap(a:b) - mean
         outside(:n) = 1.0_sp - contact(:n)
         enter(:n) = merge(outside(:n), 0.0_sp, gap(:n) < least)
         violation(:n) = min(gap(:n), 0.0_sp)
         if (allocated(self%room)) then
            where (contact(:n) <= 0.0_sp .and. self%room(a:b) <= self%change(a:b))
               enter(:n) = merge(1.0_sp, 0.0_sp, gap(:n) > allowance)
               violation(:n) = max(gap(:n), 0.0_sp)
            end where
         end if
      end associate
      contact(:n) = contact(:n) + enter(:n)
      violation(:n) = (1.0_sp - contact(:n))*violation(:n)
      sums(5) = sdot(n, enter, 1, enter, 1)
      sums(4) = sdot(n, violation, 1, violation, 1)
      gap(:n) = contact(:n)*gap(:n)
      sums(:3) = [sdot(n, contact, 1, contact, 1), sdot(n, contact, 1, gap, 1), sdot(n, gap, 1, gap, 1)]
   end subroutine measure_chunk

   !> Takes over the sums of `measure_gap`, and adds the points that enter.
   !>
   !> The squares of gaps are those about the mean before points enter; about the mean over all free points they are
   !> less by their number times the square of the shift. Overlaps at other points are left as they were before it.
   subroutine set_approach(self, mean, allowance, sums, left)
      class(pressure_correction), intent(inout) :: self
      real(sp), intent(in) :: mean, allowance
      real(dp), intent(in) :: sums(gap_sums), left

      real(dp) :: shift, unused(gap_sums)
      real(sp) :: contact(longest_chunk)
      integer :: c

      self%contact_points = sums(1)
      self%changed_points = left + sums(5)
      ! Without free points the approach stays: the next step finds it from all points.
      shift = sums(2)/max(sums(1), 1.0_dp)
      self%residual = self%scale*sqrt(max(sums(3) - sums(1)*shift**2 + sums(4), 0.0_dp) &
                                      /product(real(self%slab%points, dp)))
      self%approach = real(mean + shift, sp)
      if (sums(5) <= 0.0_dp) return
      !$omp parallel do num_threads(self%region%threads) private(contact, unused)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            contact(:b - a + 1) = self%contact(a:b)
            call self%measure_chunk(c, mean, allowance, contact, unused)
            self%contact(a:b) = int(contact(:b - a + 1), int8)
         end associate
      end do
   end subroutine set_approach

   !> Replaces the pressure in `field` by its displacement, at the points of the region.
   subroutine displace(self, half_space)
      class(pressure_correction), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space

      call self%region%clear_outside(self%field)
      call half_space%displacement(self%field, self%region%columns, self%region%columns)
   end subroutine displace

   !> Sums over the grid from those of the chunks.
   function totals(self, parts)
      class(pressure_correction), intent(in) :: self
      real(dp), intent(in) :: parts(:, :)    !! shape (any, region%chunks)
      real(dp) :: totals(size(parts, 1))

      totals = self%slab%strip_totals(self%region%strip_sums(parts))
   end function totals

end module wavycon_pressure_correction
