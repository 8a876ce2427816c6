!> Surfaces of the public interface, made from arguments. All checks, and their messages, are those of the keys of
!> &surface.
module wavycon_wavy_surface
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_deck_text, only: deck_text_type
   use wavycon_group_text, only: read_group_text
   use wavycon_group_values, only: group_values
   use wavycon_height_map, only: surface_of_map
   use wavycon_height_map_kind, only: preparation_of
   use wavycon_map_size, only: check_map_size, check_room
   use wavycon_key_table, only: key_index
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: exact_number
   use wavycon_problem_report, only: problem_report
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_group, only: check_sides, check_surface_group, make_surface, surface_table
   implicit none (type, external)
   private

   public :: wavy_surface, make_wave_1d, make_wave_2d, make_hexagonal, make_crossed_1d, make_wave_sum, make_heights, &
      make_surface_of_keys
   public :: copy_surface, number_words

   !> A periodic surface. Before it is made all its numbers are 0.
   type :: wavy_surface
      private
      type(surface_type), allocatable :: surface
      character(:), allocatable :: kind          !! as decks name it
      character(:), allocatable :: trouble       !! why it could not be made
   contains
      procedure :: is_made
      procedure :: dimension => get_dimension
      procedure :: amplitude => get_amplitude
      procedure :: lengths
      procedure :: points
   end type wavy_surface

