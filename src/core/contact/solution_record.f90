!> The numbers of a solution as one record without pointers or allocatable parts. Tables without fields, checkpoints and
!> other processes need only this record.
module wavycon_solution_record
   use wavycon_contact_status, only: not_found
   use wavycon_kinds, only: dp, int64
   use wavycon_quantities, only: quantities, unknown
   implicit none (type, external)
   private

   public :: solution_record, no_solution

   !> The solver of a solution. `no_solver` is used without load and in full contact, which need no solver.
   integer, parameter, public :: no_solver = 0, by_beale = 1, by_grid = 2, by_fitted = 3, by_closed_form = 4, &
      by_auto = 5, by_series = 6
   !> The names of these solvers in decks and tables.
   character(12), parameter, public :: solver_names(0:6) = [character(12) :: 'none', 'beale', 'grid', 'fitted', &
      'closed_form', 'auto', 'series']

   type, extends(quantities) :: solution_record
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      real(dp) :: residual = 0.0_dp           !! relative residual, which each solver defines
      integer(int64) :: active_constraints = 0   !! number of points whose pressure is at zero or at the hardness
      !> Number of iterations; of a quadratic programme the exchanges of variables since the last load.
      integer :: iterations = 0
      integer :: solver = no_solver           !! one of the names above
      integer :: status = not_found           !! one of the names in wavycon_contact_status
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
      integer, intent(in) :: status                  !! reason, one of the names in wavycon_contact_status

      record%pbar_over_pstar = pbar_over_pstar
      record%error = unknown
      record%solver = solver
      record%status = status
   end function no_solution

end module wavycon_solution_record
