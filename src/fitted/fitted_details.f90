!> The gaps and the pressure at trough and saddle, with estimates of their errors.
!>
!> The error of the expansion is estimated from the values that the lower degrees give at the same places, that of the
!> integrals over near images from a second evaluation by finer rules.
module wavycon_fitted_details
   use wavycon_error_estimate, only: at_point, error_estimate
   use wavycon_fitted_answer, only: fitted_answer, most_previous
   use wavycon_fitted_fields, only: fitted_separations
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: fitted_details, find_fitted_details

   !> Gaps in Delta, pressure in the unit of the lattice's, pi E* Delta/s.
   type :: fitted_details
      real(dp) :: trough_gap = 0.0_dp
      real(dp) :: saddle_gap = 0.0_dp               !! 0 above merging
      real(dp) :: saddle_pressure = 0.0_dp          !! 0 below merging
      real(dp) :: trough_gap_error = huge(1.0_dp)   !! estimated errors
      real(dp) :: saddle_gap_error = huge(1.0_dp)
      real(dp) :: saddle_pressure_error = huge(1.0_dp)
   end type fitted_details

contains

   subroutine find_fitted_details(lattice, answer, details)
      type(wave_lattice), intent(in) :: lattice    !! the answer's
      type(fitted_answer), intent(in) :: answer    !! with a solution, status <= fitted_less_exact
      type(fitted_details), intent(out) :: details

      !> Accuracy of the second evaluation.
      real(dp), parameter :: finer = 1e-15_dp
      !> Trough gap, saddle gap, saddle pressure.
      integer, parameter :: values = 3
      real(dp) :: at(values, 0:most_previous), by_finer_rules(values)
      real(dp), dimension(values) :: difference, error, previous_difference, scale
      type(fitted_answer) :: older
      integer :: i, k

      call separations(lattice, answer, at(:, 0))
      call separations(lattice, answer, by_finer_rules, accuracy=finer)
      older = answer
      do k = 1, size(answer%previous)
         older%solution = answer%previous(k)
         if (.not. answer%island) older%mean_gap = 1.0_dp - older%solution%approach
         call separations(lattice, older, at(:, k))
      end do
      difference = abs(at(:, 0) - at(:, 1))
      previous_difference = huge(1.0_dp)
      if (size(answer%previous) > 1) previous_difference = abs(at(:, 1) - at(:, 2))
      ! All but the gap inside an island are differences of numbers of order 1: their rounding is absolute.
      scale = 1.0_dp
      if (answer%island) scale(1) = at(1, 0)
      ! One by one: the saddle may be about to close while the trough is wide open.
      do i = 1, values
         call error_estimate(difference(i:i), previous_difference(i:i), answer%misfit_decay, scale(i:i), error(i:i))
      end do
      if (answer%island) then
         ! A value of the expansion, where the others are integrals of it.
         call error_estimate(difference(1:1), previous_difference(1:1), at_point(answer%misfit_decay), scale(1:1), &
                             error(1:1))
      else
         ! The approach is part of both gaps.
         error(:2) = max(error(:2), answer%mean_gap_error)
      end if
      error = error + abs(by_finer_rules - at(:, 0))
      details = fitted_details(at(1, 0), at(2, 0), at(3, 0), error(1), error(2), error(3))
      ! A gap in contact and a pressure outside of it are 0 by definition.
      if (answer%island) details%saddle_gap_error = 0.0_dp
      if (.not. answer%island) details%saddle_pressure_error = 0.0_dp
   end subroutine find_fitted_details

   subroutine separations(lattice, answer, values, accuracy)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: answer
      real(dp), intent(out) :: values(:)             !! trough gap, saddle gap, saddle pressure, shape (3)
      real(dp), intent(in), optional :: accuracy   !! of the integrals

      call fitted_separations(lattice, answer, values(1), values(2), values(3), accuracy)
   end subroutine separations

end module wavycon_fitted_details
