!> The statuses of a solution: codes, and their names in tables.
module wavycon_contact_status
   use wavycon_qp_problem, only: qp_converged, qp_inaccurate, qp_infeasible, qp_infeasible_start, qp_iteration_limit, &
      qp_not_convex, qp_not_finite
   implicit none (type, external)
   private

   public :: is_good_status, status_code, status_name, status_of_programme

   !> Good statuses, below 10: the solver converged, to the accuracy requested if it estimates errors; the solution is a
   !> closed form; the contact is full; there is no load.
   integer, parameter, public :: converged = 0, closed_form = 1, full_contact = 2, no_load = 3
   !> Good as well: the equations are solved on the grid that was asked for, without an accuracy, but the error estimate
   !> of mean gap, contact area or peak pressure is unknown or as large as the value.
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
   !> The iteration or the quadratic programme failed: from this number on by its status of wavycon_qp_problem.
   integer, parameter, public :: other_failure = 20
   integer, parameter, public :: iteration_limit = other_failure + qp_iteration_limit

contains

   !> Whether a solution with this status is what was requested.
   elemental logical function is_good_status(status)
      integer, intent(in) :: status

      is_good_status = status >= 0 .and. status < not_accurate
   end function is_good_status

   !> The number of a status in tables: one for all failures of the iteration.
   elemental integer function status_code(status)
      integer, intent(in) :: status

      status_code = min(status, other_failure)
   end function status_code

   !> The status of a solution by a quadratic programme.
   elemental integer function status_of_programme(qp_status) result(status)
      integer, intent(in) :: qp_status   !! of wavycon_qp_problem

      select case (qp_status)
      case (qp_converged)
         status = converged
      case (qp_not_finite)
         status = not_finite
      case default
         status = other_failure + qp_status
      end select
   end function status_of_programme

   !> The name of a status in tables.
   elemental character(16) function status_name(status) result(name)
      integer, intent(in) :: status

      select case (status)
      case (converged)
         name = 'converged'
      case (closed_form)
         name = 'closed_form'
      case (full_contact)
         name = 'full_contact'
      case (no_load)
         name = 'no_load'
      case (unresolved)
         name = 'unresolved'
      case (not_accurate)
         name = 'not_accurate'
      case (not_found)
         name = 'not_found'
      case (no_memory)
         name = 'no_memory'
      case (not_finite)
         name = 'not_finite'
      case (above_hardness)
         name = 'above_hardness'
      case (interrupted)
         name = 'interrupted'
      case (iteration_limit)
         name = 'iteration_limit'
      case (other_failure + qp_infeasible)
         name = 'infeasible'
      case (other_failure + qp_infeasible_start)
         name = 'infeasible_start'
      case (other_failure + qp_not_convex)
         name = 'not_convex'
      case (other_failure + qp_inaccurate)
         name = 'inaccurate'
      case default
         name = 'unknown'
      end select
   end function status_name

end module wavycon_contact_status
