!> Random numbers that are the same on every machine, with a separate stream for each case.
module stress_random_numbers
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: random_stream

   !> A shift-register generator (Marsaglia, J. Stat. Softw. 8 (2003) 14: the triple 13, 7, 17).
   type :: random_stream
      integer(int64), private :: state = 1   !! never 0
   contains
      procedure :: start, uniform, whole, chance
   end type random_stream

contains

   !> Starts the stream of a case. Any case can be made without those before it.
   subroutine start(self, seed, case)
      class(random_stream), intent(inout) :: self
      integer, intent(in) :: seed   !! of the campaign, >= 0
      integer, intent(in) :: case   !! number of the case, >= 0

      real(dp) :: ignored
      integer :: i

      self%state = ieor(ishft(int(seed, int64) + 1, 32), int(case, int64))
      ! The first numbers of neighbouring states are alike.
      do i = 1, 50
         ignored = self%uniform()
      end do
   end subroutine start

   !> The next number, 0 <= number < 1.
   real(dp) function uniform(self)
      class(random_stream), intent(inout) :: self

      integer, parameter :: bits = 52

      self%state = ieor(self%state, ishft(self%state, 13))
      self%state = ieor(self%state, ishft(self%state, -7))
      self%state = ieor(self%state, ishft(self%state, 17))
      uniform = scale(real(ishft(self%state, bits - 64), dp), -bits)
   end function uniform

   !> An integer between two others, both included.
   integer function whole(self, least, greatest)
      class(random_stream), intent(inout) :: self
      integer, intent(in) :: least, greatest

      whole = least + int((greatest - least + 1)*self%uniform())
   end function whole

   !> True with a given probability.
   logical function chance(self, probability)
      class(random_stream), intent(inout) :: self
      real(dp), intent(in) :: probability

      chance = self%uniform() < probability
   end function chance

end module stress_random_numbers
