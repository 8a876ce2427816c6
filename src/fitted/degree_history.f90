!> Solutions of rising degree: the estimates of their errors, and which of them is best.
module wavycon_degree_history
   use wavycon_error_estimate, only: at_point, error_estimate
   use wavycon_expansion, only: expansion
   use wavycon_fitted_answer, only: most_previous
   use wavycon_fitted_measures, only: all_measures, centre_measure, energy_measure, peak_measure, &
      perimeter_measure
   use wavycon_fitted_tuning, only: fastest_decay
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: degree_history

   type :: degree_history
      integer :: solutions = 0                                     !! pushed so far
      real(dp) :: measures(all_measures) = 0.0_dp                  !! of the newest solution
      real(dp) :: error(all_measures) = huge(1.0_dp)               !! their estimated errors
      real(dp) :: best_error(all_measures) = huge(1.0_dp)          !! those of the best solution
      logical :: newest_is_best = .false.
      real(dp), private :: difference(all_measures) = huge(1.0_dp) !! of the newest two
      real(dp) :: decay(2) = 1.0_dp                                !! of the misfit to the newest solution, and before
      real(dp), private :: misfit = huge(1.0_dp)                   !! of the newest solution
      type(expansion) :: newest(0:most_previous)                   !! the newest first, as many as there are
   contains
      procedure :: push
      procedure :: best_meets
      procedure, private :: estimate
   end type degree_history

   !> Solutions that it takes for an estimate.
   integer, parameter :: least_solutions = 2
   !> Least relative errors over what Newton's method leaves of the shape, relative to its size. It matters where the
   !> iteration ended at its limit of steps; otherwise the remainder is a tenth of the accuracy or less.
   real(dp), parameter, public :: error_per_remainder = 2.0_dp

contains

   !> Adds the solution of the next degree. From the second one on its errors are estimated.
   pure subroutine push(self, now, measures, misfit, remaining)
      class(degree_history), intent(inout) :: self
      type(expansion), intent(in) :: now
      real(dp), intent(in) :: measures(all_measures)   !! > 0, of the solution
      real(dp), intent(in) :: misfit                   !! >= 0, what the solution leaves of the equations, as a mean
      real(dp), intent(in) :: remaining                !! that Newton's method leaves of the shape, relative to its size

      real(dp) :: difference(all_measures)
      integer :: k

      self%newest_is_best = .false.
      if (self%solutions > 0) then
         difference = abs(measures - self%measures)
         self%decay = [min(max(misfit/max(self%misfit, tiny(misfit)), fastest_decay), 1.0_dp), self%decay(1)]
         call self%estimate(measures, difference, remaining)
         ! Close to merging a higher degree may be worse.
         self%newest_is_best = self%solutions < least_solutions
         if (.not. self%newest_is_best) self%newest_is_best = sum(self%error(:peak_measure)/measures(:peak_measure)) &
            < sum(self%best_error(:peak_measure)/measures(:peak_measure))
         if (self%newest_is_best) self%best_error = self%error
         self%difference = difference
      end if
      self%measures = measures
      self%misfit = misfit
      do k = most_previous, 1, -1
         self%newest(k) = self%newest(k - 1)
      end do
      self%newest(0) = now
      self%solutions = self%solutions + 1
   end subroutine push

   !> Estimates the errors of a new solution. A pool's gap at its trough converges as fields do, later than
   !> integrals of them, and energy and perimeter converge at rates of their own: they are estimated apart from the
   !> rest.
   pure subroutine estimate(self, measures, difference, remaining)
      class(degree_history), intent(inout) :: self
      real(dp), intent(in) :: measures(all_measures)
      real(dp), intent(in) :: difference(all_measures)   !! from the solution before
      real(dp), intent(in) :: remaining                  !! as of push

      call estimate_group(self, 1, peak_measure, self%decay)
      call estimate_group(self, centre_measure, centre_measure, at_point(self%decay))
      call estimate_group(self, energy_measure, all_measures, self%decay)
      ! The perimeter converges no faster than the area, and its differences are small by chance more often.
      self%error(perimeter_measure) = max(self%error(perimeter_measure), measures(perimeter_measure) &
                                          *maxval(self%error(:peak_measure)/measures(:peak_measure)))
      ! The last term of README.md (F44).
      self%error = max(self%error, error_per_remainder*remaining*measures)

   contains

      pure subroutine estimate_group(history, first, last, decay)
         class(degree_history), intent(inout) :: history
         integer, intent(in) :: first, last
         real(dp), intent(in) :: decay(2)

         call error_estimate(difference(first:last), history%difference(first:last), decay, measures(first:last), &
                             history%error(first:last))
      end subroutine estimate_group

   end subroutine estimate

   !> Whether the best solution is as accurate as required, relative to the measures.
   pure logical function best_meets(self, accuracy, required)
      class(degree_history), intent(in) :: self
      real(dp), intent(in) :: accuracy      !! > 0
      integer, intent(in) :: required       !! number of measures, in their order, that have to be as accurate

      best_meets = self%solutions >= least_solutions &
         .and. all(self%best_error(:required) <= accuracy*self%measures(:required))
   end function best_meets

end module wavycon_degree_history
