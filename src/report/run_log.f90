!> The log of a run on standard output.
module wavycon_run_log
   use, intrinsic :: iso_fortran_env, only: int64, output_unit
   use wavycon_kinds, only: dp
   use wavycon_log_columns, only: log_line
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_preparation_words, only: preparation_words
   use wavycon_result_lines, only: line_of_load, line_of_stress
   use wavycon_results, only: results_type
   use wavycon_scene, only: scene_type, target_words
   use wavycon_surface, only: surface_type
   use wavycon_solver_progress, only: solver_progress
   use wavycon_system, only: terminal_columns
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: duration, log_progress, run_log

   !> Seconds between two progress lines on a terminal.
   real(dp), parameter :: progress_interval = 0.2_dp

   type :: run_log
      private
      logical :: quiet = .false.
      integer :: columns = 0          !! of the terminal; 0: there is none
      integer :: shown = 0            !! of them by the progress line
      integer(int64) :: started = 0, last_progress = 0, rate = 1
   contains
      procedure :: start
      procedure :: say
      procedure :: say_timed
      procedure :: show_scene
      procedure :: say_progress
      procedure :: is_due
      procedure :: show_loads
      procedure :: show_stresses
      procedure :: elapsed
   end type run_log

   !> Shows the grids of a load as progress lines.
   type, extends(solver_progress) :: log_progress
      type(run_log), pointer :: log => null()
      integer :: load = 0, loads = 0   !! number of the load being solved; number of all loads
      integer :: solved = 0            !! loads that were solved
      real(dp) :: last = 0.0_dp        !! when the last of them was, since the start of the log [s]
   contains
      procedure :: grid_solved
      procedure :: shall_stop
   end type log_progress

