!> kind = 'wave_2d': the two-dimensional wave.
module wavycon_wave_2d_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_keys, only: amplitude_key, wavelength_key
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_2d, only: wave_2d
   implicit none (type, external)
   private

   public :: wave_2d_kind

contains

   type(surface_kind) function wave_2d_kind() result(kind)
      kind%name = 'wave_2d'
      kind%meaning = 'amplitude (1 - cos phi cos theta), theta = 2 pi y/wavelength_y'
      allocate (kind%keys, source=[ &
         amplitude_key('mean gap before load, half the height from trough to crest; 0 is a flat surface.'), &
         wavelength_key('wavelength along x.'), &
         real_key('wavelength_y', 'wavelength', 'length', 'wavelength along y.', above=0.0_dp)])
      kind%paper_wave_if = 'wave_2d with one wavelength'
      kind%make => make
      kind%set_defaults => set_defaults
   end function wave_2d_kind

   subroutine set_defaults(values)
      type(group_values), intent(inout) :: values

      call values%set_default('wavelength_y', values%real('wavelength'))
   end subroutine set_defaults

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = wave_2d(values%real('amplitude'), values%real('wavelength'), values%real('wavelength_y'))
   end subroutine make

end module wavycon_wave_2d_kind
