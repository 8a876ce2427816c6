!> The source of fields, edge, stresses and details of a load that was solved by fitted expansions.
module wavycon_fitted_source
   use wavycon_constants, only: pi
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: contact_details, load_derivatives, unknown
   use wavycon_contact_contours, only: contact_contour
   use wavycon_equivalent_points, only: equivalent_points, point_image
   use wavycon_field_source, only: field_source
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_fields, only: find_fitted_details, fitted_fields, start_fitted_fields
   use wavycon_fitted_frame, only: fitted_frame
   use wavycon_fitted_stress_fields, only: fitted_stress_fields, start_fitted_stress_fields
   use wavycon_kinds, only: dp
   use wavycon_load_slopes, only: find_load_slopes
   use wavycon_solution_record, only: solution_record
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: fitted_source

   type, extends(field_source) :: fitted_source
      type(fitted_frame) :: frame       !! with a lattice
      type(fitted_answer) :: answer     !! in the units of src/core/fitted
      real(dp) :: accuracy = 0.0_dp     !! of fitted_contact: largest error of gap [Delta] and pressure [p*]
   contains
      procedure :: fields
      procedure :: contact_contours
      procedure :: stresses
      procedure :: details
      procedure :: derivatives
   end type fitted_source

   type, extends(contact_fields) :: fitted_contact_fields
      type(fitted_frame) :: frame
      real(dp) :: accuracy = 0.0_dp     !! as of fitted_source
      type(fitted_fields), allocatable :: fitted
   contains
      procedure :: at
      procedure :: on_grid
   end type fitted_contact_fields

   !> Points of each contour.
   integer, parameter :: edge_points = 256

