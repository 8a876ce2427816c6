!> The numbers of a solution as one record without pointers or allocatable parts, with the codes of its solver and its
!> status. Tables without fields, checkpoints and other processes need only this record.
module wavycon_solution_record
   use wavycon_kinds, only: dp, int64
   use wavycon_qp_problem, only: qp_converged, qp_inaccurate, qp_iteration_limit
   use wavycon_quantities, only: quantities, unknown
   implicit none (type, external)
   private

   public :: solution_record, no_solution
   public :: is_good_status, status_code, status_name, status_of_programme

   !> The solver of a solution. `no_solver` is used without load and in full contact, which need no solver.
   integer, parameter, public :: no_solver = 0, by_beale = 1, by_grid = 2, by_fitted = 3, by_closed_form = 4, &
      by_auto = 5, by_series = 6
   !> The names of these solvers in decks and tables.
   character(12), parameter, public :: solver_names(0:6) = [character(12) :: 'none', 'beale', 'grid', 'fitted', &
      'closed_form', 'auto', 'series']

   !> Good statuses are below 10. `converged`: the solver converged, to the accuracy requested if it estimates errors.
   !> `closed_form`: the solution is a closed form. `full_contact`, `no_load`: neither needs a solver.
   integer, parameter, public :: converged = 0, closed_form = 1, full_contact = 2, no_load = 3
   !> This status is good as well: points of the grid were given in place of an accuracy, and the equations are solved
   !> on that grid. But the error estimate of mean gap, contact area or peak pressure is unknown or as large as the
   !> value, or a largest stress is hardly known.
   integer, parameter, public :: unresolved = 4
   !> The error estimate exceeds the accuracy requested.
   integer, parameter, public :: not_accurate = 10
   !> The solver has no solution for this load or this surface.
   integer, parameter, public :: not_found = 11
   !> There is not enough memory for the grid requested; the numbers, if any, are those of a coarser grid.
   integer, parameter, public :: no_memory = 12
   !> The load is NaN.
   integer, parameter, public :: not_finite = 13
   !> The mean pressure is not below the hardness: no pressure up to the hardness carries it.
   integer, parameter, public :: above_hardness = 14
   !> The caller ended the solver before it had a solution (`solver_progress%shall_stop`).
   integer, parameter, public :: interrupted = 15
   !> The iteration or the quadratic programme failed. The status is this number plus a status of wavycon_qp_problem.
   integer, parameter, public :: other_failure = 20
   integer, parameter, public :: iteration_limit = other_failure + qp_iteration_limit

   !> All statuses, and their names in tables.
   integer, parameter :: statuses(*) = [converged, closed_form, full_contact, no_load, unresolved, not_accurate, &
      not_found, no_memory, not_finite, above_hardness, interrupted, &
      other_failure + [qp_iteration_limit, qp_inaccurate]]
   character(16), parameter :: status_names(*) = [character(16) :: 'converged', 'closed_form', 'full_contact', &
      'no_load', 'unresolved', 'not_accurate', 'not_found', 'no_memory', 'not_finite', 'above_hardness', &
      'interrupted', 'iteration_limit', 'inaccurate']

   type, extends(quantities) :: solution_record
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      real(dp) :: residual = 0.0_dp           !! relative residual, which each solver defines
      integer(int64) :: active_constraints = 0   !! number of points whose pressure is at zero or at the hardness
      !> Number of iterations; of a quadratic programme the exchanges of variables since the last load.
      integer :: iterations = 0
      integer :: solver = no_solver           !! one of the names above
      integer :: status = not_found           !! one of the names above
      integer :: padding = 0                  !! fills the last word of 8 bytes, so that no byte is undefined
   end type solution_record

   !> Length of a record in words of 8 bytes. `transfer` converts a record to words, in which it is written to a file or
   !> sent to another process, and back.
   type(solution_record), parameter :: empty = solution_record()
   integer, parameter, public :: record_words = storage_size(empty)/64

contains

   !> The record of a load that was not solved. Its values are those without load, and its errors are unknown.
   pure type(solution_record) function no_solution(pbar_over_pstar, solver, status) result(record)
      real(dp), intent(in) :: pbar_over_pstar        !! P
      integer, intent(in) :: solver                  !! solver that failed, one of the names above
      integer, intent(in) :: status                  !! reason, one of the names above

      record%pbar_over_pstar = pbar_over_pstar
      record%error = unknown
      record%solver = solver
      record%status = status
   end function no_solution

   !> Whether a solution with this status is what was requested.
   elemental logical function is_good_status(status)
      integer, intent(in) :: status

      is_good_status = status >= 0 .and. status < not_accurate
   end function is_good_status

   !> The number of a status in tables. All failures of the iteration have one number, `other_failure`.
   elemental integer function status_code(status)
      integer, intent(in) :: status

      status_code = min(status, other_failure)
   end function status_code

   !> The status of a solution that a quadratic programme gave.
   elemental integer function status_of_programme(qp_status) result(status)
      integer, intent(in) :: qp_status   !! a status of wavycon_qp_problem

      status = converged
      if (qp_status /= qp_converged) status = other_failure + qp_status
   end function status_of_programme

   !> The name of a status in tables, 'unknown' if there is no such status.
   elemental character(16) function status_name(status) result(name)
      integer, intent(in) :: status

      integer :: i

      i = findloc(statuses, status, dim=1)
      name = 'unknown'
      if (i > 0) name = status_names(i)
   end function status_name

end module wavycon_solution_record
