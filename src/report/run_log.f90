!> What the program says while it runs, on standard output.
module wavycon_run_log
   use, intrinsic :: iso_fortran_env, only: int64, output_unit
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped
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

      if (self%quiet) return
      call clear_progress(self)
      write (output_unit, '(a)') line
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

      character(160) :: line

      if (self%quiet) return
      associate (deck => results%deck, scene => results%scene)
         call self%say('wavycon '//version//' ('//revision//')')
         call self%say('deck      '//escaped(deck%path))
         if (deck%scene%title /= '') call self%say('title     '//escaped(trim(deck%scene%title)))
         write (line, '(2a, 2(a, g0.6))') 'surface   ', trim(deck%surface%kind), ', Delta [length] = ', &
            scene%surface%amplitude, ', lambda [length] = ', scene%surface%wavelength
         call self%say(trim(line))
         write (line, '(2(a, g0.6))') 'material  E* [pressure] = ', scene%e_star, ', p* [pressure] = ', scene%p_star
         call self%say(trim(line))
         write (line, '(a, i0, 2(a, g0.6))') 'loads     ', size(scene%pbar_over_pstar), ', pbar/p* from ', &
            minval(scene%pbar_over_pstar), ' to ', maxval(scene%pbar_over_pstar)
         call self%say(trim(line))
         write (line, '(3a, i0, a, i0, a, i0, a)') 'method    ', trim(deck%method%solver), ', ', deck%method%harmonics, &
            ' harmonics (', results%contact%terms%count(), ' unknowns), ', size(results%contact%problem%bounds), &
            ' constraint points'
         call self%say(trim(line))
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
      call self%say('     pbar/p*      pbar       gap/Delta    area/A0   peak/p*   active  pivots  kkt      status')
      do i = 1, size(results%states)
         associate (state => results%states(i), measures => results%measures(i))
            write (line, '(f12.6, es12.4, f13.8, f10.6, f10.6, 2i8, es9.1, 2x, a)') state%pbar_over_pstar, &
               results%scene%mean_pressure(i), measures%mean_gap_over_amplitude, measures%contact_area_fraction, &
               measures%peak_pressure_over_pstar, state%active_constraints, state%pivots, state%kkt_residual, &
               trim(state%status)
            call self%say(trim(line))
         end associate
      end do
   end subroutine show_loads

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
