!> Solutions of the public interface: measures, status, fields, the edge of contact and the stresses below it, in the
!> user's units.
module wavycon_wavy_solution
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_constants, only: pi
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: or_nan
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_status, only: not_found, status_code, status_name
   use wavycon_edge_curves, only: edge_curve, keep_curves_of_quarter
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, exit_fine, exit_not_converged, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_linear_area, only: linear_area_fraction
   use wavycon_plain_text, only: integer_text
   use wavycon_solution_record, only: solver_names
   use wavycon_solution_stress, only: solution_stress, wavy_largest_stress
   use wavycon_surface, only: surface_type
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: wavy_solution, wavy_measures, wavy_edge, start_solution

   !> Most points of a map.
   integer(int64), parameter, public :: most_map_points = 8192_int64**2

   !> Numbers of double precision that a map takes a point: fields or stresses, the work space of transforms and copies.
   integer(int64), parameter :: numbers_of_fields = 8, numbers_of_stresses = 28

   !> The numbers of a load, named as the columns of the summary table. Errors are estimates, NaN if unknown or if the
   !> solver has none.
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
      real(c_double) :: area_at_hardness_fraction_error = 0.0_dp
      real(c_double) :: load_at_hardness_fraction_error = 0.0_dp
      real(c_double) :: mean_pressure = 0.0_dp      !! [pressure]
      real(c_double) :: mean_gap = 0.0_dp           !! [length]
      real(c_double) :: approach = 0.0_dp           !! [length]
      real(c_double) :: contact_area = 0.0_dp       !! in the cell [length^2]; of a profile [length]
      real(c_double) :: peak_pressure = 0.0_dp      !! [pressure]
      real(c_double) :: residual = 0.0_dp           !! relative, as each solver defines it
      integer(c_int) :: active_constraints = 0
      integer(c_int) :: iterations = 0
      integer(c_int) :: status_code = 0             !! below 10: as requested
      real(c_double) :: contact_area_counted_fraction = 0.0_dp     !! points of the grid in contact; NaN without a grid
      real(c_double) :: contact_area_corrected_fraction = 0.0_dp   !! by Yastrebov; NaN without a grid and of profiles
      real(c_double) :: linear_area_fraction = 0.0_dp   !! 2 pbar/(E* rms slope); NaN if the surface is no height map
   end type wavy_measures

   !> A part of the edge of contact. In 2-D a closed polygon with the contact on its left, whose last point is the first
   !> again (one period on, if the curve runs through the whole plane); in 1-D the two ends of a strip in contact.
   type :: wavy_edge
      real(dp), allocatable :: x(:), y(:)   !! [length], not reduced to one cell, so that the curve does not jump
   end type wavy_edge

   !> The solution of one load, made by a wavy_solver. Before that its status is not_found.
   type :: wavy_solution
      private
      type(contact_solution), allocatable :: solution
      type(surface_type), allocatable :: surface          !! allocated if the fields were kept
      class(contact_fields), allocatable :: fields        !! allocated at their first use
      type(solution_stress), allocatable :: stresses      !! allocated at their first use
      type(wavy_measures) :: numbers
      real(dp) :: length(2) = 1.0_dp                      !! of the cell that repeats [length]
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
      generic :: stress => stress_at_point, stress_at_points
      procedure :: stress_plane
      procedure :: largest_stress
      procedure, private :: stress_at_point, stress_at_points
      procedure, private :: prepare_fields
      procedure, private :: prepare_stresses
   end type wavy_solution

