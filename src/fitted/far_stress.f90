!> Stresses near the surface below all spots or pools of a lattice but those nearest to a cell, as a table.
!>
!> The far ones' fields are analytic down to the surface and beyond, and even or odd in x, y and z: README.md, section
!> 13. They are the difference of the Fourier series of all and the sum of the near ones, which is taken at some depth
!> where the series is short. The same point sources stand for both, so that the difference is exact.
module wavycon_far_stress
   use wavycon_even_polynomial, only: chebyshev_coefficients, chebyshev_node, chebyshev_polynomials
   use wavycon_fitted_tuning, only: far_bottom, far_top, near_clearance
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   use wavycon_stress_kernel, only: dh_field, h_field, hz_field, l_field, stress_fields, v_field
   implicit none (type, external)
   private

   public :: far_stress, start_far_stress, set_far_values

   !> Each field is x^a y^b (constant + z^c even(z)), with coefficients of Chebyshev's polynomials in x^2, y^2 and z^2.
   type :: far_stress
      real(dp), private :: sides(2) = 0.5_dp            !! of the quarter of the cell [s]
      logical, private :: pool = .false.
      integer :: n(3) = 0                               !! terms, and nodes, in x, y and z
      real(dp), allocatable :: node_x(:), node_y(:), node_z(:)   !! places at which the values are taken [s]
      !> Shape (0:n_x-1, 0:n_y-1, 0:n_z, 8); last in z the constant.
      real(dp), allocatable, private :: coefficient(:, :, :, :)
   contains
      procedure :: add_at
   end type far_stress

   !> Whether a field is odd in x, in y, and, below a spot, in z. Below a pool it is the other way round in z.
   logical, parameter :: odd_x(stress_fields) = &
      [.false., .false., .false., .true., .false., .true., .true., .false.]
   logical, parameter :: odd_y(stress_fields) = &
      [.false., .false., .false., .true., .false., .true., .false., .true.]
   logical, parameter :: odd_z(stress_fields) = &
      [.true., .false., .true., .true., .false., .false., .true., .true.]

