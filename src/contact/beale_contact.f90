!> The method of Johnson, Greenwood & Higginson (1985). The pressure is a truncated Fourier series
!> whose coefficients minimise the complementary energy, a quadratic programme. Its minimum is found by Goldfarb &
!> Idnani's dual method or, as in the paper, by Beale's.
module wavycon_beale_contact
   use wavycon_assertion, only: assert
   use wavycon_complementary_energy, only: bounds_at, energy_problem
   use wavycon_contact_measures, only: measure_series
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: status_of_programme
   use wavycon_contact_tuning, only: lightest_start
   use wavycon_dual_solver, only: dual_solver
   use wavycon_fourier_terms, only: choose_terms, symmetry_full
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution
   use wavycon_series_source, only: series_source
   use wavycon_solution_record, only: by_series
   use wavycon_surface, only: surface_type, rotated_paper_wave
   implicit none (type, external)
   private

   public :: beale_contact, paper_constraint_points, paper_harmonics, qp_options

   !> Harmonics of the paper's series, for 1-D and 2-D waves.
   integer, parameter :: paper_harmonics(2) = [10, 9]

   type :: qp_options
      integer :: harmonics = paper_harmonics(2)    !! n >= 1
      integer :: constraint_points = 27            !! on [0, pi] in each direction, >= 2
      integer :: symmetry = symmetry_full          !! one of the names of wavycon_fourier_terms
      real(dp) :: edge_level = 0.1_dp              !! isobar taken as the edge of contact [p*], > 0
      logical :: by_beale = .false.                !! by Beale's method in place of the dual method
   end type qp_options

   type, extends(contact_solver) :: beale_contact
      type(series_source) :: series                    !! without amplitudes
      type(qp_problem) :: problem                      !! at zero load, or that of the last cold start
      logical :: by_beale = .false.                    !! whether Beale's method solves each load
      type(dual_solver), allocatable, private :: solver   !! after the first load
   contains
      procedure :: start
      procedure :: solve_partial_contact
      procedure :: solve_programme
      procedure :: traits
      procedure :: forget_last_load
   end type beale_contact

contains

   !> The number of points, in the paper's proportion to harmonics: 27 for 9 harmonics of the 2-D wave, 26 (25
   !> intervals) for 10 of the 1-D wave. Always more than harmonics.
   pure integer function paper_constraint_points(dimension, harmonics) result(points)
      integer, intent(in) :: dimension   !! 1 or 2
      integer, intent(in) :: harmonics   !! >= 1

      points = 3*harmonics
      if (dimension == 1) points = (5*harmonics + 1)/2 + 1
   end function paper_constraint_points

   !> Chooses the terms of the series and the points of the constraints. Solutions always keep their fields.
   subroutine start(self, surface, options)
      class(beale_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface  !! a wave of the paper
      type(qp_options), intent(in) :: options

      call assert(options%harmonics >= 1, 'harmonics >= 1')
      call assert(options%constraint_points >= 2, 'constraint_points >= 2')
      call assert(options%edge_level > 0.0_dp, 'edge_level > 0')
      self%surface = surface
      self%is_started = surface%is_paper_wave()
      self%by_beale = options%by_beale
      self%series%edge_level = options%edge_level
      self%series%constraint_points = options%constraint_points
      self%series%symmetry = options%symmetry
      self%series%rotated = surface%paper_wave() == rotated_paper_wave
      self%series%terms = choose_terms(surface%dimension, options%harmonics, options%symmetry)
      self%problem = energy_problem(self%series%terms, options%constraint_points, options%symmetry, &
                                    surface%has_hardness())
   end subroutine start

   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(beale_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_solution), intent(out) :: solution

      type(qp_solution) :: programme
      type(series_source), allocatable :: source
      real(dp) :: residual_indentation, open_gap

      call self%solve_programme(pbar_over_pstar, programme)
      solution%pbar_over_pstar = pbar_over_pstar
      solution%solver = by_series
      solution%status = status_of_programme(programme%status)
      solution%iterations = programme%pivots
      solution%residual = programme%kkt_residual
      open_gap = 0.0_dp
      residual_indentation = 0.0_dp
      solution%active_constraints = size(programme%active)
      if (self%surface%has_hardness()) then
         ! The energy per area is P plus the programme's objective times the mean square of the surface's wave.
         associate (at_hardness => programme%active > size(self%problem%bounds)/2, &
                    gaps => programme%multipliers/2**self%surface%dimension)
            open_gap = sum(gaps, .not. at_hardness)
            residual_indentation = sum(gaps, at_hardness)
         end associate
      end if
      allocate (source)
      source = self%series
      call move_alloc(programme%x, source%x)
      ! Without residual indentation no point is at H, although a peak between the points may come close.
      call measure_series(source%pressure(pbar_over_pstar), source%displacement(), self%series%edge_level, &
                          solution%measures, merge(self%surface%hardness, huge(1.0_dp), residual_indentation > 0.0_dp))
      associate (x => source%x, n => self%surface%dimension)
         ! The mean square of the surface's own wave is 2^-n.
         solution%measures%elastic_energy = 0.5_dp*dot_product(x, self%problem%hessian*x)/2**n
      end associate
      ! The crest, from which the approach follows otherwise, is then not in elastic contact.
      if (residual_indentation > 0.0_dp) then
         solution%measures%mean_gap_over_amplitude = open_gap
         solution%measures%approach_over_amplitude = 1.0_dp - open_gap + residual_indentation
      end if
      call move_alloc(source, solution%source)
   end subroutine solve_partial_contact

   !> Solves the quadratic programme (17), (18) or (26), (27) of the paper, with p <= H where the surface has a
   !> hardness. Its pivots are those since the last load; its x are the amplitudes of the Fourier terms of
   !> (p - pbar)/p*.
   subroutine solve_programme(self, pbar_over_pstar, programme)
      class(beale_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar       !! 0 < P < 1 or H
      type(qp_solution), intent(out) :: programme

      real(dp) :: start
      integer :: pivots
      logical :: solved

      pivots = 0
      solved = .false.
      if (self%by_beale .or. .not. allocated(self%solver)) then
         if (.not. allocated(self%solver)) allocate (self%solver)
         start = pbar_over_pstar
         if (.not. self%by_beale) start = max(start, min(lightest_start, 0.5_dp*self%surface%hardness))
         self%problem%bounds = bounds_at(self%problem, start, self%surface%hardness)
         call self%solver%solve(self%problem, programme, self%by_beale)
         pivots = programme%pivots
         solved = pbar_over_pstar >= start
      end if
      if (.not. solved) then
         call self%solver%pass_to(bounds_at(self%problem, pbar_over_pstar, self%surface%hardness), programme)
         programme%pivots = programme%pivots + pivots
      end if
   end subroutine solve_programme

   type(solver_traits) function traits(self)
      class(beale_contact), intent(in) :: self

      traits = solver_traits(solver=by_series, has_errors=.false., has_coefficients=.true., &
                             continues_last_load=.not. self%by_beale)
   end function traits

   subroutine forget_last_load(self)
      class(beale_contact), intent(inout) :: self

      if (allocated(self%solver)) deallocate (self%solver)
   end subroutine forget_last_load

end module wavycon_beale_contact
