!> The gaps and the pressure at trough and saddle, with estimates of their errors.
!>
!> What the expansions of the degrees before give at the same places tells how far they have converged; a
!> second evaluation by finer rules, how exactly the integrals over near images are done.
module wavycon_fitted_details
   use wavycon_error_estimate, only: error_estimate
   use wavycon_fitted_answer, only: expansions_before, fitted_answer
   use wavycon_fitted_fields, only: fitted_separations
   use wavycon_fitted_tuning, only: detail_refinement, round_shape_ratio
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: fitted_details, find_fitted_details

   !> Gaps in Delta, pressure in p*.
   type :: fitted_details
      real(dp) :: trough_gap = 0.0_dp
      real(dp) :: saddle_gap = 0.0_dp               !! 0 above merging
      real(dp) :: saddle_pressure = 0.0_dp          !! 0 below merging
      real(dp) :: trough_gap_error = huge(1.0_dp)   !! estimates
      real(dp) :: saddle_gap_error = huge(1.0_dp)
      real(dp) :: saddle_pressure_error = huge(1.0_dp)
   end type fitted_details

contains

   subroutine find_fitted_details(lattice, answer, details)
      type(wave_lattice), intent(in) :: lattice    !! the answer's
      type(fitted_answer), intent(in) :: answer    !! solved, status <= fitted_less_exact
      type(fitted_details), intent(out) :: details

      !> Trough gap, saddle gap, saddle pressure.
      integer, parameter :: values = 3
      real(dp) :: at(values, 0:expansions_before), by_finer_rules(values)
      real(dp), dimension(values) :: decay, difference, error, last_difference, scale
      type(fitted_answer) :: older
      integer :: i, k

      call separations(lattice, answer, at(:, 0))
      call separations(lattice, answer, by_finer_rules, fineness=detail_refinement)
      older = answer
      do k = 1, size(answer%before)
         older%solution = answer%before(k)
         if (.not. answer%island) older%mean_gap = 1.0_dp - older%solution%approach
         call separations(lattice, older, at(:, k))
      end do
      difference = abs(at(:, 0) - at(:, 1))
      last_difference = huge(1.0_dp)
      if (size(answer%before) > 1) last_difference = abs(at(:, 1) - at(:, 2))
      decay = 1.0_dp
      if (size(answer%before) > 2 .and. answer%reach < round_shape_ratio) &
         decay = min(last_difference/max(abs(at(:, 2) - at(:, 3)), tiny(1.0_dp)), 1.0_dp)
      ! All but the gap inside an island are differences of numbers of order 1.
      scale = 1.0_dp
      if (answer%island) scale(1) = at(1, 0)
      ! One by one: a saddle may be about to close while the trough is wide open.
      do i = 1, values
         call error_estimate(difference(i:i), last_difference(i:i), decay(i:i), scale(i:i), error(i:i))
      end do
      error = error + abs(by_finer_rules - at(:, 0))
      details = fitted_details(at(1, 0), at(2, 0), at(3, 0), error(1), error(2), error(3))
      ! What is closed, or bears nothing, is exactly so.
      if (answer%island) details%saddle_gap_error = 0.0_dp
      if (.not. answer%island) details%saddle_pressure_error = 0.0_dp
   end subroutine find_fitted_details

   subroutine separations(lattice, answer, values, fineness)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: answer
      real(dp), intent(out) :: values(:)           !! trough gap, saddle gap, saddle pressure, shape (3)
      integer, intent(in), optional :: fineness    !! of the rules

      call fitted_separations(lattice, answer, values(1), values(2), values(3), fineness)
   end subroutine separations

end module wavycon_fitted_details
