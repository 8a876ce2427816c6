!> The numbers of a solution as one plain record: what tables without fields, checkpoints and other ranks need of it.
module wavycon_solution_record
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_measures, only: contact_measures
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: solution_record, record_of_words, words_of_record

   type :: solution_record
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      type(contact_measures) :: measures
      real(dp) :: residual = 0.0_dp           !! relative, as each solver defines it
      integer(int64) :: active_constraints = 0   !! points at which the pressure is held at zero or at the hardness
      integer :: iterations = 0               !! for a quadratic programme, exchanges of variables since the last load
      character(12) :: solver = 'none'        !! name of the solver; 'none' if no solver was needed
      character(16) :: status = ''            !! one of wavycon_contact_status, or of wavycon_qp_problem
   end type solution_record

   type(solution_record), parameter :: a_record = solution_record()

   !> Words of 8 bytes that a record has.
   integer, parameter, public :: record_words = storage_size(a_record)/64

contains

   !> The bits of a record, to be written to a file or sent between ranks.
   pure function words_of_record(record) result(words)
      class(solution_record), intent(in) :: record
      integer(int64) :: words(record_words)

      type(solution_record) :: plain

      plain = solution_record(record%pbar_over_pstar, record%measures, record%residual, record%active_constraints, &
                              record%iterations, record%solver, record%status)
      words = transfer(plain, words)
   end function words_of_record

   !> The inverse of words_of_record.
   pure type(solution_record) function record_of_words(words) result(record)
      integer(int64), intent(in) :: words(record_words)

      record = transfer(words, record)
   end function record_of_words

end module wavycon_solution_record
