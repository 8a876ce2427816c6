!> The units of length and of pressure that wavycon knows. Other labels of units stay as they are.
module wavycon_units
   use wavycon_plain_text, only: lower_case
   implicit none (type, external)
   private

   public :: makes_newton, meant_unit

   !> Units in UTF-8: the micrometre with the micro sign, the angstrom, the micrometre with the Greek letter mu.
   character(*), parameter, public :: micro_sign = char(194)//char(181)//'m', angstrom = char(195)//char(133)
   character(*), parameter :: greek_letter = char(206)//char(188)//'m', squared = char(194)//char(178)
   !> Each unit is this power of 10 m, or of 10 Pa.
   character(*), parameter, public :: lengths(*) = &
      [character(3) :: 'km', 'm', 'cm', 'mm', 'um', micro_sign, greek_letter, 'nm', angstrom, 'pm']
   integer, parameter, public :: length_powers(*) = [3, 0, -2, -3, -6, -6, -6, -9, -10, -12]
   character(*), parameter :: pressures(*) = &
      [character(6) :: 'Pa', 'kPa', 'MPa', 'GPa', 'N/m^2', 'N/mm^2', 'N/m'//squared, 'N/mm'//squared]
   integer, parameter :: pressure_powers(*) = [0, 3, 6, 9, 0, 6, 0, 6]

   !> Other words for units, in lower case and of one only, and the units that they mean.
   character(*), parameter :: &
      words(*) = [character(10) :: 'pascal', 'kilopascal', 'megapascal', 'gigapascal', 'pa', 'kpa', 'mpa', 'gpa', &
                  'n/m2', 'n/mm2', 'n/m**2', 'n/mm**2', 'n/m^2', 'n/mm^2', 'kilometer', 'meter', 'centimeter', &
                  'millimeter', 'micrometer', 'micron', 'nanometer', 'angstrom', 'picometer', lengths], &
      meant(*) = [character(10) :: pressures(:4), pressures(:4), pressures(5:6), pressures(5:6), pressures(5:6), &
                  lengths(:5), 'um', 'nm', angstrom, 'pm', lengths]

contains

   !> Whether a pressure of one unit on a square of one unit of length is a force of 1 N.
   pure logical function makes_newton(pressure_unit, length_unit)
      character(*), intent(in) :: pressure_unit, length_unit

      integer :: i, j

      i = findloc(pressures == pressure_unit, .true., dim=1)
      j = findloc(lengths == length_unit, .true., dim=1)
      makes_newton = i > 0 .and. j > 0
      if (makes_newton) makes_newton = pressure_powers(i) + 2*length_powers(j) == 0
   end function makes_newton

   !> The known unit that a label most likely means, such as MPa for megapascals; '' for a known unit, and for a label
   !> whose meaning is not clear.
   pure function meant_unit(label) result(unit)
      character(*), intent(in) :: label
      character(:), allocatable :: unit

      character(:), allocatable :: word
      integer :: i

      unit = ''
      if (any(lengths == label) .or. any(pressures == label)) return
      word = lower_case(label)
      i = index(word, 'metre')
      if (i > 0) word(i:i + 4) = 'meter'
      i = len(word)
      if (i > 2 .and. index(word, 's', back=.true.) == i) word = word(:i - 1)
      i = findloc(words == word, .true., dim=1)
      if (i > 0) unit = trim(meant(i))
   end function meant_unit

end module wavycon_units
