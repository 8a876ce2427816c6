!> What the program says while it runs, on standard output.
module wavycon_run_log
   use, intrinsic :: iso_fortran_env, only: int64, output_unit
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_results, only: results_type
   use wavycon_system, only: stdout_is_terminal
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: run_log

   !> Seconds between two progress lines on a terminal.
   real(dp), parameter :: progress_interval = 0.2_dp

   type :: run_log
      private
      logical :: quiet = .false.
      logical :: terminal = .false.
      logical :: progress_shown = .false.
      integer(int64) :: started = 0, last_progress = 0, rate = 1
   contains
      procedure :: start
      procedure :: say
      procedure :: say_timed
      procedure :: show_scene
      procedure :: show_progress
      procedure :: show_loads
   end type run_log

contains

   subroutine start(self, quiet)
      class(run_log), intent(out) :: self
      logical, intent(in) :: quiet   !! say nothing

      self%quiet = quiet
      self%terminal = stdout_is_terminal()
      call system_clock(self%started, self%rate)
      self%last_progress = self%started
   end subroutine start

   subroutine say(self, line)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: line

      integer :: ignored

      if (self%quiet) return
      call clear_progress(self)
      ! A log that nobody can read is no reason to lose the results.
      write (output_unit, '(a)', iostat=ignored) line
   end subroutine say

   !> Says a line with the time since the start.
   subroutine say_timed(self, line)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: line

      character(24) :: time

      write (time, '(a, f9.3, a)') '[', elapsed(self), ' s] '
      call self%say(trim(time)//' '//line)
   end subroutine say_timed

   !> The input in effect.
   subroutine show_scene(self, results)
      class(run_log), intent(inout) :: self
      type(results_type), intent(in) :: results

      if (self%quiet) return
      associate (deck => results%deck, scene => results%scene)
         call self%say('wavycon '//version//' ('//revision//')')
         call self%say('deck      '//escaped(deck%path))
         if (deck%scene%title /= '') call self%say('title     '//escaped(trim(deck%scene%title)))
         call self%say('surface   '//trim(deck%surface%kind)//', Delta = '//short_number(scene%surface%amplitude)// &
                       ' [length], lambda = '//short_number(scene%surface%wavelength)//' [length]')
         call self%say('material  E* = '//short_number(scene%e_star)//' [pressure], p* = '// &
                       short_number(scene%p_star)//' [pressure]')
         call self%say('loads     '//integer_text(size(scene%pbar_over_pstar))//', pbar/p* from '// &
                       short_number(minval(scene%pbar_over_pstar))//' to '// &
                       short_number(maxval(scene%pbar_over_pstar)))
         call self%say('method    '//trim(deck%method%solver)//', '//results%contact%describe())
      end associate
   end subroutine show_scene

   !> A line that overwrites itself, on a terminal only and not too often.
   subroutine show_progress(self, done, all)
      class(run_log), intent(inout) :: self
      integer, intent(in) :: done, all   !! loads

      integer(int64) :: now
      character(60) :: line

      if (self%quiet .or. .not. self%terminal) return
      call system_clock(now)
      if (now - self%last_progress < progress_interval*self%rate) return
      self%last_progress = now
      write (line, '(a, i0, a, i0)') 'solved ', done, ' of ', all
      write (output_unit, '(3a)', advance='no') achar(13), trim(line), repeat(' ', len(line) - len_trim(line))
      flush (output_unit)
      self%progress_shown = .true.
   end subroutine show_progress

   !> A line a load.
   subroutine show_loads(self, results)
      class(run_log), intent(inout) :: self
      type(results_type), intent(in) :: results

      character(160) :: line
      integer :: i

      if (self%quiet) return
      write (line, '(5a12, 2a8, a9, 2x, a)') 'pbar/p*', 'pbar', 'gap/Delta', 'area/A0', 'peak/p*', 'active', 'pivots', &
         'kkt', 'status'
      call self%say(trim(line))
      do i = 1, size(results%states)
         associate (state => results%states(i), measures => results%states(i)%measures)
            write (line, '(5a, 2i8, es9.1, 2x, a)') &
               cell(state%pbar_over_pstar), cell(results%scene%mean_pressure(i)), &
               cell(measures%mean_gap_over_amplitude), cell(measures%contact_area_fraction), &
               cell(measures%peak_pressure_over_pstar), state%active_constraints, state%pivots, &
               state%kkt_residual, trim(state%status)
            call self%say(trim(line))
         end associate
      end do
   end subroutine show_loads

   !> A number in a column of 12: with six decimals where that shows enough of it and fits, else with an exponent.
   character(12) function cell(number)
      real(dp), intent(in) :: number

      real(dp), parameter :: least = 1.0e-3_dp, most = 1.0e4_dp

      if ((abs(number) >= least .and. abs(number) < most) .or. .not. abs(number) > 0) then
         write (cell, '(f12.6)') number
      else
         write (cell, '(es12.4)') number
      end if
   end function cell

   subroutine clear_progress(self)
      class(run_log), intent(inout) :: self

      if (.not. self%progress_shown) return
      write (output_unit, '(3a)', advance='no') achar(13), repeat(' ', 60), achar(13)
      self%progress_shown = .false.
   end subroutine clear_progress

   real(dp) function elapsed(self)
      class(run_log), intent(in) :: self

      integer(int64) :: now

      call system_clock(now)
      elapsed = real(now - self%started, dp)/self%rate
   end function elapsed

end module wavycon_run_log
