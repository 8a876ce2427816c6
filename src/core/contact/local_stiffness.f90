!> The inverse S^-1 of the half-space's operator, cut off at a few steps: a preconditioner for contacts of few points.
!>
!> S^-1 is |k|. Its kernel falls with the third power of the distance, so that the next neighbours have most of it.
module wavycon_local_stiffness
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_region, only: contact_region, longest_chunk
   use wavycon_contact_tuning, only: stencil_reach
   use wavycon_grid_convolution_dp, only: grid_convolution
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   implicit none (type, external)
   private

   public :: local_stiffness

   !> The kernel is that of a cell with this many points a side: its images are far enough away.
   integer, parameter :: kernel_points = 32
   !> Largest ratio of the steps in x and y. Beyond it neighbours in a circle of steps leave out the nearest points.
   real(dp), parameter :: largest_step_ratio = 1.5_dp

   type :: local_stiffness
      logical :: exists = .false.        !! whether the grid has one: its steps are nearly equal and it is large enough
      !> Displacements of the own columns, and images of them beyond the grid; zero outside the region.
      real(sp), allocatable :: field(:, :)
      logical, private :: even = .false.
      real(sp), private :: weights(-stencil_reach:stencil_reach, -stencil_reach:stencil_reach) = 0.0_sp
      logical :: is_started = .false.
   contains
      procedure :: start
      procedure :: apply
   end type local_stiffness

contains

   subroutine start(self, half_space, slab)
      class(local_stiffness), intent(out) :: self
      type(compliance_operator), intent(in) :: half_space   !! S, started on the grid
      type(grid_slab), intent(in) :: slab                   !! of the grid

      type(grid_convolution) :: cell
      real(dp), allocatable :: pressure(:, :)
      real(dp) :: per_step(2)
      integer :: i, j, points(2)

      self%is_started = .true.
      self%even = half_space%even
      per_step = half_space%stiffness_per_step
      if (slab%points(2) == 1) per_step(2) = per_step(1)
      self%exists = maxval(per_step) <= largest_step_ratio*minval(per_step) .and. &
                    all(slab%points >= 2*stencil_reach .or. (slab%points == 1 .and. [.false., .true.]))
      if (.not. self%exists) return
      associate (m => slab%points(1), n => slab%columns(), r => stencil_reach)
         allocate (self%field(1 - r:m + r, 1 - r:n + r), source=0.0_sp)
      end associate
      points = merge(kernel_points, 1, slab%points > 1)
      allocate (pressure(0:points(1) - 1, 0:points(2) - 1), source=0.0_dp)
      pressure(0, 0) = 1.0_dp
      call cell%start(points, .false., half_space%kernel, per_step/kernel_points)
      call cell%apply(pressure, 1, threads=1)
      do j = 0, merge(stencil_reach, 0, slab%points(2) > 1)
         do i = 0, stencil_reach
            if (i**2 + j**2 > stencil_reach**2) cycle
            self%weights([-i, i], [-j, j]) = real(pressure(i, j), sp)
         end do
      end do
   end subroutine start

   !> Replaces displacements by their pressures at the points of a region.
   subroutine apply(self, slab, region, pressure)
      class(local_stiffness), intent(inout) :: self      !! which exists, with the displacements in `field`
      type(grid_slab), intent(in) :: slab                !! that of `start`
      type(contact_region), intent(in) :: region         !! of its points
      real(sp), intent(inout) :: pressure(:, :)          !! own columns; not changed outside the region

      integer, parameter :: r = stencil_reach
      real(sp) :: values(longest_chunk)
      integer :: c, k

      associate (m => slab%points(1), n => slab%columns(), field => self%field)
         do k = 1, r
            field(1 - k, 1:n) = field(image_of_point(1 - k, m, self%even), 1:n)
            field(m + k, 1:n) = field(image_of_point(m + k, m, self%even), 1:n)
         end do
         if (slab%points(2) > 1) call slab%halo(field(:, 1:n), self%even, field(:, 1 - r:0), field(:, n + 1:n + r))
         !$omp parallel do num_threads(region%threads) private(values)
         do c = 1, region%chunks
            call region%convolve_chunk(c, self%weights, field, values)
            call region%put_chunk(c, values, pressure)
         end do
      end associate
   end subroutine apply

end module wavycon_local_stiffness
