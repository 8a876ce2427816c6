!> A sum of any waves that are periodic on one cell.
module wavycon_wave_sum
   use wavycon_constants, only: pi
   use wavycon_error, only: error_type
   use wavycon_fourier_series, only: fourier_series
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_key, key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_map_statistics, only: map_statistics
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_of_series, surface_type
   use wavycon_surface_keys, only: length_x_key, length_y_key
   use wavycon_surface_kind, only: surface_kind
   implicit none (type, external)
   private

   public :: wave_sum, wave_sum_kind

   integer, parameter :: most_waves = 1000, highest_wave = 128

   type, extends(surface_kind) :: wave_sum_kind
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: make
      procedure, nopass :: set_defaults
      procedure, nopass :: check
      procedure, nopass :: advice
   end type wave_sum_kind

contains

   !> h = Delta - sum_q a_q cos(m_q X + n_q Y - phase_q), X = 2 pi x/L_x, Y = 2 pi y/L_y. Delta is the largest value of
   !> the sum, so that the surfaces just touch.
   type(surface_type) function wave_sum(length, a, m, n, phase) result(surface)
      real(dp), intent(in) :: length(2)      !! L_x, L_y [length], > 0
      real(dp), intent(in) :: a(:)           !! amplitudes [length], of either sign
      integer, intent(in) :: m(:), n(:)      !! wave numbers, shape of a; not both zero; all n = 0 for a profile
      real(dp), intent(in) :: phase(:)       !! phases [rad], shape of a

      !> If all sine coefficients are below this fraction of the sum of the amplitudes they are rounding: the sum is
      !> even.
      real(dp), parameter :: rounding = 1e-15_dp
      type(fourier_series) :: waves
      integer :: k, l, q
      real(dp) :: turn

      allocate (waves%c(0:maxval(abs(m)), 0:maxval(abs(n))), source=0.0_dp)
      allocate (waves%cs, waves%sc, waves%ss, source=waves%c)
      do q = 1, size(a)
         k = abs(m(q))
         l = abs(n(q))
         ! cos(mX + nY - phase) with m >= 0.
         turn = merge(phase(q), -phase(q), m(q) >= 0)
         associate (up => sign(1, n(q))*merge(1, -1, m(q) >= 0))
            waves%c(k, l) = waves%c(k, l) + a(q)*cos(turn)
            if (k > 0 .and. l > 0) waves%ss(k, l) = waves%ss(k, l) - up*a(q)*cos(turn)
            if (k > 0) waves%sc(k, l) = waves%sc(k, l) + a(q)*sin(turn)
            if (l > 0) waves%cs(k, l) = waves%cs(k, l) + up*a(q)*sin(turn)
         end associate
      end do
      if (max(maxval(abs(waves%cs)), maxval(abs(waves%sc)), maxval(abs(waves%ss))) <= rounding*sum(abs(a))) &
         deallocate (waves%cs, waves%sc, waves%ss)
      surface = surface_of_series(length, waves)
   end function wave_sum

   function name() result(words)
      character(:), allocatable :: words

      words = 'sum'
   end function name

   function meaning() result(words)
      character(:), allocatable :: words

      words = 'any waves'
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [ &
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
            most_values=most_waves)]
   end function keys

   subroutine set_defaults(values)
      type(group_values), intent(inout) :: values

      call values%set_default('length_y', values%real('length_x'))
      call values%set_default('waves_y', 0*values%integers('waves_x'))
      call values%set_default('phases', 0*values%reals('amplitudes'))
   end subroutine set_defaults

   subroutine check(values, problems)
      type(group_values), intent(in) :: values
      type(problem_list_type), intent(inout) :: problems

      call check_count(values, problems, 'waves_x', size(values%integers('waves_x')))
      call check_count(values, problems, 'waves_y', size(values%integers('waves_y')))
      call check_count(values, problems, 'phases', size(values%reals('phases')))
      if (values%is_bad('amplitudes') .or. values%is_bad('waves_x') .or. values%is_bad('waves_y')) return
      call check_waves(values, values%integers('waves_x'), values%integers('waves_y'), problems)
   end subroutine check

   !> Reports a wave without wave numbers, which is a constant height, and a profile along y.
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
      if (all(m == 0)) call values%complain(problems, 'waves_x', &
         'all waves_x are 0: turn the profile, so that it runs along x')
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

   function advice(key) result(words)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      words = ''
      if (key == 'amplitude') words = ': give amplitudes'
   end function advice

end module wavycon_wave_sum
