!> A field outside of spots or islands as a table: the gap about a spot, the pressure about an island.
!>
!> Over the sector of a cell that symmetry makes the whole it is
!>
!>     s^a sum over j, k of c_jk T_j(2 s - 1) T_k(t),   a = 3/2 (gap) or 1/2 (pressure),   README.md (F50),
!>
!> T Chebyshev's polynomials, s from 0 at the edge to 1 at the border to the neighbours, t from -1 to 1 with the angle of
!> the exterior map, between directions in which the border has corners. The sum is analytic also beyond the edge. Its
!> coefficients come from the accurate integrals at a few hundred places.
module wavycon_outside_table
   use wavycon_cell_sector, only: cell_sector
   use wavycon_constants, only: pi
   use wavycon_exterior_map, only: exterior_place, find_exterior, linearise_exterior
   use wavycon_fitted_fields, only: fitted_fields
   use wavycon_fitted_tuning, only: first_table_size, last_table_size
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: outside_table, start_outside_table

   !> The table between two directions.
   type :: table_part
      real(dp) :: first = 0.0_dp, last = 0.0_dp     !! angles of the exterior map
      real(dp), allocatable :: border(:)            !! |v| on the border as a series in T_k(t), shape (0:n_t-1)
      real(dp), allocatable :: c(:, :)              !! shape (0:n_t-1, 0:n_s-1)
   end type table_part

   type :: outside_table
      type(table_part), allocatable, private :: part(:)
      integer :: places = 0                         !! at which fields were evaluated
   contains
      procedure :: at
   end type outside_table

