!> The load of a pressure on a grid, and pressures of a given load between zero and the hardness: equation (C24) of
!> README.md in this directory.
module wavycon_pressure_load
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: bounded_shift, set_load, sum_of_field

contains

   !> Changes a pressure so that its sum is that of a load. Without points at H the pressure is multiplied by a factor.
   !> Otherwise all points between zero and H change by the same, within these bounds, and the others too where that is
   !> not enough.
   pure subroutine set_load(pressure, load, hardness)
      real(dp), intent(inout) :: pressure(:, :)   !! p, >= 0; more than H becomes H
      real(dp), intent(in) :: load                !! sum of the pressures, > 0 and < H times their number
      real(dp), intent(in) :: hardness            !! H, huge if there is none

      real(dp) :: lack, shift
      logical, allocatable :: changes(:, :)

      if (.not. has_points_at(hardness, pressure)) then
         pressure = pressure*(load/sum_of_field(pressure))
         if (.not. has_points_at(hardness, pressure)) return
      end if
      pressure = min(pressure, hardness)
      lack = load - sum_of_field(pressure)
      allocate (changes, source=pressure > 0.0_dp .and. pressure < hardness)
      if (abs(lack) >= sum(merge(hardness - pressure, pressure, lack > 0.0_dp), changes)) changes = .true.
      shift = bounded_shift(pack(pressure, changes), pack(hardness - pressure, changes), lack)
      where (changes) pressure = min(max(pressure + shift, 0.0_dp), hardness)
   end subroutine set_load

   pure logical function has_points_at(hardness, pressure)
      real(dp), intent(in) :: hardness, pressure(:, :)

      has_points_at = hardness < huge(hardness)
      if (has_points_at) has_points_at = any(pressure >= hardness)
   end function has_points_at

   !> The shift s for which the sum of min(max(s, -above), below) is a given one: the sum grows with s, in straight
   !> pieces.
   pure real(dp) function bounded_shift(above, below, total) result(shift)
      real(dp), intent(in) :: above(:), below(:)   !! above + below > 0, of the same size
      real(dp), intent(in) :: total                !! between the sums of -above and of below

      !> Newton's method ends in a few steps. Those by bisection end at the last digit.
      integer, parameter :: most_steps = 100
      real(dp) :: excess, high, low, next
      integer :: free, step

      shift = 0.0_dp
      if (size(above) == 0) return
      low = min(0.0_dp, -maxval(above))
      high = max(0.0_dp, maxval(below))
      do step = 1, most_steps
         excess = sum(min(max(shift, -above), below)) - total
         free = count(shift > -above .and. shift < below)
         if (excess > 0.0_dp) high = shift
         if (excess < 0.0_dp) low = shift
         next = shift - excess/max(free, 1)
         if (free == 0 .or. next <= low .or. next >= high) next = 0.5_dp*(low + high)
         if (abs(excess) <= 0.0_dp .or. abs(next - shift) <= epsilon(shift)*abs(shift)) exit
         shift = next
      end do
   end function bounded_shift

   !> Sum of a field, column by column.
   pure real(dp) function sum_of_field(field) result(total)
      real(dp), intent(in) :: field(:, :)

      integer :: j

      total = sum([(sum(field(:, j)), j=1, size(field, 2))])
   end function sum_of_field

end module wavycon_pressure_load
