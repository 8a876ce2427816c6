!> The one-dimensional wave.
module wavycon_wave_1d
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_keys, only: amplitude_key, wavelength_key
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: wave_1d, wave_1d_kind

   type, extends(surface_kind) :: wave_1d_kind
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: make
      procedure, nopass :: paper_wave_if
   end type wave_1d_kind

contains

   !> h = Delta (1 - cos 2 pi x/lambda): Johnson, Greenwood & Higginson (1985), eq. (3).
   type(surface_type) function wave_1d(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! lambda [length], > 0

      surface = wave_sum([wavelength, wavelength], [amplitude], [1], [0], [0.0_dp])
   end function wave_1d

   function name() result(words)
      character(:), allocatable :: words

      words = 'wave_1d'
   end function name

   function meaning() result(words)
      character(:), allocatable :: words

      words = 'gap amplitude (1 - cos phi), phi = 2 pi x/wavelength'
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [ &
         amplitude_key('mean gap before load, half the height from trough to crest; 0 is a flat surface.'), &
         wavelength_key('wavelength along x.')]
   end function keys

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = wave_1d(values%real('amplitude'), values%real('wavelength'))
   end subroutine make

   function paper_wave_if() result(words)
      character(:), allocatable :: words

      words = 'wave_1d'
   end function paper_wave_if

end module wavycon_wave_1d
