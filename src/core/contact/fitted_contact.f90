!> The solver 'fitted', for surfaces whose crests form a lattice (`fitted_frame`). The pressure, or the
!> gap, is a sum of polynomials on a disc that is mapped to the spot or pool (src/core/fitted). Its accuracy is limited
!> by rounding, not by the step of a grid.
module wavycon_fitted_contact
   use wavycon_assertion, only: assert
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, default_accuracy, solver_traits
   use wavycon_fitted_answer, only: fitted_answer, fitted_less_exact, fitted_solved
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_fitted_source, only: fitted_source
   use wavycon_fitted_solver, only: solve_fitted
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: elastic_energy, known_errors, main_quantities, number_of_quantities, peak_pressure, &
      perimeter, scaled
   use wavycon_solution_record, only: by_fitted, converged, no_solution, not_accurate, not_found
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: fitted_contact

   type, extends(contact_solver) :: fitted_contact
      type(fitted_frame), private :: frame
      real(dp), private :: accuracy = default_accuracy   !! as in `start`
      logical, private :: keep_fields = .true.
      type(fitted_answer), private :: last         !! solution of the last load, from which the next one starts
   contains
      procedure :: start, solve_partial_contact, traits, forget_last_load
   end type fitted_contact

contains

   !> Starts the solver. Afterwards `is_started` tells whether the surface can be solved.
   subroutine start(self, surface, accuracy, keep_fields)
      class(fitted_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface   !! without a lattice all solutions have the status not_found
      real(dp), intent(in) :: accuracy            !! largest error of gap [Delta], area fraction, peak [p*], > 0
      logical, intent(in) :: keep_fields          !! whether fields or details of the solutions will be needed

      call assert(accuracy > 0.0_dp, 'accuracy > 0')
      self%surface = surface
      self%accuracy = accuracy
      self%keep_fields = keep_fields
      call find_frame(surface, self%frame)
      ! A flat surface is in full contact at every load: no fitted function is needed.
      self%is_started = (allocated(self%frame%lattice) .or. .not. surface%amplitude > 0.0_dp) &
         .and. .not. surface%has_hardness()
   end subroutine start

   !> Solves one load by solve_fitted and converts its answer to the units p* and Delta. The status is not_found if
   !> solve_fitted has no solution, not_accurate if an error estimate exceeds the accuracy.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(fitted_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      type(contact_solution), intent(out) :: solution

      real(dp) :: unit(number_of_quantities)   !! units of the quantities of `answer` over those of `solution`
      type(fitted_answer) :: answer
      type(fitted_source), allocatable :: source

      if (allocated(self%frame%lattice)) then
         ! solve_fitted takes an accuracy relative to the values. The largest of the three values is the peak pressure,
         ! which is less than that of full contact at P = 1; so the absolute errors are at most `accuracy`.
         call solve_fitted(self%frame%lattice, pbar_over_pstar/self%frame%pressure_unit, &
                           self%accuracy/(1.0_dp + self%surface%full_contact_peak), answer, self%last, &
                           self%keep_fields)
      end if
      if (answer%status /= fitted_solved .and. answer%status /= fitted_less_exact) then
         solution%solution_record = no_solution(pbar_over_pstar, by_fitted, not_found)
         return
      end if
      self%last = answer
      solution%pbar_over_pstar = pbar_over_pstar
      solution%solver = by_fitted
      unit = 1.0_dp
      unit(peak_pressure) = self%frame%pressure_unit
      unit(elastic_energy) = self%frame%pressure_unit/self%frame%lattice%area
      unit(perimeter) = self%frame%side
      solution%value = scaled(answer%value, unit)
      solution%error = scaled(answer%error, unit)
      solution%error(main_quantities) = known_errors(solution%error(main_quantities), self%surface%full_contact_peak)
      solution%iterations = answer%iterations
      solution%residual = answer%residual
      solution%status = not_accurate
      if (maxval(solution%error(main_quantities)) <= self%accuracy) solution%status = converged
      if (.not. self%keep_fields) return
      allocate (source)
      source%frame = self%frame
      source%answer = answer
      source%accuracy = self%accuracy
      call move_alloc(source, solution%source)
   end subroutine solve_partial_contact

   !> The traits. A solution starts from the last one, so that its last digits depend on the load before.
   type(solver_traits) function traits(self)
      class(fitted_contact), intent(in) :: self

      associate (unused => self); end associate
      traits = solver_traits(solver=by_fitted, has_details=.true., continues_last_load=.true.)
   end function traits

   !> Forgets the last solution; the next one starts without it.
   subroutine forget_last_load(self)
      class(fitted_contact), intent(inout) :: self

      type(fitted_answer) :: none

      self%last = none
   end subroutine forget_last_load

end module wavycon_fitted_contact
