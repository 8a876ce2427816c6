!> The kinds of surface that are one, two or three cosine waves: 'wave_1d', 'wave_2d', 'crossed_1d' and 'hexagonal'.
module wavycon_wave_kinds
   use wavycon_crossed_1d, only: crossed_1d
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_hexagonal, only: hexagonal
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_1d, only: wave_1d
   use wavycon_wave_2d, only: wave_2d
   implicit none (type, external)
   private

   public :: get_wave_kinds

   integer, parameter, public :: number_of_wave_kinds = 4

   !> The kinds that are waves of Johnson, Greenwood & Higginson (1985), eqs. (3) and (21), and their conditions.
   character(*), parameter, public :: paper_kinds(*) = ['wave_1d   ', 'wave_2d   ', 'crossed_1d'], &
      paper_waves = 'wave_1d, wave_2d with one wavelength, crossed_1d with equal waves'

contains

   subroutine get_wave_kinds(kinds)
      type(surface_kind), intent(out) :: kinds(number_of_wave_kinds)

      character(*), parameter :: mean_gap = &
         'mean gap before load, half the height from trough to crest; 0 is a flat surface.'
      integer :: i

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
      do i = 1, size(kinds)
         kinds(i)%make => make
      end do
   end subroutine get_wave_kinds

   !> An amplitude, 1 by default unless it is required.
   pure type(key_type) function amplitude_key(name, meaning, required) result(key)
      character(*), intent(in) :: name, meaning
      logical, intent(in), optional :: required

      key = real_key(name, '1.0', 'length', meaning, least=0.0_dp, required=required)
      if (key%required) key%default = ''
   end function amplitude_key

   !> A wavelength, 1 by default unless it is required.
   pure type(key_type) function wavelength_key(name, meaning, required) result(key)
      character(*), intent(in) :: name, meaning
      logical, intent(in), optional :: required

      key = real_key(name, '1.0', 'length', meaning, above=0.0_dp, required=required)
      if (key%required) key%default = ''
   end function wavelength_key

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

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
      end select
   end subroutine make

end module wavycon_wave_kinds
