!> kind = 'wave_1d': the one-dimensional wave.
module wavycon_wave_1d_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_keys, only: amplitude_key, wavelength_key
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_1d, only: wave_1d
   implicit none (type, external)
   private

   public :: wave_1d_kind

contains

   type(surface_kind) function wave_1d_kind() result(kind)
      kind%name = 'wave_1d'
      kind%meaning = 'gap amplitude (1 - cos phi), phi = 2 pi x/wavelength'
      allocate (kind%keys, source=[ &
         amplitude_key('mean gap before load, half the height from trough to crest; 0 is a flat surface.'), &
         wavelength_key('wavelength along x.')])
      kind%paper_wave_if = 'wave_1d'
      kind%make => make
   end function wave_1d_kind

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = wave_1d(values%real('amplitude'), values%real('wavelength'))
   end subroutine make

end module wavycon_wave_1d_kind
