!> The load of a pressure on a grid, and pressures of a given load between zero and the hardness: equation (C24) of
!> README.md in this directory.
module wavycon_pressure_load
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: set_load, sum_of_field

contains

   !> Changes a pressure so that its sum is that of a load. Without points at H the pressure is multiplied by a factor.
   !> Otherwise those between zero and H change: a lack is shared in proportion to H - p, an excess in proportion to p. Where
   !> they cannot take all of it the other points change likewise.
   pure subroutine set_load(pressure, load, hardness)
      real(dp), intent(inout) :: pressure(:, :)   !! p, >= 0; more than H becomes H
      real(dp), intent(in) :: load                !! sum of the pressures, > 0 and < H times their number
      real(dp), intent(in) :: hardness            !! H, huge if there is none

      real(dp) :: lack, shares(size(pressure, 2))
      logical :: among_free
      integer :: j

      if (.not. has_points_at(hardness, pressure)) then
         pressure = pressure*(load/sum_of_field(pressure))
         if (.not. has_points_at(hardness, pressure)) return
      end if
      pressure = min(pressure, hardness)
      lack = load - sum_of_field(pressure)
      do j = 1, size(pressure, 2)
         shares(j) = sum(share(pressure(:, j)), pressure(:, j) > 0.0_dp .and. pressure(:, j) < hardness)
      end do
      among_free = sum(shares) > abs(lack)
      if (.not. among_free) shares = [(sum(share(pressure(:, j))), j=1, size(pressure, 2))]
      if (.not. sum(shares) > 0.0_dp) return
      lack = lack/sum(shares)
      do j = 1, size(pressure, 2)
         where (.not. among_free .or. (pressure(:, j) > 0.0_dp .and. pressure(:, j) < hardness)) &
            pressure(:, j) = min(max(pressure(:, j) + lack*share(pressure(:, j)), 0.0_dp), hardness)
      end do

   contains

      !> The part of the lack that a pressure takes, but for a factor.
      elemental real(dp) function share(p)
         real(dp), intent(in) :: p

         share = merge(hardness - p, p, lack > 0.0_dp)
      end function share

   end subroutine set_load

   pure logical function has_points_at(hardness, pressure)
      real(dp), intent(in) :: hardness, pressure(:, :)

      has_points_at = hardness < huge(hardness)
      if (has_points_at) has_points_at = any(pressure >= hardness)
   end function has_points_at

   !> Sum of a field, column by column.
   pure real(dp) function sum_of_field(field) result(total)
      real(dp), intent(in) :: field(:, :)

      integer :: j

      total = sum([(sum(field(:, j)), j=1, size(field, 2))])
   end function sum_of_field

end module wavycon_pressure_load
