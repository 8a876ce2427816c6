!> The integral that gives the fields outside of spots or islands, as a table: README.md, section 12.
!>
!> Over the sector of a cell that symmetry makes the whole it is
!>
!>     sum over j, k of c_jk T_j(t) T_k(2 sqrt(s) - 1),   README.md (F50),
!>
!> T Chebyshev's polynomials, s from 0 at the edge to 1 at the border to the neighbours, t from -1 to 1 with the angle
!> of the exterior map, between directions in which the border has corners. The coefficients come from the integrals
!> themselves at a few hundred places.
module wavycon_outside_table
   use wavycon_cell_sector, only: cell_sector
   use wavycon_chebyshev, only: chebyshev_coefficients, chebyshev_node, chebyshev_polynomials
   use wavycon_constants, only: pi
   use wavycon_exterior_map, only: exterior_place, find_exterior
   use wavycon_fitted_fields, only: fitted_fields, start_fitted_fields
   use wavycon_fitted_tuning, only: coarsest_rules, first_table_size, largest_enlargement, &
      last_table_size, last_terms, near_field_radius, rules_share, rules_step
   use wavycon_kinds, only: dp
   use wavycon_sector_part, only: radius_at, s_at, sector_part
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
   type, extends(sector_part) :: table_part
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
         else if (refinement >= 1.0_dp) then
            return
         else
            refinement = min(refinement*rules_step, 1.0_dp)
         end if
      end do
   end subroutine start_outside_table

   !> Sets angles and borders of the parts and the places where tables are compared with the integrals: next to the
   !> edge, where the plain rule over the disc begins to take the place of chords, and on the border.
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
               call part(i)%find_border(shape, direction, border, found)
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
            call part%find_border(fields%answer%solution%shape, direction, border(i), found)
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

   !> The integral at a place of the sector.
   pure real(dp) function at(self, v)
      class(outside_table), intent(in) :: self   !! one that was found
      complex(dp), intent(in) :: v               !! preimage of the place under the exterior map, |v| >= 1

      integer :: i

      do i = 1, size(self%part) - 1
         if (atan2(v%im, v%re) < self%part(i)%last) exit
      end do
      at = sum_of_part(self%part(i), v)
   end function at

   !> The sum of one part.
   pure real(dp) function sum_of_part(part, v)
      type(table_part), intent(in) :: part
      complex(dp), intent(in) :: v

      real(dp) :: of_angle(size(part%c, 1)), of_radius(size(part%c, 2)), s

      of_angle = chebyshev_polynomials(part%t_of(v), size(of_angle))
      s = max(s_at(abs(v), dot_product(part%border, of_angle)), 0.0_dp)
      of_radius = chebyshev_polynomials(2*sqrt(s) - 1.0_dp, size(of_radius))
      sum_of_part = dot_product(of_angle, matmul(part%c, of_radius))
   end function sum_of_part

end module wavycon_outside_table
