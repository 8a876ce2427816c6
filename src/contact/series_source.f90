!> The source of fields, edge and stresses of a pressure that is a truncated Fourier series.
module wavycon_series_source
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_complementary_energy, only: energy_problem
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: load_derivatives, measuring_intervals
   use wavycon_contact_contours, only: contact_contour, make_strips, trace_edges, rotate_contours
   use wavycon_field_source, only: field_source
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: fourier_terms
   use wavycon_isobar_grid, only: isobar_grid, start_isobar_grid
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: line_zeros
   use wavycon_qp_problem, only: qp_problem
   use wavycon_series_fields, only: series_fields
   use wavycon_series_stress, only: series_stress, start_series_stress
   use wavycon_solution_record, only: solution_record
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   use wavycon_rotated_series, only: to_sum_angles
   use wavycon_working_set, only: working_set
   implicit none (type, external)
   private

   public :: series_source

   type, extends(field_source) :: series_source
      type(fourier_terms) :: terms
      logical :: rotated = .false.          !! phi and theta are the cell's angles rotated by 45 degrees
      real(dp) :: edge_level = 0.0_dp      !! isobar taken as the edge of contact [p*]
      integer :: constraint_points = 2     !! on [0, pi] in each direction
      integer :: symmetry = 0              !! of the terms
      real(dp), allocatable :: x(:)        !! amplitudes of the terms of (p - pbar)/p*
   contains
      procedure :: pressure
      procedure :: displacement
      procedure :: fields
      procedure :: contact_contours
      procedure :: stresses
      procedure :: coefficients
      procedure :: derivatives
   end type series_source

contains

   !> p/p* as a series in phi and theta.
   type(fourier_series) function pressure(self, pbar_over_pstar) result(series)
      class(series_source), intent(in) :: self
      real(dp), intent(in) :: pbar_over_pstar    !! P

      call self%terms%coefficients(self%x, series%c)
      series%c(0, 0) = pbar_over_pstar
   end function pressure

   !> (u - ubar)/Delta as a series in phi and theta: eqs. (13), (A10).
   type(fourier_series) function displacement(self) result(series)
      class(series_source), intent(in) :: self

      call self%terms%coefficients(self%terms%compliance*self%x, series%c)
   end function displacement

   subroutine fields(self, record, surface, answer)
      class(series_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(series_fields), allocatable :: own

      allocate (own)
      call self%coefficients(record, own%pressure)
      own%displacement = surface%displacement_of(own%pressure)
      own%surface = surface
      own%mean_gap = 1.0_dp - record%measures%approach_over_amplitude
      call move_alloc(own, answer)
   end subroutine fields

   !> The error of a truncated series is not estimated.
   subroutine stresses(self, record, surface, answer)
      class(series_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fourier_series) :: series
      type(series_stress), allocatable :: own

      call self%coefficients(record, series)
      allocate (own)
      call start_series_stress(own, surface, series, record%pbar_over_pstar, &
                               pressure_error=ieee_value(1.0_dp, ieee_quiet_nan), is_sampled=.false.)
      call move_alloc(own, answer)
   end subroutine stresses

   subroutine coefficients(self, record, series)
      class(series_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(fourier_series), intent(out) :: series

      series = self%pressure(record%pbar_over_pstar)
      if (self%rotated) series = to_sum_angles(series)
   end subroutine coefficients

   !> The isobar p = edge_level p*.
   subroutine contact_contours(self, record, surface, curves, loads)
      class(series_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      type(contact_contour), allocatable, intent(out) :: curves(:)
      real(dp), allocatable, intent(out) :: loads(:)

      type(fourier_series) :: series
      type(isobar_grid) :: grid
      real(dp), allocatable :: zeros(:)

      series = self%pressure(record%pbar_over_pstar)
      associate (level => self%edge_level, harmonics => self%terms%harmonics)
         if (surface%dimension == 2) then
            call start_isobar_grid(grid, series, level, measuring_intervals(harmonics))
            if (self%rotated) then
               ! A period of phi and theta is two cells.
               call trace_edges(grid, curves, cell=grid%period/[1, 2], skew=grid%period(1)/2)
               call rotate_contours(curves, factor=1.0_dp)
            else
               call trace_edges(grid, curves)
            end if
         else
            series%c(0, 0) = series%c(0, 0) - level
            call line_zeros(series%c(:, 0), measuring_intervals(harmonics), zeros)
            call make_strips(zeros, sum(series%c) >= 0.0_dp, .true., curves)
         end if
         ! The part outside the isobar is not known.
         allocate (loads(0))
      end associate
   end subroutine contact_contours

   !> The slope of the mean gap at fixed active constraints, from the least energy of pressures of mean 1 that vanish at
   !> these: (C30) of README.md in this directory. Unknown with a hardness, or if the constraints depend on each other.
   subroutine derivatives(self, record, surface, answer)
      class(series_source), intent(in) :: self
      type(solution_record), intent(in) :: record
      type(surface_type), intent(in) :: surface
      type(load_derivatives), intent(out) :: answer

      !> Pressures below this part of the peak pressure are rounding: the constraint is active.
      real(dp), parameter :: active = 1e-9_dp
      type(qp_problem) :: problem
      type(working_set) :: set
      integer, allocatable :: constraints(:)
      integer :: i
      real(dp), allocatable :: multipliers(:), x(:)

      if (surface%has_hardness()) return
      problem = energy_problem(self%terms, self%constraint_points, self%symmetry, has_hardness=.false.)
      associate (pressure => record%pbar_over_pstar + matmul(self%x, problem%normals), &
                 least => active*record%measures%peak_pressure_over_pstar)
         constraints = pack([(i, i=1, size(pressure))], pressure < least)
      end associate
      problem%linear = 0.0_dp
      problem%bounds = -1.0_dp
      call set%start(problem)
      call set%assign_active(problem, constraints)
      if (set%count < size(constraints)) return
      allocate (multipliers(set%count), x(size(self%x)))
      call set%solve(problem, x, multipliers)
      ! The energy is in units of the mean square of the surface's own wave.
      answer%gap_slope = -sum(problem%hessian*x**2)/2**surface%dimension
   end subroutine derivatives

end module wavycon_series_source
