!> The source of fields, contact contours, stresses and details of a load that the solver 'fitted' has solved.
module wavycon_fitted_source
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_contours, only: contact_contour
   use wavycon_contact_spots, only: in_cell
   use wavycon_field_source, only: field_source
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_fields, only: find_fitted_details, fitted_fields, start_fitted_fields
   use wavycon_fitted_frame, only: fitted_frame
   use wavycon_fitted_answer_stress, only: start_fitted_answer_stress
   use wavycon_fitted_stress_fields, only: fitted_stress_fields
   use wavycon_kinds, only: dp, pi
   use wavycon_load_slopes, only: find_load_slopes
   use wavycon_quantities, only: area_slope, contact_area, gap_curvature, gap_slope, perimeter, quantities, &
      saddle_gap, saddle_pressure, trough_gap, unknown
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: fitted_source

   type, extends(field_source) :: fitted_source
      type(fitted_frame) :: frame       !! frame of the surface, which has a lattice
      type(fitted_answer) :: answer     !! the solution in the units of src/core/fitted
      real(dp) :: accuracy = 0.0_dp     !! accuracy of fitted_contact: largest error of gap [Delta] and pressure [p*]
   contains
      procedure :: fields, contact_contours, stresses, details, derivatives
   end type fitted_source

   type, extends(contact_fields) :: fitted_contact_fields
      type(fitted_frame) :: frame
      real(dp) :: accuracy = 0.0_dp     !! as in fitted_source
      type(fitted_fields), allocatable :: fitted
   contains
      procedure :: at, prepare_places
   end type fitted_contact_fields

   !> Number of points on each contour.
   integer, parameter :: edge_points = 256

contains

   !> Makes the fields (`at`), with the symmetries of the lattice.
   subroutine fields(self, surface, answer)
      class(fitted_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(fitted_contact_fields), allocatable :: own

      associate (unused => surface); end associate
      allocate (own)
      own%frame = self%frame
      own%symmetry = self%frame%symmetry
      own%accuracy = self%accuracy
      allocate (own%fitted)
      call start_fitted_fields(own%fitted, self%frame%lattice, self%answer)
      call move_alloc(own, answer)
   end subroutine fields

   !> Makes the stresses, with the symmetries of the lattice.
   subroutine stresses(self, surface, answer)
      class(fitted_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fitted_stress_fields), allocatable :: own

      allocate (own)
      own%pbar_over_pstar = self%record%pbar_over_pstar
      own%side_ratio = surface%length(2)/surface%length(1)
      own%symmetry = self%frame%symmetry
      own%frame = self%frame
      call start_fitted_answer_stress(own%fitted, self%frame%lattice, self%answer, self%accuracy)
      call move_alloc(own, answer)
   end subroutine stresses

   !> Pressure, displacement and gap at a point, converted from the units of the lattice.
   subroutine at(self, x, y, pressure, displacement, gap)
      class(fitted_contact_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      call self%fitted%at(self%frame%lattice_position(x, y), pressure, displacement, gap)
      pressure = pressure*self%frame%pressure_unit
      ! Without adhesion a negative pressure can only be an error next to the edge.
      if (self%fitted%answer%solution%work <= 0.0_dp) pressure = max(pressure, 0.0_dp)
      gap = max(gap, 0.0_dp)
   end subroutine at

   !> Prepares the fields of src/core/fitted for many points.
   subroutine prepare_places(self, places)
      class(fitted_contact_fields), intent(inout) :: self
      integer, intent(in) :: places

      call self%fitted%prepare_map(self%accuracy, places)
   end subroutine prepare_places

   !> A closed curve about each crest or, once the spots have merged, about each trough.
   subroutine contact_contours(self, surface, curves)
      class(fitted_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(contact_contour), allocatable, intent(out) :: curves(:)

      complex(dp) :: centre, edge(edge_points), to_surface, trough
      integer :: contours, i, k, rotated
      real(dp) :: inside   ! area that the contours enclose over the area of the cell, negative for pools

      to_surface = self%frame%side/self%frame%turn
      edge = self%answer%solution%shape%position_of([(exp(cmplx(0.0_dp, 2*pi*i/edge_points, dp)), &
                                                       i=0, edge_points - 1)]) &
         *to_surface
      contours = self%frame%crests
      trough = (0.0_dp, 0.0_dp)
      inside = self%record%value(contact_area)
      if (self%answer%pool) then
         contours = contours*self%frame%lattice%troughs
         trough = self%frame%lattice%trough
         inside = inside - 1.0_dp
         ! The contact lies on the left of a contour: about a pool the points run backwards.
         edge = edge(edge_points:1:-1)
      end if
      ! The second of two pools is the first one rotated by 180 degrees. If the cell has two crests its second half is
      ! the first one translated by half a cell both ways.
      allocate (curves(contours))
      do k = 1, contours
         rotated = 1
         if (k > self%frame%crests) rotated = -1
         centre = rotated*trough*to_surface
         associate (length => surface%length, places => [(mod(i, edge_points) + 1, i=0, edge_points)], &
                    half_cells => modulo(k - 1, self%frame%crests))
            curves(k)%phi = in_cell(2*pi*centre%re/length(1) + pi*half_cells) + 2*pi*rotated*edge(places)%re/length(1)
            curves(k)%theta = in_cell(2*pi*centre%im/length(2) + pi*half_cells) + 2*pi*rotated*edge(places)%im/length(2)
         end associate
      end do
      ! All contours are alike. The area is that of the fitted function; that of the polygon would be less accurate.
      associate (pool => self%answer%pool, numbers => [(k, k=1, contours)])
         curves%turns = merge(-1, 1, pool)
         curves%spot = merge(1, numbers, pool)
         curves%pool = merge(numbers, 1, pool)
         curves%load = 1.0_dp/merge(1, contours, pool)
      end associate
      curves%area = (2*pi)**2/contours*inside
      curves%length = self%record%value(perimeter)
   end subroutine contact_contours

   !> Adds the gap at the troughs, and gap and pressure at the saddles.
   subroutine details(self, answer)
      class(fitted_source), intent(in) :: self
      type(quantities), intent(inout) :: answer

      real(dp) :: errors(3), values(3)

      call find_fitted_details(self%frame%lattice, self%answer, values, errors)
      associate (units => [1.0_dp, 1.0_dp, self%frame%pressure_unit])
         answer%value([trough_gap, saddle_gap, saddle_pressure]) = values*units
         answer%error([trough_gap, saddle_gap, saddle_pressure]) = errors*units
      end associate
   end subroutine details

   !> The derivatives of mean gap and area with respect to P, from one more linear system of Newton's method. All are
   !> unknown if that system has no solution; each is unknown if its error is as large as the value.
   subroutine derivatives(self, surface, answer)
      class(fitted_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(quantities), intent(out) :: answer

      logical :: found
      real(dp) :: errors(3), slopes(3)

      associate (unused => surface); end associate
      call find_load_slopes(self%frame%lattice, self%answer, slopes, errors, found)
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
      answer%value([gap_slope, area_slope, gap_curvature]) = slopes
      answer%error([gap_slope, area_slope, gap_curvature]) = errors
   end subroutine derivatives

end module wavycon_fitted_source
