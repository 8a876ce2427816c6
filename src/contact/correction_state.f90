!> Pressure, gap and contact of a correction at the points of a region: the approach (C3), the points that enter (C8)
!> and the residual (C9), by the sums (C8c). Numbers (C..) are the equations of README.md in this directory.
!>
!> Vectors have the points of the own columns. A pass over them goes chunk by chunk (`contact_region`) and computes all
!> its sums; one message then adds those of all slabs.
module wavycon_correction_state
   use, intrinsic :: iso_c_binding, only: c_bool
   use, intrinsic :: iso_fortran_env, only: int8
   use wavycon_assertion, only: assert, assertions_stop
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: contact_region, longest_chunk
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_lapack, only: sdot
   implicit none (type, external)
   private

   public :: correction_state

   !> Sums of a pass over the gap: the free points, their gaps and squares of gaps, the squares of violations at the
   !> others, and the points that enter the contact.
   integer, parameter, public :: gap_sums = 5

   !> All vectors have the shape (region%points) and are over `scale`; pressures are in p*, gaps in Delta.
   type :: correction_state
      type(grid_slab) :: slab
      type(contact_region) :: region
      real(dp) :: scale = 1.0_dp                  !! the residual at the start
      real(dp) :: residual = huge(1.0_dp)         !! as `solve_on_grid`'s, times G
      real(dp) :: hardness = huge(1.0_dp)
      real(dp) :: contact_points = 0.0_dp
      real(dp) :: entered_points = 0.0_dp         !! since the last direction: they have p = 0 or p = H
      real(sp) :: approach = 0.0_sp               !! what is to be subtracted from `gap`
      real(sp) :: mean_gap = 0.0_sp               !! over the contact, before points enter
      real(sp) :: allowance = huge(1.0_sp)        !! the least overlap of points that enter
      real(sp), allocatable :: start_pressure(:)
      real(sp), allocatable :: room(:)            !! H - p of the start; not allocated without a hardness
      real(sp), allocatable :: change(:)          !! of the pressure since the start
      real(sp), allocatable :: gap(:)
      integer(int8), allocatable :: contact(:)    !! 1 at free points, 0 at those with p = 0 or p = H
   contains
      procedure :: start
      procedure :: put_residual
      procedure :: exclude_blocked
      procedure :: displace
      procedure :: add_image
      procedure :: has_points_at_hardness
      procedure :: measure_gap
      procedure :: measure_chunk
      procedure :: update_contact
      procedure :: totals
   end type correction_state

