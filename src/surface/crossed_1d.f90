!> Two blocks with a one-dimensional wave each, crossed at right angles.
module wavycon_crossed_1d
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: crossed_1d, crossed_1d_kind

   type, extends(surface_kind) :: crossed_1d_kind
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: make
      procedure, nopass :: advice
      procedure, nopass :: paper_wave_if
   end type crossed_1d_kind

contains

   !> Two blocks with a one-dimensional wave each, crossed at right angles: h = a_1 (1 - cos 2 pi x/lambda_1) + a_2 (1
   !> - cos 2 pi y/lambda_2). With equal amplitudes a and equal wavelengths it is eq. (21) turned by 45 degrees, with
   !> Delta = 2a and sqrt2 times the wavelength.
   type(surface_type) function crossed_1d(amplitude1, wavelength1, amplitude2, wavelength2) result(surface)
      real(dp), intent(in) :: amplitude1, wavelength1   !! along x [length], >= 0, > 0
      real(dp), intent(in) :: amplitude2, wavelength2   !! along y [length], >= 0, > 0

      surface = wave_sum([wavelength1, wavelength2], [amplitude1, amplitude2], [1, 0], [0, 1], [0.0_dp, 0.0_dp])
   end function crossed_1d

   function name() result(words)
      character(:), allocatable :: words

      words = 'crossed_1d'
   end function name

   function meaning() result(words)
      character(:), allocatable :: words

      words = 'a wave on each of two blocks'
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [ &
         real_key('amplitude1', '', 'length', 'amplitude of the wave along x, on the first block.', least=0.0_dp, &
                  required=.true.), &
         real_key('wavelength1', '', 'length', 'wavelength along x.', above=0.0_dp, required=.true.), &
         real_key('amplitude2', '', 'length', 'amplitude of the wave along y, on the second block.', least=0.0_dp, &
                  required=.true.), &
         real_key('wavelength2', '', 'length', 'wavelength along y.', above=0.0_dp, required=.true.)]
   end function keys

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = crossed_1d(values%real('amplitude1'), values%real('wavelength1'), &
                           values%real('amplitude2'), values%real('wavelength2'))
   end subroutine make

   function advice(key) result(words)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      words = ''
      if (any(key == [character(10) :: 'amplitude', 'wavelength'])) words = ': give '//key//'1 and '//key//'2'
   end function advice

   function paper_wave_if() result(words)
      character(:), allocatable :: words

      words = 'crossed_1d with equal waves'
   end function paper_wave_if

end module wavycon_crossed_1d
