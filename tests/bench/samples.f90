!> Times of repeated runs: median, smallest and largest.
module samples
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: sample_set, clock_ms

   !> A set keeps so many times and ignores later ones.
   integer, parameter :: capacity = 10000

   type :: sample_set
      integer :: count = 0
      real(dp), allocatable, private :: times(:)   !! [ms]
   contains
      procedure :: add
      procedure :: median
      procedure :: least
      procedure :: largest
   end type sample_set

contains

   !> The processor time since the program began [ms]: on one thread it does not depend on what else the machine does.
   real(dp) function clock_ms()
      call cpu_time(clock_ms)
      clock_ms = 1000*clock_ms
   end function clock_ms

   subroutine add(self, time)
      class(sample_set), intent(inout) :: self
      real(dp), intent(in) :: time   !! [ms]

      if (.not. allocated(self%times)) allocate (self%times(capacity))
      if (self%count == capacity) return
      self%count = self%count + 1
      self%times(self%count) = time
   end subroutine add

   !> The middle time; of an even number of times the later one of the two in the middle.
   pure real(dp) function median(self)
      class(sample_set), intent(in) :: self   !! not empty

      real(dp) :: candidate
      integer :: i

      ! The smallest time that more than half of the times do not exceed.
      median = huge(median)
      do i = 1, self%count
         candidate = self%times(i)
         if (candidate >= median) cycle
         if (2*count(self%times(:self%count) <= candidate) > self%count) median = candidate
      end do
   end function median

   pure real(dp) function least(self)
      class(sample_set), intent(in) :: self   !! not empty

      least = minval(self%times(:self%count))
   end function least

   pure real(dp) function largest(self)
      class(sample_set), intent(in) :: self   !! not empty

      largest = maxval(self%times(:self%count))
   end function largest

end module samples
