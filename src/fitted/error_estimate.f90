!> Errors of what expansions of rising degree give.
module wavycon_error_estimate
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: error_estimate

   !> Below this reach of the edge shapes are round and the terms that turn with the angle matter less: some
   !> degrees add next to nothing, so that the decay of the differences is a guide to the next one.
   real(dp), parameter, public :: round_reach = 0.75_dp

contains

   !> Errors from the last difference of two degrees and the ones before.
   pure subroutine error_estimate(difference, last_difference, last_decay, value, error)
      real(dp), intent(in) :: difference(:)       !! >= 0
      real(dp), intent(in) :: last_difference(:)  !! the one before; huge if there is none
      real(dp), intent(in) :: last_decay(:)       !! of that one over the one before it; 1 if no guide
      real(dp), intent(in) :: value(:)
      real(dp), intent(out) :: error(:)

      !> The next difference is never taken to fall by more than this.
      real(dp), parameter :: fastest_decay = 0.5_dp
      !> A difference that is small by chance, which happens where the terms that a degree adds hardly matter,
      !> is known by the one before, which has to go on falling.
      real(dp), parameter :: most_of_last = 0.1_dp
      !> On everything: with it the estimates of hundreds of loads hold, those of the perimeter of a rhombic
      !> lattice's spots aside, which now and then are too small.
      real(dp), parameter :: safety = 3.0_dp
      !> The mean gap converges faster than the rest, but not by much more than this.
      real(dp), parameter :: least_of_others = 0.02_dp
      !> In units of the last place.
      real(dp), parameter :: rounding = 64*epsilon(1.0_dp)

      where (last_difference < huge(1.0_dp))
         error = min(max(sqrt(difference/max(last_difference, tiny(1.0_dp))), fastest_decay), 1.0_dp) &
            *difference
         error = max(error, min(most_of_last, sqrt(last_decay))*last_difference)
      elsewhere
         error = difference
      end where
      error = max(safety*error, rounding*value)
      error = max(error, least_of_others*value*maxval(error/value))
   end subroutine error_estimate

end module wavycon_error_estimate
