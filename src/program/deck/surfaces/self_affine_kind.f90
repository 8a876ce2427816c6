!> kind = 'self_affine': the surface is a random rough one, made from its spectrum.
module wavycon_self_affine_kind
   use wavycon_error, only: error_type
   use wavycon_formula_kinds, only: radii_of
   use wavycon_key_group, only: key_value
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_scene_groups, only: surface_group
   use wavycon_self_affine, only: has_waves, least_points_of, self_affine_spectrum, self_affine_surface, &
      sides_of_spectrum
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_self_affine, self_affine_of

   !> Most points along a side if the deck does not give `points`; fewest points along a side.
   integer, parameter :: most_default_points = 8192, least_points = 4

contains

   !> The number of points along a side: the least power of two that gives at least four points to the shortest wave,
   !> but at most `most_default_points`.
   elemental integer function default_points(waves) result(points)
      real(dp), intent(in) :: waves   !! length of the side over the shortest wavelength

      points = least_points
      do while (points < 4*waves .and. points < most_default_points)
         points = 2*points
      end do
   end function default_points

   !> Sets the defaults that depend on other keys. Cut-off wavelengths in the wrong order, too few points, and cut-offs
   !> between which the cell has no wave are reported.
   subroutine check_self_affine(values)
      type(surface_group), intent(inout) :: values

      integer :: points(2)
      real(dp) :: length(2), longest
      type(self_affine_spectrum) :: spectrum

      points = 0
      if (values%points%is_given .and. .not. values%points%is_bad) points = nint(values%points%pair)
      length = values%length_x%number
      ! If the deck does not give length_y, points are equally far apart along x and y.
      if (points(2) > 1) length(2) = length(1)*points(2)/points(1)
      call values%length_y%set_default(length(2:))
      length(2) = values%length_y%number
      longest = maxval(length)
      if (points(2) == 1) longest = length(1)
      call values%long_wavelength%set_default([longest])
      call values%rolloff_wavelength%set_default(values%long_wavelength%numbers)
      call values%short_wavelength%set_default(values%rolloff_wavelength%numbers/64)
      if (points(1) == 0) points = default_points(sides_of_spectrum(length, values%anisotropy%number)/ &
                                                  values%short_wavelength%number)
      if (.not. values%points%is_bad) call values%points%set(real(points, dp))
      if (all(values%edges%text /= ['periodic', 'free    '])) call values%complain(values%edges, &
         "a random surface is made periodic: edges must be 'periodic' or 'free'")
      values%anisotropy%in_effect = points(2) > 1
      if (points(2) == 1 .and. values%anisotropy%is_given) call values%complain(values%anisotropy, &
         'a profile has one direction: leave anisotropy out')
      if (values%any_bad) return
      spectrum = spectrum_of(values)
      call check_order(values%long_wavelength, 'long_wavelength', spectrum%longest, &
                       'the longest side of the cell', maxval(spectrum%length(:spectrum%dimension)))
      call check_order(values%rolloff_wavelength, 'rolloff_wavelength', spectrum%rolloff, 'long_wavelength', &
                       spectrum%longest)
      call check_order(values%short_wavelength, 'short_wavelength', spectrum%shortest, 'rolloff_wavelength', &
                       spectrum%rolloff)
      call check_points(values, spectrum)
      if (values%problems%number > 0) return
      if (.not. has_waves(spectrum)) call values%complain(values%short_wavelength, &
         'nothing varies: no wave of the cell has a length from short_wavelength = '// &
         short_number(spectrum%shortest)//' to long_wavelength = '//short_number(spectrum%longest))

   contains

      !> Reports a wavelength that is longer than its limit.
      subroutine check_order(key, name, length, most_words, most)
         type(key_value), intent(in) :: key
         character(*), intent(in) :: name, most_words   !! name of the key; the limit in words
         real(dp), intent(in) :: length, most           !! the wavelength; its limit [length]

         if (length > most) call values%complain(key, name//' = '//short_number(length)// &
                                                 ' must not be longer than '//most_words//', '//short_number(most))
      end subroutine check_order

   end subroutine check_self_affine

   !> Reports numbers of points that are less than `least_points` or too few for the shortest wave.
   subroutine check_points(values, spectrum)
      type(surface_group), intent(inout) :: values
      type(self_affine_spectrum), intent(in) :: spectrum

      !> Factor that makes a wave longer than two steps by an amount that a message's six digits show.
      real(dp), parameter :: longer = 1.001_dp
      character(:), allocatable :: advice
      integer :: least(2), points(2)

      points = nint(values%points%numbers)
      if (points(1) < least_points .or. (points(2) < least_points .and. spectrum%dimension == 2)) then
         call values%complain(values%points, 'there must be at least '//integer_text(least_points)// &
                              ' points along each side, or 1 along y for a profile')
         return
      end if
      least = least_points_of(spectrum)
      if (all(points >= least)) return
      advice = ', and accurate contact areas twice as many each way or more'
      if (all(points >= least - 1)) advice = advice//'. Waves of exactly two steps have no phase on the points: '// &
         'short_wavelength = '//short_number(longer*spectrum%shortest)//' leaves them out'
      call values%complain(values%points, integer_text(points(1))//' x '//integer_text(points(2))// &
         ' points are too few for short_wavelength = '//short_number(spectrum%shortest)//': it needs '// &
         integer_text(least(1))//' x '//integer_text(least(2))//advice)
   end subroutine check_points

   !> The spectrum that the keys describe.
   pure function spectrum_of(values) result(spectrum)
      type(surface_group), intent(in) :: values
      type(self_affine_spectrum) :: spectrum

      spectrum%dimension = merge(1, 2, nint(values%points%pair(2)) == 1)
      spectrum%length = [values%length_x%number, values%length_y%number]
      spectrum%hurst = values%hurst%number
      spectrum%anisotropy = values%anisotropy%number
      spectrum%longest = values%long_wavelength%number
      spectrum%rolloff = values%rolloff_wavelength%number
      spectrum%shortest = values%short_wavelength%number
      spectrum%by_slope = values%rms_slope%is_given
      spectrum%rms = values%rms_height%number
      if (spectrum%by_slope) spectrum%rms = values%rms_slope%number
      if (values%spectral_density%is_given) spectrum%density = values%spectral_density%number
      spectrum%random_amplitudes = values%spectrum%text == 'random'
      spectrum%seed = nint(values%seed%number)
   end function spectrum_of

   !> Makes the surface. Errors: those of self_affine_surface.
   subroutine self_affine_of(values, surface, map, error)
      type(surface_group), intent(inout) :: values   !! the values of &surface, without problems
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      call self_affine_surface(escaped(values%deck_path)//": kind = 'self_affine'", spectrum_of(values), &
                               nint(values%points%numbers), surface, map, error, values%edges%text == 'free', &
                               radii_of(values%form_radius, values%form_radius_x, values%form_radius_y))
      if (.not. allocated(error)) map%changes%edges = values%edges%text
   end subroutine self_affine_of

end module wavycon_self_affine_kind
