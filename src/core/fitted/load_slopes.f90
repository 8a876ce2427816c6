!> The derivatives of mean gap and contact area by the load, from a fitted function. Equations (I..) are those of
!> src/beyond/README.md.
module wavycon_load_slopes
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_degree_history, only: error_estimate
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_tuning, only: series_growth
   use wavycon_gauss_newton, only: changes_with_load
   use wavycon_fitted_size, only: merging_ratio
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: find_load_slopes

   !> The derivatives in an array of slopes: G', A' of the contact area fraction, G''.
   integer, parameter :: number_of_slopes = 3

contains

   !> The derivatives of a solution by the load, with errors estimated from the derivatives of lower degrees.
   subroutine find_load_slopes(lattice, answer, slopes, errors, found)
      type(wave_lattice), intent(in) :: lattice    !! the lattice that was solved
      type(fitted_answer), intent(in) :: answer    !! the solution, status <= fitted_less_exact
      real(dp), intent(out) :: slopes(number_of_slopes)
         !! G', A', G'' [Delta/q, 1/q, Delta/q^2 with the unit of pressure q = pi E* Delta/s]
      real(dp), intent(out) :: errors(number_of_slopes)   !! estimates of their errors
      logical, intent(out) :: found                       !! false if the equations have no finite solution

      !> Relative error of G'' by the finite differences of Newton's matrix.
      real(dp), parameter :: of_differences = 1e-10_dp
      real(dp) :: of_degree(number_of_slopes, 0:size(answer%previous))
      integer :: k

      call slopes_of(lattice, answer%solution, slopes, found)
      of_degree(:, 0) = slopes
      do k = 1, size(answer%previous)
         if (.not. found) return
         call slopes_of(lattice, answer%previous(k), of_degree(:, k), found)
      end do
      if (.not. found) return
      errors = error_estimate(of_degree, answer%misfit_decay, abs(slopes))
      errors(3) = max(errors(3), of_differences*abs(slopes(3)))
   end subroutine find_load_slopes

   !> The derivatives of one fitted function by the load: (I4) to (I7b).
   subroutine slopes_of(lattice, now, slopes, found)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: now             !! the fitted function, a solution without adhesion
      real(dp), intent(out) :: slopes(number_of_slopes)    !! as of find_load_slopes
      logical, intent(out) :: found                        !! as of find_load_slopes

      type(contact_equations) :: equations
      real(dp), allocatable :: change(:), change_of_change(:)
      real(dp) :: by_shape(0:ubound(now%shape%b, 1)), load_change(2)   ! by_shape: derivatives of the area

      call equations%images%prepare(lattice, now, series_growth, epsilon(1.0_dp))
      call start_equations(equations, now, merging_ratio(lattice, now))
      allocate (change(equations%unknowns), change_of_change(equations%unknowns))
      call changes_with_load(equations, lattice, now, change, change_of_change, load_change, found)
      if (.not. found) return
      call now%shape%linearise_area(by_shape)
      slopes(2) = dot_product(by_shape, change(equations%before_shape + 1:))/lattice%area
      if (now%pool) then
         slopes([1, 3]) = lattice%troughs*load_change/lattice%area
         slopes(2) = -lattice%troughs*slopes(2)
      else
         slopes([1, 3]) = -[change(now%basis%terms + 1), change_of_change(now%basis%terms + 1)]
      end if
   end subroutine slopes_of

end module wavycon_load_slopes