contains

   !> Takes a solution of a solver. Errors: exit_file_trouble if there is not the memory to keep its fields.
   subroutine start_solution(from, surface, p_star, mean_pressure, keep_fields, has_errors, solution, error)
      type(contact_solution), allocatable, intent(inout) :: from   !! not allocated afterwards
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p_star           !! [pressure]
      real(dp), intent(in) :: mean_pressure    !! [pressure]
      logical, intent(in) :: keep_fields       !! whether the solver was started so
      logical, intent(in) :: has_errors        !! whether the solver estimates errors
      type(wavy_solution), intent(out) :: solution
      type(error_type), allocatable, intent(out) :: error

      real(dp) :: at_hardness(4), errors(3), peak

      errors = ieee_value(1.0_dp, ieee_quiet_nan)
      at_hardness = errors(1)
      associate (measures => from%measures)
         if (surface%has_hardness()) &
            at_hardness(:2) = [measures%area_at_hardness_fraction, measures%load_at_hardness_fraction]
         if (surface%has_hardness() .and. has_errors) &
            at_hardness(3:) = or_nan([measures%area_at_hardness_error, measures%load_at_hardness_error])
         if (has_errors) errors = or_nan(measures%errors())
         ! On a flat surface, whose p* is 0, the pressure is uniform.
         peak = mean_pressure
         if (p_star > 0.0_dp) peak = p_star*measures%peak_pressure_over_pstar
         solution%numbers = wavy_measures( &
            from%pbar_over_pstar, measures%mean_gap_over_amplitude, measures%approach_over_amplitude, &
            measures%contact_area_fraction, measures%peak_pressure_over_pstar, measures%min_pressure_over_pstar, &
            errors(1), errors(2), errors(3), at_hardness(1), at_hardness(2), at_hardness(3), &
            at_hardness(4), mean_pressure, &
            surface%amplitude*measures%mean_gap_over_amplitude, &
            surface%amplitude*measures%approach_over_amplitude, &
            surface%nominal_area()*measures%contact_area_fraction, peak, from%residual, &
            int(min(from%active_constraints, int(huge(1_c_int), int64)), c_int), int(from%iterations, c_int), &
            int(status_code(from%status), c_int), &
            or_nan(measures%contact_area_counted_fraction), or_nan(measures%contact_area_corrected_fraction), &
            or_nan(linear_area_fraction(surface, surface%rms_slope(), from%pbar_over_pstar)))
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

   !> The status, such as converged or not_accurate.
   pure integer function status(self)
      class(wavy_solution), intent(in) :: self

      status = not_found
      if (allocated(self%solution)) status = self%solution%status
   end function status

   !> The name of the solver; 'none' if no solver was needed.
   pure function name_of_solver(self) result(name)
      class(wavy_solution), intent(in) :: self
      character(:), allocatable :: name

      name = 'none'
      if (allocated(self%solution)) name = trim(solver_names(self%solution%solver))
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

   !> Fields on a grid of the sides L of the surface: x = L_x (k + offset(1))/N_x, k = 0 .. N_x - 1, the same in y.
   !> Pressure is exactly 0 outside contact and the gap exactly 0 in contact (not with solver 'beale', whose series is
   !> shown as it is). Errors: exit_bad_input for a bad number of points, without fields, or without memory.
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
      if (.not. allocated(error)) call check_points(points, self%surface%dimension, first, numbers_of_fields, error)
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
      if (allocated(error)) return
      points = self%fields%own_points
      offset = self%fields%own_offset
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
      if (self%surface%mirrored) call keep_curves_of_quarter(curves)
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

   !> The stress at one point in a body: xx, yy, zz, xy, xz, yz, tension positive, z into the body. NaN for a load
   !> without a solution. Errors: exit_bad_input for a solution that was not made or has no fields, and for arguments
   !> that are not finite or out of range; exit_file_trouble without memory.
   subroutine stress_at_point(self, x, y, depth, nu, lateral, stress, error, stress_error)
      class(wavy_solution), intent(inout) :: self
      real(dp), intent(in) :: x, y                   !! [length]
      real(dp), intent(in) :: depth                  !! >= 0 [length]
      real(dp), intent(in) :: nu                     !! Poisson's ratio of the body, -1 < nu <= 1/2
      !> Lateral stresses of the mean pressure: 'constrained', 'free' or 'hydrostatic', as the key of &stress.
      character(*), intent(in) :: lateral
      real(dp), intent(out) :: stress(6)             !! [pressure]
      type(error_type), allocatable, intent(out) :: error
      !> Estimate of the largest error of a component [pressure]; NaN if the solver has none.
      real(dp), intent(out), optional :: stress_error

      real(dp), allocatable :: errors(:), stresses(:, :)

      stress = 0.0_dp
      if (present(stress_error)) stress_error = 0.0_dp
      call self%stress_at_points([x], [y], [depth], nu, lateral, stresses, error, errors)
      if (allocated(error)) return
      stress = stresses(:, 1)
      if (present(stress_error)) stress_error = errors(1)
   end subroutine stress_at_point

   !> The stress at n points, likewise. Errors also: exit_bad_input for arrays of different sizes.
   subroutine stress_at_points(self, x, y, depth, nu, lateral, stress, error, stress_error)
      class(wavy_solution), intent(inout) :: self
      real(dp), intent(in) :: x(:), y(:), depth(:)                 !! shape (n) [length]
      real(dp), intent(in) :: nu
      character(*), intent(in) :: lateral
      real(dp), allocatable, intent(out) :: stress(:, :)           !! shape (6, n) [pressure]
      type(error_type), allocatable, intent(out) :: error
      real(dp), allocatable, intent(out), optional :: stress_error(:)   !! shape (n) [pressure]

      real(dp), allocatable :: errors(:)

      call self%prepare_stresses(error)
      if (.not. allocated(error)) call self%stresses%at(x, y, depth, nu, lateral, stress, errors, error)
      if (present(stress_error)) call move_alloc(errors, stress_error)
   end subroutine stress_at_points

   !> The stress at the points of `map`, at one depth. It is faster than `stress` at as many points. Errors: as of
   !> `stress`, and exit_bad_input for a bad number of points.
   subroutine stress_plane(self, points, depth, nu, lateral, stress, error, stress_error, offset)
      class(wavy_solution), intent(inout) :: self
      integer, intent(in) :: points(2)                             !! N_x, N_y >= 1; N_y = 1 for a profile
      real(dp), intent(in) :: depth                                !! >= 0 [length]
      real(dp), intent(in) :: nu                                   !! as of `stress`
      character(*), intent(in) :: lateral
      real(dp), allocatable, intent(out) :: stress(:, :, :)        !! shape (6, N_x, N_y) [pressure]
      type(error_type), allocatable, intent(out) :: error
      real(dp), allocatable, intent(out), optional :: stress_error(:, :)   !! shape (N_x, N_y) [pressure]
      real(dp), intent(in), optional :: offset(2)                  !! of the first point, in steps; 0 if absent

      real(dp), allocatable :: errors(:, :)
      real(dp) :: first(2)

      first = 0.0_dp
      if (present(offset)) first = offset
      call self%prepare_stresses(error)
      if (.not. allocated(error)) call check_points(points, self%surface%dimension, first, numbers_of_stresses, error)
      if (allocated(error)) return
      if (self%surface%dimension == 1) first(2) = 0.0_dp
      call self%stresses%on_plane(points, first, depth, nu, lateral, stress, errors, error)
      if (present(stress_error)) call move_alloc(errors, stress_error)
   end subroutine stress_plane

   !> The largest von Mises stress and the largest shear stress in a body, and where they are. Errors: as of `stress`.
   subroutine largest_stress(self, nu, lateral, largest, error)
      class(wavy_solution), intent(inout) :: self
      real(dp), intent(in) :: nu                        !! as of `stress`
      character(*), intent(in) :: lateral
      type(wavy_largest_stress), intent(out) :: largest
      type(error_type), allocatable, intent(out) :: error

      call self%prepare_stresses(error)
      if (.not. allocated(error)) call self%stresses%largest(nu, lateral, largest, error)
   end subroutine largest_stress

   !> Makes the fields, once. Errors: exit_bad_input if there are none.
   subroutine prepare_fields(self, error)
      class(wavy_solution), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (allocated(self%fields)) return
      call check_kept(self, error)
      if (allocated(error)) return
      if (is_failure(self%solution)) then
         call fatal_error(error, exit_bad_input, 'there are no fields: the status of the solution is '// &
                          trim(status_name(self%status())))
      else
         call self%solution%fields(self%surface, self%fields)
      end if
   end subroutine prepare_fields

   !> Makes the stresses, once. Errors: exit_bad_input if the fields were not kept; exit_file_trouble without memory.
   subroutine prepare_stresses(self, error)
      class(wavy_solution), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      !> Series, their waves and copies of them, in numbers a point of the grid.
      integer(int64), parameter :: numbers = 8
      integer :: points(2)
      real(dp) :: offset(2)

      if (allocated(self%stresses)) return
      call check_kept(self, error)
      points = 0
      if (.not. allocated(error)) then
         if (.not. is_failure(self%solution)) call self%own_points(points, offset, error)
      end if
      if (allocated(error)) return
      if (.not. has_memory_for(numbers*product(int(points, int64)))) then
         call fatal_error(error, exit_file_trouble, 'there is not the memory for the stresses')
         return
      end if
      allocate (self%stresses)
      self%stresses%length = self%length
      self%stresses%p_star = self%p_star
      self%stresses%mean_pressure = self%numbers%mean_pressure
      if (self%p_star > 0.0_dp) call self%solution%stresses(self%surface, self%stresses%fields)
   end subroutine prepare_stresses

   !> Errors: exit_bad_input if there is no solution or its fields were not kept.
   subroutine check_kept(solution, error)
      class(wavy_solution), intent(in) :: solution
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(solution%solution)) then
         call fatal_error(error, exit_bad_input, 'there is no solution: no load has been solved')
      else if (.not. allocated(solution%surface)) then
         call fatal_error(error, exit_bad_input, 'there are no fields: the solver was made without them')
      end if
   end subroutine check_kept

   !> Whether a solution stands for a failure and has no numbers.
   pure logical function is_failure(solution)
      type(contact_solution), intent(in) :: solution

      is_failure = .not. (solution%is_good() .or. allocated(solution%source))
   end function is_failure

   !> Checks the points of a map. Errors: exit_bad_input, and exit_file_trouble without memory.
   subroutine check_points(points, dimension, offset, numbers, error)
      integer, intent(in) :: points(2), dimension
      real(dp), intent(in) :: offset(2)
      integer(int64), intent(in) :: numbers    !! of double precision that a point needs
      type(error_type), allocatable, intent(out) :: error

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