contains

   !> Whether the surface has been made.
   pure logical function is_made(self)
      class(wavy_surface), intent(in) :: self

      is_made = allocated(self%surface)
   end function is_made

   !> 1 for a profile, 2 for any other surface.
   pure integer function get_dimension(self)
      class(wavy_surface), intent(in) :: self

      get_dimension = 0
      if (self%is_made()) get_dimension = self%surface%dimension
   end function get_dimension

   !> Delta, the mean gap before load [length]; of wave_1d and wave_2d the amplitude.
   pure real(dp) function get_amplitude(self)
      class(wavy_surface), intent(in) :: self

      get_amplitude = 0.0_dp
      if (self%is_made()) get_amplitude = self%surface%amplitude
   end function get_amplitude

   !> L_x, L_y, the sides of the periodic cell, of a mirrored map those of the map [length]. A profile uses the first
   !> alone.
   pure function lengths(self)
      class(wavy_surface), intent(in) :: self
      real(dp) :: lengths(2)

      lengths = 0.0_dp
      if (self%is_made()) lengths = self%surface%sides()
   end function lengths

   !> The points of a height map along x and y; zeros for any other surface.
   pure function points(self)
      class(wavy_surface), intent(in) :: self
      integer :: points(2)

      points = 0
      if (self%is_made()) points = self%surface%points/self%surface%parts()
   end function points

   !> The one-dimensional wave, gap = amplitude (1 - cos(2 pi x/wavelength)). Errors, here and below: exit_bad_input.
   subroutine make_wave_1d(amplitude, wavelength, surface, error)
      real(dp), intent(in) :: amplitude    !! >= 0 [length]
      real(dp), intent(in) :: wavelength   !! > 0 [length]
      type(wavy_surface), intent(out) :: surface
      type(error_type), allocatable, intent(out) :: error

      call make_surface_of_keys("kind = 'wave_1d'"//pair('amplitude', [amplitude])//pair('wavelength', [wavelength]), &
                                surface, error)
   end subroutine make_wave_1d

   !> The two-dimensional wave, gap = amplitude [1 - cos(2 pi x/wavelength) cos(2 pi y/wavelength_y)].
   subroutine make_wave_2d(amplitude, wavelength, wavelength_y, surface, error)
      real(dp), intent(in) :: amplitude                !! >= 0 [length]
      real(dp), intent(in) :: wavelength               !! > 0 [length]
      real(dp), intent(in), optional :: wavelength_y   !! > 0 [length]; that along x if absent
      type(wavy_surface), intent(out) :: surface
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: keys

      keys = "kind = 'wave_2d'"//pair('amplitude', [amplitude])//pair('wavelength', [wavelength])
      if (present(wavelength_y)) keys = keys//pair('wavelength_y', [wavelength_y])
      call make_surface_of_keys(keys, surface, error)
   end subroutine make_wave_2d

   !> Three equal waves at 60 degrees to each other.
   subroutine make_hexagonal(amplitude, wavelength, surface, error)
      real(dp), intent(in) :: amplitude    !! the mean gap before load, >= 0 [length]
      real(dp), intent(in) :: wavelength   !! of each wave, > 0 [length]
      type(wavy_surface), intent(out) :: surface
      type(error_type), allocatable, intent(out) :: error

      call make_surface_of_keys("kind = 'hexagonal'"//pair('amplitude', [amplitude])// &
                                pair('wavelength', [wavelength]), surface, error)
   end subroutine make_hexagonal

   !> Two blocks with a wave each, crossed at right angles.
   subroutine make_crossed_1d(amplitude1, wavelength1, amplitude2, wavelength2, surface, error)
      real(dp), intent(in) :: amplitude1, wavelength1   !! of the wave along x, >= 0, > 0 [length]
      real(dp), intent(in) :: amplitude2, wavelength2   !! of the wave along y, >= 0, > 0 [length]
      type(wavy_surface), intent(out) :: surface
      type(error_type), allocatable, intent(out) :: error

      call make_surface_of_keys("kind = 'crossed_1d'"// &
                                pair('amplitude1', [amplitude1])//pair('wavelength1', [wavelength1])// &
                                pair('amplitude2', [amplitude2])//pair('wavelength2', [wavelength2]), surface, error)
   end subroutine make_crossed_1d

   !> The height sum_q amplitudes(q) cos(2 pi (waves_x(q) x/length_x + waves_y(q) y/length_y) - phases(q)).
   subroutine make_wave_sum(amplitudes, waves_x, waves_y, phases, length_x, length_y, surface, error)
      real(dp), intent(in) :: amplitudes(:)              !! at least one [length]
      integer, intent(in) :: waves_x(:), waves_y(:)      !! periods in the cell, one a wave; all waves_y 0: a profile
      real(dp), intent(in) :: phases(:)                  !! one a wave [degree]
      real(dp), intent(in) :: length_x, length_y         !! sides of the periodic cell, > 0 [length]
      type(wavy_surface), intent(out) :: surface
      type(error_type), allocatable, intent(out) :: error

      call make_surface_of_keys("kind = 'sum'"//pair('amplitudes', amplitudes)//pair('waves_x', real(waves_x, dp))// &
                                pair('waves_y', real(waves_y, dp))//pair('phases', phases)// &
                                pair('length_x', [length_x])//pair('length_y', [length_y]), surface, error)
   end subroutine make_wave_sum

   !> A map of heights, periodic unless the keys say otherwise. The mean height does not matter. Errors also:
   !> exit_file_trouble without memory.
   subroutine make_heights(heights, length_x, length_y, surface, error, keys)
      !> Upwards to the other body [length], NaN where they are missing; x first, one column: a profile.
      real(dp), intent(in) :: heights(:, :)
      real(dp), intent(in) :: length_x, length_y   !! sides of the map, > 0 [length]
      type(wavy_surface), intent(out) :: surface
      type(error_type), allocatable, intent(out) :: error
      !> Of &surface: how the map is prepared, such as "detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror'".
      character(*), intent(in), optional :: keys

      character(*), parameter :: source = 'heights'
      type(group_values) :: values
      type(map_statistics), allocatable :: statistics
      type(measured_map) :: map

      call check_map_size(source, shape(heights), error)
      if (.not. allocated(error)) call check_room(source, shape(heights), error)
      if (.not. allocated(error)) call read_map_keys(length_x, length_y, keys, values, error)
      if (.not. allocated(error)) then
         map%missing = ieee_is_nan(heights)
         if (any(map%missing)) then
            allocate (map%height, source=merge(0.0_dp, heights, map%missing))
         else
            deallocate (map%missing)
            allocate (map%height, source=heights)
         end if
         allocate (surface%surface)
         call surface_of_map(source, preparation_of(values), values%real('height_scale'), [length_x, length_y], map, &
                             surface%surface, statistics, error)
      end if
      surface%kind = 'file'
      if (.not. allocated(error)) return
      if (allocated(surface%surface)) deallocate (surface%surface)
      surface%trouble = error%message
   end subroutine make_heights

   !> Reads the keys of a map in memory. Errors: exit_bad_input for sides out of range, for keys that only files have,
   !> and with all problems of the others.
   subroutine read_map_keys(length_x, length_y, keys, values, error)
      real(dp), intent(in) :: length_x, length_y
      character(*), intent(in), optional :: keys
      type(group_values), intent(out) :: values
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: of_files(*) = [character(13) :: &
         'file_format', 'missing_value', 'length_x', 'length_y']
      character(*), parameter :: of_all = "kind = 'file', file = 'heights', "
      type(deck_text_type) :: text
      type(problem_list_type) :: problems
      type(wavy_surface) :: cell
      integer :: i

      ! The sides are checked as those of a surface that has nothing else.
      call make_surface_of_keys("kind = 'sum', amplitudes = 0, waves_x = 1"//pair('length_x', [length_x])// &
                                pair('length_y', [length_y]), cell, error)
      if (allocated(error)) return
      if (present(keys)) then
         call read_group_text(surface_table(), of_all//keys, values, text, problems)
      else
         call read_group_text(surface_table(), of_all, values, text, problems)
      end if
      do i = 1, size(of_files)
         if (key_index(values%table%keys, of_files(i)) == 0) cycle
         if (values%has(of_files(i))) call values%complain(problems, of_files(i), &
            trim(of_files(i))//' is not for heights in memory')
      end do
      call check_surface_group(values, problems)
      if (problems%number > 0) call fatal_error(error, exit_bad_input, problem_report(problems, text))
   end subroutine read_map_keys

   !> Any surface that a deck can describe. Errors: exit_bad_input, with all problems of the keys; exit_file_trouble for
   !> a height map that cannot be read.
   subroutine make_surface_of_keys(keys, surface, error)
      character(*), intent(in) :: keys    !! of &surface, such as "kind = 'wave_1d', amplitude = 2"
      type(wavy_surface), intent(out) :: surface
      type(error_type), allocatable, intent(out) :: error

      type(deck_text_type) :: text
      type(group_values) :: values
      type(map_statistics), allocatable :: map
      type(problem_list_type) :: problems

      call read_group_text(surface_table(), keys, values, text, problems)
      call check_surface_group(values, problems)
      if (problems%number == 0) call make_surface(values, surface%surface, map, error)
      if (allocated(surface%surface)) call check_sides(values, surface%surface, problems)
      if (problems%number > 0) call fatal_error(error, exit_bad_input, problem_report(problems, text))
      if (allocated(error) .and. allocated(surface%surface)) deallocate (surface%surface)
      surface%kind = values%text('kind')
      if (allocated(error)) surface%trouble = error%message
   end subroutine make_surface_of_keys

   !> A copy of the internal surface and its kind, for the solver. Errors: exit_bad_input if it has not been made, with
   !> the reason.
   subroutine copy_surface(from, surface, kind, error)
      type(wavy_surface), intent(in) :: from
      type(surface_type), allocatable, intent(out) :: surface
      character(:), allocatable, intent(out) :: kind
      type(error_type), allocatable, intent(out) :: error

      if (from%is_made()) then
         surface = from%surface
         kind = from%kind
      else if (allocated(from%trouble)) then
         call fatal_error(error, exit_bad_input, from%trouble)
      else
         call fatal_error(error, exit_bad_input, 'the surface has not been made')
      end if
   end subroutine copy_surface

   !> ', key = numbers' as in a deck, the numbers to all digits.
   function pair(key, numbers)
      character(*), intent(in) :: key
      real(dp), intent(in) :: numbers(:)
      character(:), allocatable :: pair

      integer :: i

      pair = ', '//key//' ='
      do i = 1, size(numbers)
         pair = pair//' '//number_words(numbers(i))
      end do
   end function pair

   !> A number to all digits; 'NaN', of which a deck's reader makes a good message, if it is none.
   function number_words(number) result(words)
      real(dp), intent(in) :: number
      character(:), allocatable :: words

      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      words = 'NaN'
      if (.not. ieee_is_nan(number)) words = exact_number(number)
   end function number_words

end module wavycon_wavy_surface
