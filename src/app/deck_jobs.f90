!> Processes that each run a deck, those of the option --jobs: an interface to jobs.c. Jobs are numbered from 1.
module wavycon_deck_jobs
   use, intrinsic :: iso_c_binding, only: c_int, c_int8_t, c_size_t
   use, intrinsic :: iso_fortran_env, only: error_unit, int8, output_unit
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   implicit none (type, external)
   private

   public :: await_job, begin_job, close_job, job_has_ended, send_bytes, show_job, start_jobs, take_bytes

   !> A status from here on less this number is that of the signal that ended a process.
   integer, parameter, public :: signal_status = 128

   interface
      integer(c_int) function c_start_jobs(number) bind(c, name='wavycon_start_jobs')
         import :: c_int
         integer(c_int), value :: number
      end function c_start_jobs

      integer(c_int) function c_begin_job(job) bind(c, name='wavycon_begin_job')
         import :: c_int
         integer(c_int), value :: job
      end function c_begin_job

      integer(c_int) function c_job_has_ended(job) bind(c, name='wavycon_job_has_ended')
         import :: c_int
         integer(c_int), value :: job
      end function c_job_has_ended

      !> Waits for any process to end.
      subroutine await_job() bind(c, name='wavycon_await_job')
      end subroutine await_job

      integer(c_int) function c_show_job(job) bind(c, name='wavycon_show_job')
         import :: c_int
         integer(c_int), value :: job
      end function c_show_job

      integer(c_int) function c_send(bytes, number) bind(c, name='wavycon_send')
         import :: c_int, c_int8_t, c_size_t
         integer(c_int8_t), intent(in) :: bytes(*)
         integer(c_size_t), value :: number
      end function c_send

      integer(c_int) function c_take(job, bytes, number) bind(c, name='wavycon_take')
         import :: c_int, c_int8_t, c_size_t
         integer(c_int), value :: job
         integer(c_int8_t), intent(out) :: bytes(*)
         integer(c_size_t), value :: number
      end function c_take

      subroutine c_close_job(job) bind(c, name='wavycon_close_job')
         import :: c_int
         integer(c_int), value :: job
      end subroutine c_close_job
   end interface

contains

   !> Makes room for jobs. Errors: exit_file_trouble without memory.
   subroutine start_jobs(number, error)
      integer, intent(in) :: number
      type(error_type), allocatable, intent(out) :: error

      if (c_start_jobs(int(number, c_int)) == 0) &
         call fatal_error(error, exit_file_trouble, 'there is not the memory for so many decks')
   end subroutine start_jobs

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

   logical function job_has_ended(job)
      integer, intent(in) :: job   !! that was begun

      job_has_ended = c_job_has_ended(int(job, c_int)) /= 0
   end function job_has_ended

   !> Prints what a job that has ended has printed.
   subroutine show_job(job, status)
      integer, intent(in) :: job
      integer, intent(out) :: status   !! its exit status, or signal_status and more

      flush (output_unit)
      status = int(c_show_job(int(job, c_int)))
   end subroutine show_job

   !> Sends bytes from the process of a job. If they cannot be written the other process finds too few.
   subroutine send_bytes(bytes)
      integer(int8), intent(in) :: bytes(:)

      integer(c_int) :: ignored

      ignored = c_send(bytes, size(bytes, kind=c_size_t))
   end subroutine send_bytes

   !> Takes bytes that a job has sent, after show_job.
   subroutine take_bytes(job, number, bytes)
      integer, intent(in) :: job, number
      integer(int8), allocatable, intent(out) :: bytes(:)   !! none if there are fewer

      allocate (bytes(number))
      if (c_take(int(job, c_int), bytes, int(number, c_size_t)) /= 0) return
      deallocate (bytes)
      allocate (bytes(0))
   end subroutine take_bytes

   !> Ends a job after show_job.
   subroutine close_job(job)
      integer, intent(in) :: job

      call c_close_job(int(job, c_int))
   end subroutine close_job

end module wavycon_deck_jobs
