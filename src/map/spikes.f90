!> Finds spikes, single heights far from all around them, by a median rule: (M8) of README.md in this directory.
module wavycon_spikes
   use wavycon_kinds, only: dp
   use wavycon_map_tuning, only: reach_of_spike
   implicit none (type, external)
   private

   public :: find_spikes

   !> Neighbours of a height: those up to so many points away, in each direction of a map, along a profile.
   integer, parameter :: around_in_map = 2, around_in_profile = 6

contains

   !> Counts the heights that differ from the median of their neighbours by more than a multiple of what these differ
   !> among themselves, here and on the average over the map, and replaces them by this median on demand.
   subroutine find_spikes(height, missing, number, replace)
      real(dp), intent(inout) :: height(:, :)                 !! shape (M, N), a whole map; N = 1 for a profile
      logical, allocatable, intent(in) :: missing(:, :)       !! shape of height; not allocated if none is missing
      integer, intent(out) :: number                          !! of spikes
      logical, intent(in) :: replace                          !! by the median of the neighbours; their number only

      real(dp) :: median, spread, spreads
      logical, allocatable :: there(:, :)
      real(dp), allocatable :: was(:, :)
      integer :: i, j, pass

      allocate (was, source=height)
      allocate (there(size(height, 1), size(height, 2)), source=.true.)
      if (allocated(missing)) there = .not. missing
      number = 0
      spreads = 0.0_dp
      do pass = 1, 2
         do j = 1, size(height, 2)
            do i = 1, size(height, 1)
               if (.not. there(i, j)) cycle
               call look_around(i, j, median, spread)
               if (pass == 1) spreads = spreads + spread
               if (pass == 1) cycle
               if (.not. abs(was(i, j) - median) > reach_of_spike*max(spread, spreads/size(height))) cycle
               number = number + 1
               if (replace) height(i, j) = median
            end do
         end do
      end do

   contains

      !> The median of the neighbours of a height that are there, and by how much they differ without the sixth of them
      !> at either end, which may be parts of the same spike. With fewer than six a height is its own median.
      pure subroutine look_around(i, j, median, spread)
         integer, intent(in) :: i, j
         real(dp), intent(out) :: median, spread

         real(dp) :: sorted((2*around_in_map + 1)**2)
         integer :: around(2), k, l, m, n

         around = around_in_map
         if (size(height, 2) == 1) around = [around_in_profile, 0]
         n = 0
         do l = max(1, j - around(2)), min(size(height, 2), j + around(2))
            do k = max(1, i - around(1)), min(size(height, 1), i + around(1))
               if ((k == i .and. l == j) .or. .not. there(k, l)) cycle
               n = n + 1
               do m = n, 2, -1
                  if (sorted(m - 1) <= was(k, l)) exit
                  sorted(m) = sorted(m - 1)
               end do
               sorted(m) = was(k, l)
            end do
         end do
         median = was(i, j)
         spread = 0.0_dp
         if (n < 6) return
         median = 0.5_dp*(sorted((n + 1)/2) + sorted(n/2 + 1))
         spread = sorted(n - n/6) - sorted(1 + n/6)
      end subroutine look_around

   end subroutine find_spikes

end module wavycon_spikes
