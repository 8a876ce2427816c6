!> Three equal waves whose directions differ by 60 degrees.
module wavycon_hexagonal
   use wavycon_constants, only: sqrt3
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

   public :: hexagonal, hexagonal_kind

   type, extends(surface_kind) :: hexagonal_kind
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: make
   end type hexagonal_kind

contains

   !> Three equal waves whose directions differ by 60 degrees: h = Delta [1 - (cos k1.r + cos k2.r + cos k3.r)/3] with
   !> wave vectors k1, k2, k3 = k2 - k1 of length 2 pi/lambda. The crests form rows along x with a distance of 2
   !> lambda/sqrt3 in each; the rectangular cell has two crests.
   type(surface_type) function hexagonal(amplitude, wavelength) result(surface)
      real(dp), intent(in) :: amplitude    !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength   !! of each wave [length], > 0

      surface = wave_sum([2/sqrt3, 2.0_dp]*wavelength, spread(amplitude/3, 1, 3), [0, 1, 1], [2, 1, -1], &
                         spread(0.0_dp, 1, 3))
   end function hexagonal

   function name() result(words)
      character(:), allocatable :: words

      words = 'hexagonal'
   end function name

   function meaning() result(words)
      character(:), allocatable :: words

      words = 'three equal waves at 60 degrees to each other'
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [ &
         amplitude_key('mean gap before load; 0 is a flat surface.'), &
         wavelength_key('wavelength of each of the three waves.')]
   end function keys

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = hexagonal(values%real('amplitude'), values%real('wavelength'))
   end subroutine make

end module wavycon_hexagonal