contains

   !> Makes the table.
   subroutine start_outside_table(table, fields, sector, tolerance, most_places, found)
      type(outside_table), intent(out) :: table
      type(fitted_fields), intent(inout) :: fields   !! that the table is made from
      type(cell_sector), intent(in) :: sector        !! of the same solution
      real(dp), intent(in) :: tolerance              !! of the table [Delta], of an island's [pi E* Delta/s]
      integer, intent(in) :: most_places             !! limit of the evaluations of fields
      logical, intent(out) :: found                  !! whether the table is within the tolerance

      complex(dp) :: v
      integer :: i, lines

      lines = size(sector%corner) - 1
      allocate (table%part(lines))
      associate (solution => fields%answer%solution)
         table%part(lines)%last = pi/solution%shape%fold
         do i = 1, lines - 1
            call find_exterior(solution%shape, sector%corner(i + 1), v, found)
            if (.not. found) return
            table%part(i)%last = atan2(v%im, v%re)
            table%part(i + 1)%first = table%part(i)%last
         end do
      end associate
      do i = 1, lines
         call fit_part(table%part(i), fields, sector%corner(i), sector%corner(i + 1), sector%centre, &
                       tolerance, most_places, table%places, found)
         if (.not. found) return
      end do
   end subroutine start_outside_table

   !> Fits one part, with more terms until those left out are below the tolerance at some places that are no nodes.
   subroutine fit_part(part, fields, from, to, centre, tolerance, most_places, places, found)
      type(table_part), intent(inout) :: part        !! with its angles
      type(fitted_fields), intent(inout) :: fields
      complex(dp), intent(in) :: from, to            !! ends of the border
      complex(dp), intent(in) :: centre
      real(dp), intent(in) :: tolerance
      integer, intent(in) :: most_places
      integer, intent(inout) :: places
      logical, intent(out) :: found

      real(dp) :: largest, last_angular, last_radial
      integer :: angles, radii

      radii = first_table_size
      angles = first_table_size
      do
         found = places + radii*angles <= most_places .and. max(radii, angles) <= last_table_size
         if (.not. found) return
         places = places + radii*angles
         call fit_terms(part, fields, from, to, centre, radii, angles, found)
         if (.not. found) return
         ! The sums of the last two terms either way bound what the table misses about as well as a comparison.
         largest = maxval(sum(abs(part%c), 1))
         last_radial = maxval(sum(abs(part%c(:, radii - 2:)), 1))
         last_angular = maxval(sum(abs(part%c(angles - 2:, :)), 2))
         if (max(last_radial, last_angular) <= tolerance) return
         radii = enlarged(radii, last_radial)
         angles = enlarged(angles, last_angular)
      end do

   contains

      !> The number of terms that brings the last ones below the tolerance if they go on to fall as they did.
      integer function enlarged(terms, last)
         integer, intent(in) :: terms
         real(dp), intent(in) :: last

         real(dp) :: factor

         enlarged = terms
         if (last <= tolerance) return
         factor = log(tolerance/largest)/min(log(last/largest), -0.1_dp)
         enlarged = max(terms + 2, ceiling(terms*min(factor, 1.8_dp)))
      end function enlarged

   end subroutine fit_part

   !> Fits a number of terms to as many values.
   subroutine fit_terms(part, fields, from, to, centre, radii, angles, found)
      type(table_part), intent(inout) :: part
      type(fitted_fields), intent(inout) :: fields
      complex(dp), intent(in) :: from, to, centre
      integer, intent(in) :: radii, angles
      logical, intent(out) :: found

      real(dp) :: border(angles), of_angle(0:angles - 1, angles), of_radius(0:radii - 1, radii), values(angles, radii)
      real(dp) :: displacement, gap, pressure
      complex(dp) :: direction, z
      integer :: i, j

      of_radius = chebyshev_coefficients(radii)
      of_angle = chebyshev_coefficients(angles)
      do i = 1, angles
         associate (t => chebyshev_node(i, angles))
            direction = exp(cmplx(0.0_dp, 0.5_dp*(part%first + part%last + (part%last - part%first)*t), dp))
         end associate
         call find_border(fields%answer%solution%shape, direction, from, to, border(i), found)
         if (.not. found) return
         do j = 1, radii
            associate (s => (0.5_dp*(1.0_dp + chebyshev_node(j, radii)))**2)
               z = exterior_place(fields%answer%solution%shape, radius_at(s, border(i))*direction)
            end associate
            call fields%at(centre + z, pressure, displacement, gap)
            values(i, j) = merge(pressure, gap, fields%answer%island)
         end do
      end do
      part%border = matmul(of_angle, border)
      part%c = matmul(of_angle, matmul(values, transpose(of_radius)))
   end subroutine fit_terms

   !> |v| at which a ray of the exterior map meets the border's line, by Newton's method.
   pure subroutine find_border(shape, direction, from, to, radius, found)
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: direction         !! of modulus 1
      complex(dp), intent(in) :: from, to          !! ends of the line
      real(dp), intent(out) :: radius
      logical, intent(out) :: found                !! false if there is none, or it is on the edge

      !> Safety limit: most steps.
      integer, parameter :: most_steps = 50
      !> Relative step that rounding leaves; distance from the edge below which there is no room for a table.
      real(dp), parameter :: rounding = 1e-13_dp, least_distance = 1e-6_dp
      complex(dp) :: conjugate_slope, normal, slope, z
      real(dp) :: step
      integer :: i

      normal = (0.0_dp, -1.0_dp)*(to - from)/abs(to - from)
      radius = 2*max(abs(from), abs(to))/shape%b(0)
      found = .false.
      do i = 1, most_steps
         call linearise_exterior(shape, radius*direction, z, slope, conjugate_slope)
         slope = slope*direction + conjugate_slope*conjg(direction)
         z = from - z
         step = (z%re*normal%re + z%im*normal%im)/(slope%re*normal%re + slope%im*normal%im)
         radius = max(radius + step, 1.0_dp)
         found = abs(step) <= rounding*radius
         if (found) exit
      end do
      found = found .and. radius > 1.0_dp + least_distance
   end subroutine find_border

   !> s of a place at |v| = radius where the border is at |v| = border: README.md (F49). It is 0 at the edge and 1 at the
   !> border, and the singularities of the field inside of the edge and beyond the border are about equally far off.
   pure real(dp) function s_at(radius, border) result(s)
      real(dp), intent(in) :: radius, border

      associate (c => sqrt(2*border))
         s = (radius - 1.0_dp)*(border + c)/((radius + c)*(border - 1.0_dp))
      end associate
   end function s_at

   !> Its inverse.
   pure real(dp) function radius_at(s, border) result(radius)
      real(dp), intent(in) :: s, border

      associate (c => sqrt(2*border))
         associate (ratio => s*(border - 1.0_dp)/(border + c))
            radius = (1.0_dp + c*ratio)/(1.0_dp - ratio)
         end associate
      end associate
   end function radius_at

   !> The i-th of n nodes of Chebyshev's interpolation.
   pure real(dp) function chebyshev_node(i, n) result(x)
      integer, intent(in) :: i, n

      x = cos(pi*(i - 0.5_dp)/n)
   end function chebyshev_node

   !> The matrix that turns values at n nodes into coefficients of T_0 to T_(n-1).
   pure function chebyshev_coefficients(n) result(matrix)
      integer, intent(in) :: n
      real(dp) :: matrix(0:n - 1, n)

      integer :: i, k

      do i = 1, n
         matrix(:, i) = [(merge(1, 2, k == 0)*cos(pi*k*(i - 0.5_dp)/n)/n, k=0, n - 1)]
      end do
   end function chebyshev_coefficients

   !> T_0 to T_(n-1).
   pure function chebyshev(x, n) result(t)
      real(dp), intent(in) :: x
      integer, intent(in) :: n          !! >= 2
      real(dp) :: t(0:n - 1)

      integer :: i

      t(0) = 1.0_dp
      t(1) = x
      do i = 2, n - 1
         t(i) = 2*x*t(i - 1) - t(i - 2)
      end do
   end function chebyshev

   !> The field at a place of the sector: the gap [Delta] about a spot, the pressure [pi E* Delta/s] about an island.
   pure real(dp) function at(self, v)
      class(outside_table), intent(in) :: self   !! one that was found
      complex(dp), intent(in) :: v               !! preimage of the place under the exterior map, |v| >= 1

      real(dp) :: angle
      integer :: i

      angle = atan2(v%im, v%re)
      do i = 1, size(self%part) - 1
         if (angle < self%part(i)%last) exit
      end do
      at = sum_of_part(self%part(i), abs(v), angle)
   end function at

   !> The sum of one part, README.md (F50).
   pure real(dp) function sum_of_part(part, radius, angle)
      type(table_part), intent(in) :: part
      real(dp), intent(in) :: radius, angle

      real(dp) :: of_angle(size(part%c, 1)), of_radius(size(part%c, 2)), s

      of_angle = chebyshev((2*angle - part%first - part%last)/(part%last - part%first), size(of_angle))
      s = max(s_at(radius, dot_product(part%border, of_angle)), 0.0_dp)
      of_radius = chebyshev(2*sqrt(s) - 1.0_dp, size(of_radius))
      sum_of_part = dot_product(of_angle, matmul(part%c, of_radius))
   end function sum_of_part

end module wavycon_outside_table
