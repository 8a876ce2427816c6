!> State of a correction of the pressure (`pressure_correction`): pressure, gap and contact at the points of a region.
!> The procedures compute the approach (C3), the points that enter the contact (C8) and the residual (C9), from the
!> sums (C8b). Numbers (C..) are the equations of README.md in this directory.
!>
!> Vectors have the points of the columns that this process has. A pass over vectors goes chunk by chunk
!> (`contact_region`) and computes several sums over each chunk. If the grid is distributed, one message then adds the
!> sums of all processes.
module wavycon_correction_state
   use wavycon_assertion, only: assert, assertions_stop
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: contact_region, longest_chunk
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_state, only: grid_state
   use wavycon_kinds, only: dp, sp
   use wavycon_lapack, only: sdot
   use wavycon_pressure_load, only: set_load
   implicit none (type, external)
   private

   public :: correction_state

   !> All vectors have the shape (region%points). Their pressures [p*] and gaps [Delta] are divided by `scale`, so that
   !> the numbers in single precision are of the order of one. Free points have 0 < p < H; they are the set K of (C3).
   type :: correction_state
      type(grid_slab) :: slab                     !! slab of the grid that this process has
      type(contact_region) :: region              !! points whose pressure may change
      real(dp) :: scale = 1.0_dp                  !! residual at the start [Delta], the unit of the vectors
      real(dp) :: residual = huge(1.0_dp)         !! present residual times G [Delta], (C9)
      real(dp) :: contact_points = 0.0_dp         !! number of free points
      !> Number of points that became free since the last direction; their pressure is still at its bound, 0 or H.
      real(dp) :: entered_points = 0.0_dp
      logical, allocatable :: has_entered(:)      !! whether a chunk has points that became free, shape (region%chunks)
      real(sp) :: approach = 0.0_sp               !! change of the approach, which is still to be subtracted from `gap`
      real(sp) :: allowance = huge(1.0_sp)        !! points with a smaller overlap than this do not enter (C8)
      !> Points with a smaller overlap than this part of the gap at the free points, `free_gap`, do not enter (C8c).
      real(sp) :: part_of_free_gap = 0.0_sp
      real(sp) :: free_gap = 0.0_sp               !! root mean square gap at the free points
      real(sp), allocatable :: start_pressure(:)  !! pressure p at the start
      real(sp), allocatable :: below_hardness(:)  !! H - p at the start; not allocated without a hardness
      real(sp), allocatable :: change(:)          !! change of the pressure since the start
      real(sp), allocatable :: gap(:)             !! gap before `approach` is subtracted
      real(sp), allocatable :: contact(:)         !! 1 at free points, 0 at those with p = 0 or p = H
      logical :: contact_is_new = .true.          !! whether `contact` changed since the preconditioner last copied it
   contains
      procedure :: start, put_residual, exclude_blocked, displace, take_step
      procedure, private :: update_contact
      procedure :: totals, sum_of, add_to
   end type correction_state

