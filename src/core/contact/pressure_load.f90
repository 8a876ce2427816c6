!> The load of a pressure on a grid, and pressures of a given load between zero and the hardness: equation (C24) of
!> README.md in this directory. Fields have the own columns of the grid, and sums go over all of it.
module wavycon_pressure_load
   use wavycon_grid_slab, only: grid_slab, strip_columns
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: bounded_shift, has_points_at, set_load

contains

   !> Changes a pressure so that its sum is that of a load. Without points at H the pressure is multiplied by a factor.
   !> Otherwise all points between zero and H change by the same, within these bounds, and the others too where that is
   !> not enough.
   subroutine set_load(slab, pressure, load, hardness)
      type(grid_slab), intent(in) :: slab         !! of the grid
      real(dp), intent(inout) :: pressure(:, :)   !! p, >= 0; more than H becomes H. Shape (M, slab%columns())
      real(dp), intent(in) :: load                !! sum of the pressures, > 0 and < H times their number
      real(dp), intent(in) :: hardness            !! H, huge if there is none

      real(dp) :: lack, room, shift
      logical, allocatable :: changes(:, :)
      integer :: first(slab%strips() + 1), s

      if (.not. has_points_at(slab, hardness, pressure)) then
         pressure = pressure*(load/slab%sum_of(pressure))
         if (.not. has_points_at(slab, hardness, pressure)) return
      end if
      pressure = min(pressure, hardness)
      lack = load - slab%sum_of(pressure)
      allocate (changes, source=pressure > 0.0_dp .and. pressure < hardness)
      room = slab%sum_of(merge(merge(hardness - pressure, pressure, lack > 0.0_dp), 0.0_dp, changes))
      if (abs(lack) >= room) changes = .true.
      do s = 1, slab%strips() + 1
         first(s) = 1 + size(pressure, 1)*min((s - 1)*strip_columns, size(pressure, 2))
      end do
      shift = bounded_shift(slab, first, pack(merge(pressure, 0.0_dp, changes), .true.), &
                            pack(merge(hardness - pressure, 0.0_dp, changes), .true.), lack)
      where (changes) pressure = min(max(pressure + shift, 0.0_dp), hardness)
   end subroutine set_load

   !> Whether any pressure is at the hardness or above.
   logical function has_points_at(slab, hardness, pressure)
      type(grid_slab), intent(in) :: slab
      real(dp), intent(in) :: hardness, pressure(:, :)

      real(dp) :: extremes(2)

      has_points_at = hardness < huge(hardness)
      if (.not. has_points_at) return
      extremes = slab%extremes(pressure)
      has_points_at = extremes(1) >= hardness
   end function has_points_at

   !> The shift s for which the sum of min(max(s, -above), below) is a given one: the sum grows with s, in straight
   !> pieces.
   real(dp) function bounded_shift(slab, first, above, below, total) result(shift)
      type(grid_slab), intent(in) :: slab
      integer, intent(in) :: first(:)              !! places at which the numbers of each own strip begin, and one more
                                                   !! than the last of all, shape (slab%strips() + 1)
      real(dp), intent(in) :: above(:), below(:)   !! of points of the own columns, both 0 where nothing changes
      real(dp), intent(in) :: total                !! between the sums of -above and of below over the grid

      !> Newton's method ends in a few steps. Those by bisection end at the last digit.
      integer, parameter :: most_steps = 100
      real(dp) :: excess, extremes(2), free, high, low, next, parts(2, size(first) - 1), sums(2)
      integer :: s, step

      shift = 0.0_dp
      extremes = slab%largest([maxval(above), maxval(below)])
      if (all(extremes <= 0.0_dp)) return
      low = min(0.0_dp, -extremes(1))
      high = max(0.0_dp, extremes(2))
      do step = 1, most_steps
         do s = 1, size(first) - 1
            associate (over => above(first(s):first(s + 1) - 1), under => below(first(s):first(s + 1) - 1))
               parts(:, s) = [sum(min(max(shift, -over), under)), real(count(shift > -over .and. shift < under), dp)]
            end associate
         end do
         sums = slab%strip_totals(parts)
         excess = sums(1) - total
         free = sums(2)
         if (excess > 0.0_dp) high = shift
         if (excess < 0.0_dp) low = shift
         next = shift - excess/max(free, 1.0_dp)
         if (free <= 0.0_dp .or. next <= low .or. next >= high) next = 0.5_dp*(low + high)
         if (abs(excess) <= 0.0_dp .or. abs(next - shift) <= epsilon(shift)*abs(shift)) exit
         shift = next
      end do
   end function bounded_shift

end module wavycon_pressure_load
