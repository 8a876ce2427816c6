!> Stresses near the surface below all spots or pools of a lattice but those nearest to a cell, as a table.
!>
!> The far ones' fields are analytic down to the surface and beyond, and even or odd in x, y and z: README.md, section
!> 13. They are the difference of the Fourier series of all and the sum of the near ones, which is taken at some depth
!> where the series is short. The same point sources stand for both, so that the difference is exact.
module wavycon_far_stress
   use wavycon_even_polynomial, only: chebyshev_coefficients, chebyshev_node, chebyshev_polynomials
   use wavycon_fitted_tuning, only: far_bottom, far_top, near_clearance
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgels, dgemv
   use wavycon_stress_kernel, only: stress_fields
   implicit none (type, external)
   private

   public :: far_stress, start_far_stress, set_far_values

   !> Each field is x^a y^b (constant + z^c even(z)), with coefficients of Chebyshev's polynomials in x^2, y^2 and z^2.
   type :: far_stress
      real(dp), private :: sides(2) = 0.5_dp            !! of the quarter of the cell [s]
      integer, private :: regime = 1                    !! 1 below spots, 2 below pools
      integer :: n(3) = 0                               !! terms in x, y and z; nodes are as many, in z one more
      real(dp), allocatable :: node_x(:), node_y(:), node_z(:)   !! places at which the values are taken [s]
      !> Shape (0:n_x-1, 0:n_y-1, 0:n_z, 8); last in z the constant.
      real(dp), allocatable, private :: coefficient(:, :, :, :)
   contains
      procedure :: add_at
   end type far_stress

   !> The powers a and b of each field, and c below a spot and below a pool.
   integer, parameter :: power_x(stress_fields) = [0, 0, 0, 1, 0, 1, 1, 0], power_y(stress_fields) = &
      [0, 0, 0, 1, 0, 1, 0, 1], power_z(stress_fields, 2) = &
      reshape([1, 1, 1, 1, 1, 1, 2, 2, 0, 2, 0, 0, 2, 2, 1, 1], [stress_fields, 2])
   !> Whether a field has a constant: below a spot H and D^2 L.
   logical, parameter :: has_constant(stress_fields, 2) = &
      reshape([.true., .false., .true., .true., spread(.false., 1, 12)], [stress_fields, 2])

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
      table%regime = merge(2, 1, pool)
      table%n(:2) = ceiling(digits/log(ellipse(2*((sides + near_clearance)/sides)**2 - 1.0_dp)))
      ! At the surface, outside of the nodes, the polynomials have grown.
      table%n(3) = ceiling(digits/log(ellipse((near_clearance**2 + middle)/half)/ellipse(middle/half)))
      table%n = max(table%n, 4)
      associate (n => table%n)
         table%node_x = sides(1)*sqrt(0.5_dp*(1.0_dp + chebyshev_node([(i, i=1, n(1))], n(1))))
         table%node_y = sides(2)*sqrt(0.5_dp*(1.0_dp + chebyshev_node([(i, i=1, n(2))], n(2))))
         table%node_z = sqrt(middle + half*chebyshev_node([(i, i=1, n(3) + 1)], n(3) + 1))
         allocate (table%coefficient(0:n(1) - 1, 0:n(2) - 1, 0:n(3), stress_fields), source=0.0_dp)
      end associate
   end subroutine start_far_stress

   !> Sum of the half axes of Bernstein's ellipse through x > 1: a function that is analytic inside has coefficients of
   !> Chebyshev's polynomials that fall as its powers.
   elemental real(dp) function ellipse(x)
      real(dp), intent(in) :: x

      ellipse = x + sqrt(x**2 - 1.0_dp)
   end function ellipse

   !> Sets the table, in z by least squares.
   subroutine set_far_values(table, values)
      type(far_stress), intent(inout) :: table
      real(dp), intent(in) :: values(:, :, :, :)   !! at the nodes, shape (n_x, n_y, n_z+1, 8)

      real(dp) :: of_nodes(size(table%node_z), 0:table%n(3)), right(size(table%node_z), product(table%n(:2))), &
                  work(64*size(of_nodes) + size(right))
      integer :: f, info, k, terms

      associate (n => table%n, x => table%node_x, y => table%node_y, z => table%node_z, nodes => size(table%node_z))
         do f = 1, stress_fields
            do k = 1, nodes
               of_nodes(k, :) = [z(k)**power_z(f, table%regime)*chebyshev_polynomials(depth_argument(z(k)), n(3)), &
                                 1.0_dp]
            end do
            terms = merge(n(3), n(3) - 1, has_constant(f, table%regime))
            right = transpose(reshape(values(:, :, :, f), [size(right, 2), nodes]))
            call dgels('N', nodes, terms + 1, size(right, 2), of_nodes, nodes, right, nodes, work, size(work), info)
            do k = 0, terms
               associate (plane => reshape(right(k + 1, :), [n(1), n(2)])/(spread(x**power_x(f), 2, n(2)) &
                                                                   *spread(y**power_y(f), 1, n(1))))
                  table%coefficient(:, :, k, f) = &
                     matmul(chebyshev_coefficients(n(1)), matmul(plane, transpose(chebyshev_coefficients(n(2)))))
               end associate
            end do
         end do
      end associate
   end subroutine set_far_values

   !> The argument of the polynomials for a depth.
   pure real(dp) function depth_argument(depth)
      real(dp), intent(in) :: depth

      depth_argument = (2*depth**2 - far_top**2 - far_bottom**2)/(far_bottom**2 - far_top**2)
   end function depth_argument

   !> Adds the fields at a place.
   subroutine add_at(self, x, y, depth, fields)
      class(far_stress), intent(in) :: self
      real(dp), intent(in) :: x, y                        !! from a crest, in the rectangle about it [s]
      real(dp), intent(in) :: depth                       !! between 0 and the lowest node [s]
      real(dp), intent(inout) :: fields(stress_fields)

      real(dp) :: of_x(0:self%n(1) - 1), of_y(0:self%n(2) - 1), of_z(0:self%n(3) - 1), &
                  plane(0:self%n(2) - 1, 0:self%n(3), stress_fields), value
      integer :: f, k

      of_x = chebyshev_polynomials(2*(x/self%sides(1))**2 - 1.0_dp, self%n(1))
      of_y = chebyshev_polynomials(2*(y/self%sides(2))**2 - 1.0_dp, self%n(2))
      of_z = chebyshev_polynomials(depth_argument(depth), self%n(3))
      call dgemv('T', self%n(1), size(plane), 1.0_dp, self%coefficient, self%n(1), of_x, 1, 0.0_dp, plane, 1)
      do f = 1, stress_fields
         value = 0.0_dp
         do k = 0, self%n(3) - 1
            value = value + of_z(k)*dot_product(of_y, plane(:, k, f))
         end do
         value = value*depth**power_z(f, self%regime) + dot_product(of_y, plane(:, self%n(3), f))
         fields(f) = fields(f) + value*x**power_x(f)*y**power_y(f)
      end do
   end subroutine add_at

end module wavycon_far_stress
