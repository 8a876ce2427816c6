!> The pressure, the displacement and the gap of one solution, at points and on grids of the cell.
!>
!> Positions are the angles X, Y of the surface's cell. Where the gap is open the pressure is exactly 0, and where there
!> is contact the gap is exactly 0, unless an extension of the type says otherwise. Gap, displacement u and undeformed
!> gap h satisfy gap = h + u - approach everywhere.
module wavycon_contact_fields
   use wavycon_equivalent_points, only: equivalent_points, point_image
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, not_a_number, pi
   implicit none (type, external)
   private

   public :: contact_fields

   type, abstract :: contact_fields
      !> The grid that the solution was computed on, as `points` and `offset` of on_grid: there `on_grid` returns the
      !> solution's numbers without interpolation. Zeros if there is no such grid.
      integer :: own_points(2) = 0
      real(dp) :: own_offset(2) = 0.0_dp
      !> The same grid, restricted to the part of the cell that was solved, with the columns that this process has.
      type(grid_slab) :: own_slab = grid_slab()
      !> Symmetries of the fields: on_grid evaluates one point of each set of equivalent ones.
      type(equivalent_points) :: symmetry = equivalent_points()
      integer :: maps_in_cell(2) = 1        !! that of the surface: how often the points of on_grid fit into the cell
   contains
      procedure(fields_at_point), deferred :: at
      procedure :: on_grid, prepare_places, at_own_column, at_points
   end type contact_fields

   abstract interface
      !> `at`: the fields at one point.
      subroutine fields_at_point(self, x, y, pressure, displacement, gap)
         import :: contact_fields, dp
         class(contact_fields), intent(inout) :: self
         real(dp), intent(in) :: x, y             !! X, Y [rad]
         real(dp), intent(out) :: pressure        !! p/p*
         real(dp), intent(out) :: displacement    !! (u - ubar)/Delta
         real(dp), intent(out) :: gap             !! gap/Delta
      end subroutine fields_at_point
   end interface

contains

   !> The fields on a grid of the cell, X = 2 pi (k + offset_x)/N_x, k = 0 .. N_x - 1, and the same in Y. For a mirrored
   !> height map the grid covers the map, X = pi (k + offset_x)/N_x. This default calls `at` once for each set of
   !> points that are equivalent by `symmetry`; the order of the loops makes sure that the first of them comes first.
   subroutine on_grid(self, points, offset, pressure, displacement, gap)
      class(contact_fields), intent(inout) :: self
      integer, intent(in) :: points(2)       !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)      !! distance of the first point from the origin, in steps; 0 along y in 1-D
      !> p/p*, (u - ubar)/Delta and gap/Delta, shape (N_x, N_y).
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :), gap(:, :)

      type(point_image) :: first
      integer :: k, l

      allocate (pressure(points(1), points(2)), displacement(points(1), points(2)), gap(points(1), points(2)))
      call self%symmetry%start(points, offset)
      call self%prepare_places(self%symmetry%number_of_first())
      do l = 1, points(2)
         do k = 1, points(1)
            first = self%symmetry%first_of([k, l] - 1)
            associate (i => first%point(1) + 1, j => first%point(2) + 1, &
                       angles => 2*pi*(first%point + offset)/(self%maps_in_cell*points))
               if (i == k .and. j == l) &
                  call self%at(angles(1), angles(2), pressure(k, l), displacement(k, l), gap(k, l))
               pressure(k, l) = pressure(i, j)
               displacement(k, l) = displacement(i, j)
               gap(k, l) = gap(i, j)
            end associate
         end do
      end do
   end subroutine on_grid

   !> Prepares many calls of `at`: an extension may make tables first. The default does nothing.
   subroutine prepare_places(self, places)
      class(contact_fields), intent(inout) :: self
      integer, intent(in) :: places          !! number of the calls that follow

      associate (unused => self, unused_too => places); end associate
   end subroutine prepare_places

   !> The fields at many points. An extension may use the surface's shape, which the caller knows; the default does not.
   subroutine at_points(self, angle, shape_values, pressure, displacement, gap)
      class(contact_fields), intent(inout) :: self
      real(dp), intent(in) :: angle(:, :)            !! X, Y, shape (2, n) [rad]
      real(dp), intent(in) :: shape_values(:)        !! 1 - h/Delta at the points, shape (n)
      real(dp), intent(out) :: pressure(:), displacement(:), gap(:)   !! as in `at`, shape (n)

      integer :: k

      associate (unused => shape_values); end associate
      do k = 1, size(gap)
         call self%at(angle(1, k), angle(2, k), pressure(k), displacement(k), gap(k))
      end do
   end subroutine at_points

   !> The fields at the points of one column of own_slab. The default, for solutions without a grid, is NaN.
   subroutine at_own_column(self, column, shape_values, pressure, displacement, gap)
      class(contact_fields), intent(in) :: self
      integer, intent(in) :: column                  !! number of the column, own_slab%first .. own_slab%last
      real(dp), intent(in) :: shape_values(:)        !! 1 - h/Delta at the points, shape (M)
      real(dp), intent(out) :: pressure(:), displacement(:), gap(:)   !! as in on_grid, shape (M)

      associate (unused => self, unused_too => column, not_used => shape_values); end associate
      pressure = not_a_number()
      displacement = pressure
      gap = pressure
   end subroutine at_own_column

end module wavycon_contact_fields
