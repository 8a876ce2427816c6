!> Changes a pressure on a grid so that it carries a given load and stays between zero and the hardness: equation (C24)
!> of README.md in this directory. If the grid is distributed over processes, fields have the columns of this process,
!> and sums are those over the whole grid.
module wavycon_pressure_load
   use wavycon_grid_slab, only: grid_slab, strip_columns
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: bounded_shift, has_points_at, set_load

contains

   !> Changes a pressure so that its sum becomes a given load. If no point is at H the pressure is multiplied by a
   !> factor. Otherwise a shift is added at all points between zero and H, and the result is cut at these bounds. If
   !> that cannot give the load, the points at the bounds are shifted too.
   subroutine set_load(slab, pressure, load, hardness)
      type(grid_slab), intent(in) :: slab         !! columns of the grid that this process has
      real(dp), intent(inout) :: pressure(:, :)   !! p >= 0, a pressure above H becomes H; shape (M, slab%columns())
      real(dp), intent(in) :: load                !! sum of the pressures, > 0 and < H times their number
      real(dp), intent(in) :: hardness            !! H, huge if there is none

      !> Load that is missing (too much if negative), and the largest change that the points between zero and H allow.
      real(dp) :: lack, largest_change, shift
      logical, allocatable :: changes(:, :)
      integer :: first(slab%strips() + 1), s

      if (.not. has_points_at(slab, hardness, pressure)) then
         pressure = pressure*(load/slab%sum_of(pressure))
         if (.not. has_points_at(slab, hardness, pressure)) return
      end if
      pressure = min(pressure, hardness)
      lack = load - slab%sum_of(pressure)
      allocate (changes, source=pressure > 0.0_dp .and. pressure < hardness)
      largest_change = slab%sum_of(merge(pressure, 0.0_dp, changes))
      if (lack > 0.0_dp) largest_change = slab%sum_of(merge(hardness - pressure, 0.0_dp, changes))
      if (abs(lack) >= largest_change) changes = .true.
      first = 1 + size(pressure, 1)*min([(s*strip_columns, s=0, slab%strips())], size(pressure, 2))
      shift = bounded_shift(slab, first, pack(merge(pressure, 0.0_dp, changes), .true.), &
                            pack(merge(hardness - pressure, 0.0_dp, changes), .true.), lack)
      where (changes) pressure = min(max(pressure + shift, 0.0_dp), hardness)
   end subroutine set_load

   !> Whether the pressure is at the hardness or above at any point of the grid.
   logical function has_points_at(slab, hardness, pressure)
      type(grid_slab), intent(in) :: slab                !! columns of the grid that this process has
      real(dp), intent(in) :: hardness, pressure(:, :)   !! H, huge if there is none; p, shape (M, slab%columns())

      real(dp) :: extremes(2)

      has_points_at = hardness < huge(hardness)
      if (.not. has_points_at) return
      extremes = slab%extremes(pressure)
      has_points_at = extremes(1) >= hardness
   end function has_points_at

   !> The shift s for which the sum over all points of min(max(s, -above), below) has a given value. The sum is a
   !> piecewise linear function of s that grows with s. Newton's method solves the equation; a step that leaves the
   !> bracket of the root is replaced by bisection.
   real(dp) function bounded_shift(slab, first, above, below, total) result(shift)
      type(grid_slab), intent(in) :: slab          !! columns of the grid that this process has
      !> Indices in `above` and `below` at which the strips of this process begin, and one more than the last index,
      !> shape (slab%strips() + 1).
      integer, intent(in) :: first(:)
      !> Distances of the pressure from the lower and from the upper bound, both >= 0, at the points of this process; 0
      !> at points that do not change.
      real(dp), intent(in) :: above(:), below(:)
      real(dp), intent(in) :: total                !! the sum, between the sums of -above and of below over the grid

      !> Newton's method ends in a few steps, bisection when the digits are used up.
      integer, parameter :: most_steps = 100
      real(dp) :: excess, extremes(2), free, high, low, next, strip_sums(2, size(first) - 1), sums(2)
      integer :: i, s, step

      shift = 0.0_dp
      extremes = slab%largest([maxval(above), maxval(below)])
      if (all(extremes <= 0.0_dp)) return
      low = min(0.0_dp, -extremes(1))
      high = max(0.0_dp, extremes(2))
      do step = 1, most_steps
         do s = 1, size(first) - 1
            ! One after another: close to H a sum in another order may make the iteration longer.
            sums = 0.0_dp
            do i = first(s), first(s + 1) - 1
               sums(1) = sums(1) + min(max(shift, -above(i)), below(i))
               sums(2) = sums(2) + merge(1.0_dp, 0.0_dp, shift > -above(i) .and. shift < below(i))
            end do
            strip_sums(:, s) = sums
         end do
         sums = slab%strip_totals(strip_sums)
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
