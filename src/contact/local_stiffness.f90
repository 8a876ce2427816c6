!> The inverse S^-1 of the half-space's operator, cut off at a few steps: a preconditioner for contacts of few points.
!>
!> S^-1 is |k|. Its kernel falls with the third power of the distance, so that the next neighbours have most of it.
module wavycon_local_stiffness
   use wavycon_constants, only: pi
   use wavycon_contact_region, only: contact_region
   use wavycon_contact_tuning, only: stencil_reach
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: local_stiffness

   !> The kernel is that of a cell with this many points a side: its images are far enough away.
   integer, parameter :: kernel_points = 32
   !> Largest ratio of the steps in x and y. Beyond it neighbours in a circle of steps leave out the nearest points.
   real(dp), parameter :: largest_step_ratio = 1.5_dp

   type :: local_stiffness
      logical :: exists = .false.        !! whether the grid has one: its steps are nearly equal and it is large enough
      logical :: even = .false.
      real(sp), private :: weights(-stencil_reach:stencil_reach, -stencil_reach:stencil_reach) = 0.0_sp
      real(sp), allocatable, private :: field(:, :)   !! with its neighbours beyond the grid
   contains
      procedure :: start
      procedure :: apply
   end type local_stiffness

contains

   subroutine start(self, surface, points)
      class(local_stiffness), intent(out) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)      !! M, N, on a quarter of an even surface's cell

      real(dp) :: step(2), symbol(0:kernel_points - 1, 0:kernel_points - 1), x, y
      integer :: i, j, k, last(2), wave(2)

      self%even = surface%shape%is_even()
      step = surface%length/(points*merge(2, 1, self%even))
      if (points(2) == 1) step(2) = step(1)
      self%exists = maxval(step) <= largest_step_ratio*minval(step) .and. &
                    all(points >= 2*stencil_reach .or. (points == 1 .and. [.false., .true.]))
      if (.not. self%exists) return
      last = merge(stencil_reach, 0, points > 1)
      do j = 0, kernel_points - 1
         do i = 0, kernel_points - 1
            wave = [min(i, kernel_points - i), merge(min(j, kernel_points - j), 0, points(2) > 1)]
            symbol(i, j) = surface%stiffness*norm2(wave/(kernel_points*step))
         end do
      end do
      do j = 0, last(2)
         do i = 0, last(1)
            if (i**2 + j**2 > stencil_reach**2) cycle
            x = 2*pi*i/kernel_points
            y = 2*pi*j/kernel_points
            self%weights(i, j) = real(dot_product(cos(x*[(k, k=0, kernel_points - 1)]), &
               matmul(symbol, cos(y*[(k, k=0, kernel_points - 1)])))/kernel_points**2, sp)
            self%weights(-i, j) = self%weights(i, j)
            self%weights(i, -j) = self%weights(i, j)
            self%weights(-i, -j) = self%weights(i, j)
         end do
      end do
   end subroutine start

   !> From displacements in a region, zero outside it, to their pressures there; in the units of the surface.
   subroutine apply(self, region, points, vector)
      class(local_stiffness), intent(inout) :: self   !! which exists
      type(contact_region), intent(in) :: region      !! of the own columns
      integer, intent(in) :: points(2)                !! M, N of the whole grid, those of `start`
      real(sp), intent(inout), contiguous :: vector(:)   !! shape (region%points)

      integer, parameter :: r = stencil_reach
      type(grid_slab) :: slab
      integer :: k

      call slab%start(points)
      associate (m => points(1), n => slab%columns())
         if (.not. allocated(self%field)) allocate (self%field(1 - r:m + r, 1 - r:n + r), source=0.0_sp)
         call region%scatter(vector, self%field(1:m, 1:n))
         do k = 1, r
            self%field(1 - k, 1:n) = self%field(image_of_point(1 - k, m, self%even), 1:n)
            self%field(m + k, 1:n) = self%field(image_of_point(m + k, m, self%even), 1:n)
         end do
         if (points(2) > 1) &
            call slab%halo(self%field(:, 1:n), self%even, self%field(:, 1 - r:0), self%field(:, n + 1:n + r))
         call region%convolve(self%weights, r, self%field, vector)
      end associate
   end subroutine apply

end module wavycon_local_stiffness