contains

   !> Starts the log and its clock.
   subroutine start(self, quiet)
      class(run_log), intent(out) :: self
      logical, intent(in) :: quiet   !! whether to write nothing

      self%quiet = quiet
      self%columns = terminal_columns()
      call system_clock(self%started, self%rate)
      self%last_progress = self%started
   end subroutine start

   !> Writes a line.
   subroutine say(self, line)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: line

      integer :: ignored

      if (self%quiet) return
      call clear_progress(self)
      ! A closed or full standard output must not stop the run: the results go to files.
      write (output_unit, '(a)', iostat=ignored) line
   end subroutine say

   !> Writes a line after the time since the start.
   subroutine say_timed(self, line)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: line

      character(24) :: time

      write (time, '(a, f9.3, a)') '[', self%elapsed(), ' s] '
      call self%say(trim(time)//' '//line)
   end subroutine say_timed

   !> Writes the input in effect: deck, surface, material, loads and method.
   subroutine show_scene(self, results)
      class(run_log), intent(inout) :: self
      type(results_type), intent(in) :: results

      character(:), allocatable :: words
      real(dp), allocatable :: loads(:)

      if (self%quiet) return
      associate (scene => results%scene, surface => results%solver%surface)
         call self%say('wavycon '//version//' ('//revision//')')
         call self%say('deck      '//escaped(scene%deck_path))
         if (scene%title /= '') call self%say('title     '//escaped(scene%title))
         call self%say('surface   '//scene%surface_kind//', Delta = '// &
                       short_number(surface%amplitude)//' ['//scene%length_unit//'], cell '// &
                       cell_of(surface)//' ['//scene%length_unit//']')
         if (allocated(scene%map)) call show_map(self, scene, scene%map, surface%amplitude > 0.0_dp)
         call show_unlikely_slopes(self, scene)
         call self%say('material  '//material_words(scene, surface))
         loads = scene%target
         words = target_words(scene%loads_by)
         if (surface%has_free_edges .and. allocated(scene%mean_pressure)) then
            loads = surface%nominal_area()*scene%mean_pressure
            words = 'force'
         end if
         call self%say('loads     '//integer_text(size(scene%target))//', '//words// &
                       ' from '//short_number(minval(loads))//' to '//short_number(maxval(loads)))
         call self%say('method    '//results%method)
         if (results%sharing%words() /= '') call self%say('ranks     '//results%sharing%words())
      end associate
   end subroutine show_scene

   !> Writes the statistics of a height map, what was done to it, and what is suspicious of it.
   subroutine show_map(self, scene, map, is_rough)
      class(run_log), intent(inout) :: self
      type(scene_type), intent(in) :: scene
      type(map_statistics), intent(in) :: map   !! of the scene
      logical, intent(in) :: is_rough           !! or flat

      character(:), allocatable :: words

      call self%say('map       '//integer_text(map%points(1))//' x '//integer_text(map%points(2))//' points ('// &
                    trim(map%format)//'), heights over their mean '//short_number(map%lowest)//' to '// &
                    short_number(map%highest)//', rms '//short_number(map%rms)//' ['//scene%length_unit//']')
      if (map%assumed_sides /= '') call self%say('sides     '//map%assumed_sides)
      if (is_rough) call self%say('roughness '//roughness_words(scene))
      words = preparation_words(map%changes, scene%length_unit)
      if (words /= '') call self%say('prepared  '//words)
      if (map%lacks_missing_value) call self%say('note: no height of the file has the missing_value of the deck')
      if (map%spikes > 0) call self%say('note: '//integer_text(map%spikes)//' of the heights are far from all '// &
         'around them (kurtosis '//short_number(map%kurtosis)//'): spikes of an instrument carry load that the '// &
         'surface does not. Remedy: despike = .true.')
      call show_broken_borders(self, map, scene%length_unit)
      ! A broken border is a step between two points.
      if (.not. any(map%is_broken_along([1, 2]))) call show_unresolved_slopes(self, scene%roughness%slope, map)
   end subroutine show_map

   !> Slope and curvature, in brackets by differences, and the form of the distribution of heights.
   pure function roughness_words(scene) result(words)
      type(scene_type), intent(in) :: scene   !! of a height map
      character(:), allocatable :: words

      associate (roughness => scene%roughness, map => scene%map)
         words = 'rms slope '//short_number(roughness%slope)//' (by differences '// &
                 short_number(map%slope_by_differences)//'), rms curvature '// &
                 short_number(roughness%curvature)//' ('//short_number(map%curvature_by_differences)// &
                 ') [1/'//scene%length_unit//'], skewness '//short_number(map%skewness)//', kurtosis '// &
                 short_number(map%kurtosis)
      end associate
   end function roughness_words

   !> Modulus, p* and, if there is one, hardness.
   pure function material_words(scene, surface) result(words)
      type(scene_type), intent(in) :: scene
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      words = 'E* = '//short_number(scene%e_star)//' ['//scene%pressure_unit//']'
      if (.not. surface%has_free_edges) &
         words = words//', p* = '//short_number(scene%p_star)//' ['//scene%pressure_unit//']'
      if (surface%has_hardness()) words = words//', hardness = '// &
         short_number(surface%hardness*scene%p_star)//' ['//scene%pressure_unit//']'
   end function material_words

   !> Warns of a map whose opposite borders do not fit together.
   subroutine show_broken_borders(self, map, length_unit)
      class(run_log), intent(inout) :: self
      type(map_statistics), intent(in) :: map
      character(*), intent(in) :: length_unit

      character(:), allocatable :: remedies
      integer :: direction

      remedies = "edges = 'mirror', edges = 'window'"
      if (map%changes%detrend /= 'plane' .and. map%changes%detrend /= 'quadratic') &
         remedies = "detrend = 'plane', "//remedies
      do direction = 1, 2
         if (map%is_broken_along(direction)) call self%say('note: along '//'xy'(direction:direction)// &
            ' the last heights differ from the first by '//short_number(map%border_step(direction))//' ['// &
            length_unit//'] (rms), neighbours inside by at most '//short_number(map%largest_step(direction))// &
            '; such steps carry load. Remedies: '//remedies)
      end do
   end subroutine show_broken_borders

   !> Warns of a map whose slopes are between neighbouring points rather than in waves of many.
   subroutine show_unresolved_slopes(self, rms_slope, map)
      class(run_log), intent(inout) :: self
      real(dp), intent(in) :: rms_slope            !! of the series
      type(map_statistics), intent(in) :: map

      !> Least slope by differences over that of the series. Noise that lowers it to 0.9 takes a quarter or more of the
      !> contact area at light loads: see the table of src/map/README.md.
      real(dp), parameter :: least = 0.9_dp

      if (map%slope_by_differences >= least*rms_slope) return
      call self%say('note: the rms slope is '//short_number(rms_slope)//', by differences of neighbours only '// &
                    short_number(map%slope_by_differences)// &
                    ': much of it is in waves of two or three points. If these are noise, smooth the map: '// &
                    'they make contact areas smaller')
   end subroutine show_unresolved_slopes

   !> Warns of a surface that is too steep for the theory, if the deck has units, and of one that is all but flat: most
   !> likely by a mistake of units.
   subroutine show_unlikely_slopes(self, scene)
      class(run_log), intent(inout) :: self
      type(scene_type), intent(in) :: scene

      !> The theory of small slopes is off by the order of their square, here a tenth.
      real(dp), parameter :: steepest = 0.3_dp
      !> Heights in m beside sides in um make slopes of 1e-4 (polished silicon) to 10 a million times smaller.
      real(dp), parameter :: flattest = 1e-5_dp
      character(:), allocatable :: borders, cause, verdict
      logical :: is_flat

      is_flat = scene%roughness%slope > 0.0_dp .and. scene%roughness%slope < flattest
      if (.not. (is_flat .or. (scene%has_units .and. scene%roughness%slope > steepest))) return
      verdict = '; the theory needs small ones.'
      if (is_flat) verdict = '; those of real surfaces are larger.'
      borders = ''
      cause = 'Are amplitudes and wavelengths in one unit?'
      if (allocated(scene%map)) then
         if (scene%map%path /= '') cause = 'Do height_scale, and the sides of the cell, suit the units of the file?'
         if (any(scene%map%is_broken_along([1, 2]))) borders = ', with the steps across its borders'
      end if
      call self%say('note: the slopes of the surface are '//short_number(scene%roughness%slope)//' (rms)'//borders// &
                    verdict//' '//cause)
   end subroutine show_unlikely_slopes

   !> The sides of the cell, or of a mirrored map, such as "2 x 3".
   pure function cell_of(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      real(dp) :: side(2)

      side = surface%sides()
      words = short_number(side(1))
      if (surface%dimension == 2) words = words//' x '//short_number(side(2))
   end function cell_of

   !> Shows the grid that was solved last, as of `solver_progress`.
   subroutine grid_solved(self, points, iterations, residual)
      class(log_progress), intent(in) :: self
      integer, intent(in) :: points(2), iterations
      real(dp), intent(in) :: residual

      if (self%log%is_due()) call self%log%say_progress(words_of_load(self)//': '//integer_text(points(1))//' x '// &
         integer_text(points(2))//' points, '//integer_text(iterations)//' iterations, residual '// &
         short_number(residual))
   end subroutine grid_solved

   !> Shows the iteration on a grid; never stops it.
   logical function shall_stop(self, iterations, residual)
      class(log_progress), intent(in) :: self
      integer, intent(in) :: iterations
      real(dp), intent(in) :: residual

      shall_stop = .false.
      if (self%log%is_due()) call self%log%say_progress(words_of_load(self)//': iteration '// &
         integer_text(iterations)//', residual '//short_number(residual))
   end function shall_stop

   !> The load being solved, the time since the start and, from the second load on, what is left if the others take as
   !> long as those before.
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

   !> A time in words, in seconds or minutes.
   pure function duration(seconds) result(words)
      real(dp), intent(in) :: seconds
      character(:), allocatable :: words

      words = integer_text(nint(seconds))//' s'
      if (seconds >= 100) words = integer_text(nint(seconds/60))//' min'
   end function duration

   !> Whether a progress line would be shown: only on a terminal and at most every progress_interval.
   logical function is_due(self)
      class(run_log), intent(in) :: self

      integer(int64) :: now

      is_due = .false.
      if (self%quiet .or. self%columns == 0) return
      call system_clock(now)
      is_due = now - self%last_progress >= progress_interval*self%rate
   end function is_due

   !> Writes a progress line over the last one if it is due, cut to the width of the terminal.
   subroutine say_progress(self, words)
      class(run_log), intent(inout) :: self
      character(*), intent(in) :: words

      integer :: width

      if (.not. self%is_due()) return
      call system_clock(self%last_progress)
      width = min(len(words), self%columns - 1)
      write (output_unit, '(3a)', advance='no') achar(13), words(:width), repeat(' ', max(0, self%shown - width))
      flush (output_unit)
      self%shown = width
   end subroutine say_progress

   !> Writes a table with a line for each load.
   subroutine show_loads(self, results)
      class(run_log), intent(inout) :: self
      type(results_type), intent(in) :: results

      type(log_line) :: line
      integer :: load

      if (self%quiet) return
      do load = 1, size(results%loads)
         call line_of_load(results, load, line)
         if (load == 1) call self%say(line%names)
         call self%say(line%words)
      end do
   end subroutine show_loads

   !> Writes the largest stresses, with a line for each load and body.
   subroutine show_stresses(self, results)
      class(run_log), intent(inout) :: self
      type(results_type), intent(in) :: results   !! with the largest stresses

      type(log_line) :: line
      integer :: body, load

      if (self%quiet) return
      do load = 1, size(results%loads)
         do body = 1, size(results%von_mises, 1)
            call line_of_stress(results, load, body, line)
            if (load == 1 .and. body == 1) call self%say(line%names)
            call self%say(line%words)
         end do
      end do
   end subroutine show_stresses

   !> Overwrites the progress line with blanks.
   subroutine clear_progress(self)
      class(run_log), intent(inout) :: self

      if (self%shown == 0) return
      write (output_unit, '(3a)', advance='no') achar(13), repeat(' ', self%shown), achar(13)
      self%shown = 0
   end subroutine clear_progress

   !> Time since the start [s].
   real(dp) function elapsed(self)
      class(run_log), intent(in) :: self

      integer(int64) :: now

      call system_clock(now)
      elapsed = real(now - self%started, dp)/self%rate
   end function elapsed

end module wavycon_run_log
