!> The kinds of surface that are formulas: cosine waves, 'wave_1d', 'wave_2d', 'crossed_1d' and 'hexagonal' of one, two
!> or three and 'sum' of any; and 'ball', a ball, or a body with two radii of curvature, pressed on a half-space.
module wavycon_formula_kinds
   use wavycon_constants, only: pi
   use wavycon_free_edges, only: surface_of_ball
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_wave_surfaces, only: crossed_1d, hexagonal, wave_1d, wave_2d, wave_sum
   implicit none (type, external)
   private

   public :: check_sum, formula_surface, radii_of

   !> The waves of Johnson, Greenwood & Higginson (1985), eqs. (3) and (21).
   character(*), parameter, public :: paper_waves = &
      'wave_1d, wave_2d with one wavelength, crossed_1d with equal waves'

contains

   !> Sets the defaults of 'sum', and reports lists of unlike lengths and waves without wave numbers.
   subroutine check_sum(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      character(7), parameter :: lists(3) = [character(7) :: 'waves_x', 'waves_y', 'phases']
      character(:), allocatable :: key
      integer :: i, number
      integer, allocatable :: m(:), n(:)

      call values%set_default('length_y', values%reals('length_x'))
      call values%set_default('waves_y', 0*values%reals('waves_x'))
      call values%set_default('phases', 0*values%reals('amplitudes'))
      if (values%any_bad() .or. .not. values%has('amplitudes')) return
      number = size(values%reals('amplitudes'))
      do i = 1, size(lists)
         key = trim(lists(i))
         if (values%has(key) .and. size(values%reals(key)) /= number) call values%complain(problems, key, &
            key//' has '//integer_text(size(values%reals(key)))//' values and amplitudes '//integer_text(number)// &
            ': give one for each wave')
      end do
      m = nint(values%reals('waves_x'))
      n = nint(values%reals('waves_y'))
      if (size(m) /= size(n)) return
      i = findloc(m == 0 .and. n == 0, .true., dim=1)
      if (i > 0) call values%complain(problems, 'waves_x', 'wave '//integer_text(i)// &
         ' has waves_x = 0 and waves_y = 0: it is a height and no wave; leave it out')
   end subroutine check_sum

   !> The surface of a kind of this module.
   function formula_surface(values) result(surface)
      type(group_values), intent(inout) :: values   !! of &surface, without problems
      type(surface_type) :: surface

      select case (values%text('kind'))
      case ('wave_1d')
         surface = wave_1d(values%real('amplitude'), values%real('wavelength'))
      case ('wave_2d')
         call values%set_default('wavelength_y', values%reals('wavelength'))
         surface = wave_2d(values%real('amplitude'), values%real('wavelength'), values%real('wavelength_y'))
      case ('crossed_1d')
         surface = crossed_1d(values%real('amplitude1'), values%real('wavelength1'), values%real('amplitude2'), &
                              values%real('wavelength2'))
      case ('hexagonal')
         surface = hexagonal(values%real('amplitude'), values%real('wavelength'))
      case ('sum')
         surface = wave_sum([values%real('length_x'), values%real('length_y')], values%reals('amplitudes'), &
                            nint(values%reals('waves_x')), nint(values%reals('waves_y')), values%reals('phases')*pi/180)
      case ('ball')
         surface = surface_of_ball([values%real('length_x'), values%real('length_y')], radii_of(values, 'radius'))
         if (values%has('points')) surface%points = surface%parts()*nint(values%pair('points'))
      end select
   end function formula_surface

   !> The radii along x and y that the keys `name`, or `name_x` and `name_y`, give [length]; huge where they give none.
   pure function radii_of(values, name) result(radii)
      type(group_values), intent(in) :: values
      character(*), intent(in) :: name
      real(dp) :: radii(2)

      radii = huge(radii)
      if (values%has(name)) radii = values%real(name)
      if (values%has(name//'_x')) radii(1) = values%real(name//'_x')
      if (values%has(name//'_y')) radii(2) = values%real(name//'_y')
   end function radii_of

end module wavycon_formula_kinds
