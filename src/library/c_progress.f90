!> A callback of C that solvers ask whether to stop.
module wavycon_c_progress
   use, intrinsic :: iso_c_binding, only: c_double, c_int, c_null_ptr, c_ptr
   use wavycon_kinds, only: dp
   use wavycon_solver_progress, only: solver_progress
   implicit none (type, external)
   private

   public :: c_progress, progress_callback

   abstract interface
      integer(c_int) function progress_callback(data, iterations, residual) bind(c)
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: data
         integer(c_int), value :: iterations
         real(c_double), value :: residual
      end function progress_callback
   end interface

   type, extends(solver_progress) :: c_progress
      procedure(progress_callback), pointer, nopass :: callback => null()
      type(c_ptr) :: data = c_null_ptr
   contains
      procedure :: grid_solved
      procedure :: shall_stop
   end type c_progress

contains

   subroutine grid_solved(self, points, iterations, residual)
      class(c_progress), intent(in) :: self
      integer, intent(in) :: points(2), iterations
      real(dp), intent(in) :: residual

      associate (unused => self, also_unused => points, unused_too => iterations, not_used => residual); end associate
   end subroutine grid_solved

   logical function shall_stop(self, iterations, residual)
      class(c_progress), intent(in) :: self
      integer, intent(in) :: iterations
      real(dp), intent(in) :: residual

      shall_stop = .false.
      if (associated(self%callback)) shall_stop = self%callback(self%data, int(iterations, c_int), residual) /= 0
   end function shall_stop

end module wavycon_c_progress