contains

   subroutine start(self, slab, inside, pressure, gap, residual, hardness)
      class(correction_state), intent(out) :: self
      type(grid_slab), intent(in) :: slab         !! of the grid
      logical(c_bool), intent(in) :: inside(:, :) !! the points in and near the contact, shape (M, slab%columns())
      real(dp), intent(in) :: pressure(:, :)      !! p/p*, 0 <= p <= H, own columns; 0 or H outside the region
      real(dp), intent(in) :: gap(:, :)           !! its gap/Delta, own columns
      real(dp), intent(in) :: residual            !! root mean square of the violated conditions [Delta], > 0
      real(dp), intent(in) :: hardness            !! H/p*, huge if there is none

      call assert(residual > 0.0_dp .and. residual < huge(residual), 'the residual is positive and finite')
      call assert(all(shape(pressure) == [slab%points(1), slab%columns()] .and. shape(gap) == shape(pressure) &
                      .and. shape(inside) == shape(pressure)), 'the fields have the columns of the slab')
      if (assertions_stop) then
         call assert(all(pressure >= 0.0_dp .and. pressure <= hardness), '0 <= p <= H')
         call assert(all(abs(gap) < huge(gap)), 'the gap is finite')
      end if
      self%hardness = hardness
      self%scale = residual
      self%slab = slab
      call self%region%start(inside)
      associate (n => self%region%points)
         allocate (self%start_pressure(n), self%gap(n), self%contact(n))
         allocate (self%change(n), source=0.0_sp)
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
   end subroutine start

   !> Writes the residual r, the gap at free points and zero at others, to the points of the region.
   subroutine put_residual(self, field)
      class(correction_state), intent(in) :: self
      real(sp), intent(inout), contiguous :: field(:, :)   !! shape (M, slab%columns())

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
      real(sp), dimension(longest_chunk) :: contact, excluded, gap, z
      integer :: c, n

      blocked = 0.0_dp
      if (self%entered_points <= 0.0_dp) return
      allocate (parts(size(sums), self%region%chunks), source=0.0_dp)
      !$omp parallel do num_threads(self%region%threads) private(contact, n, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, field, z)
            contact(:n) = self%contact(a:b)
            parts(1, c) = sdot(n, contact, 1, z, 1)
         end associate
      end do
      sums = self%totals(parts)
      mean = real(sums(1)/max(self%contact_points, 1.0_dp), sp)
      !$omp parallel do num_threads(self%region%threads) private(contact, excluded, gap, n, z)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, field, z)
            contact(:n) = self%contact(a:b)
            excluded(:n) = merge(contact(:n), 0.0_sp, z(:n) > mean .and. &
                                 self%start_pressure(a:b) + self%change(a:b) <= 0.0_sp)
            if (allocated(self%room)) &
               excluded(:n) = merge(contact(:n), excluded(:n), z(:n) < mean .and. self%room(a:b) <= self%change(a:b))
            contact(:n) = contact(:n) - excluded(:n)
            self%contact(a:b) = int(contact(:n), int8)
            gap(:n) = self%gap(a:b) - self%approach
            parts(:, c) = [sdot(n, excluded, 1, excluded, 1), sdot(n, contact, 1, gap, 1)]
         end associate
      end do
      sums = self%totals(parts)
      blocked = sums(1)
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

   !> Adds the displacement of a pressure to the gap, and finds the mean over the contact and how many points have left.
   subroutine add_image(self, half_space, field, sums)
      class(correction_state), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      real(sp), intent(inout), contiguous :: field(:, :)   !! pressure, then displacement, shape (M, slab%columns())
      real(dp), intent(out) :: sums(gap_sums)              !! of `measure_gap`

      real(dp) :: in_contact(2)
      real(dp), allocatable :: parts(:, :)
      real(sp), dimension(longest_chunk) :: contact, image
      integer :: c, n

      call self%displace(half_space, field)
      allocate (parts(size(in_contact), self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact, image, n)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            n = b - a + 1
            call self%region%take_chunk(c, field, image)
            self%gap(a:b) = self%gap(a:b) + image(:n)
            contact(:n) = self%contact(a:b)
            parts(:, c) = [sdot(n, contact, 1, contact, 1), sdot(n, contact, 1, self%gap(a:b), 1)]
         end associate
      end do
      in_contact = self%totals(parts)
      self%mean_gap = real(in_contact(2)/max(in_contact(1), 1.0_dp), sp)
      sums = self%measure_gap()
   end subroutine add_image

   !> Whether any point of the region has p = H at the start.
   logical function has_points_at_hardness(self) result(has)
      class(correction_state), intent(in) :: self

      has = .false.
      if (allocated(self%room)) has = self%slab%any(any(self%room <= 0.0_sp))
   end function has_points_at_hardness

   !> The sums of a pass over the gap.
   function measure_gap(self) result(sums)
      class(correction_state), intent(in) :: self
      real(dp) :: sums(gap_sums)

      real(dp), allocatable :: parts(:, :)
      real(sp) :: contact(longest_chunk)
      integer :: c

      allocate (parts(gap_sums, self%region%chunks))
      !$omp parallel do num_threads(self%region%threads) private(contact)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            contact(:b - a + 1) = self%contact(a:b)
         end associate
         call self%measure_chunk(c, contact, parts(:, c))
      end do
      sums = self%totals(parts)
   end function measure_gap

   !> The part of one chunk in the sums of `measure_gap`.
   subroutine measure_chunk(self, c, contact, sums)
      class(correction_state), intent(in) :: self
      integer, intent(in) :: c
      real(sp), intent(inout) :: contact(longest_chunk)   !! 1 at free points, 0 at others; then those that enter too
      real(dp), intent(out) :: sums(gap_sums)

      real(sp), dimension(longest_chunk) :: enter, gap, outside, violation
      integer :: n

      associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
         n = b - a + 1
         gap(:n) = self%gap(a:b) - self%mean_gap
         outside(:n) = 1.0_sp - contact(:n)
         enter(:n) = merge(outside(:n), 0.0_sp, gap(:n) < -self%allowance)
         violation(:n) = min(gap(:n), 0.0_sp)
         if (allocated(self%room)) then
            where (contact(:n) <= 0.0_sp .and. self%room(a:b) <= self%change(a:b))
               enter(:n) = merge(1.0_sp, 0.0_sp, gap(:n) > self%allowance)
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

   !> Adds to the free points those that overlap (C8), changes the approach so that the mean gap over the free points is
   !> zero (C3), and computes the residual (C9) times G.
   !>
   !> The sum of squares of gaps is taken about the mean before points enter. About the mean over all free points it is
   !> smaller by their number times the square of the shift. Overlaps at other points are not updated.
   subroutine update_contact(self, sums)
      class(correction_state), intent(inout) :: self
      real(dp), intent(in) :: sums(gap_sums)   !! of `measure_gap`

      real(dp) :: shift, unused(gap_sums)
      real(sp) :: contact(longest_chunk)
      integer :: c

      self%contact_points = sums(1)
      self%entered_points = sums(5)
      ! Without free points the approach stays: the next step finds it from all points.
      shift = sums(2)/max(sums(1), 1.0_dp)
      self%residual = self%scale*sqrt(max(sums(3) - sums(1)*shift**2 + sums(4), 0.0_dp) &
                                      /product(real(self%slab%points, dp)))
      self%approach = real(self%mean_gap + shift, sp)
      if (sums(5) <= 0.0_dp) return
      !$omp parallel do num_threads(self%region%threads) private(contact, unused)
      do c = 1, self%region%chunks
         associate (a => self%region%chunk(c), b => self%region%chunk(c + 1) - 1)
            contact(:b - a + 1) = self%contact(a:b)
            call self%measure_chunk(c, contact, unused)
            self%contact(a:b) = int(contact(:b - a + 1), int8)
         end associate
      end do
   end subroutine update_contact

   !> Sums over the grid from those of the chunks.
   function totals(self, parts)
      class(correction_state), intent(in) :: self
      real(dp), intent(in) :: parts(:, :)    !! shape (any, region%chunks)
      real(dp) :: totals(size(parts, 1))

      totals = self%slab%strip_totals(self%region%strip_sums(parts))
   end function totals

end module wavycon_correction_state
