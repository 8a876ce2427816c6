!> The gaps and the pressure at trough and saddle, with estimates of their errors.
!>
!> The error of the expansion is estimated from the values that the lower degrees give at the same places, that of the
!> integrals over near images from a second evaluation by finer rules.
module wavycon_fitted_details
   use wavycon_error_estimate, only: error_estimate
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_fields, only: fitted_separations
   use wavycon_fitted_tuning, only: fastest_decay_at_point
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: find_fitted_details

contains

   subroutine find_fitted_details(lattice, answer, values, error)
      type(wave_lattice), intent(in) :: lattice    !! the answer's
      type(fitted_answer), intent(in) :: answer    !! with a solution, status <= fitted_less_exact
      real(dp), intent(out) :: values(3)           !! as of fitted_separations: trough gap, saddle gap, saddle pressure
      real(dp), intent(out) :: error(3)            !! estimates of their errors

      !> Accuracy of the second evaluation.
      real(dp), parameter :: finer = 1e-15_dp
      real(dp) :: at(3, 0:size(answer%previous)), decay(2), scale(3)
      type(fitted_answer) :: older
      integer :: i, k

      values = fitted_separations(lattice, answer)
      at(:, 0) = values
      older = answer
      do k = 1, size(answer%previous)
         older%solution = answer%previous(k)
         if (.not. answer%pool) older%mean_gap = 1.0_dp - older%solution%approach
         at(:, k) = fitted_separations(lattice, older)
      end do
      ! All but the gap inside a pool are differences of numbers of order 1: their rounding is absolute.
      scale = 1.0_dp
      if (answer%pool) scale(1) = at(1, 0)
      ! One by one: the saddle may be about to close while the trough is wide open.
      do i = 1, size(values)
         decay = answer%misfit_decay
         ! The gap inside a pool is a value of the expansion, where the others are integrals of it.
         if (answer%pool .and. i == 1) decay = max(decay, fastest_decay_at_point)
         error(i:i) = error_estimate(at(i:i, :), decay, scale(i:i))
      end do
      ! A spot's approach is part of both gaps.
      if (.not. answer%pool) error(:2) = max(error(:2), answer%mean_gap_error)
      error = error + abs(fitted_separations(lattice, answer, finer) - values)
      ! A gap in contact and a pressure outside of it are 0 by definition.
      error(merge(2, 3, answer%pool)) = 0.0_dp
   end subroutine find_fitted_details

end module wavycon_fitted_details
