!> The numbers of a solution as one plain record: what tables without fields, checkpoints and other processes need of
!> it.
module wavycon_solution_record
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_measures, only: contact_measures, unmeasured
   use wavycon_contact_status, only: not_found
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solution_record, no_solution, record_of_words, words_of_record

   !> The solver of a solution. None is needed for no load and for full contact.
   integer, parameter, public :: no_solver = 0, by_series = 1, by_grids = 2, by_expansions = 3, by_closed_form = 4, &
      by_choice = 5
   !> Their names in decks and tables.
   character(12), parameter, public :: solver_names(0:5) = [character(12) :: 'none', 'beale', 'grid', 'fitted', &
      'closed_form', 'auto']

   type :: solution_record
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      type(contact_measures) :: measures
      real(dp) :: residual = 0.0_dp           !! relative, as each solver defines it
      integer(int64) :: active_constraints = 0   !! points at which the pressure is held at zero or at the hardness
      integer :: iterations = 0               !! for a quadratic programme, exchanges of variables since the last load
      integer :: solver = no_solver           !! one of the names above
      integer :: status = not_found           !! one of wavycon_contact_status
   end type solution_record

   type(contact_measures), parameter :: no_measures = contact_measures()
   integer, parameter :: measures_words = storage_size(no_measures)/64

   !> Words of 8 bytes that a record has.
   integer, parameter, public :: record_words = measures_words + 6

contains

   !> The record that stands for a failure, with unknown measures and errors.
   pure type(solution_record) function no_solution(pbar_over_pstar, solver, status) result(record)
      real(dp), intent(in) :: pbar_over_pstar        !! P
      integer, intent(in) :: solver                  !! that failed, one of the names above
      integer, intent(in) :: status                  !! why: a name of wavycon_contact_status

      record%pbar_over_pstar = pbar_over_pstar
      record%measures = unmeasured()
      record%solver = solver
      record%status = status
   end function no_solution

   !> The bits of a record, to be written to a file or sent to another process.
   pure function words_of_record(record) result(words)
      class(solution_record), intent(in) :: record
      integer(int64) :: words(record_words)

      words = [transfer(record%pbar_over_pstar, words), transfer(record%measures, words), &
               transfer(record%residual, words), record%active_constraints, &
               int([record%iterations, record%solver, record%status], int64)]
   end function words_of_record

   !> The inverse of words_of_record.
   pure type(solution_record) function record_of_words(words) result(record)
      integer(int64), intent(in) :: words(record_words)

      integer, parameter :: m = measures_words

      record = solution_record(transfer(words(1), 1.0_dp), transfer(words(2:m + 1), no_measures), &
                               transfer(words(m + 2), 1.0_dp), words(m + 3), &
                               int(words(m + 4)), int(words(m + 5)), int(words(m + 6)))
   end function record_of_words

end module wavycon_solution_record
