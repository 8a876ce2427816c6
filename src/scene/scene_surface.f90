!> The surface that a deck describes.
module wavycon_scene_surface
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_constants, only: pi
   use wavycon_height_map_file, only: height_map_type, read_height_map
   use wavycon_key_table, only: largest_number, smallest_number
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, short_number
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_system, only: full_path, path_absent, path_kind
   use wavycon_wave_surfaces, only: crossed_1d, hexagonal, wave_1d, wave_2d, wave_sum
   implicit none (type, external)
   private

   public :: map_statistics, surface_of_deck

   !> What a height map is like, for the log.
   type :: map_statistics
      integer :: points(2) = 0
      character(6) :: format = ''
      real(dp) :: lowest = 0.0_dp, highest = 0.0_dp, rms = 0.0_dp   !! of the heights over their mean [length]
      character(:), allocatable :: path   !! from the root on
   end type map_statistics

contains

   !> Errors: exit_file_trouble for a height map that cannot be read, exit_bad_input for one that is none.
   subroutine surface_of_deck(deck, surface, map, error)
      type(deck_type), intent(in) :: deck
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map   !! allocated for a height map
      type(error_type), allocatable, intent(out) :: error

      associate (group => deck%surface)
         select case (group%kind)
         case ('wave_1d')
            surface = wave_1d(group%amplitude, group%wavelength)
         case ('wave_2d')
            surface = wave_2d(group%amplitude, group%wavelength, group%wavelength_y)
         case ('crossed_1d')
            surface = crossed_1d(group%amplitude1, group%wavelength1, group%amplitude2, group%wavelength2)
         case ('hexagonal')
            surface = hexagonal(group%amplitude, group%wavelength)
         case ('sum')
            surface = wave_sum([group%length_x, group%length_y], group%amplitudes, group%waves_x, group%waves_y, &
                               group%phases*pi/180)
         case ('file')
            call surface_of_file(deck, surface, map, error)
         end select
      end associate
   end subroutine surface_of_deck

   subroutine surface_of_file(deck, surface, statistics, error)
      type(deck_type), intent(in) :: deck
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: statistics
      type(error_type), allocatable, intent(out) :: error

      type(height_map_type) :: map
      character(:), allocatable :: map_of, path
      real(dp) :: length(2)

      path = place_of_map(deck)
      map_of = ' (the height map of '//escaped(deck%path)//')'
      call read_height_map(path, deck%surface%file_format, map, error)
      if (allocated(error)) then
         error%message = error%message//map_of
         return
      end if
      length = [deck%surface%length_x, deck%surface%length_y]
      if (all(map%step > 0.0_dp)) length = map%step*shape(map%height)
      if (map%step(1) > 0.0_dp .and. size(map%height, 2) == 1) length = map%step(1)*size(map%height, 1)
      if (maxval(map%height) <= minval(map%height)) then
         ! Rounding of the mean is no roughness.
         map%height = 0.0_dp
      else
         map%height = deck%surface%height_scale*(map%height - sum(map%height)/size(map%height))
      end if
      associate (largest => maxval(abs(map%height)))
         if (largest > largest_number .or. (largest < smallest_number .and. largest > 0.0_dp)) then
            call fatal_error(error, exit_bad_input, escaped(path)//': the heights over their mean, times '// &
                             'height_scale, are up to '//short_number(largest)//' [length]: lengths may be '// &
                             'from '//short_number(smallest_number)//' to '//short_number(largest_number)//map_of)
            return
         end if
      end associate
      surface = surface_of_points(length, map%height)
      allocate (statistics)
      statistics%points = shape(map%height)
      statistics%format = map%format
      statistics%lowest = minval(map%height)
      statistics%highest = maxval(map%height)
      statistics%rms = sqrt(sum(map%height**2)/size(map%height))
      statistics%path = full_path(path)
   end subroutine surface_of_file

   !> The file is looked for beside the deck, then from where the program was started.
   function place_of_map(deck) result(path)
      type(deck_type), intent(in) :: deck
      character(:), allocatable :: path

      path = deck%path(:index(deck%path, '/', back=.true.))//trim(deck%surface%file)
      if (deck%surface%file(1:1) == '/') path = trim(deck%surface%file)
      if (path_kind(path) /= path_absent) return
      if (path_kind(trim(deck%surface%file)) /= path_absent) path = trim(deck%surface%file)
   end function place_of_map

end module wavycon_scene_surface
