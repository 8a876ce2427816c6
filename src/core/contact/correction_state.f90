!> Pressure, gap and contact of a correction at the points of a region: the approach (C3), the points that enter (C8)
!> and the residual (C9), by the sums (C8c). Numbers (C..) are the equations of README.md in this directory.
!>
!> Vectors have the points of the own columns. A pass over them goes chunk by chunk (`contact_region`) and computes all
!> its sums; one message then adds those of all slabs.
module wavycon_correction_state
   use, intrinsic :: iso_c_binding, only: c_bool
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

   !> All vectors have the shape (region%points) and are over `scale`; pressures are in p*, gaps in Delta.
   type :: correction_state
      type(grid_slab) :: slab
      type(contact_region) :: region
      real(dp) :: scale = 1.0_dp                  !! the residual at the start
      real(dp) :: residual = huge(1.0_dp)         !! as `solve_on_grid`'s, times G
      real(dp) :: contact_points = 0.0_dp
      real(dp) :: entered_points = 0.0_dp         !! since the last direction: they have p = 0 or p = H
      logical, allocatable :: has_entered(:)      !! whether some of these are in a chunk, shape (region%chunks)
      real(sp) :: approach = 0.0_sp               !! what is to be subtracted from `gap`
      real(sp) :: allowance = huge(1.0_sp)        !! the least overlap of points that enter
      real(sp), allocatable :: start_pressure(:)
      real(sp), allocatable :: room(:)            !! H - p of the start; not allocated without a hardness
      real(sp), allocatable :: change(:)          !! of the pressure since the start
      real(sp), allocatable :: gap(:)
      real(sp), allocatable :: contact(:)         !! 1 at free points, 0 at those with p = 0 or p = H
      logical :: contact_is_new = .true.          !! whether it has changed since the preconditioner took it over
   contains
      procedure :: start
      procedure :: put_residual
      procedure :: exclude_blocked
      procedure :: displace
      procedure :: mean_gap
      procedure :: update_contact
      procedure :: totals
      procedure :: sum_of
      procedure :: add_to
   end type correction_state

