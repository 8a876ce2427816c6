!> Solutions of rising degree: the estimates of their errors, and which of them is best.
module wavycon_degree_history
   use wavycon_expansion, only: expansion
   use wavycon_fitted_answer, only: most_previous
   use wavycon_fitted_measures, only: all_measures, centre_measure, energy_measure, load_measure, perimeter_measure
   use wavycon_fitted_tuning, only: error_safety, fastest_decay, fastest_decay_at_point, first_error_factor, &
      least_relative_share, previous_difference_share
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: degree_history, error_estimate

   type :: degree_history
      integer :: solutions = 0                                     !! pushed so far
      real(dp) :: measures(all_measures, 0:most_previous) = 0.0_dp !! of the newest solutions, the newest first
      real(dp) :: scale(all_measures) = 0.0_dp                     !! what errors are relative to, of the newest
      real(dp) :: error(all_measures) = huge(1.0_dp)               !! their estimated errors
      real(dp) :: best_error(all_measures) = huge(1.0_dp)          !! those of the best solution
      logical :: newest_is_best = .false.
      real(dp) :: decay(2) = 1.0_dp                                !! of the misfit to the newest solution, and before
      real(dp), private :: misfit = huge(1.0_dp)                   !! of the newest solution
      type(expansion) :: newest(0:most_previous)                   !! the newest first, as many as there are
   contains
      procedure :: push
      procedure :: best_meets
   end type degree_history

   !> Solutions that it takes for an estimate.
   integer, parameter :: least_solutions = 2
   !> Least relative errors over what Newton's method leaves of the shape, relative to its size. It matters where the
   !> iteration ended at its limit of steps; otherwise the remainder is a tenth of the accuracy or less.
   real(dp), parameter, public :: error_per_remainder = 2.0_dp

contains

   !> Adds the solution of the next degree. From the second one on its errors are estimated.
   pure subroutine push(self, now, measures, scale, misfit, remaining)
      class(degree_history), intent(inout) :: self
      type(expansion), intent(in) :: now
      real(dp), intent(in) :: measures(all_measures)   !! of the solution
      real(dp), intent(in) :: scale(all_measures)      !! > 0, what errors are relative to
      real(dp), intent(in) :: misfit                   !! >= 0, what the solution leaves of the equations, as a mean
      real(dp), intent(in) :: remaining                !! that Newton's method leaves of the shape, relative to its size

      integer :: k

      self%solutions = self%solutions + 1
      self%measures(:, 1:) = self%measures(:, :most_previous - 1)
      self%measures(:, 0) = measures
      self%scale = scale
      self%newest_is_best = self%solutions == least_solutions
      if (self%solutions >= least_solutions) then
         self%decay = [min(max(misfit/max(self%misfit, tiny(misfit)), fastest_decay), 1.0_dp), self%decay(1)]
         ! A pool's gap at its trough converges as fields do, later than integrals of them, and energy and perimeter
         ! converge at rates of their own: their errors are estimated apart from the rest.
         associate (values => self%measures(:, :min(self%solutions - 1, most_previous)), error => self%error)
            error = [error_estimate(values(:load_measure, :), self%decay, scale(:load_measure)), &
                     error_estimate(values([centre_measure], :), max(self%decay, fastest_decay_at_point), &
                                    scale([centre_measure])), &
                     error_estimate(values(energy_measure:, :), self%decay, scale(energy_measure:))]
            ! The perimeter converges no faster than the area, and its differences are small by chance more often.
            error(perimeter_measure) = max(error(perimeter_measure), measures(perimeter_measure) &
                                           *maxval(error(:load_measure)/scale(:load_measure)))
            ! The last term of README.md (F44).
            error = max(error, error_per_remainder*remaining*scale)
         end associate
         ! Close to merging a higher degree may be worse.
         if (.not. self%newest_is_best) self%newest_is_best = sum(self%error(:load_measure)/scale(:load_measure)) &
            < sum(self%best_error(:load_measure)/scale(:load_measure))
         if (self%newest_is_best) self%best_error = self%error
      end if
      self%misfit = misfit
      do k = most_previous, 1, -1
         self%newest(k) = self%newest(k - 1)
      end do
      self%newest(0) = now
   end subroutine push

   !> Whether the best solution is as accurate as required, relative to the measures.
   pure logical function best_meets(self, accuracy, required)
      class(degree_history), intent(in) :: self
      real(dp), intent(in) :: accuracy      !! > 0
      integer, intent(in) :: required       !! number of measures, in their order, that have to be as accurate

      best_meets = self%solutions >= least_solutions &
         .and. all(self%best_error(:required) <= accuracy*self%scale(:required))
   end function best_meets

   !> Errors of values from those of the lower degrees: README.md (F43) and, but for its last term, (F44).
   !>
   !> A difference of two degrees is about the error of the lower one. That of the higher one is smaller by the decay of
   !> the misfit, which is measured at all points of collocation and is hardly ever small by chance, as differences of
   !> single values are. The difference before, carried on by the decays since, is a lower limit for the same reason.
   !> Other limits are rounding and a share of the values' largest relative error: integrals such as the mean gap
   !> converge faster than the shape, but not by much.
   !>
   !> N.B. These are estimates, no bounds. They hold for thousands of loads; those of the perimeter of a rhombic
   !> lattice's spots are too small now and then.
   pure function error_estimate(values, decay, scale) result(error)
      real(dp), intent(in) :: values(:, 0:)   !! at the last two or three degrees, the highest one first, shape (n, 0:.)
      real(dp), intent(in) :: decay(2)        !! chi_n and chi_(n-1) <= 1, of the misfit
      real(dp), intent(in) :: scale(:)        !! > 0, what rounding and shares are relative to, shape (n)
      real(dp) :: error(size(scale))

      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)   !! relative

      if (ubound(values, 2) == 1) then
         error = first_error_factor*decay(1)*abs(values(:, 0) - values(:, 1))
      else
         error = decay(1)*max(abs(values(:, 0) - values(:, 1)), &
                              previous_difference_share*decay(2)*abs(values(:, 1) - values(:, 2)))
      end if
      error = max(error_safety*error, rounding*scale)
      error = max(error, least_relative_share*scale*maxval(error/scale))
   end function error_estimate

end module wavycon_degree_history
