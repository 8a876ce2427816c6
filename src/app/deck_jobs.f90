!> Processes that each run a deck, those of the option --jobs: an interface to jobs.c. Jobs are numbered from 1.
module wavycon_deck_jobs
   use, intrinsic :: iso_c_binding, only: c_bool, c_int
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   implicit none (type, external)
   private

   public :: await_job, begin_job, job_has_ended, show_job

   !> A status from here on less this number is that of the signal that ended a process.
   integer, parameter, public :: signal_status = 128
   !> Jobs that may be begun beyond the first one that was not shown: each has open files, and a place in jobs.c.
   integer, parameter, public :: most_waiting = 100

   interface
      integer(c_int) function c_begin_job(job) bind(c, name='wavycon_begin_job')
         import :: c_int
         integer(c_int), value :: job
      end function c_begin_job

      logical(c_bool) function job_has_ended(job) bind(c, name='wavycon_job_has_ended')
         import :: c_bool, c_int
         integer(c_int), value :: job   !! that was begun
      end function job_has_ended

      !> Waits for any process to end.
      subroutine await_job() bind(c, name='wavycon_await_job')
      end subroutine await_job

      integer(c_int) function c_show_job(job) bind(c, name='wavycon_show_job')
         import :: c_int
         integer(c_int), value :: job
      end function c_show_job
   end interface

contains

   !> Starts a process, a copy of this one, for a job. Errors: exit_file_trouble.
   subroutine begin_job(job, is_here, error)
      integer, intent(in) :: job
      logical, intent(out) :: is_here   !! in the process of the job
      type(error_type), allocatable, intent(out) :: error

      integer :: answer

      flush (output_unit)
      flush (error_unit)
      answer = int(c_begin_job(int(job, c_int)))
      is_here = answer > 0
      if (answer < 0) call fatal_error(error, exit_file_trouble, 'a process or a temporary file for it cannot be made')
   end subroutine begin_job

   !> Prints what a job that has ended has printed.
   subroutine show_job(job, status)
      integer, intent(in) :: job
      integer, intent(out) :: status   !! its exit status, or signal_status and more

      flush (output_unit)
      status = int(c_show_job(int(job, c_int)))
   end subroutine show_job

end module wavycon_deck_jobs
