!> Processes that each run a deck, those of the option --jobs: an interface to jobs.c. Jobs are numbered from 1. What
!> Fortran has in its buffers must be flushed before a job is begun or shown.
module wavycon_deck_jobs
   use, intrinsic :: iso_c_binding, only: c_bool, c_int
   implicit none (type, external)
   private

   public :: await_job, begin_job, job_has_ended, show_job

   !> A status from here on less this number is that of the signal that ended a process.
   integer, parameter, public :: signal_status = 128
   !> Jobs that may be begun beyond the first one that was not shown: each has open files, and a place in jobs.c.
   integer, parameter, public :: most_waiting = 100

   interface
      !> Starts a process, a copy of this one, for a job: 1 in it, 0 in this one, -1 if there is none.
      integer(c_int) function begin_job(job) bind(c, name='wavycon_begin_job')
         import :: c_int
         integer(c_int), value :: job
      end function begin_job

      logical(c_bool) function job_has_ended(job) bind(c, name='wavycon_job_has_ended')
         import :: c_bool, c_int
         integer(c_int), value :: job   !! that was begun
      end function job_has_ended

      !> Waits for any process to end.
      subroutine await_job() bind(c, name='wavycon_await_job')
      end subroutine await_job

      !> Prints what a job that has ended has printed: its exit status, or signal_status and more.
      integer(c_int) function show_job(job) bind(c, name='wavycon_show_job')
         import :: c_int
         integer(c_int), value :: job
      end function show_job
   end interface

end module wavycon_deck_jobs
