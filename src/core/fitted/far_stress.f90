!> Stresses near the surface that the far spots or pools of a lattice cause, all except those near one cell, as a table.
!>
!> The fields of the far spots or pools are analytic down to the surface and beyond, and even or odd in x, y and z:
!> README.md, section 13. They are computed as the difference of the Fourier series of all and the sum of the near ones,
!> at depths where the series is short. The same point sources are used for both, so that the difference is exactly that
!> of the far sources.
module wavycon_far_stress
   use wavycon_chebyshev_table, only: chebyshev_nodes, chebyshev_polynomials, chebyshev_table, square_argument, &
      square_nodes
   use wavycon_fitted_tuning, only: far_bottom, far_top, near_clearance
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgels
   use wavycon_stress_kernel, only: stress_field_count
   implicit none (type, external)
   private

   public :: far_stress, start_far_stress, set_far_values

   !> Each field is x^a y^b (constant + z^c f(z^2)). The constant and f are sums of Chebyshev's polynomials in x^2 and
   !> y^2, f also in z^2.
   type :: far_stress
      real(dp), private :: sides(2) = 0.5_dp            !! half the sides of the rectangle about a crest [s]
      integer, private :: regime = 1                    !! 1 below spots, 2 below pools
      integer :: n(3) = 0                               !! numbers of terms in x, y and z; in z there is a node more
      real(dp), allocatable :: node_x(:), node_y(:), node_z(:)   !! coordinates at which the values are computed [s]
      type(chebyshev_table), private :: planes          !! tables in x and y for each term in z, the constant last
   contains
      procedure :: add_at
   end type far_stress

   !> The powers a and b of each field, and the power c below spots and below pools.
   integer, parameter :: power_x(stress_field_count) = [0, 0, 0, 1, 0, 1, 1, 0], power_y(stress_field_count) = &
      [0, 0, 0, 1, 0, 1, 0, 1], power_z(stress_field_count, 2) = &
      reshape([1, 1, 1, 1, 1, 1, 2, 2, 0, 2, 0, 0, 2, 2, 1, 1], [stress_field_count, 2])
   !> Whether a field has the constant: H and D^2 L below spots do.
   logical, parameter :: has_constant(stress_field_count, 2) = &
      reshape([.true., .false., .true., .true., spread(.false., 1, 12)], [stress_field_count, 2])

contains

   !> Chooses the numbers of terms and the nodes. The nearest singularities of the fields are at the distance
   !> `near_clearance` from the rectangle, and as far above the surface.
   subroutine start_far_stress(table, sides, pool, e_folds)
      type(far_stress), intent(out) :: table
      real(dp), intent(in) :: sides(2)         !! half the sides of the rectangle about a crest, along x and y [s]
      logical, intent(in) :: pool              !! true: below pools; false: below spots
      real(dp), intent(in) :: e_folds     !! natural logarithm of 1/accuracy

      real(dp), parameter :: middle = 0.5_dp*(far_bottom**2 + far_top**2), half = 0.5_dp*(far_bottom**2 - far_top**2)

      table%sides = sides
      table%regime = merge(2, 1, pool)
      table%n(:2) = ceiling(e_folds/log(ellipse(2*((sides + near_clearance)/sides)**2 - 1.0_dp)))
      ! The nodes are below the surface. At the surface the polynomials have grown by the factor in the denominator.
      table%n(3) = ceiling(e_folds/log(ellipse((near_clearance**2 + middle)/half)/ellipse(middle/half)))
      table%n = max(table%n, 4)
      table%node_x = square_nodes(table%n(1), sides(1))
      table%node_y = square_nodes(table%n(2), sides(2))
      table%node_z = sqrt(middle + half*chebyshev_nodes(table%n(3) + 1))
   end subroutine start_far_stress

   !> The sum q of the half axes of Bernstein's ellipse through x > 1, with the foci -1 and 1. If a function is analytic
   !> inside of the ellipse, its coefficients of Chebyshev's polynomials fall as q^(-n) with the degree n.
   elemental real(dp) function ellipse(x)
      real(dp), intent(in) :: x   !! > 1

      ellipse = x + sqrt(x**2 - 1.0_dp)
   end function ellipse

   !> Sets the table from values at the nodes: by interpolation in x and y and by least squares in z.
   subroutine set_far_values(table, values)
      type(far_stress), intent(inout) :: table
      real(dp), intent(in) :: values(:, :, :, :)   !! the eight fields at the nodes, shape (n_x, n_y, n_z+1, 8)

      real(dp) :: of_nodes(size(table%node_z), 0:table%n(3)), right(size(table%node_z), product(table%n(:2))), &
                  planes(table%n(1), table%n(2), 0:table%n(3), stress_field_count), &
                  work(64*size(of_nodes) + size(right))
      integer :: f, info, k, terms

      associate (n => table%n, x => table%node_x, y => table%node_y, z => table%node_z, nodes => size(table%node_z))
         do f = 1, stress_field_count
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
         call table%planes%set(reshape(planes, [n(1), n(2), (n(3) + 1)*stress_field_count]))
      end associate
   end subroutine set_far_values

   !> The argument of the polynomials in z^2, from -1 to 1 between the depths far_top and far_bottom.
   pure real(dp) function depth_argument(depth)
      real(dp), intent(in) :: depth   !! [s]

      depth_argument = (2*depth**2 - far_top**2 - far_bottom**2)/(far_bottom**2 - far_top**2)
   end function depth_argument

   !> Adds the fields of the far spots or pools at a point.
   subroutine add_at(self, x, y, depth, fields)
      class(far_stress), intent(in) :: self
      real(dp), intent(in) :: x, y                        !! position from a crest, in the rectangle about the crest [s]
      real(dp), intent(in) :: depth                       !! between 0 and the lowest node [s]
      real(dp), intent(inout) :: fields(stress_field_count)

      real(dp) :: of_z(0:self%n(3) - 1), planes(0:self%n(3), stress_field_count)

      of_z = chebyshev_polynomials(depth_argument(depth), self%n(3))
      planes = reshape(self%planes%at(square_argument(x, self%sides(1)), square_argument(y, self%sides(2))), &
                       shape(planes))
      fields = fields + x**power_x*y**power_y &
         *(matmul(of_z, planes(:self%n(3) - 1, :))*depth**power_z(:, self%regime) + planes(self%n(3), :))
   end subroutine add_at

end module wavycon_far_stress
