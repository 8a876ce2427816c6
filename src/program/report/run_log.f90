!> The log of a run on standard output: lines, notes, and on a terminal a progress line.
module wavycon_run_log
   use, intrinsic :: iso_c_binding, only: c_null_char
   use wavycon_kinds, only: dp, int64
   use wavycon_plain_text, only: integer_text, newline, short_number
   use wavycon_solver_progress, only: solver_progress
   use wavycon_system, only: print_text, say_line => say, terminal_columns
   implicit none (type, external)
   private

   public :: duration, log_progress, run_log

   !> Seconds between two progress lines on a terminal.
   real(dp), parameter :: progress_interval = 0.2_dp

   type :: run_log
      private
      logical, public :: quiet = .false.   !! whether nothing is written
      character(:), allocatable, public :: notes   !! the notes since the start, each once, as lines
      integer :: columns = 0          !! width of the terminal in characters; 0: standard output is no terminal
      integer :: shown = 0            !! length of the progress line that the terminal shows
      integer(int64) :: started = 0, rate = 1   !! the system's clock at the start, and its counts per second
      real(dp) :: last_progress = 0.0_dp   !! time of the last progress line since the start [s]
   contains
      procedure :: start, say, note, say_timed, say_progress, is_due, elapsed
   end type run_log

   !> Shows the grids and iterations of a load as progress lines. The solver calls `grid_solved` and `shall_stop`.
   type, extends(solver_progress) :: log_progress
      type(run_log), pointer :: log => null()   !! the log that writes the progress lines
      integer :: load = 0, loads = 0   !! number of the load being solved; number of all loads
      integer :: solved = 0            !! number of loads that were solved
      real(dp) :: last = 0.0_dp        !! time at which the last of these was solved, since the start of the log [s]
   contains
      procedure :: grid_solved, shall_stop
   end type log_progress

contains

   !> Starts the log and its clock.
   subroutine start(self, quiet)
      class(run_log), intent(out) :: self
      logical, intent(in) :: quiet   !! whether to write nothing

      self%quiet = quiet
      self%notes = ''
      self%columns = terminal_columns()
      call system_clock(self%started, self%rate)
   end subroutine start

   !> Writes a line in place of the progress line, if there is one.
   subroutine say(self, line)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: line

      if (self%quiet) return
      ! Overwrite the progress line with blanks.
      if (self%shown > 0) call print_text(achar(13)//repeat(' ', self%shown)//achar(13)//c_null_char)
      self%shown = 0
      ! A closed or full standard output does not stop the run, whose results go to files: the program reports it when
      ! it ends.
      call say_line(line)
   end subroutine say

   !> Writes a note, something that the user should know, and keeps it in `notes`.
   subroutine note(self, words)
      class(run_log), intent(inout) :: self   !! after `start`
      character(*), intent(in) :: words       !! one line

      call self%say('note: '//words)
      if (index(newline//self%notes, newline//words//newline) == 0) self%notes = self%notes//words//newline
   end subroutine note

   !> Writes the time since the start in brackets, and a line behind it.
   subroutine say_timed(self, line)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: line

      character(24) :: time

      write (time, '(a, f9.3, a)') '[', self%elapsed(), ' s]'
      ! From 27.8 hours on nine characters do not hold the time.
      if (index(time, '*') > 0) write (time, '(a, i9, a)') '[', int(self%elapsed(), int64), ' s]'
      call self%say(trim(time)//' '//line)
   end subroutine say_timed

   !> Shows the grid that was solved last. The arguments are those of `solver_progress`.
   subroutine grid_solved(self, points, iterations, residual)
      class(log_progress), intent(in) :: self
      integer, intent(in) :: points(2), iterations
      real(dp), intent(in) :: residual

      if (self%log%is_due()) call self%log%say_progress(words_of_load(self)//': '//integer_text(points(1))//' x '// &
         integer_text(points(2))//' points, '//integer_text(iterations)//' iterations, residual '// &
         short_number(residual))
   end subroutine grid_solved

   !> Shows the iteration on a grid. The result is always .false.: the solver shall not stop.
   logical function shall_stop(self, iterations, residual)
      class(log_progress), intent(in) :: self
      integer, intent(in) :: iterations
      real(dp), intent(in) :: residual

      shall_stop = .false.
      if (self%log%is_due()) call self%log%say_progress(words_of_load(self)//': iteration '// &
         integer_text(iterations)//', residual '//short_number(residual))
   end function shall_stop

   !> The number of the load being solved, the time since the start and, from the second load on, an estimate of the
   !> time that is left: each remaining load takes the mean time of the loads before.
   function words_of_load(self) result(words)
      class(log_progress), intent(in) :: self
      character(:), allocatable :: words

      real(dp) :: now

      now = self%log%elapsed()
      words = 'load '//integer_text(self%load)//' of '//integer_text(self%loads)//', '//duration(now)
      if (self%solved == 0) return
      words = words//', some '//duration(max(0.0_dp, self%last/self%solved*(self%loads - self%load + 1) &
                                             - (now - self%last)))//' left'
   end function words_of_load

   !> A time in words: in seconds, from 100 s on in minutes.
   pure function duration(seconds) result(words)
      real(dp), intent(in) :: seconds   !! >= 0
      character(:), allocatable :: words

      words = integer_text(nint(seconds))//' s'
      if (seconds >= 100) words = integer_text(nint(seconds/60))//' min'
   end function duration

   !> Whether a progress line would be shown now: only on a terminal, and `progress_interval` after the last one.
   logical function is_due(self)
      class(run_log), intent(in) :: self

      is_due = .not. self%quiet .and. self%columns > 0
      if (is_due) is_due = self%elapsed() - self%last_progress >= progress_interval
   end function is_due

   !> Writes a progress line over the last one, if `is_due`. The line is cut to the width of the terminal.
   subroutine say_progress(self, words)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: words

      integer :: width

      if (.not. self%is_due()) return
      self%last_progress = self%elapsed()
      width = min(len(words), self%columns - 1)
      call print_text(achar(13)//words(:width)//repeat(' ', max(0, self%shown - width))//c_null_char)
      self%shown = width
   end subroutine say_progress

   !> Time since the start [s].
   real(dp) function elapsed(self)
      class(run_log), intent(in) :: self

      integer(int64) :: now

      call system_clock(now)
      elapsed = real(now - self%started, dp)/self%rate
   end function elapsed

end module wavycon_run_log