contains

   !> Starts a correction: makes the region, gathers pressure and gap, and computes approach and residual. No point
   !> enters the contact, because `allowance` is still infinite.
   subroutine start(self, grid, inside)
      class(correction_state), intent(out) :: self
      !> Pressure, gap, and residual [Delta] > 0, all computed for the same pressure, which is 0 or H outside the
      !> region.
      type(grid_state), intent(in) :: grid
      real(sp), intent(in) :: inside(:, :)      !! > 0 at the points of the region, shape of the pressure

      call assert(grid%residual > 0.0_dp .and. grid%residual < huge(1.0_dp), 'the residual is positive and finite')
      if (assertions_stop) then
         call assert(all(grid%pressure >= 0.0_dp .and. grid%pressure <= grid%hardness), '0 <= p <= H')
         call assert(all(abs(grid%gap) < huge(1.0_dp)), 'the gap is finite')
      end if
      self%scale = grid%residual
      self%slab = grid%slab
      call self%region%start(inside)
      associate (n => self%region%points)
         allocate (self%start_pressure(n), self%gap(n), self%contact(n))
         allocate (self%change(n), source=0.0_sp)
      end associate
      call self%region%gather_scaled(grid%pressure, self%scale, self%start_pressure)
      call self%region%gather_scaled(grid%gap, self%scale, self%gap)
      self%contact = merge(1.0_sp, 0.0_sp, self%start_pressure > 0.0_sp)
      if (grid%hardness < huge(grid%hardness)) then
         allocate (self%below_hardness, mold=self%gap)
         ! The difference loses no digits where the pressure is close to H.
         call self%region%gather_scaled(grid%hardness - grid%pressure, self%scale, self%below_hardness)
         where (self%below_hardness <= 0.0_sp) self%contact = 0.0_sp
      end if
      ! The first call finds the approach, the second the violations at this approach.
      call self%update_contact(0.0_sp)
      call self%update_contact(self%approach)
   end subroutine start

   !> Writes the residual r of (C3) to the points of the region: the gap at free points, zero at others.
   subroutine put_residual(self, field)
      class(correction_state), intent(in) :: self
      real(sp), intent(inout) :: field(:, :)   !! does not change outside the region, shape (M, slab%columns())

      real(sp) :: r(longest_chunk)
      integer :: c

      !$omp parallel do num_threads(self%region%threads) private(r)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            r(:b - a + 1) = self%contact(a:b)*(self%gap(a:b) - self%approach)
         end associate
         call self%region%put_chunk(c, r, field)
      end do
   end subroutine put_residual

   !> Excludes blocked points from the free ones (C4d): points that have just entered, whose pressure is still at its
   !> bound, and that a step along z would move beyond the bound. The approach then changes, because (C3) is a mean over
   !> the free points. The pressure falls where z exceeds its mean over the free points.
   subroutine exclude_blocked(self, field, blocked)
      class(correction_state), intent(inout) :: self
      real(sp), intent(in), contiguous :: field(:, :)   !! z, shape (M, slab%columns())
      real(dp), intent(out) :: blocked                  !! number of the points that are excluded

      real(dp) :: sums(2)
      real(dp), allocatable :: chunk_sums(:, :)
      real(sp) :: mean
      real(sp), dimension(longest_chunk) :: excluded, gap, z
      integer :: c, n

      blocked = 0.0_dp
      if (self%entered_points <= 0.0_dp) return
      allocate (chunk_sums(size(sums), self%region%chunks), source=0.0_dp)
      !$omp parallel do num_threads(self%region%threads) private(n, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, field, z)
            chunk_sums(1, c) = sdot(n, self%contact(a:b), 1, z, 1)
         end associate
      end do
      sums = self%totals(chunk_sums)
      mean = real(sums(1)/max(self%contact_points, 1.0_dp), sp)
      !$omp parallel do num_threads(self%region%threads) private(excluded, gap, n, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1, contact => self%contact)
            chunk_sums(:, c) = 0.0_dp
            if (.not. self%has_entered(c)) cycle
            n = b - a + 1
            call self%region%take_chunk(c, field, z)
            excluded(:n) = 0.0_sp
            where (z(:n) > mean .and. self%change(a:b) <= -self%start_pressure(a:b)) excluded(:n) = contact(a:b)
            if (allocated(self%below_hardness)) then
               where (z(:n) < mean .and. self%below_hardness(a:b) <= self%change(a:b)) excluded(:n) = contact(a:b)
            end if
            contact(a:b) = contact(a:b) - excluded(:n)
            gap(:n) = self%gap(a:b) - self%approach
            chunk_sums(:, c) = [sdot(n, excluded, 1, excluded, 1), -sdot(n, excluded, 1, gap, 1)]
         end associate
      end do
      sums = self%totals(chunk_sums)
      blocked = sums(1)
      self%contact_is_new = self%contact_is_new .or. blocked > 0.0_dp
      self%contact_points = self%contact_points - blocked
      self%approach = self%approach + real(sums(2)/max(self%contact_points, 1.0_dp), sp)
   end subroutine exclude_blocked

   !> The displacement S p of a pressure that is zero outside the region, in the columns of the region.
   subroutine displace(self, half_space, pressure, field)
      class(correction_state), intent(in) :: self
      type(compliance_operator), intent(inout) :: half_space   !! S, started on the grid
      real(sp), intent(in), contiguous :: pressure(:)          !! shape (region%points)
      !> On return the displacement, undefined in other columns, shape (M, slab%columns()).
      real(sp), intent(inout), contiguous :: field(:, :)

      integer :: c, j

      !$omp parallel num_threads(self%region%threads)
      !$omp do
      do j = 1, size(field, 2)
         if (self%region%columns(j)) field(:, j) = 0.0_sp
      end do
      !$omp do
      do c = 1, self%region%chunks
         call self%region%put_chunk(c, pressure(self%region%chunk(c):self%region%chunk(c + 1) - 1), field)
      end do
      !$omp end parallel
      call half_space%displacement(field, self%region%columns, self%region%columns)
   end subroutine displace

   !> Takes a step, and updates the contact. Points whose pressure reaches a bound leave it.
   subroutine take_step(self, step, direction, image)
      class(correction_state), intent(inout) :: self
      real(sp), intent(in) :: step                            !! step*direction is subtracted from the pressure
      real(sp), intent(in), contiguous :: direction(:)        !! shape (region%points)
      real(sp), intent(in), contiguous :: image(:, :)         !! displacement of `direction`, shape (M, slab%columns())

      !> A pressure below this part of the numbers that it is the sum of is zero but for rounding.
      real(sp), parameter :: rounding = 4*epsilon(1.0_sp)
      real(dp) :: sums(3)
      real(dp), allocatable :: chunk_sums(:, :)
      real(sp), dimension(longest_chunk) :: gap, within   ! within: 1 where the pressure is within a bound, else 0
      integer :: c, n

      allocate (chunk_sums(size(sums), self%region%chunks), source=0.0_dp)
      !$omp parallel do num_threads(self%region%threads) private(gap, n, within)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1, start => self%start_pressure, &
                    change => self%change, contact => self%contact)
            n = b - a + 1
            call self%region%take_chunk(c, image, gap)
            self%gap(a:b) = self%gap(a:b) - step*gap(:n)
            change(a:b) = change(a:b) - step*direction(a:b)
            ! Products with 0 and 1 make vector instructions, `where` and longer expressions with `merge` do not.
            within(:n) = merge(1.0_sp, 0.0_sp, start(a:b) + change(a:b) > rounding*(start(a:b) + abs(change(a:b))))
            contact(a:b) = within(:n)*contact(a:b)
            change(a:b) = within(:n)*change(a:b) - (1.0_sp - within(:n))*start(a:b)
            if (allocated(self%below_hardness)) then
               within(:n) = merge(1.0_sp, 0.0_sp, change(a:b) < self%below_hardness(a:b))
               contact(a:b) = within(:n)*contact(a:b)
               change(a:b) = min(change(a:b), self%below_hardness(a:b))
            end if
            gap(:n) = contact(a:b)*self%gap(a:b)
            chunk_sums(:2, c) = [sdot(n, contact(a:b), 1, contact(a:b), 1), sdot(n, contact(a:b), 1, self%gap(a:b), 1)]
            if (self%part_of_free_gap > 0.0_sp) chunk_sums(3, c) = sdot(n, gap, 1, gap, 1)   ! (C8c)
         end associate
      end do
      sums = self%totals(chunk_sums)
      sums(2:) = sums(2:)/max(sums(1), 1.0_dp)
      if (sums(1) < self%contact_points) then
         self%contact_is_new = .true.
         self%free_gap = real(sqrt(max(sums(3) - sums(2)**2, 0.0_dp)), sp)
      end if
      call self%update_contact(real(sums(2), sp))
   end subroutine take_step

   !> Updates the contact, in one pass over the points and with one message. Points that overlap become free (C8). The
   !> approach becomes that whose mean gap over the free points is zero (C3). The residual (C9) times G follows from the
   !> sums (C8b).
   subroutine update_contact(self, mean)
      class(correction_state), intent(inout) :: self
      real(sp), intent(in) :: mean                      !! mean gap over the free points, m of (C8b)

      real(dp) :: shift, squares, sums(5)
      real(dp), allocatable :: chunk_sums(:, :)
      real(sp) :: allowance
      ! The new set of free points, those that become free, the gap less its mean, and the overlap at other points.
      real(sp), dimension(longest_chunk) :: contact, enter, gap, outside
      integer :: c, n

      allocate (chunk_sums(size(sums), self%region%chunks))
      allowance = max(self%allowance, self%part_of_free_gap*self%free_gap)
      !$omp parallel do num_threads(self%region%threads) private(contact, enter, gap, n, outside)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            gap(:n) = self%gap(a:b) - mean
            outside(:n) = gap(:n)
            if (allocated(self%below_hardness)) then
               ! At the hardness the condition on the gap has the other sign (C21).
               where (self%below_hardness(a:b) <= self%change(a:b)) outside(:n) = -gap(:n)
            end if
            enter(:n) = merge(1.0_sp, 0.0_sp, outside(:n) < -allowance)
            enter(:n) = (1.0_sp - self%contact(a:b))*enter(:n)
            contact(:n) = self%contact(a:b) + enter(:n)
            outside(:n) = (1.0_sp - contact(:n))*min(outside(:n), 0.0_sp)
            gap(:n) = contact(:n)*gap(:n)
            chunk_sums(:, c) = [sdot(n, contact, 1, contact, 1), sdot(n, contact, 1, gap, 1), &
                                sdot(n, gap, 1, gap, 1), sdot(n, outside, 1, outside, 1), sdot(n, enter, 1, enter, 1)]
            if (chunk_sums(5, c) > 0.0_dp) self%contact(a:b) = contact(:n)
         end associate
      end do
      self%has_entered = chunk_sums(5, :) > 0.0_dp
      sums = self%totals(chunk_sums)
      self%contact_points = sums(1)
      self%entered_points = sums(5)
      self%contact_is_new = self%contact_is_new .or. sums(5) > 0.0_dp
      ! Without free points the shift is zero. The next step of `solve_on_grid` computes the approach from all points.
      shift = sums(2)/max(sums(1), 1.0_dp)
      self%approach = real(mean + shift, sp)
      squares = sums(3) - sums(1)*shift**2
      self%free_gap = real(sqrt(max(squares, 0.0_dp)/max(sums(1), 1.0_dp)), sp)
      self%residual = self%scale*sqrt(max(squares + sums(4), 0.0_dp)/product(real(self%slab%points, dp)))
   end subroutine update_contact

   !> Adds sums over chunks to sums over the grid. If the grid is distributed this takes one message.
   function totals(self, chunk_sums)
      class(correction_state), intent(in) :: self
      real(dp), intent(in) :: chunk_sums(:, :)    !! shape (number of different sums, region%chunks)
      real(dp) :: totals(size(chunk_sums, 1))

      totals = self%slab%strip_totals(self%region%strip_sums(chunk_sums))
   end function totals

   !> The sum of a vector over the grid.
   real(dp) function sum_of(self, vector)
      class(correction_state), intent(in) :: self
      real(dp), intent(in) :: vector(:)      !! shape (region%points)

      real(dp) :: chunk_sums(1, self%region%chunks)
      integer :: c

      do c = 1, self%region%chunks
         chunk_sums(1, c) = sum(vector(self%region%chunk(c):self%region%chunk(c + 1) - 1))
      end do
      sum_of = sum(self%totals(chunk_sums))
   end function sum_of

   !> Ends a correction: adds the change to the pressure of the grid, in double precision, and restores the pressure's
   !> mean, which single precision has changed a little.
   subroutine add_to(self, grid)
      class(correction_state), intent(in) :: self
      type(grid_state), intent(inout) :: grid   !! the grid of `start`, with the same pressure

      real(dp) :: load

      load = grid%slab%sum_of(grid%pressure)
      call self%region%correct(self%change, self%contact, self%scale, grid%hardness, grid%pressure)
      call set_load(grid%slab, grid%pressure, load, grid%hardness)
   end subroutine add_to

end module wavycon_correction_state
