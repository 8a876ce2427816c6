!> The two-dimensional wave, with a wavelength of its own along y.
module wavycon_wave_2d
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_surface, only: surface_type
   use wavycon_surface_keys, only: amplitude_key, wavelength_key
   use wavycon_surface_kind, only: surface_kind
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: wave_2d, wave_2d_kind

   type, extends(surface_kind) :: wave_2d_kind
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: make
      procedure, nopass :: set_defaults
      procedure, nopass :: paper_wave_if
   end type wave_2d_kind

contains

   !> h = Delta [1 - cos(2 pi x/lambda_x) cos(2 pi y/lambda_y)]: eq. (21) with a wavelength of its own each way.
   type(surface_type) function wave_2d(amplitude, wavelength, wavelength_y) result(surface)
      real(dp), intent(in) :: amplitude                !! Delta [length], >= 0
      real(dp), intent(in) :: wavelength               !! along x [length], > 0
      real(dp), intent(in), optional :: wavelength_y   !! along y [length], > 0; that along x if absent

      real(dp) :: length(2)

      length = wavelength
      if (present(wavelength_y)) length(2) = wavelength_y
      surface = wave_sum(length, 0.5_dp*[amplitude, amplitude], [1, 1], [1, -1], &
                         [0.0_dp, 0.0_dp])
   end function wave_2d

   function name() result(words)
      character(:), allocatable :: words

      words = 'wave_2d'
   end function name

   function meaning() result(words)
      character(:), allocatable :: words

      words = 'amplitude (1 - cos phi cos theta), theta = 2 pi y/wavelength_y'
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [ &
         amplitude_key('mean gap before load, half the height from trough to crest; 0 is a flat surface.'), &
         wavelength_key('wavelength along x.'), &
         real_key('wavelength_y', 'wavelength', 'length', 'wavelength along y.', above=0.0_dp)]
   end function keys

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

   function paper_wave_if() result(words)
      character(:), allocatable :: words

      words = 'wave_2d with one wavelength'
   end function paper_wave_if

end module wavycon_wave_2d
