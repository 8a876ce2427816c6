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
   use wavycon_fitted_fields, only: fitted_fields, start_fitted_fields
   use wavycon_fitted_tuning, only: bend => table_bend, coarsest_rules, first_table_size, largest_enlargement, &
      last_table_size, last_terms, near_field_radius, rules_share, rules_step
   use wavycon_kinds, only: dp
   use wavycon_shape_map, only: shape_map
   implicit none (type, external)
   private

   public :: outside_table, start_outside_table

   !> Tables that are made at most; often it is the first one, with a sharp edge the second.
   integer, parameter :: most_attempts = 4
   !> Places of a part at which tables and rules are compared: three on each of three rays.
   integer, parameter :: checks_of_part = 9
   !> The first as a part of the way to the border.
   real(dp), parameter :: near_edge = 0.02_dp
   !> The second by its |v|, where the plain rule over the disc is least exact.
   real(dp), parameter :: beyond_chords = 1.01_dp*near_field_radius

   !> The table between two directions.
   type :: table_part
      complex(dp) :: from = 0.0_dp, to = 0.0_dp     !! ends of the border's line
      real(dp) :: first = 0.0_dp, last = 0.0_dp     !! angles of the exterior map
      real(dp), allocatable :: border(:)            !! |v| on the border as a series in T_k(t), shape (0:n_t-1)
      real(dp), allocatable :: c(:, :)              !! shape (0:n_t-1, 0:n_s-1)
   contains
      procedure, private :: direction
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
      real(dp), intent(in) :: tolerance              !! > 0, of the integral in its unit
      real(dp), intent(in) :: most_places            !! of one table, in evaluations by the full rules
      logical, intent(out) :: found                  !! whether the table is within the tolerance

      type(fitted_fields) :: rules
      complex(dp) :: v(checks_of_part, size(sector%corner) - 1)
      real(dp), dimension(checks_of_part, size(sector%corner) - 1) :: exact, values
      real(dp) :: limit, refinement
      integer :: attempts, i, j, places

      call place_parts(table, fields, sector, v, found)
      if (.not. found) return
      call evaluate(fields, sector%centre, v, exact)
      refinement = coarsest_rules
      limit = last_terms*tolerance
      attempts = 0
      do while (attempts < most_attempts)
         call start_fitted_fields(rules, fields%lattice, fields%answer, refinement)
         call evaluate(rules, sector%centre, v, values)
         found = all(abs(values - exact) <= rules_share*tolerance) .or. refinement >= 1.0_dp
         if (found) then
            attempts = attempts + 1
            places = 0
            do i = 1, size(table%part)
               call fit_part(table%part(i), rules, sector%centre, limit, nint(most_places/refinement**2), places, found)
               if (.not. found) exit
            end do
            table%places = table%places + places
            if (places > most_places/refinement**2) return
         end if
         if (found) then
            found = all([((abs(table%at(v(i, j)) - exact(i, j)), i=1, size(v, 1)), j=1, size(v, 2))] <= tolerance)
            if (found) return
            limit = 0.25_dp*limit
         else
            refinement = min(refinement*rules_step, 1.0_dp)
         end if
      end do
   end subroutine start_outside_table

   !> Sets angles and borders of the parts and the places where tables are compared with the integrals: next to the edge,
   !> where the rule over the disc begins to take the place of chords, and on the border.
   subroutine place_parts(table, fields, sector, v, found)
      type(outside_table), intent(inout) :: table
      type(fitted_fields), intent(in) :: fields
      type(cell_sector), intent(in) :: sector
      complex(dp), intent(out) :: v(:, :)            !! of the places, shape (checks_of_part, parts)
      logical, intent(out) :: found

      complex(dp) :: corner, direction
      real(dp) :: border
      integer :: i, j

      allocate (table%part(size(sector%corner) - 1))
      associate (part => table%part, shape => fields%answer%solution%shape, parts => size(table%part))
         part%from = sector%corner(:parts)
         part%to = sector%corner(2:)
         part(parts)%last = pi/shape%fold
         do i = 1, parts - 1
            call find_exterior(shape, part(i)%to, corner, found)
            if (.not. found) return
            part(i)%last = atan2(corner%im, corner%re)
            part(i + 1)%first = part(i)%last
         end do
         do i = 1, parts
            do j = 1, size(v, 1), 3
               direction = part(i)%direction(-1.0_dp + 2*(j - 1.0_dp)/(size(v, 1) - 3))
               call find_border(part(i), shape, direction, border, found)
               if (.not. found) return
               v(j:j + 2, i) = [1.0_dp + near_edge*(border - 1.0_dp), min(beyond_chords, border), border]*direction
            end do
         end do
      end associate
   end subroutine place_parts

   !> The integral at some places of the sector.
   subroutine evaluate(fields, centre, v, values)
      type(fitted_fields), intent(inout) :: fields
      complex(dp), intent(in) :: centre, v(:, :)
      real(dp), intent(out) :: values(:, :)

      integer :: i, j

      do j = 1, size(v, 2)
         do i = 1, size(v, 1)
            values(i, j) = fields%outside_integral(centre + exterior_place(fields%answer%solution%shape, v(i, j)))
         end do
      end do
   end subroutine evaluate

   !> Fits one part, with more terms until the last ones are below the tolerance.
   subroutine fit_part(part, fields, centre, limit, most_places, places, found)
      type(table_part), intent(inout) :: part        !! with its angles and border
      type(fitted_fields), intent(inout) :: fields
      complex(dp), intent(in) :: centre
      real(dp), intent(in) :: limit                  !! of the sums of the last terms
      integer, intent(in) :: most_places
      integer, intent(inout) :: places
      logical, intent(out) :: found                  !! false if the last terms do not fall, or too many are needed

      real(dp) :: largest, last(2), last_before(2)
      integer :: terms(2)

      terms = first_table_size
      if (allocated(part%c)) terms = shape(part%c) + 2
      last_before = huge(last)
      do
         places = places + product(terms)
         found = places <= most_places .and. maxval(terms) <= last_table_size
         if (.not. found) return
         call fit_terms(part, fields, centre, terms, found)
         if (.not. found) return
         largest = maxval(abs(part%c))
         last = [sum(abs(part%c(terms(1) - 1:, :))), sum(abs(part%c(:, terms(2) - 1:)))]
         if (all(last <= limit)) return
         found = all(last <= limit .or. last < 0.5_dp*last_before)
         if (.not. found) return
         last_before = last
         terms = [enlarged(terms(1), last(1)), enlarged(terms(2), last(2))]
      end do

   contains

      !> The number of terms that brings the last ones below the tolerance if they go on to fall as they did.
      integer function enlarged(terms, last)
         integer, intent(in) :: terms
         real(dp), intent(in) :: last

         real(dp) :: factor

         enlarged = terms
         if (last <= limit) return
         factor = log(limit/largest)/min(log(last/largest), -0.1_dp)
         enlarged = max(terms + 2, ceiling(terms*min(factor, largest_enlargement)))
      end function enlarged

   end subroutine fit_part

   !> Fits a number of terms to as many values.
   subroutine fit_terms(part, fields, centre, terms, found)
      type(table_part), intent(inout) :: part
      type(fitted_fields), intent(inout) :: fields
      complex(dp), intent(in) :: centre
      integer, intent(in) :: terms(2)        !! n_t, n_s
      logical, intent(out) :: found

      real(dp) :: border(terms(1)), of_angle(0:terms(1) - 1, terms(1)), of_radius(0:terms(2) - 1, terms(2))
      real(dp) :: values(terms(1), terms(2))
      complex(dp) :: v(terms(1), terms(2))
      integer :: i, j

      of_angle = chebyshev_coefficients(terms(1))
      of_radius = chebyshev_coefficients(terms(2))
      do i = 1, terms(1)
         associate (direction => part%direction(chebyshev_node(i, terms(1))))
            call find_border(part, fields%answer%solution%shape, direction, border(i), found)
            if (.not. found) return
            do j = 1, terms(2)
               v(i, j) = radius_at((0.5_dp*(1.0_dp + chebyshev_node(j, terms(2))))**2, border(i))*direction
            end do
         end associate
      end do
      call evaluate(fields, centre, v, values)
      part%border = matmul(of_angle, border)
      part%c = matmul(of_angle, matmul(values, transpose(of_radius)))
   end subroutine fit_terms

   !> e^(i angle) at t between -1 and 1.
   pure complex(dp) function direction(self, t)
      class(table_part), intent(in) :: self
      real(dp), intent(in) :: t

      direction = exp(cmplx(0.0_dp, 0.5_dp*(self%first + self%last + (self%last - self%first)*t), dp))
   end function direction

   !> |v| at which a ray of the exterior map meets the border's line, by Newton's method.
   pure subroutine find_border(part, shape, direction, radius, found)
      type(table_part), intent(in) :: part         !! with its border
      type(shape_map), intent(in) :: shape
      complex(dp), intent(in) :: direction         !! of modulus 1
      real(dp), intent(out) :: radius
      logical, intent(out) :: found                !! false if there is none, or it is on the edge

      !> Safety limit: most steps.
      integer, parameter :: most_steps = 50
      !> Relative step that rounding leaves; distance from the edge below which there is no room for a table.
      real(dp), parameter :: rounding = 1e-13_dp, least_distance = 1e-6_dp
      complex(dp) :: conjugate_slope, normal, slope, z
      real(dp) :: step
      integer :: i

      normal = (0.0_dp, -1.0_dp)*(part%to - part%from)/abs(part%to - part%from)
      radius = 2*max(abs(part%from), abs(part%to))/shape%b(0)
      found = .false.
      do i = 1, most_steps
         call linearise_exterior(shape, radius*direction, z, slope, conjugate_slope)
         slope = slope*direction + conjugate_slope*conjg(direction)
         z = part%from - z
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

      s = (radius - 1.0_dp)*(1.0_dp + bend)*border/((radius + bend*border)*(border - 1.0_dp))
   end function s_at

   !> Its inverse.
   pure real(dp) function radius_at(s, border) result(radius)
      real(dp), intent(in) :: s, border

      associate (ratio => s*(border - 1.0_dp)/((1.0_dp + bend)*border))
         radius = (1.0_dp + bend*border*ratio)/(1.0_dp - ratio)
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
