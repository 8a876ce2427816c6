!> The kinds of surface that are formulas. Sums of cosine waves are 'wave_1d', 'wave_2d', 'crossed_1d' and 'hexagonal',
!> of one to three waves, and 'sum', of any waves. 'ball' is a ball, or a body with two radii of curvature, on a
!> half-space.
module wavycon_formula_kinds
   use wavycon_free_edges, only: surface_of_ball
   use wavycon_key_group, only: key_value
   use wavycon_kinds, only: dp, pi
   use wavycon_plain_text, only: integer_text
   use wavycon_scene_groups, only: surface_group
   use wavycon_surface, only: surface_type
   use wavycon_wave_surfaces, only: crossed_1d, hexagonal, wave_1d, wave_2d, wave_sum
   implicit none (type, external)
   private

   public :: check_sum, formula_surface, radii_of

   !> The waves of Johnson, Greenwood & Higginson (1985), eqs. (3) and (21), in the words of decks.
   character(*), parameter, public :: paper_waves = 'wave_1d, wave_2d with one wavelength, crossed_1d with equal waves'

contains

   !> Sets the defaults of kind = 'sum'. Lists of different lengths, and waves whose two wave numbers are 0, are
   !> reported.
   subroutine check_sum(values)
      type(surface_group), intent(inout) :: values

      integer :: i

      call values%length_y%set_default(values%length_x%numbers)
      call values%waves_y%set_default(0*values%waves_x%numbers)
      call values%phases%set_default(0*values%amplitudes%numbers)
      if (values%any_bad .or. .not. values%amplitudes%is_given) return
      call check_size(values%waves_x, 'waves_x')
      call check_size(values%waves_y, 'waves_y')
      call check_size(values%phases, 'phases')
      if (size(values%waves_x%numbers) /= size(values%waves_y%numbers)) return
      i = findloc(nint(values%waves_x%numbers) == 0 .and. nint(values%waves_y%numbers) == 0, .true., dim=1)
      if (i > 0) call values%complain(values%waves_x, 'wave '//integer_text(i)// &
         ' has waves_x = 0 and waves_y = 0: it is a height and no wave; leave it out')

   contains

      !> Reports a list that does not have one value for each amplitude.
      subroutine check_size(key, name)
         type(key_value), intent(in) :: key
         character(*), intent(in) :: name

         associate (number => size(values%amplitudes%numbers))
            if (key%is_given .and. size(key%numbers) /= number) call values%complain(key, &
               name//' has '//integer_text(size(key%numbers))//' values and amplitudes '//integer_text(number)// &
               ': give one for each wave')
         end associate
      end subroutine check_size

   end subroutine check_sum

   !> The surface of one of these kinds.
   function formula_surface(values) result(surface)
      type(surface_group), intent(inout) :: values   !! the values of &surface, without problems
      type(surface_type) :: surface

      select case (values%kind%text)
      case ('wave_1d')
         surface = wave_1d(values%amplitude%number, values%wavelength%number)
      case ('wave_2d')
         call values%wavelength_y%set_default(values%wavelength%numbers)
         surface = wave_2d(values%amplitude%number, values%wavelength%number, values%wavelength_y%number)
      case ('crossed_1d')
         surface = crossed_1d(values%amplitude1%number, values%wavelength1%number, values%amplitude2%number, &
                              values%wavelength2%number)
      case ('hexagonal')
         surface = hexagonal(values%amplitude%number, values%wavelength%number)
      case ('sum')
         surface = wave_sum([values%length_x%number, values%length_y%number], values%amplitudes%numbers, &
                            nint(values%waves_x%numbers), nint(values%waves_y%numbers), values%phases%numbers*pi/180)
      case ('ball')
         surface = surface_of_ball([values%length_x%number, values%length_y%number], &
                                   radii_of(values%radius, values%radius_x, values%radius_y))
         if (values%points%is_given) surface%points = surface%maps_in_cell()*nint(values%points%pair)
      end select
   end function formula_surface

   !> The radii of curvature along x and y that keys give [length]; huge(radii) where no key gives the radius.
   pure function radii_of(both, x, y) result(radii)
      type(key_value), intent(in) :: both, x, y   !! the key of both radii, of that along x, and of that along y
      real(dp) :: radii(2)

      radii = huge(radii)
      if (both%is_given) radii = both%number
      if (x%is_given) radii(1) = x%number
      if (y%is_given) radii(2) = y%number
   end function radii_of

end module wavycon_formula_kinds