contains

   subroutine start(self, grid, inside)
      class(correction_state), intent(out) :: self
      type(grid_state), intent(in) :: grid      !! with pressure, gap and residual > 0; p is 0 or H outside the region
      real(sp), intent(in) :: inside(:, :)      !! > 0 at the points in and near the contact, shape of the pressure

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
         allocate (self%room, mold=self%gap)
         ! The difference loses no digits where the pressure is close to H.
         call self%region%gather_scaled(grid%hardness - grid%pressure, self%scale, self%room)
         self%contact = merge(self%contact, 0.0_sp, self%room > 0.0_sp)
      end if
      call self%update_contact(self%mean_gap())
   end subroutine start

   !> Writes the residual r, the gap at free points and zero at others, to the points of the region.
   subroutine put_residual(self, field)
      class(correction_state), intent(in) :: self
      real(sp), intent(inout) :: field(:, :)   !! shape (M, slab%columns())

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

   !> Excludes from the free points those that have just entered and that z would move beyond their bound (C4d).
   subroutine exclude_blocked(self, field, blocked)
      class(correction_state), intent(inout) :: self
      real(sp), intent(in), contiguous :: field(:, :)   !! z, shape (M, slab%columns())
      real(dp), intent(out) :: blocked                  !! how many points are excluded

      real(dp) :: sums(2)
      real(dp), allocatable :: parts(:, :)
      real(sp) :: mean
      real(sp), dimension(longest_chunk) :: excluded, gap, z
      integer :: c, n

      blocked = 0.0_dp
      if (self%entered_points <= 0.0_dp) return
      allocate (parts(size(sums), self%region%chunks), source=0.0_dp)
      !$omp parallel do num_threads(self%region%threads) private(n, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, field, z)
            parts(1, c) = sdot(n, self%contact(a:b), 1, z, 1)
         end associate
      end do
      sums = self%totals(parts)
      mean = real(sums(1)/max(self%contact_points, 1.0_dp), sp)
      !$omp parallel do num_threads(self%region%threads) private(excluded, gap, n, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1, contact => self%contact)
            parts(:, c) = 0.0_dp
            if (.not. self%has_entered(c)) cycle
            n = b - a + 1
            call self%region%take_chunk(c, field, z)
            excluded(:n) = merge(contact(a:b), 0.0_sp, z(:n) > mean .and. self%change(a:b) <= -self%start_pressure(a:b))
            if (allocated(self%room)) &
               excluded(:n) = merge(contact(a:b), excluded(:n), z(:n) < mean .and. self%room(a:b) <= self%change(a:b))
            contact(a:b) = contact(a:b) - excluded(:n)
            gap(:n) = self%gap(a:b) - self%approach
            parts(:, c) = [sdot(n, excluded, 1, excluded, 1), -sdot(n, excluded, 1, gap, 1)]
         end associate
      end do
      sums = self%totals(parts)
      blocked = sums(1)
      self%contact_is_new = self%contact_is_new .or. blocked > 0.0_dp
      self%contact_points = self%contact_points - blocked
      self%approach = self%approach + real(sums(2)/max(self%contact_points, 1.0_dp), sp)
   end subroutine exclude_blocked

   !> Replaces a pressure by its displacement, at the points of the region.
   subroutine displace(self, half_space, field)
      class(correction_state), intent(in) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(sp), intent(inout), contiguous :: field(:, :)   !! pressure, then displacement, shape (M, slab%columns())

      call self%region%clear_outside(field)
      call half_space%displacement(field, self%region%columns, self%region%columns)
   end subroutine displace

   !> The mean of the gap over the free points, after a displacement is added to the gap.
   real(sp) function mean_gap(self, displacement)
      class(correction_state), intent(inout) :: self
      real(sp), intent(in), optional :: displacement(:, :)   !! shape (M, slab%columns())

      real(dp) :: sums(2)
      real(dp), allocatable :: parts(:, :)
      real(sp) :: added(longest_chunk)
      integer :: c, n

      allocate (parts(size(sums), self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(added, n)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1, contact => self%contact)
            n = b - a + 1
            if (present(displacement)) then
               call self%region%take_chunk(c, displacement, added)
               self%gap(a:b) = self%gap(a:b) + added(:n)
            end if
            parts(:, c) = [sdot(n, contact(a:b), 1, contact(a:b), 1), sdot(n, contact(a:b), 1, self%gap(a:b), 1)]
         end associate
      end do
      sums = self%totals(parts)
      mean_gap = real(sums(2)/max(sums(1), 1.0_dp), sp)
   end function mean_gap

   !> Takes a step, if one is given, that takes no point to a bound. Then adds to the free points those that overlap
   !> (C8), changes the approach so that the mean gap over the free points is zero (C3), and computes the residual (C9)
   !> times G: by the sums (C8c).
   subroutine update_contact(self, mean, step, direction, image)
      class(correction_state), intent(inout) :: self
      real(sp), intent(in) :: mean                      !! of the gap over the free points, after the step
      real(sp), intent(in), optional :: step            !! what is subtracted is this times
      real(sp), intent(in), optional :: direction(:)    !! of the pressure, shape (region%points), and
      real(sp), intent(in), optional :: image(:, :)     !! its displacement, shape (M, slab%columns())

      real(dp) :: shift, sums(5)
      real(dp), allocatable :: parts(:, :)
      real(sp), dimension(longest_chunk) :: contact, enter, gap, outside
      integer :: c, n

      allocate (parts(size(sums), self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact, enter, gap, n, outside)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            if (present(step)) then
               call self%region%take_chunk(c, image, gap)
               self%gap(a:b) = (self%gap(a:b) - self%approach) - step*gap(:n)
               self%change(a:b) = self%change(a:b) - step*direction(a:b)
            end if
            gap(:n) = self%gap(a:b) - mean
            outside(:n) = gap(:n)
            if (allocated(self%room)) outside(:n) = merge(-gap(:n), gap(:n), self%room(a:b) <= self%change(a:b))
            enter(:n) = merge(1.0_sp - self%contact(a:b), 0.0_sp, outside(:n) < -self%allowance)
            contact(:n) = self%contact(a:b) + enter(:n)
            outside(:n) = (1.0_sp - contact(:n))*min(outside(:n), 0.0_sp)
            gap(:n) = contact(:n)*gap(:n)
            parts(:, c) = [sdot(n, contact, 1, contact, 1), sdot(n, contact, 1, gap, 1), sdot(n, gap, 1, gap, 1), &
                           sdot(n, outside, 1, outside, 1), sdot(n, enter, 1, enter, 1)]
            if (parts(5, c) > 0.0_dp) self%contact(a:b) = contact(:n)
         end associate
      end do
      self%has_entered = parts(5, :) > 0.0_dp
      sums = self%totals(parts)
      self%contact_points = sums(1)
      self%entered_points = sums(5)
      self%contact_is_new = self%contact_is_new .or. sums(5) > 0.0_dp
      ! Without free points the approach stays: the next step finds it from all points.
      shift = sums(2)/max(sums(1), 1.0_dp)
      self%approach = real(mean + shift, sp)
      self%residual = self%scale*sqrt(max(sums(3) - sums(1)*shift**2 + sums(4), 0.0_dp) &
                                      /product(real(self%slab%points, dp)))
   end subroutine update_contact

   !> Sums over the grid from those of the chunks.
   function totals(self, parts)
      class(correction_state), intent(in) :: self
      real(dp), intent(in) :: parts(:, :)    !! shape (any, region%chunks)
      real(dp) :: totals(size(parts, 1))

      totals = self%slab%strip_totals(self%region%strip_sums(parts))
   end function totals

   !> The sum of a vector over the grid.
   real(dp) function sum_of(self, vector)
      class(correction_state), intent(in) :: self
      real(dp), intent(in) :: vector(:)      !! shape (region%points)

      real(dp) :: parts(1, self%region%chunks), total(1)
      integer :: c

      do c = 1, self%region%chunks
         parts(1, c) = sum(vector(self%region%chunk(c):self%region%chunk(c + 1) - 1))
      end do
      total = self%totals(parts)
      sum_of = total(1)
   end function sum_of

   !> Adds the change to the pressure of the grid and restores its mean.
   subroutine add_to(self, grid)
      class(correction_state), intent(in) :: self
      type(grid_state), intent(inout) :: grid   !! that of `start`

      logical(c_bool), allocatable :: at_hardness(:)
      real(dp) :: load

      allocate (at_hardness(self%region%points), source=.false._c_bool)
      if (allocated(self%room)) at_hardness = self%room <= self%change
      load = grid%slab%sum_of(grid%pressure)
      call self%region%correct(self%change, self%contact, at_hardness, self%scale, grid%hardness, grid%pressure)
      call set_load(grid%slab, grid%pressure, load, grid%hardness)
   end subroutine add_to

end module wavycon_correction_state
