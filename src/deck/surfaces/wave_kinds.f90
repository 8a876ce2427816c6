!> The kinds of surface that are cosine waves: 'wave_1d', 'wave_2d', 'crossed_1d' and 'hexagonal' of one, two or three,
!> and 'sum' of any.
module wavycon_wave_kinds
   use wavycon_constants, only: pi
   use wavycon_group_values, only: group_values
   use wavycon_key_relations, only: alternative_type
   use wavycon_key_table, only: integer_key, key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_keys, only: length_x_key, length_y_key
   use wavycon_wave_surfaces, only: crossed_1d, hexagonal, wave_1d, wave_2d, wave_sum
   implicit none (type, external)
   private

   public :: get_wave_kinds, check_sum, wave_surface

   integer, parameter, public :: number_of_wave_kinds = 5
   integer, parameter :: most_waves = 1000, highest_wave = 128

   !> The kinds that are waves of Johnson, Greenwood & Higginson (1985), eqs. (3) and (21), and their conditions.
   character(*), parameter, public :: paper_kinds(*) = ['wave_1d   ', 'wave_2d   ', 'crossed_1d'], &
      paper_waves = 'wave_1d, wave_2d with one wavelength, crossed_1d with equal waves'

contains

   subroutine get_wave_kinds(kinds)
      type(alternative_type), intent(out) :: kinds(number_of_wave_kinds)

      character(*), parameter :: mean_gap = &
         'mean gap before load, half the height from trough to crest; 0 is a flat surface.'

      kinds(1)%name = 'wave_1d'
      kinds(1)%meaning = 'gap amplitude (1 - cos phi), phi = 2 pi x/wavelength'
      kinds(1)%keys = [amplitude_key('amplitude', mean_gap), wavelength_key('wavelength', 'wavelength along x.')]

      kinds(2)%name = 'wave_2d'
      kinds(2)%meaning = 'amplitude (1 - cos phi cos theta), theta = 2 pi y/wavelength_y'
      kinds(2)%keys = [amplitude_key('amplitude', mean_gap), wavelength_key('wavelength', 'wavelength along x.'), &
                       real_key('wavelength_y', 'wavelength', 'length', 'wavelength along y.', above=0.0_dp)]

      kinds(3)%name = 'crossed_1d'
      kinds(3)%meaning = 'a wave on each of two blocks'
      kinds(3)%keys = [ &
         amplitude_key('amplitude1', 'amplitude of the wave along x, on the first block.', required=.true.), &
         wavelength_key('wavelength1', 'wavelength along x.', required=.true.), &
         amplitude_key('amplitude2', 'amplitude of the wave along y, on the second block.', required=.true.), &
         wavelength_key('wavelength2', 'wavelength along y.', required=.true.)]

      kinds(4)%name = 'hexagonal'
      kinds(4)%meaning = 'three equal waves at 60 degrees to each other'
      kinds(4)%keys = [amplitude_key('amplitude', 'mean gap before load; 0 is a flat surface.'), &
                       wavelength_key('wavelength', 'wavelength of each of the three waves.')]

      kinds(5)%name = 'sum'
      kinds(5)%meaning = 'any waves'
      allocate (kinds(5)%keys, source=[ &
         length_x_key(), length_y_key(), &
         real_key('amplitudes', '', 'length', &
            'the height is the sum of amplitudes cos(2 pi (waves_x x/length_x + waves_y y/length_y) - phases).', &
            most_values=most_waves, required=.true.), &
         integer_key('waves_x', '', 'number of periods of each wave in the cell along x; may be negative.', &
            -highest_wave, highest_wave, most_values=most_waves, required=.true.), &
         integer_key('waves_y', '0', &
            'number of periods of each wave in the cell along y. If all are 0 the surface is a profile.', &
            -highest_wave, highest_wave, most_values=most_waves), &
         real_key('phases', '0', 'degree', 'phase of each wave.', least=-360.0_dp, most=360.0_dp, &
            most_values=most_waves)])
   end subroutine get_wave_kinds

   !> An amplitude, 1 by default unless it is required.
   pure type(key_type) function amplitude_key(name, meaning, required) result(key)
      character(*), intent(in) :: name, meaning
      logical, intent(in), optional :: required

      key = real_key(name, '1.0', 'length', meaning, least=0.0_dp, required=required)
      if (key%required) key%default = ''
   end function amplitude_key

   !> A wavelength: as an amplitude, but not 0.
   pure type(key_type) function wavelength_key(name, meaning, required) result(key)
      character(*), intent(in) :: name, meaning
      logical, intent(in), optional :: required

      key = amplitude_key(name, meaning, required)
      key%above = .true.
   end function wavelength_key

   !> Sets the defaults of 'sum', and reports lists of unlike lengths and waves without wave numbers.
   subroutine check_sum(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      character(7), parameter :: lists(3) = [character(7) :: 'waves_x', 'waves_y', 'phases']
      character(:), allocatable :: key
      integer :: i, number
      integer, allocatable :: m(:), n(:)

      call values%set_default('length_y', values%reals('length_x'))
      call values%set_default('waves_y', 0*values%reals('waves_x'))
      call values%set_default('phases', 0*values%reals('amplitudes'))
      if (values%any_bad()) return
      number = size(values%reals('amplitudes'))
      do i = 1, size(lists)
         key = trim(lists(i))
         if (values%has(key) .and. size(values%reals(key)) /= number) call values%complain(problems, key, &
            key//' has '//integer_text(size(values%reals(key)))//' values and amplitudes '//integer_text(number)// &
            ': give one for each wave')
      end do
      m = nint(values%reals('waves_x'))
      n = nint(values%reals('waves_y'))
      if (size(m) /= size(n)) return
      i = findloc(m == 0 .and. n == 0, .true., dim=1)
      if (i > 0) call values%complain(problems, 'waves_x', 'wave '//integer_text(i)// &
         ' has waves_x = 0 and waves_y = 0: it is a height and no wave; leave it out')
   end subroutine check_sum

   !> The surface of a kind of this module.
   function wave_surface(values) result(surface)
      type(group_values), intent(inout) :: values   !! of &surface, without problems
      type(surface_type) :: surface

      select case (values%text('kind'))
      case ('wave_1d')
         surface = wave_1d(values%real('amplitude'), values%real('wavelength'))
      case ('wave_2d')
         call values%set_default('wavelength_y', values%reals('wavelength'))
         surface = wave_2d(values%real('amplitude'), values%real('wavelength'), values%real('wavelength_y'))
      case ('crossed_1d')
         surface = crossed_1d(values%real('amplitude1'), values%real('wavelength1'), values%real('amplitude2'), &
                              values%real('wavelength2'))
      case ('hexagonal')
         surface = hexagonal(values%real('amplitude'), values%real('wavelength'))
      case ('sum')
         surface = wave_sum([values%real('length_x'), values%real('length_y')], values%reals('amplitudes'), &
                            nint(values%reals('waves_x')), nint(values%reals('waves_y')), values%reals('phases')*pi/180)
      end select
   end function wave_surface

end module wavycon_wave_kinds
