!> The statuses of a solution: codes, and their names in tables.
module wavycon_contact_status
   use wavycon_qp_problem, only: qp_converged, qp_inaccurate, qp_iteration_limit
   implicit none (type, external)
   private

   public :: is_good_status, status_code, status_name, status_of_programme

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
   character(16), parameter :: names(*) = [character(16) :: 'converged', 'closed_form', 'full_contact', 'no_load', &
      'unresolved', 'not_accurate', 'not_found', 'no_memory', 'not_finite', 'above_hardness', 'interrupted', &
      'iteration_limit', 'inaccurate']

contains

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
      if (i > 0) name = names(i)
   end function status_name

end module wavycon_contact_status
