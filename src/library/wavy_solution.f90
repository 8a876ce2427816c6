!> Solutions of the public interface: measures, status, fields and the edge of contact, in the user's units.
module wavycon_wavy_solution
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_constants, only: pi
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution, solution_without_contact_edge
   use wavycon_contact_status, only: not_found, status_code
   use wavycon_edge_curves, only: edge_curve
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, exit_fine, exit_not_converged, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text
   use wavycon_surface, only: surface_type
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: wavy_solution, wavy_measures, wavy_edge, start_solution

   !> Most points of a map.
   integer(int64), parameter, public :: most_map_points = 8192_int64**2

   !> The numbers of a load, named as the columns of the summary table. Errors are estimates; NaN if the solver has
   !> none.
   type, bind(c) :: wavy_measures
      real(c_double) :: pbar_over_pstar = 0.0_dp
      real(c_double) :: mean_gap_over_amplitude = 0.0_dp
      real(c_double) :: approach_over_amplitude = 0.0_dp
      real(c_double) :: contact_area_fraction = 0.0_dp
      real(c_double) :: peak_pressure_over_pstar = 0.0_dp
      real(c_double) :: min_pressure_over_pstar = 0.0_dp
      real(c_double) :: mean_gap_over_amplitude_error = 0.0_dp
      real(c_double) :: contact_area_fraction_error = 0.0_dp
      real(c_double) :: peak_pressure_over_pstar_error = 0.0_dp
      real(c_double) :: area_at_hardness_fraction = 0.0_dp   !! NaN without a hardness
      real(c_double) :: load_at_hardness_fraction = 0.0_dp   !! likewise
      real(c_double) :: mean_pressure = 0.0_dp      !! [pressure]
      real(c_double) :: mean_gap = 0.0_dp           !! [length]
      real(c_double) :: approach = 0.0_dp           !! [length]
      real(c_double) :: contact_area = 0.0_dp       !! in the cell [length^2]; of a profile [length]
      real(c_double) :: peak_pressure = 0.0_dp      !! [pressure]
      real(c_double) :: residual = 0.0_dp           !! relative, as each solver defines it
      integer(c_int) :: active_constraints = 0
      integer(c_int) :: iterations = 0
      integer(c_int) :: status_code = 0             !! below 10: as accurate as requested
   end type wavy_measures

   !> A part of the edge of contact. In 2-D a closed polygon with the contact on its left, whose last point is the first
   !> again (one period on, if the curve runs through the whole plane); in 1-D the two ends of a strip in contact.
   type :: wavy_edge
      real(dp), allocatable :: x(:), y(:)   !! [length], not reduced to one cell, so that the curve does not jump
   end type wavy_edge

   !> The solution of one load, made by a wavy_solver. Before that its status is not_found.
   type :: wavy_solution
      private
      class(contact_solution), allocatable :: solution
      type(surface_type), allocatable :: surface          !! allocated if the fields were kept
      class(contact_fields), allocatable :: fields        !! allocated at their first use
      type(wavy_measures) :: numbers
      real(dp) :: length(2) = 1.0_dp                      !! L_x, L_y [length]
      real(dp) :: amplitude = 0.0_dp                      !! Delta [length]
      real(dp) :: p_star = 0.0_dp                         !! [pressure]
   contains
      procedure :: measures
      procedure :: status
      procedure :: solver => name_of_solver
      procedure :: is_good
      procedure :: exit_status
      procedure :: map
      procedure :: own_points
      procedure :: at
      procedure :: edges
      procedure :: details
      procedure, private :: prepare_fields
   end type wavy_solution