contains

   subroutine fields(self, record, surface, answer)
      class(fitted_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(fitted_contact_fields), allocatable :: own

      associate (unused => record, unused_too => surface); end associate
      allocate (own)
      own%frame = self%frame
      own%accuracy = self%accuracy
      allocate (own%fitted)
      call start_fitted_fields(own%fitted, self%frame%lattice, self%answer)
      call move_alloc(own, answer)
   end subroutine fields

   subroutine stresses(self, record, surface, answer)
      class(fitted_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fitted_stress_fields), allocatable :: own

      allocate (own)
      call start_fitted_stress_fields(own, surface, self%frame, self%answer, self%accuracy, record%pbar_over_pstar)
      call move_alloc(own, answer)
   end subroutine stresses

   subroutine at(self, x, y, pressure, displacement, gap)
      class(fitted_contact_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      call self%fitted%at(self%frame%place(x, y), pressure, displacement, gap)
      call convert(self, pressure, gap)
   end subroutine at

   !> To p*, and without what errors next to the edge may leave below 0.
   elemental subroutine convert(self, pressure, gap)
      class(fitted_contact_fields), intent(in) :: self
      real(dp), intent(inout) :: pressure, gap

      pressure = max(pressure*self%frame%pressure_unit, 0.0_dp)
      gap = max(gap, 0.0_dp)
   end subroutine convert

   !> Points that are equivalent by mirror symmetry, by the diagonals of a square cell or by the second crest are
   !> evaluated once.
   subroutine on_grid(self, points, offset, pressure, displacement, gap)
      class(fitted_contact_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2)
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :), gap(:, :)

      type(equivalent_points) :: grid
      type(point_image) :: first
      integer :: k, l

      allocate (pressure(points(1), points(2)), displacement(points(1), points(2)), gap(points(1), points(2)))
      call grid%start(points, offset, self%frame%lattice%square, self%frame%crests)
      call self%fitted%prepare_map(self%accuracy, grid%number_of_first())
      do l = 0, points(2) - 1
         do k = 0, points(1) - 1
            first = grid%first_of([k, l])
            associate (i => first%point(1) + 1, j => first%point(2) + 1)
               if (all(first%point == [k, l])) then
                  associate (angles => 2*pi*([k, l] + offset)/points)
                     call self%fitted%at(self%frame%place(angles(1), angles(2)), pressure(i, j), displacement(i, j), &
                                         gap(i, j))
                  end associate
               else
                  pressure(k + 1, l + 1) = pressure(i, j)
                  displacement(k + 1, l + 1) = displacement(i, j)
                  gap(k + 1, l + 1) = gap(i, j)
               end if
            end associate
         end do
      end do
      call convert(self, pressure, gap)
   end subroutine on_grid

   !> A closed curve about each crest or, once the spots have merged, about each trough.
   subroutine contact_contours(self, record, surface, curves, loads)
      class(fitted_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      type(contact_contour), allocatable, intent(out) :: curves(:)
      real(dp), allocatable, intent(out) :: loads(:)

      complex(dp) :: centre, edge(edge_points), to_surface
      integer :: i, k, rotated

      to_surface = self%frame%side/self%frame%turn
      edge = self%answer%solution%shape%place([(exp(cmplx(0.0_dp, 2*pi*i/edge_points, dp)), i=0, edge_points - 1)]) &
         *to_surface
      ! The contact lies on the left of the curve.
      if (self%answer%pool) edge = edge(edge_points:1:-1)
      ! The second of two pools is the first one rotated by 180 degrees; the second half of a cell is the first one
      ! translated.
      allocate (curves(self%frame%crests*merge(self%frame%lattice%troughs, 1, self%answer%pool)))
      do k = 1, size(curves)
         rotated = merge(-1, 1, k > self%frame%crests)
         centre = rotated*merge(self%frame%lattice%trough, (0.0_dp, 0.0_dp), self%answer%pool)*to_surface
         associate (length => surface%length, places => [(mod(i, edge_points) + 1, i=0, edge_points)], &
                    half_cells => modulo(k - 1, self%frame%crests))
            curves(k)%phi = in_cell(2*pi*centre%re/length(1) + pi*half_cells) + 2*pi*rotated*edge(places)%re/length(1)
            curves(k)%theta = in_cell(2*pi*centre%im/length(2) + pi*half_cells) + 2*pi*rotated*edge(places)%im/length(2)
         end associate
         ! All are alike: the area is that of the expansion itself, not that of polygons.
         curves(k)%turns = merge(-1, 1, self%answer%pool)
         curves(k)%spot = merge(1, k, self%answer%pool)
         curves(k)%pool = merge(k, 1, self%answer%pool)
         curves(k)%area = (2*pi)**2/size(curves)* &
                          (record%measures%contact_area_fraction - merge(1, 0, self%answer%pool))
         curves(k)%length = self%answer%perimeter*self%frame%side
      end do
      associate (count => merge(1, size(curves), self%answer%pool))
         allocate (loads(count), source=1.0_dp/count)
      end associate

   contains

      !> The equivalent angle between 0 and 2 pi.
      pure real(dp) function in_cell(angle)
         real(dp), intent(in) :: angle

         !> An angle of 2 pi less rounding becomes 0, as 2 pi does.
         real(dp), parameter :: rounding = 1e-9_dp

         in_cell = angle - 2*pi*floor(angle/(2*pi) + rounding)
      end function in_cell

   end subroutine contact_contours

   subroutine details(self, answer, found)
      class(fitted_source), intent(in) :: self
      type(contact_details), intent(out) :: answer
      logical, intent(out) :: found

      real(dp) :: energy_unit, errors(3), values(3)

      found = .true.
      call find_fitted_details(self%frame%lattice, self%answer, values, errors)
      energy_unit = self%frame%pressure_unit/self%frame%lattice%area
      answer = contact_details( &
               trough_gap=values(1), trough_gap_error=errors(1), &
               saddle_gap=values(2), saddle_gap_error=errors(2), &
               saddle_pressure=values(3)*self%frame%pressure_unit, &
               saddle_pressure_error=errors(3)*self%frame%pressure_unit, &
               energy=self%answer%energy*energy_unit, energy_error=self%answer%energy_error*energy_unit, &
               perimeter=self%answer%perimeter*self%frame%side, &
               perimeter_error=self%answer%perimeter_error*self%frame%side, degree=self%answer%degree)
   end subroutine details

   !> From one more linear system of Newton's method, in units of p*.
   subroutine derivatives(self, record, surface, answer)
      class(fitted_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      type(load_derivatives), intent(out) :: answer

      logical :: found
      real(dp) :: errors(3), range(2), slopes(3)

      associate (unused => record, unused_too => surface); end associate
      call find_load_slopes(self%frame%lattice, self%answer, slopes, errors, range, found)
      if (.not. found) return
      associate (units => self%frame%pressure_unit**[1, 1, 2])
         slopes = slopes/units
         errors = errors/units
      end associate
      ! Where spots merge the slopes grow without bound.
      where (errors >= abs(slopes))
         slopes = unknown
         errors = unknown
      end where
      answer = load_derivatives(gap_slope=slopes(1), gap_slope_error=errors(1), &
                                area_slope=slopes(2), area_slope_error=errors(2), &
                                gap_curvature=slopes(3), gap_curvature_error=errors(3), intensity_range=range)
   end subroutine derivatives

end module wavycon_fitted_source
