!> Stresses near the surface below all spots or pools of a lattice but those nearest to a cell, as a table.
!>
!> The far ones' fields are analytic down to the surface and beyond, and even or odd in x, y and z: README.md, section
!> 13. They are the difference of the Fourier series of all and the sum of the near ones, which is taken at some depth
!> where the series is short. The same point sources stand for both, so that the difference is exact.
module wavycon_far_stress
   use wavycon_chebyshev_table, only: chebyshev_nodes, chebyshev_polynomials, chebyshev_table, square_argument, &
      square_nodes
   use wavycon_fitted_tuning, only: far_bottom, far_top, near_clearance
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgels
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
      type(chebyshev_table), private :: planes          !! of each term in z, the constant last, and each field
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

      table%sides = sides
      table%regime = merge(2, 1, pool)
      table%n(:2) = ceiling(digits/log(ellipse(2*((sides + near_clearance)/sides)**2 - 1.0_dp)))
      ! At the surface, outside of the nodes, the polynomials have grown.
      table%n(3) = ceiling(digits/log(ellipse((near_clearance**2 + middle)/half)/ellipse(middle/half)))
      table%n = max(table%n, 4)
      table%node_x = square_nodes(table%n(1), sides(1))
      table%node_y = square_nodes(table%n(2), sides(2))
      table%node_z = sqrt(middle + half*chebyshev_nodes(table%n(3) + 1))
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
                  planes(table%n(1), table%n(2), 0:table%n(3), stress_fields), work(64*size(of_nodes) + size(right))
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
            planes(:, :, terms + 1:, f) = 0.0_dp
            do k = 0, terms
               planes(:, :, k, f) = reshape(right(k + 1, :), [n(1), n(2)])/(spread(x**power_x(f), 2, n(2)) &
                                                                            *spread(y**power_y(f), 1, n(1)))
            end do
         end do
         call table%planes%set(reshape(planes, [n(1), n(2), (n(3) + 1)*stress_fields]))
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

      real(dp) :: of_z(0:self%n(3) - 1), planes(0:self%n(3), stress_fields)

      of_z = chebyshev_polynomials(depth_argument(depth), self%n(3))
      planes = reshape(self%planes%at(square_argument(x, self%sides(1)), square_argument(y, self%sides(2))), &
                       shape(planes))
      fields = fields + x**power_x*y**power_y &
         *(matmul(of_z, planes(:self%n(3) - 1, :))*depth**power_z(:, self%regime) + planes(self%n(3), :))
   end subroutine add_at

end module wavycon_far_stress
