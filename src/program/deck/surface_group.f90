!> The &surface group: the gap between the bodies.
module wavycon_surface_group
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_formula_kinds, only: check_sum, formula_surface
   use wavycon_height_map_kind, only: surface_of_file, surface_of_heights
   use wavycon_key_group, only: key_list, key_value
   use wavycon_key_table, only: choice_value, integer_value, key_type, logical_value, real_value, text_value
   use wavycon_kinds, only: dp, largest_number, smallest_number
   use wavycon_map_statistics, only: map_statistics
   use wavycon_map_tuning, only: usual_window_width
   use wavycon_measured_map, only: most_points
   use wavycon_plain_text, only: escaped, short_number
   use wavycon_scene_groups, only: surface_group
   use wavycon_self_affine_kind, only: check_self_affine, self_affine_of
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_sides, check_surface_group, list_surface_keys, make_surface

   !> Most bytes of a file's path; most waves of a sum, and most periods of such a wave in the cell.
   integer, parameter :: longest_path = 1000, most_waves = 1000, highest_wave = 128

   !> Largest ratio of the sides of a cell. The number of iterations on a grid grows as the square root of the longer
   !> side over the shortest step. Up to this ratio waves, sums of waves and random maps of up to 128 x 128 points were
   !> all solved, with at most 1700 iterations for a load. At ten times this ratio some maps were not solved.
   real(dp), parameter :: largest_ratio = 1000.0_dp

