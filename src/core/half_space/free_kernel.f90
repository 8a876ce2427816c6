!> The kernel of a half-space with free edges on a grid: the displacements at the centres of all cells that a uniform
!> pressure on one cell causes, (E15) of README.md in this directory, and the kernel's transform (E17).
module wavycon_free_kernel
   use, intrinsic :: iso_c_binding, only: c_int, c_ptr
   use wavycon_assertion, only: assert
   use wavycon_fftw, only: fftw_destroy_plan, FFTW_ESTIMATE, fftw_execute_r2r, fftw_plan_r2r, FFTW_REDFT00
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: free_kernel, integral_to_corner, transform_of_kernel

   !> If a cell is farther away than this, in steps, the integral over the cell is Taylor's series of fourth order about
   !> its centre (E15a). The relative error of the series is below 1e-13 there, and the closed form would lose digits,
   !> because it is a difference of large numbers.
   real(dp), parameter :: far = 64.0_dp

contains

   !> sigma K_ij of (E15): sigma times the displacement at the centre of cell (i, j) under a unit pressure on cell (0,
   !> 0). In 2-D this is the integral of 1/r over the cell, in 1-D that of -2 ln(r/L), L the length of the profile.
   pure subroutine free_kernel(points, step, kernel)
      integer, intent(in) :: points(2)     !! M, N, points of the map; N = 1 in 1-D
      real(dp), intent(in) :: step(2)      !! steps of the grid along x and y [length], > 0
      real(dp), allocatable, intent(out) :: kernel(:, :)   !! [length], shape (0:M, 0:N), (0:M, 0:0) in 1-D

      integer :: i, j
      real(dp) :: c2, mean(2), closest, r2, s2, x, y   ! r2, c2, s2: squares of r and of its cosines with x and y

      if (points(2) == 1) then
         allocate (kernel(0:points(1), 0:0))
         kernel(:, 0) = [(-2*step(1)*(line(i + 0.5_dp) - line(i - 0.5_dp) - log(real(points(1), dp))), i=0, points(1))]
         return
      end if
      allocate (kernel(0:points(1), 0:points(2)))
      closest = (far*maxval(step))**2
      ! a and b of (E15a): mean squares of x and y in a cell, measured from its centre.
      mean = step**2/12
      do j = 0, points(2)
         y = j*step(2)
         do i = 0, points(1)
            x = i*step(1)
            r2 = x**2 + y**2
            if (r2 > closest) then
               c2 = x**2/r2
               s2 = y**2/r2
               kernel(i, j) = product(step)/sqrt(r2)*( &
                  1.0_dp + (mean(1)*(3*c2 - 1) + mean(2)*(3*s2 - 1))/(2*r2) &
                  + (0.075_dp*(mean(1)**2*((105*c2 - 90)*c2 + 9) + mean(2)**2*((105*s2 - 90)*s2 + 9)) &
                     + 0.25_dp*mean(1)*mean(2)*(105*c2*s2 - 12))/r2**2)
            else
               associate (h => 0.5_dp*step)
                  kernel(i, j) = integral_to_corner(x + h(1), y + h(2)) - integral_to_corner(x - h(1), y + h(2)) &
                                 - integral_to_corner(x + h(1), y - h(2)) + integral_to_corner(x - h(1), y - h(2))
               end associate
            end if
         end do
      end do

   contains

      !> The integral of ln|x| from 0 to x.
      pure real(dp) function line(x)
         real(dp), intent(in) :: x   !! /= 0

         line = x*(log(abs(x)) - 1.0_dp)
      end function line

   end subroutine free_kernel

   !> The integral of 1/r over the rectangle between the origin and the corner (x, y). Its sign is that of x y, so that
   !> four of these make any rectangle.
   elemental real(dp) function integral_to_corner(x, y) result(integral)
      real(dp), intent(in) :: x, y   !! coordinates of the corner [length], /= 0

      integral = x*asinh(y/abs(x)) + y*asinh(x/abs(y))
   end function integral_to_corner

   !> Replaces a kernel by its transform (E17). The kernel is even along both axes and has 2M x 2N values, which repeat
   !> periodically; the values 0..M and 0..N determine it, and a DCT-I gives the transform.
   subroutine transform_of_kernel(kernel)
      real(dp), intent(inout), allocatable :: kernel(:, :)   !! shape (0:M, 0:N), (0:M, 0:0) in 1-D

      integer(c_int) :: dimensions, kinds(2), lengths(2)
      real(dp), allocatable :: transform(:, :)
      type(c_ptr) :: plan

      call assert(all(lbound(kernel) == 0), 'the kernel begins at 0')
      dimensions = min(size(kernel, 2), 2)
      kinds = FFTW_REDFT00
      lengths = shape(kernel)
      if (dimensions == 2) lengths = lengths(2:1:-1)
      allocate (transform, mold=kernel)
      ! FFTW's planner is not thread-safe.
      !$omp critical (wavycon_fftw_planner)
      plan = fftw_plan_r2r(dimensions, lengths, kernel, transform, kinds, FFTW_ESTIMATE)
      !$omp end critical (wavycon_fftw_planner)
      call fftw_execute_r2r(plan, kernel, transform)
      !$omp critical (wavycon_fftw_planner)
      call fftw_destroy_plan(plan)
      !$omp end critical (wavycon_fftw_planner)
      call move_alloc(transform, kernel)
   end subroutine transform_of_kernel

end module wavycon_free_kernel
