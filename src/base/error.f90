!> Errors that travel up to the program, which alone ends the run.
!>
!> A procedure that can fail has a last argument `type(error_type), allocatable, intent(out) :: error`:
!> allocated means failed.
module wavycon_error
   implicit none (type, external)
   private

   public :: error_type, fatal_error

   !> Exit statuses of the program.
   integer, parameter, public :: exit_fine = 0
   integer, parameter, public :: exit_bad_input = 1
   integer, parameter, public :: exit_not_converged = 2
   integer, parameter, public :: exit_file_trouble = 3

   !> What went wrong, in words for the user, and the exit status that it calls for.
   type :: error_type
      integer :: status = exit_fine
      character(:), allocatable :: message
   end type error_type

contains

   !> Raises an error.
   pure subroutine fatal_error(error, status, message)
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in) :: status        !! one of the exit statuses above
      character(*), intent(in) :: message  !! may hold several lines

      allocate (error)
      error%status = status
      error%message = message
   end subroutine fatal_error

end module wavycon_error