contains

   !> Chooses terms and nodes. The fields are singular beyond the sides by near_clearance, and above the surface by as
   !> much.
   subroutine start_far_stress(table, sides, pool, digits)
      type(far_stress), intent(out) :: table
      real(dp), intent(in) :: sides(2)         !! half the sides of the rectangle about a crest, along x and y [s]
      logical, intent(in) :: pool
      real(dp), intent(in) :: digits           !! natural logarithm of 1/accuracy

      real(dp), parameter :: middle = 0.5_dp*(far_bottom**2 + far_top**2), half = 0.5_dp*(far_bottom**2 - far_top**2)
      integer :: i

      table%sides = sides
      table%pool = pool
      table%n(:2) = ceiling(digits/log(ellipse(2*((sides + near_clearance)/sides)**2 - 1.0_dp)))
      ! At the surface, outside of the nodes, the polynomials have grown.
      table%n(3) = ceiling(digits/log(ellipse((near_clearance**2 + middle)/half)/ellipse(middle/half)))
      table%n = max(table%n, 4)
      associate (n => table%n)
         table%node_x = sides(1)*sqrt(0.5_dp*(1.0_dp + chebyshev_node([(i, i=1, n(1))], n(1))))
         table%node_y = sides(2)*sqrt(0.5_dp*(1.0_dp + chebyshev_node([(i, i=1, n(2))], n(2))))
         table%node_z = sqrt(middle + half*chebyshev_node([(i, i=1, n(3))], n(3)))
         allocate (table%coefficient(0:n(1) - 1, 0:n(2) - 1, 0:n(3), stress_fields), source=0.0_dp)
      end associate
   end subroutine start_far_stress

   !> Sum of the half axes of Bernstein's ellipse through x > 1: a function that is analytic inside has coefficients of
   !> Chebyshev's polynomials that fall as its powers.
   elemental real(dp) function ellipse(x)
      real(dp), intent(in) :: x

      ellipse = x + sqrt(x**2 - 1.0_dp)
   end function ellipse

   !> Sets the table.
   subroutine set_far_values(table, mean, values)
      type(far_stress), intent(inout) :: table
      real(dp), intent(in) :: mean                   !! H on the surface: less the mean pressure of spots, 0 of pools
      real(dp), intent(inout) :: values(:, :, :, :)  !! at the nodes, shape (n_x, n_y, n_z, 8); used up

      real(dp) :: constant(table%n(1), table%n(2), 2), of_x(table%n(1), table%n(1)), of_y(table%n(2), table%n(2)), &
                  of_z(table%n(3), table%n(3)), z(table%n(3))
      integer :: f, i, j, k

      z = table%node_z
      of_x = chebyshev_coefficients(table%n(1))
      of_y = chebyshev_coefficients(table%n(2))
      of_z = chebyshev_coefficients(table%n(3))
      ! From z H_z, z D^2 V and z D H.
      do k = 1, table%n(3)
         values(:, :, k, [2, 5, 6, 7, 8]) = values(:, :, k, [2, 5, 6, 7, 8])/z(k)
      end do
      constant = 0.0_dp
      if (.not. table%pool) then
         ! D^2 L is its value on the surface less the integral of D^2 V over the depth.
         constant = surface_values()
         values(:, :, :, h_field) = values(:, :, :, h_field) - mean
         do k = 1, table%n(3)
            values(:, :, k, l_field:l_field + 1) = values(:, :, k, l_field:l_field + 1) - constant
         end do
      end if
      do f = 1, stress_fields
         do k = 1, table%n(3)
            if (odd_z(f) .neqv. table%pool) values(:, :, k, f) = values(:, :, k, f)/z(k)
            call divide(values(:, :, k, f))
         end do
         values(:, :, :, f) = reshape(matmul(reshape(values(:, :, :, f), [table%n(1)*table%n(2), table%n(3)]), &
                                             transpose(of_z)), table%n)
         do k = 1, table%n(3)
            table%coefficient(:, :, k - 1, f) = matmul(of_x, matmul(values(:, :, k, f), transpose(of_y)))
         end do
      end do
      do f = l_field, l_field + 1
         call divide(constant(:, :, f - l_field + 1))
         table%coefficient(:, :, table%n(3), f) = &
            matmul(of_x, matmul(constant(:, :, f - l_field + 1), transpose(of_y)))
      end do
      if (.not. table%pool) table%coefficient(0, 0, table%n(3), h_field) = mean

   contains

      subroutine divide(plane)
         real(dp), intent(inout) :: plane(:, :)

         if (odd_x(f)) then
            do i = 1, table%n(1)
               plane(i, :) = plane(i, :)/table%node_x(i)
            end do
         end if
         if (odd_y(f)) then
            do j = 1, table%n(2)
               plane(:, j) = plane(:, j)/table%node_y(j)
            end do
         end if
      end subroutine divide

      !> D^2 L on the surface, from its value at the least depth and D^2 V above, integrated by Gauss's rule of as many
      !> points as there are terms: exact for the polynomial.
      function surface_values() result(surface)
         real(dp) :: surface(table%n(1), table%n(2), 2)

         real(dp) :: node(table%n(3)), per_node(table%n(3)), weight(table%n(3))

         call gauss_jacobi(0.0_dp, 0.0_dp, node, weight)
         per_node = 0.0_dp
         associate (least => z(table%n(3)))
            do k = 1, table%n(3)
               per_node = per_node + 0.5_dp*least*weight(k) &
                  *matmul(chebyshev_polynomials(depth_argument(0.5_dp*least*(1.0_dp + node(k))), &
                                                table%n(3)), of_z)
            end do
         end associate
         surface = values(:, :, table%n(3), l_field:l_field + 1)
         do k = 1, table%n(3)
            surface = surface + per_node(k)*values(:, :, k, v_field:v_field + 1)
         end do
      end function surface_values

   end subroutine set_far_values

   !> The argument of the polynomials for a depth.
   pure real(dp) function depth_argument(depth)
      real(dp), intent(in) :: depth

      depth_argument = (2*depth**2 - far_top**2 - far_bottom**2)/(far_bottom**2 - far_top**2)
   end function depth_argument

   !> Adds the fields at a place.
   subroutine add_at(self, x, y, depth, fields)
      class(far_stress), intent(in) :: self
      real(dp), intent(in) :: x, y                        !! in the quarter of the cell, >= 0 [s]
      real(dp), intent(in) :: depth                       !! between 0 and the lowest node [s]
      real(dp), intent(inout) :: fields(stress_fields)

      real(dp) :: of_x(0:self%n(1) - 1), of_y(0:self%n(2) - 1), of_z(0:self%n(3), 2), &
                  plane(0:self%n(2) - 1, 0:self%n(3), stress_fields), value
      integer :: f, i, k, rest

      of_x = chebyshev_polynomials(2*(x/self%sides(1))**2 - 1.0_dp, self%n(1))
      of_y = chebyshev_polynomials(2*(y/self%sides(2))**2 - 1.0_dp, self%n(2))
      of_z(:self%n(3) - 1, 1) = chebyshev_polynomials(depth_argument(depth), self%n(3))
      of_z(:, 2) = depth*of_z(:, 1)
      of_z(self%n(3), :) = 1.0_dp
      rest = size(plane)
      call dgemv('T', self%n(1), rest, 1.0_dp, self%coefficient, self%n(1), of_x, 1, 0.0_dp, plane, 1)
      do f = 1, stress_fields
         i = merge(2, 1, odd_z(f) .neqv. self%pool)
         value = 0.0_dp
         do k = 0, self%n(3)
            value = value + of_z(k, i)*dot_product(of_y, plane(:, k, f))
         end do
         if (odd_x(f)) value = value*x
         if (odd_y(f)) value = value*y
         if (f == hz_field .or. f == v_field .or. f == v_field + 1 .or. f >= dh_field) value = value*depth
         fields(f) = fields(f) + value
      end do
   end subroutine add_at

end module wavycon_far_stress
