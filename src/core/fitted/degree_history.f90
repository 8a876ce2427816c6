!> The solutions of one load with rising degrees: estimates of their errors from their differences, and which solution
!> is the best one.
module wavycon_degree_history
   use wavycon_fitted_answer, only: most_previous
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_measures, only: all_measures, centre_measure, energy_measure, load_measure, perimeter_measure
   use wavycon_fitted_tuning, only: error_safety, fastest_decay, fastest_decay_at_point, first_error_factor, &
      least_relative_share, previous_difference_share
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: degree_history, error_estimate

   type :: degree_history
      integer :: required = load_measure                           !! the measures 1 to `required` have to be accurate
      integer :: solutions = 0                                     !! number of solutions so far
      real(dp) :: measures(all_measures, 0:most_previous) = 0.0_dp !! measures of the last solutions, the newest first
      real(dp) :: error(all_measures) = huge(1.0_dp)               !! error estimates of the newest solution's measures
      real(dp) :: best_error(all_measures) = huge(1.0_dp)          !! error estimates of the best solution's measures
      logical :: newest_is_best = .false.                          !! whether the newest solution is the best one
      real(dp) :: decay(2) = 1.0_dp                                !! chi_n and chi_(n-1): misfit over the one before
      real(dp), private :: misfit = huge(1.0_dp)                   !! misfit of the newest solution
      type(fitted_function) :: newest(0:most_previous)             !! the last solutions, the newest first
   contains
      procedure :: push, best_meets
   end type degree_history

   !> The number of solutions that an error estimate needs.
   integer, parameter :: least_solutions = 2
   !> Least relative error of a measure over the relative error of the shape that Newton's method leaves. This bound
   !> matters if the iteration ended at its limit of steps. Otherwise the remainder is a tenth of the accuracy or less.
   real(dp), parameter, public :: error_per_remainder = 2.0_dp

contains

   !> Adds the solution of the next degree, and estimates its errors if it is not the first one.
   pure subroutine push(self, now, measures, reference, misfit, remaining)
      class(degree_history), intent(inout) :: self
      type(fitted_function), intent(in) :: now
      real(dp), intent(in) :: measures(all_measures)   !! measures of the solution
      real(dp), intent(in) :: reference(all_measures)  !! what errors of the measures are relative to, > 0
      real(dp), intent(in) :: misfit                   !! >= 0, mean residual of the equations, as of least_squares_step
      real(dp), intent(in) :: remaining                !! relative error of the shape that Newton's method leaves

      integer :: k

      self%solutions = self%solutions + 1
      self%measures(:, 1:) = self%measures(:, :most_previous - 1)
      self%measures(:, 0) = measures
      self%newest_is_best = self%solutions == least_solutions
      if (self%solutions >= least_solutions) then
         self%decay = [min(max(misfit/max(self%misfit, tiny(misfit)), fastest_decay), 1.0_dp), self%decay(1)]
         ! The errors of a pool's gap at the trough, and those of energy and perimeter, are estimated apart from the
         ! rest. The gap is a value at a point, which converges more slowly than integrals. Energy and perimeter
         ! converge at rates of their own.
         associate (values => self%measures(:, :min(self%solutions - 1, most_previous)), error => self%error)
            error = [error_estimate(values(:load_measure, :), self%decay, reference(:load_measure)), &
                     error_estimate(values([centre_measure], :), max(self%decay, fastest_decay_at_point), &
                                    reference([centre_measure])), &
                     error_estimate(values(energy_measure:, :), self%decay, reference(energy_measure:))]
            ! The perimeter converges no faster than the area, but its differences are small by chance more often. So
            ! its relative error is at least the largest one of the first measures.
            error(perimeter_measure) = max(error(perimeter_measure), measures(perimeter_measure) &
                                           *maxval(error(:load_measure)/reference(:load_measure)))
            ! The last term of README.md (F44).
            error = max(error, error_per_remainder*remaining*reference)
         end associate
         ! Close to merging a higher degree may be less accurate than a lower one. Where the first measures are exact to
         ! rounding, the gap at the trough may still become more accurate.
         associate (n => self%required)
            if (.not. self%newest_is_best) self%newest_is_best = &
               sum(self%error(:n)/reference(:n)) < sum(self%best_error(:n)/reference(:n))
         end associate
         if (self%newest_is_best) self%best_error = self%error
      end if
      self%misfit = misfit
      do k = most_previous, 1, -1
         self%newest(k) = self%newest(k - 1)
      end do
      self%newest(0) = now
   end subroutine push

   !> Whether the errors of the best solution are within the largest allowed ones.
   pure logical function best_meets(self, allowed)
      class(degree_history), intent(in) :: self
      real(dp), intent(in) :: allowed(all_measures)   !! > 0; the first `required` ones are used

      associate (n => self%required)
         best_meets = self%solutions >= least_solutions .and. all(self%best_error(:n) <= allowed(:n))
      end associate
   end function best_meets

   !> Estimates the errors of values from those of lower degrees: README.md (F43) and, without its last term, (F44).
   !>
   !> The difference of two degrees is about the error of the lower one. The error of the higher one is smaller by the
   !> decay of the misfit from the one degree to the other. The misfit is a mean over all points of collocation, so that
   !> its decay is hardly ever small by chance, while differences of single values are. For the same reason an estimate
   !> is at least a share of the previous difference times both decays. Further lower bounds are rounding and a share of
   !> the largest relative error of all values: integrals such as the mean gap converge faster than the shape, but not
   !> much.
   !>
   !> N.B. These are estimates, not bounds. They hold for thousands of loads; those of the perimeter of spots on a
   !> rhombic lattice are too small now and then.
   pure function error_estimate(values, decay, reference) result(error)
      real(dp), intent(in) :: values(:, 0:)   !! n values at the last 2 or 3 degrees, the highest first, shape (n, 0:.)
      real(dp), intent(in) :: decay(2)        !! decay of the misfit, chi_n and chi_(n-1) <= 1
      real(dp), intent(in) :: reference(:)    !! what relative errors are relative to, > 0, shape (n)
      real(dp) :: error(size(reference))

      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)   !! relative

      if (ubound(values, 2) == 1) then
         error = first_error_factor*decay(1)*abs(values(:, 0) - values(:, 1))
      else
         error = decay(1)*max(abs(values(:, 0) - values(:, 1)), &
                              previous_difference_share*decay(2)*abs(values(:, 1) - values(:, 2)))
      end if
      error = max(error_safety*error, rounding*reference)
      error = max(error, least_relative_share*reference*maxval(error/reference))
   end function error_estimate

end module wavycon_degree_history