contains

   !> Takes a solution of a solver. Errors: exit_file_trouble if there is not the memory to keep its fields.
   subroutine start_solution(from, surface, p_star, mean_pressure, keep_fields, has_errors, solution, error)
      class(contact_solution), allocatable, intent(inout) :: from   !! not allocated afterwards
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p_star           !! [pressure]
      real(dp), intent(in) :: mean_pressure    !! [pressure]
      logical, intent(in) :: keep_fields       !! whether the solver was started so
      logical, intent(in) :: has_errors        !! whether the solver estimates errors
      type(wavy_solution), intent(out) :: solution
      type(error_type), allocatable, intent(out) :: error

      real(dp) :: at_hardness(2), errors(3), peak

      errors = ieee_value(1.0_dp, ieee_quiet_nan)
      at_hardness = errors(:2)
      associate (measures => from%measures)
         if (surface%has_hardness()) &
            at_hardness = [measures%area_at_hardness_fraction, measures%load_at_hardness_fraction]
         if (has_errors) errors = [measures%mean_gap_error, measures%contact_area_error, measures%peak_pressure_error]
         ! On a flat surface, whose p* is 0, the pressure is uniform.
         peak = mean_pressure
         if (p_star > 0.0_dp) peak = p_star*measures%peak_pressure_over_pstar
         solution%numbers = wavy_measures( &
            from%pbar_over_pstar, measures%mean_gap_over_amplitude, measures%approach_over_amplitude, &
            measures%contact_area_fraction, measures%peak_pressure_over_pstar, measures%min_pressure_over_pstar, &
            errors(1), errors(2), errors(3), at_hardness(1), at_hardness(2), mean_pressure, &
            surface%amplitude*measures%mean_gap_over_amplitude, &
            surface%amplitude*measures%approach_over_amplitude, &
            product(surface%length(:surface%dimension))*measures%contact_area_fraction, peak, from%residual, &
            int(from%active_constraints, c_int), int(from%iterations, c_int), int(status_code(from%status), c_int))
      end associate
      solution%length = surface%length
      solution%amplitude = surface%amplitude
      solution%p_star = p_star
      if (keep_fields) then
         ! Up to four series, each with as many coefficients.
         if (.not. has_memory_for(4*size(surface%shape%c, kind=int64))) then
            call fatal_error(error, exit_file_trouble, 'there is not the memory to keep the fields of the solution')
            return
         end if
         solution%surface = surface
      end if
      call move_alloc(from, solution%solution)
   end subroutine start_solution

   !> The numbers of the load.
   pure type(wavy_measures) function measures(self)
      class(wavy_solution), intent(in) :: self

      measures = self%numbers
      if (.not. allocated(self%solution)) measures%status_code = int(status_code(not_found), c_int)
   end function measures

   !> The status in a word, such as 'converged' or 'not_accurate'.
   pure function status(self)
      class(wavy_solution), intent(in) :: self
      character(:), allocatable :: status

      status = not_found
      if (allocated(self%solution)) status = trim(self%solution%status)
   end function status

   !> The name of the solver; 'none' if no solver was needed.
   pure function name_of_solver(self) result(name)
      class(wavy_solution), intent(in) :: self
      character(:), allocatable :: name

      name = 'none'
      if (allocated(self%solution)) name = trim(self%solution%solver)
   end function name_of_solver

   !> Whether the numbers are as accurate as requested.
   pure logical function is_good(self)
      class(wavy_solution), intent(in) :: self

      is_good = allocated(self%solution)
      if (is_good) is_good = self%solution%is_good()
   end function is_good

   !> The exit status of a program that has this solution to show: exit_fine or exit_not_converged.
   pure integer function exit_status(self)
      class(wavy_solution), intent(in) :: self

      exit_status = merge(exit_fine, exit_not_converged, self%is_good())
   end function exit_status

   !> Fields on a grid: x = L_x (k + offset(1))/N_x, k = 0 .. N_x - 1, the same in y. Pressure is exactly 0 outside
   !> contact and the gap exactly 0 in contact (not with solver 'beale', whose series is shown as it is). Errors:
   !> exit_bad_input for a bad number of points, without fields, or without memory.
   subroutine map(self, points, pressure, gap, displacement, error, offset)
      class(wavy_solution), intent(inout) :: self
      integer, intent(in) :: points(2)                        !! N_x, N_y >= 1; N_y = 1 for a profile
      !> [pressure], [length], and the displacement u - ubar [length]; shape (N_x, N_y).
      real(dp), allocatable, intent(out) :: pressure(:, :), gap(:, :), displacement(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(in), optional :: offset(2)             !! of the first point, in steps; 0 if absent

      real(dp) :: first(2)

      first = 0.0_dp
      if (present(offset)) first = offset
      call self%prepare_fields(error)
      if (.not. allocated(error)) call check_points(points, self%surface%dimension, first, error)
      if (allocated(error)) return
      if (self%p_star > 0.0_dp) then
         call self%fields%on_grid(points, first, pressure, displacement, gap)
         pressure = self%p_star*pressure
         gap = self%amplitude*gap
         displacement = self%amplitude*displacement
      else
         allocate (pressure(points(1), points(2)), source=self%numbers%mean_pressure)
         allocate (gap, displacement, mold=pressure)
         gap = 0.0_dp
         displacement = 0.0_dp
      end if
   end subroutine map

   !> The grid that the solution was computed on, as arguments of `map`, which shows the solution's own numbers there.
   !> Zeros if there is none.
   subroutine own_points(self, points, offset, error)
      class(wavy_solution), intent(inout) :: self
      integer, intent(out) :: points(2)
      real(dp), intent(out) :: offset(2)
      type(error_type), allocatable, intent(out) :: error   !! as of `map`

      points = 0
      offset = 0.0_dp
      call self%prepare_fields(error)
      if (.not. allocated(error)) call self%fields%own_points(points, offset)
   end subroutine own_points

   !> Fields at one point. Errors: as of `map`, and for places that are not finite.
   subroutine at(self, x, y, pressure, gap, displacement, error)
      class(wavy_solution), intent(inout) :: self
      real(dp), intent(in) :: x, y                                !! [length]
      real(dp), intent(out) :: pressure, gap, displacement        !! as of `map`
      type(error_type), allocatable, intent(out) :: error

      pressure = 0.0_dp
      gap = 0.0_dp
      displacement = 0.0_dp
      call self%prepare_fields(error)
      if (allocated(error)) return
      if (.not. all(ieee_is_finite([x, y]/self%length))) then
         call fatal_error(error, exit_bad_input, 'the place must be two finite numbers')
         return
      end if
      pressure = self%numbers%mean_pressure
      if (.not. self%p_star > 0.0_dp) return
      call self%fields%at(2*pi*modulo(x/self%length(1), 1.0_dp), 2*pi*modulo(y/self%length(2), 1.0_dp), pressure, &
                          displacement, gap)
      pressure = self%p_star*pressure
      gap = self%amplitude*gap
      displacement = self%amplitude*displacement
   end subroutine at

   !> All parts of the edge of contact in one cell; none for full contact and no load. Errors: as of `map`.
   subroutine edges(self, parts, error)
      class(wavy_solution), intent(inout) :: self
      type(wavy_edge), allocatable, intent(out) :: parts(:)
      type(error_type), allocatable, intent(out) :: error

      type(edge_curve), allocatable :: curves(:)
      integer :: i

      call self%prepare_fields(error)
      if (allocated(error)) return
      call self%solution%edge_curves(self%surface, curves)
      allocate (parts(size(curves)))
      do i = 1, size(curves)
         parts(i)%x = self%length(1)/(2*pi)*curves(i)%phi
         parts(i)%y = self%length(2)/(2*pi)*curves(i)%theta
      end do
   end subroutine edges

   !> Further numbers, normalised, of solutions by expansions: strain energy, gaps at trough and saddle, perimeter.
   subroutine details(self, answer, found)
      class(wavy_solution), intent(in) :: self
      type(contact_details), intent(out) :: answer   !! to be used only if found
      logical, intent(out) :: found

      found = allocated(self%solution) .and. allocated(self%surface)
      if (found) call self%solution%details(answer, found)
   end subroutine details

   !> Makes the fields, once. Errors: exit_bad_input if there are none.
   subroutine prepare_fields(self, error)
      class(wavy_solution), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (allocated(self%fields)) return
      if (.not. allocated(self%solution)) then
         call fatal_error(error, exit_bad_input, 'there is no solution: no load has been solved')
      else if (.not. allocated(self%surface)) then
         call fatal_error(error, exit_bad_input, 'there are no fields: the solver was made without them')
      else if (is_failure(self%solution)) then
         call fatal_error(error, exit_bad_input, 'there are no fields: the status of the solution is '//self%status())
      else
         call self%solution%fields(self%surface, self%fields)
      end if
   end subroutine prepare_fields

   !> Whether a solution stands for a failure and has no numbers.
   pure logical function is_failure(solution)
      class(contact_solution), intent(in) :: solution

      is_failure = .false.
      select type (solution)
      class is (solution_without_contact_edge)
         is_failure = .not. solution%is_good()
      end select
   end function is_failure

   !> Checks the points of a map. Errors: exit_bad_input.
   subroutine check_points(points, dimension, offset, error)
      integer, intent(in) :: points(2), dimension
      real(dp), intent(in) :: offset(2)
      type(error_type), allocatable, intent(out) :: error

      !> The three fields and the work space of transforms, in numbers a point.
      integer(int64), parameter :: numbers = 8

      if (any(points < 1) .or. product(int(points, int64)) > most_map_points) then
         call fatal_error(error, exit_bad_input, 'a map needs 1 or more points a side and at most '// &
                          integer_text(int(most_map_points))//' in all, got '//integer_text(points(1))//' x '// &
                          integer_text(points(2)))
      else if (dimension == 1 .and. points(2) /= 1) then
         call fatal_error(error, exit_bad_input, 'a map of a profile needs 1 point along y, got '// &
                          integer_text(points(2)))
      else if (.not. all(ieee_is_finite(offset))) then
         call fatal_error(error, exit_bad_input, 'the offset of a map must be two finite numbers')
      else if (.not. has_memory_for(numbers*product(int(points, int64)))) then
         call fatal_error(error, exit_file_trouble, 'there is not the memory for a map of '// &
                          integer_text(points(1))//' x '//integer_text(points(2))//' points')
      end if
   end subroutine check_points

end module wavycon_wavy_solution
