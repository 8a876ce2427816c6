!> kind = 'self_affine': a random rough surface, made from its spectrum.
module wavycon_self_affine_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_key, integer_key, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: most_points
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_self_affine, only: self_affine_surface
   use wavycon_self_affine_heights, only: has_waves, least_points_of, self_affine_spectrum
   use wavycon_surface, only: surface_type
   use wavycon_surface_kind, only: check_radii, form_radius_keys, length_x_key, length_y_key, radii_of, surface_kind
   implicit none (type, external)
   private

   public :: self_affine_kind

   !> Most points along a side that a deck without `points` gets.
   integer, parameter :: most_default_points = 8192
   integer, parameter :: least_points = 4

contains

   type(surface_kind) function self_affine_kind() result(kind)
      kind%name = 'self_affine'
      kind%meaning = 'a random rough surface, made from its spectrum'
      allocate (kind%keys, source=[ &
         length_x_key(), length_y_key(), &
         real_key('hurst', '0.8', '-', 'Hurst exponent of the roughness.', least=0.0_dp, most=1.0_dp), &
         real_key('rms_height', '', 'length', 'root mean square of the height; or give rms_slope.', &
                  above=0.0_dp, way=10, required=.true.), &
         real_key('rms_slope', '', '-', 'root mean square of the slope, the size of the gradient; or give '// &
                  'rms_height.', above=0.0_dp, way=11), &
         real_key('spectral_density', '', 'length^4', 'in place of rms_height or rms_slope: the spectral density '// &
                  'of waves longer than rolloff_wavelength, as &output spectrum has it; of a profile in length^3.', &
                  above=0.0_dp, way=12), &
         real_key('long_wavelength', 'the longer side of the cell', 'length', 'longest wave, the long cut-off.', &
                  above=0.0_dp), &
         real_key('rolloff_wavelength', 'long_wavelength', 'length', &
                  'the spectrum of the heights is flat for longer waves and self-affine for shorter ones.', &
                  above=0.0_dp), &
         real_key('short_wavelength', '', 'length', 'shortest wave, the short cut-off; without it '// &
                  'rolloff_wavelength/64.', above=0.0_dp), &
         choice_key('spectrum', "'ideal'", &
            "amplitudes of the waves: 'ideal', those of the spectrum; 'random', those of a Gaussian process with "// &
            'this spectrum. Phases are random.', [character(6) :: 'ideal', 'random']), &
         integer_key('seed', '1', 'of the random numbers. The surface depends on the seed and on the keys above, '// &
                     'not on points.', 1, huge(1)), &
         integer_key('points', 'as kind says', &
                     'points of the cell along x and y on which the surface is made, and solved unless &method '// &
                     'says otherwise; one number for both, and 1 along y for a profile. The default is the least '// &
                     'power of two with at least four points to short_wavelength, if that is not more than 8192.', &
                     1, most_points, most_values=2), &
         choice_key('edges', "'periodic'", "how the surface continues beyond its borders: 'periodic'; 'free', not "// &
                    'at all: it is pressed on a half-space.', &
                    [character(8) :: 'periodic', 'mirror', 'window', 'free']), &
         form_radius_keys('the surface')])
      kind%make => make
      kind%check => check
   end function self_affine_kind

   !> Sets the defaults that depend on other keys.
   subroutine set_defaults(values)
      type(group_values), intent(inout) :: values

      real(dp) :: length(2)
      integer :: points(2)

      points = 0
      if (values%has('points') .and. .not. values%is_bad('points')) points = nint(values%pair('points'))
      length = values%real('length_x')
      ! Without length_y points are as far apart along y as along x.
      if (points(2) > 1) length(2) = length(1)*points(2)/points(1)
      call values%set_default('length_y', length(2:))
      length(2) = values%real('length_y')
      call values%set_default('long_wavelength', [merge(length(1), maxval(length), points(2) == 1)])
      call values%set_default('rolloff_wavelength', values%reals('long_wavelength'))
      call values%set_default('short_wavelength', values%reals('rolloff_wavelength')/64)
      if (points(1) == 0) points = default_points(length/values%real('short_wavelength'))
      if (.not. values%is_bad('points')) call values%set('points', real(points, dp))
   end subroutine set_defaults

   !> The least power of two with four points to the shortest wave.
   elemental integer function default_points(waves) result(points)
      real(dp), intent(in) :: waves   !! of the shortest wavelength along a side

      points = least_points
      do while (points < 4*waves .and. points < most_default_points)
         points = 2*points
      end do
   end function default_points

   !> Reports cut-offs out of order, too few points, and cut-offs between which the cell has no wave.
   subroutine check(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      type(self_affine_spectrum) :: spectrum
      integer :: before

      call set_defaults(values)
      if (all(values%text('edges') /= ['periodic', 'free    '])) call values%complain(problems, 'edges', &
         "a random surface is made periodic: edges must be 'periodic' or 'free'")
      call check_radii(values, problems, 'form_radius')
      if (values%any_bad()) return
      before = problems%number
      spectrum = spectrum_of(values)
      call check_order('long_wavelength', spectrum%longest, &
                       'the longest side of the cell', maxval(spectrum%length(:spectrum%dimension)))
      call check_order('rolloff_wavelength', spectrum%rolloff, 'long_wavelength', spectrum%longest)
      call check_order('short_wavelength', spectrum%shortest, 'rolloff_wavelength', spectrum%rolloff)
      call check_points(values, spectrum, problems)
      if (problems%number > before) return
      if (.not. has_waves(spectrum)) call values%complain(problems, 'short_wavelength', &
         'nothing varies: no wave of the cell has a length from short_wavelength = '// &
         short_number(spectrum%shortest)//' to long_wavelength = '//short_number(spectrum%longest))

   contains

      !> Reports a length that is longer than another one.
      subroutine check_order(key, length, most_words, most)
         character(*), intent(in) :: key, most_words
         real(dp), intent(in) :: length, most

         if (length > most) call values%complain(problems, key, key//' = '//short_number(length)// &
                                                 ' must not be longer than '//most_words//', '//short_number(most))
      end subroutine check_order

   end subroutine check

   !> Reports numbers of points that are too small, by themselves or for the shortest wave.
   subroutine check_points(values, spectrum, problems)
      type(group_values), intent(in) :: values
      type(self_affine_spectrum), intent(in) :: spectrum
      type(problem_list_type), intent(inout) :: problems

      !> Factor for a wave longer than two steps, within the digits of a message.
      real(dp), parameter :: longer = 1.001_dp
      character(:), allocatable :: advice
      integer :: least(2), points(2)

      points = values%integers('points')
      if (points(1) < least_points .or. (points(2) < least_points .and. spectrum%dimension == 2)) then
         call values%complain(problems, 'points', 'there must be at least '//integer_text(least_points)// &
                              ' points along each side, or 1 along y for a profile')
         return
      end if
      least = least_points_of(spectrum)
      if (all(points >= least)) return
      if (any(least > most_points)) then
         call values%complain(problems, 'short_wavelength', 'short_wavelength = '// &
            short_number(spectrum%shortest)//' needs '//grid_words(least)//' points, and more than '// &
            integer_text(most_points)//' a side are not possible: give a longer one or a smaller cell')
      else
         advice = ', and accurate contact areas twice as many each way or more'
         if (all(points >= least - 1)) advice = advice//'. Waves of exactly two steps have no phase on the points: '// &
            'short_wavelength = '//short_number(longer*spectrum%shortest)//' leaves them out'
         call values%complain(problems, 'points', grid_words(points)//' points are too few for short_wavelength = '// &
            short_number(spectrum%shortest)//': it needs '//grid_words(least)//advice)
      end if
   end subroutine check_points

   !> "2 x 3", as for the sides of a grid.
   pure function grid_words(points) result(words)
      integer, intent(in) :: points(2)
      character(:), allocatable :: words

      words = integer_text(points(1))//' x '//integer_text(points(2))
   end function grid_words

   !> The spectrum that the keys describe.
   pure function spectrum_of(values) result(spectrum)
      type(group_values), intent(in) :: values
      type(self_affine_spectrum) :: spectrum

      integer :: points(2)

      points = values%integers('points')
      spectrum%dimension = merge(1, 2, points(2) == 1)
      spectrum%length = [values%real('length_x'), values%real('length_y')]
      spectrum%hurst = values%real('hurst')
      spectrum%longest = values%real('long_wavelength')
      spectrum%rolloff = values%real('rolloff_wavelength')
      spectrum%shortest = values%real('short_wavelength')
      spectrum%by_slope = values%has('rms_slope')
      spectrum%rms = merge(values%real('rms_slope'), values%real('rms_height'), spectrum%by_slope)
      if (values%has('spectral_density')) spectrum%density = values%real('spectral_density')
      spectrum%random_amplitudes = values%text('spectrum') == 'random'
      spectrum%seed = values%integer('seed')
   end function spectrum_of

   !> Errors: as of self_affine_surface.
   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      call self_affine_surface(escaped(values%deck_path)//": kind = 'self_affine'", spectrum_of(values), &
                               values%integers('points'), surface, map, error, values%text('edges') == 'free', &
                               radii_of(values, 'form_radius'))
      if (.not. allocated(error)) map%changes%edges = values%text('edges')
   end subroutine make

end module wavycon_self_affine_kind