contains

   !> The keys of &surface.
   subroutine list_surface_keys(values, keys)
      type(surface_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      character(*), parameter :: trends = 'none mean plane quadratic lines'
      character(*), parameter :: on_a_ball = "a ball that the map or the surface lies on, with edges = 'free'."

      keys = key_list('surface', 'which waves or heights the bodies carry', values%key_group, required=.true., &
                      selector='kind')
      call keys%add(values%kind, key_type(choice_value, 'kind', '', '', &
         "'wave_1d': gap amplitude (1 - cos(2 pi x/wavelength)). 'wave_2d': gap amplitude (1 - cos(2 pi "// &
         "x/wavelength) cos(2 pi y/wavelength_y)). 'crossed_1d': a wave on each of two blocks. 'hexagonal': "// &
         'three equal waves, along y and at 60 degrees to it, whose crests lie in rows along x, in a cell of '// &
         "2/sqrt(3) wavelength by 2 wavelength. 'sum': any waves. 'file': a height map. 'self_affine': "// &
         "a random rough surface, made from its spectrum. 'ball': a ball on a half-space, not repeated.", &
         choices='wave_1d wave_2d crossed_1d hexagonal sum file self_affine ball', required=.true.))
      keys%of = 'wave_1d wave_2d hexagonal'
      call keys%add(values%amplitude, key_type(real_value, 'amplitude', '1.0', 'length', &
         'mean gap before load, of wave_1d and wave_2d half the height from trough to crest; 0 is a flat '// &
         'surface.', least=0))
      call keys%add(values%wavelength, key_type(real_value, 'wavelength', '1.0', 'length', &
         'wavelength along x, of hexagonal that of each wave.', above=0))
      keys%of = 'wave_2d'
      call keys%add(values%wavelength_y, key_type(real_value, 'wavelength_y', 'wavelength', 'length', &
         'wavelength along y.', above=0))
      keys%of = 'crossed_1d'
      call keys%add(values%amplitude1, key_type(real_value, 'amplitude1', '', 'length', &
         'amplitude of the wave along x, on the first block.', least=0, required=.true.))
      call keys%add(values%wavelength1, key_type(real_value, 'wavelength1', '', 'length', &
         'wavelength along x.', above=0, required=.true.))
      call keys%add(values%amplitude2, key_type(real_value, 'amplitude2', '', 'length', &
         'amplitude of the wave along y, on the second block.', least=0, required=.true.))
      call keys%add(values%wavelength2, key_type(real_value, 'wavelength2', '', 'length', &
         'wavelength along y.', above=0, required=.true.))
      keys%of = 'sum file self_affine ball'
      call keys%add(values%length_x, key_type(real_value, 'length_x', '1.0', 'length', &
         "side of the cell along x; a ball's are by default four half axes of the contact under the largest load, "// &
         'and it stands in the middle.', above=0))
      call keys%add(values%length_y, key_type(real_value, 'length_y', 'length_x', 'length', &
         'side of the cell along y; without it points of a file are equally far apart along x and y.', &
         above=0))
      keys%of = 'sum'
      call keys%add(values%amplitudes, key_type(real_value, 'amplitudes', '', 'length', &
         'the height is the sum of amplitudes cos(2 pi (waves_x x/length_x + waves_y y/length_y) - phases).', &
         most_values=most_waves, required=.true.))
      call keys%add(values%waves_x, key_type(integer_value, 'waves_x', '', '', &
         'number of periods of each wave in the cell along x; may be negative.', -highest_wave, highest_wave, &
         most_values=most_waves, required=.true.))
      call keys%add(values%waves_y, key_type(integer_value, 'waves_y', '0', '', &
         'number of periods of each wave in the cell along y. If all are 0 the surface is a profile.', &
         -highest_wave, highest_wave, most_values=most_waves))
      call keys%add(values%phases, key_type(real_value, 'phases', '0', 'degree', &
         'phase of each wave.', -360, 360, most_values=most_waves))
      keys%of = 'file'
      call keys%add(values%file, key_type(text_value, 'file', '', '', &
         'a periodic map of heights, upwards to the other body; looked for beside the deck, then where the '// &
         "program is started. The last row and column are the cell's last, not copies of the first.", &
         longest=longest_path, required=.true.))
      call keys%add(values%file2, key_type(text_value, 'file2', '', '', &
         'a second map, of the other body, upwards to the first one: points and sides are those of the first. The '// &
         'surface has the sum of both heights. The keys below prepare each map by itself.', longest=longest_path))
      call keys%add(values%file2_scale, key_type(real_value, 'file2_scale', 'height_scale', 'length', &
         "length of one unit of file2's heights, a factor if the file has units; default 1 if only one of both "// &
         'files has units.', above=0, needs='file2'))
      call keys%add(values%file2_flip, key_type(logical_value, 'file2_flip', '.true.', '', &
         'whether the second map is turned over about the y axis, as its body is when it is laid on the first: '// &
         'the last point along x becomes the first.', needs='file2'))
      call keys%add(values%file2_missing_value, key_type(real_value, 'file2_missing_value', 'missing_value', '-', &
         'missing_value of the second map.', needs='file2'))
      call keys%add(values%file2_detrend, key_type(choice_value, 'file2_detrend', 'detrend', '', &
         'what is subtracted from the second map, as detrend does from the first.', choices=trends, needs='file2'))
      call keys%add(values%file_format, key_type(choice_value, 'file_format', "'auto'", '', &
         "'matrix', a row of heights for each y; 'xyz', lines of x, y, z on a regular grid; 'xz', lines of x "// &
         "and z of a profile; 'npy' of numpy; 'gsf' of Gwyddion; 'auto', what the file looks like, xyz if "// &
         'all lines have three numbers, xz if all have two. xyz and xz give the sides of the cell, gsf and '// &
         'heads of texts also units: leave out length_x and length_y.', choices='auto matrix xyz xz npy gsf'))
      call keys%add(values%missing_value, key_type(real_value, 'missing_value', '', '-', &
         'heights of the file that have this value are missing, as are nan and empty fields between commas, '// &
         'semicolons or tabs.'))
      call keys%add(values%height_scale, key_type(real_value, 'height_scale', '1.0', 'length', &
         "length of one unit of the file's heights; a factor if the file has units.", above=0))
      call keys%add(values%crop_missing, key_type(logical_value, 'crop_missing', '.false.', '', &
         'whether rows and columns at the borders in which all heights are missing are cut off. The sides of '// &
         'the cell are those of the whole file.'))
      call keys%add(values%despike, key_type(logical_value, 'despike', '.false.', '', &
         'whether spikes, heights far from all around them, become the median of their neighbours.'))
      call keys%add(values%detrend, key_type(choice_value, 'detrend', "'none'", '', &
         "what is subtracted first, fitted to the heights that are there by least squares: 'mean', 'plane' "// &
         "or 'quadratic', a polynomial of the second degree; 'lines', from each row along x its median.", &
         choices=trends))
      call keys%add(values%fill_missing, key_type(choice_value, 'fill_missing', "'none'", '', &
         "heights that are missing: 'none', they are an error; 'harmonic', filled after detrend by the "// &
         "smooth surface of Laplace's equation.", choices='none harmonic'))
      keys%of = 'file self_affine'
      call keys%add(values%edges, key_type(choice_value, 'edges', "'periodic'", '', &
         "how the surface continues beyond its borders: 'periodic', its last points are neighbours of its first; "// &
         "'free', not at all: it is pressed on a half-space; of file also 'mirror', by its mirror images; "// &
         "'window', periodic after a taper to the mean at the borders.", choices='periodic mirror window free'))
      keys%of = 'file'
      call keys%add(values%window_width, key_type(real_value, 'window_width', short_number(usual_window_width), '-', &
         "with edges = 'window': width of the taper at each border, over the side.", above=0, most=0.5_dp, &
         needs="edges='window'"))
      keys%of = 'file self_affine'
      call keys%add(values%short_wavelength, key_type(real_value, 'short_wavelength', '', 'length', &
         'shortest wave; without it all waves of a file stay, and the short cut-off of self_affine is '// &
         'rolloff_wavelength/64.', above=0))
      call keys%add(values%long_wavelength, key_type(real_value, 'long_wavelength', 'as kind says', 'length', &
         'longest wave, the long cut-off; without it all waves of a file stay, and that of self_affine is the '// &
         'longer side of the cell.', above=0))
      keys%of = 'file'
      call keys%add(values%filter, key_type(choice_value, 'filter', "'sharp'", '', &
         "how short_wavelength and long_wavelength cut off: 'sharp', waves beyond them are left out; 'gaussian', "// &
         'by the filters of ISO 16610-61, which let half of a wave of this length pass.', choices='sharp gaussian'))
      keys%of = 'file self_affine'
      call keys%add(values%form_radius, key_type(real_value, 'form_radius', '', 'length', &
         'radius of '//on_a_ball, above=0, way=300, needs="edges='free'"))
      call keys%add(values%form_radius_x, key_type(real_value, 'form_radius_x', '', 'length', &
         'radius of curvature along x of '//on_a_ball, above=0, way=301, needs="form_radius_y edges='free'"))
      call keys%add(values%form_radius_y, key_type(real_value, 'form_radius_y', '', 'length', &
         'radius of curvature along y.', above=0, way=301, needs="form_radius_x edges='free'"))
      keys%of = 'self_affine'
      call keys%add(values%hurst, key_type(real_value, 'hurst', '0.8', '-', 'Hurst exponent of the roughness.', 0, 1))
      call keys%add(values%anisotropy, key_type(real_value, 'anisotropy', '1.0', '-', &
         'correlation length along x over that along y. The spectrum, with its wavelengths, is that of the '// &
         'isotropic surface, which is stretched by the root of this ratio along x and compressed by it along y.', &
         0.01_dp, 100.0_dp))
      call keys%add(values%rms_height, key_type(real_value, 'rms_height', '', 'length', &
         'root mean square of the height; or give rms_slope.', above=0, way=100, required=.true.))
      call keys%add(values%rms_slope, key_type(real_value, 'rms_slope', '', '-', &
         'root mean square of the slope, the size of the gradient; or give rms_height.', above=0, way=101))
      call keys%add(values%spectral_density, key_type(real_value, 'spectral_density', '', 'length^4', &
         'in place of rms_height or rms_slope: the spectral density of waves longer than rolloff_wavelength, '// &
         'as &output spectrum has it; of a profile in length^3.', above=0, way=102))
      call keys%add(values%rolloff_wavelength, key_type(real_value, 'rolloff_wavelength', 'long_wavelength', 'length', &
         'the spectrum of the heights is flat for longer waves and self-affine for shorter ones.', above=0))
      call keys%add(values%spectrum, key_type(choice_value, 'spectrum', "'ideal'", '', &
         "amplitudes of the waves: 'ideal', those of the spectrum; 'random', those of a Gaussian process "// &
         'with this spectrum. Phases are random.', choices='ideal random'))
      call keys%add(values%seed, key_type(integer_value, 'seed', '1', '', &
         'of the random numbers. The surface depends on the seed and on the keys above, not on points.', 1, huge(1)))
      keys%of = 'self_affine ball'
      call keys%add(values%points, key_type(integer_value, 'points', 'as kind says', '', &
         'points of the cell along x and y on which the surface is made, and solved unless &method says '// &
         'otherwise; one number for both, and 1 along y for a profile. The default of self_affine is the least '// &
         'power of two with at least four points to short_wavelength, if that is not more than 8192; without '// &
         'points of a ball grids are refined to the accuracy of &method.', 1, most_points, most_values=2))
      keys%of = 'ball'
      call keys%add(values%radius, key_type(real_value, 'radius', '', 'length', &
         'radius of the ball.', above=0, way=200, required=.true.))
      call keys%add(values%radius_x, key_type(real_value, 'radius_x', '', 'length', &
         'radius of curvature along x of the ball.', above=0, way=201, needs='radius_y'))
      call keys%add(values%radius_y, key_type(real_value, 'radius_y', '', 'length', &
         'radius of curvature along y.', above=0, way=201, needs='radius_x'))
   end subroutine list_surface_keys

   !> Checks the keys against the kind of surface and sets the defaults that depend on the kind.
   subroutine check_surface_group(values)
      type(surface_group), intent(inout) :: values

      select case (values%kind%text)
      case ('file')
         if (values%file2%is_given) then
            call values%file2_scale%set_default([values%height_scale%number])
            call values%file2_detrend%set_default(text=values%detrend%text)
            if (values%missing_value%is_given) &
               call values%file2_missing_value%set_default([values%missing_value%number])
         end if
         if (values%file2%is_given .and. values%crop_missing%is_true) call values%complain(values%crop_missing, &
            'crop_missing is for one map: borders cut off one of two maps would displace it against the other')
         values%filter%in_effect = values%short_wavelength%is_given .or. values%long_wavelength%is_given
         if (values%filter%is_given .and. .not. values%filter%in_effect) &
            call values%complain(values%filter, 'filter needs short_wavelength or long_wavelength beside it')
         if (values%short_wavelength%is_given .and. values%long_wavelength%is_given .and. &
             values%short_wavelength%number >= values%long_wavelength%number) call values%complain( &
            values%long_wavelength, 'long_wavelength must be above short_wavelength')
      case ('sum')
         call check_sum(values)
      case ('self_affine')
         call check_self_affine(values)
      case ('ball')
         if (values%length_y%is_given .and. .not. values%length_x%is_given) &
            call values%complain(values%length_y, 'length_y needs length_x beside it')
      end select
      call check_radii(values%radius_x, values%radius_y, 'radius')
      call check_radii(values%form_radius_x, values%form_radius_y, 'form_radius')

   contains

      !> Reports two radii of curvature whose ratio is too large.
      subroutine check_radii(x, y, name)
         type(key_value), intent(in) :: x, y
         character(*), intent(in) :: name   !! name of both keys, without '_x' and '_y'

         real(dp), parameter :: largest_ratio = 1e4_dp

         associate (radii => [x%number, y%number])
            if (minval(radii) > 0.0_dp .and. maxval(radii) > largest_ratio*minval(radii)) call values%complain(x, &
               name//'_x and '//name//'_y must be within a factor of '//short_number(largest_ratio)// &
               '; for a roller give a profile')
         end associate
      end subroutine check_radii

   end subroutine check_surface_group

   !> Reports a cell whose sides have so large a ratio that loads would take too many iterations. The report names the
   !> keys, or the file, that give the sides.
   subroutine check_sides(values, surface)
      type(surface_group), intent(inout) :: values      !! values from which the surface was made
      type(surface_type), intent(in) :: surface

      character(:), allocatable :: keys
      integer :: position
      real(dp) :: side(2)

      if (surface%dimension == 1) return
      side = surface%sides()
      if (maxval(side) <= largest_ratio*minval(side)) return
      position = values%kind%position
      keys = 'both sides'
      if (values%file%is_given) then
         position = values%file%position
         keys = 'the sides in '//escaped(values%file%text)
      end if
      call name_sides(values%length_x, values%length_y, 'length_x and length_y')
      call name_sides(values%wavelength, values%wavelength_y, 'wavelength and wavelength_y')
      call name_sides(values%wavelength1, values%wavelength2, 'wavelength1 and wavelength2')
      call values%problems%add(max(position, values%position), &
         'the cell is '//short_number(side(1))//' x '//short_number(side(2))// &
         ', one side '//short_number(maxval(side)/minval(side))//' times the other; at most '// &
         short_number(largest_ratio)//' times is allowed. Are '//keys//' in one unit?')

   contains

      !> Sets `keys` and `position` to two keys, if at least one of them is in effect.
      subroutine name_sides(x, y, names)
         type(key_value), intent(in) :: x, y
         character(*), intent(in) :: names

         if (.not. (x%in_effect .or. y%in_effect)) return
         keys = names
         position = x%position
         if (y%is_given) position = y%position
      end subroutine name_sides

   end subroutine check_sides

   !> Makes the surface. Errors: exit_file_trouble for a height map that cannot be read; exit_bad_input for a bad height
   !> map, and for `heights` beside a kind that is not 'file'.
   subroutine make_surface(values, surface, map, two_maps, error, heights)
      !> The values of the keys, without problems. Keys that have no effect because the file gives the same are marked,
      !> so that the resolved deck does not show them.
      type(surface_group), intent(inout) :: values
      type(surface_type), allocatable, intent(out) :: surface   !! not allocated in case of an error
      type(map_statistics), allocatable, intent(out) :: map     !! allocated for a height map
      type(map_statistics), allocatable, intent(out) :: two_maps(:)   !! allocated for two maps, whose sum `map` is
      type(error_type), allocatable, intent(out) :: error
      !> Heights in place of those of the file, as in surface_of_heights.
      real(dp), intent(in), optional :: heights(:, :)

      if (values%kind%text == '') return
      allocate (surface)
      if (present(heights)) then
         call surface_of_heights(values, heights, surface, map, error)
      else
         select case (values%kind%text)
         case ('file')
            call surface_of_file(values, surface, map, two_maps, error)
         case ('self_affine')
            call self_affine_of(values, surface, map, error)
         case default
            surface = formula_surface(values)
         end select
      end if
      if (.not. allocated(error) .and. surface%has_free_edges .and. surface%amplitude > 0.0_dp .and. &
          (surface%amplitude < smallest_number .or. surface%amplitude > largest_number)) &
         call fatal_error(error, exit_bad_input, escaped(values%deck_path)//': the mean gap before load is '// &
                          short_number(surface%amplitude)//' [length]: lengths may be from '// &
                          short_number(smallest_number)//' to '//short_number(largest_number))
      if (allocated(error)) deallocate (surface)
   end subroutine make_surface

end module wavycon_surface_group
