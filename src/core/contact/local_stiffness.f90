!> The preconditioner for contacts of few points: the inverse S^-1 of the half-space's operator, cut off at a distance
!> of a few steps.
!>
!> S^-1 multiplies each wave by its wave number |k|. Its kernel falls as the inverse third power of the distance, so
!> that the nearest neighbours have most of it, and a stencil of a few steps is close to S^-1.
module wavycon_local_stiffness
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: contact_region
   use wavycon_contact_tuning, only: stencil_reach
   use wavycon_grid_convolution_dp, only: grid_convolution
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   implicit none (type, external)
   private

   public :: local_stiffness

   !> The weights are computed on a periodic cell with this many points a side. So the images are far enough away.
   integer, parameter :: kernel_points = 32
   !> Largest ratio of the steps in x and y. The stencil is a circle in numbers of steps; at larger ratios it would
   !> leave out points that are nearer than some of its own.
   real(dp), parameter :: largest_step_ratio = 1.5_dp

   type :: local_stiffness
      !> Whether there is a stencil: the steps are nearly equal, the grid is larger than the stencil, and the compliance
      !> does not rise with the wave number.
      logical :: exists = .false.
      !> Displacements to which the stencil is applied, zero outside the region: the columns of this process and
      !> `stencil_reach` rows and columns on each side, shape (1-r:M+r, 1-r:slab%columns()+r).
      real(sp), allocatable :: field(:, :)
      logical, private :: even = .false.   !! whether the grid continues by mirror images, otherwise periodically
      !> The stencil: pressures at the distances of i and j steps from a displacement of one at one point.
      real(sp), private :: weights(-stencil_reach:stencil_reach, -stencil_reach:stencil_reach) = 0.0_sp
      logical :: is_started = .false.
   contains
      procedure :: start, apply
   end type local_stiffness

contains

   !> Computes the weights, if there is a stencil: S^-1 is applied to a displacement of one at a single point.
   subroutine start(self, half_space, slab)
      class(local_stiffness), intent(out) :: self
      type(compliance_operator), intent(in) :: half_space   !! S, started on the grid
      type(grid_slab), intent(in) :: slab                   !! columns of the grid that this process has

      type(grid_convolution) :: cell
      real(dp), allocatable :: pressure(:, :)
      real(dp) :: per_step(2)
      integer :: i, j, points(2)

      self%is_started = .true.
      self%even = half_space%even
      per_step = half_space%stiffness_per_step
      if (slab%points(2) == 1) per_step(2) = per_step(1)
      self%exists = maxval(per_step) <= largest_step_ratio*minval(per_step) .and. &
                    all(slab%points >= 2*stencil_reach .or. (slab%points == 1 .and. [.false., .true.])) .and. &
                    half_space%kernel%order(half_space%frequency_of_step) <= 0.0_dp
      if (.not. self%exists) return
      associate (m => slab%points(1), n => slab%columns(), r => stencil_reach)
         allocate (self%field(1 - r:m + r, 1 - r:n + r), source=0.0_sp)
      end associate
      points = merge(kernel_points, 1, slab%points > 1)
      allocate (pressure(0:points(1) - 1, 0:points(2) - 1), source=0.0_dp)
      pressure(0, 0) = 1.0_dp
      call cell%start(points, .false., half_space%kernel, per_step/kernel_points)
      call cell%apply(pressure, 1, threads=1)
      do j = 0, min(stencil_reach, points(2) - 1)
         do i = 0, stencil_reach
            if (i**2 + j**2 > stencil_reach**2) cycle
            self%weights([-i, i], [-j, j]) = real(pressure(i, j), sp)
         end do
      end do
   end subroutine start

   !> Applies the stencil to the displacements in self%field, at the points of a region.
   subroutine apply(self, slab, region, pressure)
      class(local_stiffness), intent(inout) :: self      !! self%exists is true; `field` has the displacements
      type(grid_slab), intent(in) :: slab                !! the slab of `start`
      type(contact_region), intent(in) :: region         !! points at which pressures are wanted
      real(sp), intent(inout) :: pressure(:, :)          !! does not change elsewhere, shape (M, slab%columns())

      integer, parameter :: r = stencil_reach
      integer :: k

      associate (m => slab%points(1), n => slab%columns(), field => self%field)
         do k = 1, r
            field(1 - k, 1:n) = field(image_of_point(1 - k, m, self%even), 1:n)
            field(m + k, 1:n) = field(image_of_point(m + k, m, self%even), 1:n)
         end do
         if (slab%points(2) > 1) call slab%halo(field(:, 1:n), self%even, field(:, 1 - r:0), field(:, n + 1:n + r))
         call region%convolve(self%weights, field, pressure)
      end associate
   end subroutine apply

end module wavycon_local_stiffness
