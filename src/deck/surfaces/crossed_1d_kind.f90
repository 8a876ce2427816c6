!> kind = 'crossed_1d': two blocks with a wave each.
module wavycon_crossed_1d_kind
   use wavycon_crossed_1d, only: crossed_1d
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_kind, only: surface_kind
   implicit none (type, external)
   private

   public :: crossed_1d_kind

contains

   type(surface_kind) function crossed_1d_kind() result(kind)
      kind%name = 'crossed_1d'
      kind%meaning = 'a wave on each of two blocks'
      allocate (kind%keys, source=[ &
         real_key('amplitude1', '', 'length', 'amplitude of the wave along x, on the first block.', least=0.0_dp, &
                  required=.true.), &
         real_key('wavelength1', '', 'length', 'wavelength along x.', above=0.0_dp, required=.true.), &
         real_key('amplitude2', '', 'length', 'amplitude of the wave along y, on the second block.', least=0.0_dp, &
                  required=.true.), &
         real_key('wavelength2', '', 'length', 'wavelength along y.', above=0.0_dp, required=.true.)])
      kind%paper_wave_if = 'crossed_1d with equal waves'
      kind%make => make
   end function crossed_1d_kind

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = crossed_1d(values%real('amplitude1'), values%real('wavelength1'), &
                           values%real('amplitude2'), values%real('wavelength2'))
   end subroutine make

end module wavycon_crossed_1d_kind
