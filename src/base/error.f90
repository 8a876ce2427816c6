!> Errors, which procedures return to their callers. Only the main program ends the run.
!>
!> A procedure that can fail has an argument `type(error_type), allocatable, intent(out) :: error`. If `error` is
!> allocated on return, the procedure has failed.
module wavycon_error
   implicit none (type, external)
   private

   public :: error_type, fatal_error

   !> Exit statuses of the program.
   integer, parameter, public :: exit_fine = 0
   integer, parameter, public :: exit_bad_input = 1
   integer, parameter, public :: exit_not_converged = 2
   integer, parameter, public :: exit_file_trouble = 3

   !> A failure.
   type :: error_type
      integer :: status = exit_fine          !! the exit status that the program will have, one of those above
      character(:), allocatable :: message   !! for the user
   end type error_type

contains

   !> Makes an error.
   pure subroutine fatal_error(error, status, message)
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in) :: status        !! one of the exit statuses above, not exit_fine
      character(*), intent(in) :: message  !! may hold several lines

      if (status == exit_fine) error stop 'fatal_error: exit_fine is not the status of an error'
      allocate (error)
      error%status = status
      error%message = message
   end subroutine fatal_error

end module wavycon_error
