!> kind = 'sum': any waves.
module wavycon_wave_sum_kind
   use wavycon_constants, only: pi
   use wavycon_error, only: error_type
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_key, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_kind, only: length_x_key, length_y_key, surface_kind
   use wavycon_wave_sum, only: wave_sum
   implicit none (type, external)
   private

   public :: wave_sum_kind

   integer, parameter :: most_waves = 1000, highest_wave = 128

contains

   type(surface_kind) function wave_sum_kind() result(kind)
      kind%name = 'sum'
      kind%meaning = 'any waves'
      allocate (kind%keys, source=[ &
         length_x_key(), length_y_key(), &
         real_key('amplitudes', '', 'length', &
            'the height is the sum of amplitudes cos(2 pi (waves_x x/length_x + waves_y y/length_y) - phases).', &
            most_values=most_waves, required=.true.), &
         integer_key('waves_x', '', 'number of periods of each wave in the cell along x; may be negative.', &
            -highest_wave, highest_wave, most_values=most_waves, required=.true.), &
         integer_key('waves_y', '0', &
            'number of periods of each wave in the cell along y. If all are 0 the surface is a profile.', &
            -highest_wave, highest_wave, most_values=most_waves), &
         real_key('phases', '0', 'degree', 'phase of each wave.', least=-360.0_dp, most=360.0_dp, &
            most_values=most_waves)])
      kind%make => make
      kind%check => check
   end function wave_sum_kind

   subroutine check(values, problems)
      type(group_values), intent(inout) :: values
      type(problem_list_type), intent(inout) :: problems

      call values%set_default('length_y', values%reals('length_x'))
      call values%set_default('waves_y', 0*values%reals('waves_x'))
      call values%set_default('phases', 0*values%reals('amplitudes'))
      call check_count(values, problems, 'waves_x', size(values%integers('waves_x')))
      call check_count(values, problems, 'waves_y', size(values%integers('waves_y')))
      call check_count(values, problems, 'phases', size(values%reals('phases')))
      if (values%is_bad('amplitudes') .or. values%is_bad('waves_x') .or. values%is_bad('waves_y')) return
      call check_waves(values, values%integers('waves_x'), values%integers('waves_y'), problems)
   end subroutine check

   !> Reports a wave without wave numbers, which is a constant height.
   subroutine check_waves(values, m, n, problems)
      type(group_values), intent(in) :: values
      integer, intent(in) :: m(:), n(:)   !! waves_x and waves_y
      type(problem_list_type), intent(inout) :: problems

      integer :: i

      if (size(m) /= size(n) .or. size(m) == 0) return
      do i = 1, size(m)
         if (m(i) /= 0 .or. n(i) /= 0) cycle
         call values%complain(problems, 'waves_x', 'wave '//integer_text(i)// &
            ' has waves_x = 0 and waves_y = 0: it is a height and no wave; leave it out')
         return
      end do
   end subroutine check_waves

   !> Reports a list whose number of values differs from that of the amplitudes.
   subroutine check_count(values, problems, key, number)
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems
      character(*), intent(in) :: key
      integer, intent(in) :: number   !! of its values

      integer :: amplitudes

      if (.not. values%has(key) .or. values%is_bad(key) .or. values%is_bad('amplitudes')) return
      amplitudes = size(values%reals('amplitudes'))
      if (number /= amplitudes) call values%complain(problems, key, key//' has '//integer_text(number)// &
         ' values and amplitudes '//integer_text(amplitudes)//': give one for each wave')
   end subroutine check_count

   subroutine make(values, surface, map, error)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error

      surface = wave_sum([values%real('length_x'), values%real('length_y')], values%reals('amplitudes'), &
                         values%integers('waves_x'), values%integers('waves_y'), values%reals('phases')*pi/180)
   end subroutine make

end module wavycon_wave_sum_kind
