!> Conversion of the lengths of map files from one unit to another.
module wavycon_length_unit
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped, excerpt, listed
   use wavycon_units, only: length_powers, lengths
   implicit none (type, external)
   private

   public :: convert_lengths, find_factor

contains

   !> Finds the factor that converts lengths from one unit to another.
   pure subroutine find_factor(from, to, factor, is_found)
      character(*), intent(in) :: from, to   !! names of units
      real(dp), intent(out) :: factor        !! number of units `to` in one unit `from`; 1 if it is not found
      logical, intent(out) :: is_found       !! .true. if both units are known, and also if the two names are equal

      integer :: i, j

      factor = 1.0_dp
      is_found = from == to
      if (is_found) return
      i = findloc(lengths == from, .true., dim=1)
      j = findloc(lengths == to, .true., dim=1)
      is_found = i > 0 .and. j > 0
      if (is_found) factor = 10.0_dp**(length_powers(i) - length_powers(j))
   end subroutine find_factor

   !> Converts steps and heights of a map from the units that its file names to one unit. A map without units does not
   !> change. Errors: exit_bad_input for a unit that cannot be converted.
   subroutine convert_lengths(path, unit, map, error)
      character(*), intent(in) :: path           !! path of the map's file, for the message
      character(*), intent(in) :: unit           !! the unit to convert to; empty: the unit of the steps
      type(measured_map), intent(inout) :: map   !! on exit both of its units are the unit converted to
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: target
      real(dp) :: factor
      logical :: is_known

      if (.not. allocated(map%length_unit)) return
      target = unit
      if (unit == '') target = 'm'
      call find_factor(map%length_unit, target, factor, is_known)
      if (.not. is_known) then
         call fatal_error(error, exit_bad_input, escaped(path)//": its lengths are in '"// &
                          excerpt(map%length_unit)//"' and cannot be converted to '"//escaped(target)// &
                          "': both must be one of "//listed(lengths, ' and ')// &
                          ', or length_unit in &scene the same as in the file')
         return
      end if
      if (unit /= '') then
         map%step = factor*map%step
         map%uneven_steps = factor*map%uneven_steps
         map%length_unit = unit
      end if
      call find_factor(map%height_unit, map%length_unit, factor, is_known)
      if (.not. is_known) call fatal_error(error, exit_bad_input, &
         escaped(path)//": its heights are in '"//excerpt(map%height_unit)//"' and cannot be "// &
         "converted to '"//escaped(map%length_unit)//"': they must be lengths, in one of "//listed(lengths, ' and ')// &
         ' (Gwyddion: Data Process > Basic Operations > Dimensions and Units)')
      if (factor > 1.0_dp .or. factor < 1.0_dp) map%height = factor*map%height
      map%height_unit = map%length_unit
   end subroutine convert_lengths

end module wavycon_length_unit
