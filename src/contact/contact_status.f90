!> The statuses of a solution.
!>
!> A solution whose iteration or quadratic programme failed has a status of wavycon_qp_problem instead, such as
!> 'iteration_limit'.
module wavycon_contact_status
   implicit none (type, external)
   private

   public :: is_good_status, status_code

   !> Good statuses: the solver converged, to the accuracy requested if it estimates errors; the solution is a closed
   !> form; the contact is full; there is no load.
   character(*), parameter, public :: converged = 'converged', closed_form = 'closed_form', &
                                      full_contact = 'full_contact', no_load = 'no_load'
   !> Good as well: the equations are solved on the grid that was asked for, without an accuracy, but the error estimate
   !> of mean gap, contact area or peak pressure is unknown or as large as the value.
   character(*), parameter, public :: unresolved = 'unresolved'
   !> The load is NaN.
   character(*), parameter, public :: not_finite = 'not_finite'
   !> The error estimate exceeds the accuracy requested.
   character(*), parameter, public :: not_accurate = 'not_accurate'
   !> The solver has no solution for this load or this surface.
   character(*), parameter, public :: not_found = 'not_found'
   !> The mean pressure is not below the hardness: no pressure up to the hardness carries it.
   character(*), parameter, public :: above_hardness = 'above_hardness'
   !> There is not enough memory for the grid requested; the numbers, if any, are those of a coarser grid.
   character(*), parameter, public :: no_memory = 'no_memory'

contains

   !> Whether a solution with this status is what was requested.
   elemental logical function is_good_status(status)
      character(*), intent(in) :: status

      is_good_status = status == converged .or. status == closed_form .or. status == full_contact .or. &
                       status == no_load .or. status == unresolved
   end function is_good_status

   !> The number of a status, for tables: below 10 if the status is good.
   elemental integer function status_code(status)
      character(*), intent(in) :: status   !! trailing blanks are ignored

      select case (status)
      case (converged)
         status_code = 0
      case (closed_form)
         status_code = 1
      case (full_contact)
         status_code = 2
      case (no_load)
         status_code = 3
      case (unresolved)
         status_code = 4
      case (not_accurate)
         status_code = 10
      case (not_found)
         status_code = 11
      case (no_memory)
         status_code = 12
      case (not_finite)
         status_code = 13
      case (above_hardness)
         status_code = 14
      case default
         status_code = 20
      end select
   end function status_code

end module wavycon_contact_status
