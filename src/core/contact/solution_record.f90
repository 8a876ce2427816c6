!> The numbers of a solution as one plain record: what tables without fields, checkpoints and other processes need of
!> it.
module wavycon_solution_record
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_status, only: not_found
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: quantities, unknown
   implicit none (type, external)
   private

   public :: solution_record, no_solution

   !> The solver of a solution. None is needed for no load and for full contact.
   integer, parameter, public :: no_solver = 0, by_beale = 1, by_grids = 2, by_expansions = 3, by_closed_form = 4, &
      by_choice = 5, by_dual = 6
   !> Their names in decks and tables.
   character(12), parameter, public :: solver_names(0:6) = [character(12) :: 'none', 'beale', 'grid', 'fitted', &
      'closed_form', 'auto', 'series']

   type, extends(quantities) :: solution_record
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      real(dp) :: residual = 0.0_dp           !! relative, as each solver defines it
      integer(int64) :: active_constraints = 0   !! points at which the pressure is held at zero or at the hardness
      integer :: iterations = 0               !! for a quadratic programme, exchanges of variables since the last load
      integer :: solver = no_solver           !! one of the names above
      integer :: status = not_found           !! one of wavycon_contact_status
      integer :: padding = 0                  !! to whole words of 8 bytes, so that no byte is undefined
   end type solution_record

   !> Words of 8 bytes that a record has when it is written to a file or sent to another process: `transfer` makes them,
   !> and a record of them.
   type(solution_record), parameter :: empty = solution_record()
   integer, parameter, public :: record_words = storage_size(empty)/64

contains

   !> The record that stands for a failure: the quantities without load, with unknown errors.
   pure type(solution_record) function no_solution(pbar_over_pstar, solver, status) result(record)
      real(dp), intent(in) :: pbar_over_pstar        !! P
      integer, intent(in) :: solver                  !! that failed, one of the names above
      integer, intent(in) :: status                  !! why: a name of wavycon_contact_status

      record%pbar_over_pstar = pbar_over_pstar
      record%error = unknown
      record%solver = solver
      record%status = status
   end function no_solution

end module wavycon_solution_record
