!> kind = 'hexagonal': three equal waves.
module wavycon_hexagonal_kind
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_hexagonal, only: hexagonal
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_keys, only: amplitude_key, wavelength_key
   use wavycon_surface_kind, only: surface_kind
   implicit none (type, external)
   private

   public :: hexagonal_kind

contains

   type(surface_kind) function hexagonal_kind() result(kind)
      kind%name = 'hexagonal'
      kind%meaning = 'three equal waves at 60 degrees to each other'
      allocate (kind%keys, source=[ &
         amplitude_key('mean gap before load; 0 is a flat surface.'), &
         wavelength_key('wavelength of each of the three waves.')])
      kind%make => make
   end function hexagonal_kind

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = hexagonal(values%real('amplitude'), values%real('wavelength'))
   end subroutine make

end module wavycon_hexagonal_kind
