!> Gauss-Newton steps for the coefficients and the shape of an expansion.
module wavycon_gauss_newton
   use wavycon_contact_equations, only: contact_equations
   use wavycon_expansion, only: expansion
   use wavycon_fitted_tuning, only: least_centre_jacobian, longest_shape_change
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgels, dgglse
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: gauss_newton_step

contains

   !> One step: the equations by least squares, a spot's load exactly.
   subroutine gauss_newton_step(equations, lattice, load, now, change, residual, ok)
      type(contact_equations), intent(inout) :: equations  !! started for expansions like `now`
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load                         !! P
      type(expansion), intent(inout) :: now
      real(dp), intent(out) :: change                      !! largest change of the shape over its size
      real(dp), intent(out) :: residual                    !! largest of the equations before the step [Delta, p*]
      logical, intent(out) :: ok                           !! the step is finite and its shape is one

      real(dp) :: constraint(1, equations%unknowns), missing(1), step(equations%unknowns)
      real(dp) :: work(64*(size(equations%rest) + equations%unknowns + 1)), part
      integer :: info, m, n, others, shapes, terms

      m = size(equations%rest)
      n = equations%unknowns
      terms = now%basis%terms
      shapes = n - size(now%shape%b)
      others = shapes - terms
      call equations%linearise(lattice, load, now)
      residual = maxval(abs(equations%rest))
      change = huge(change)
      ok = .false.
      ! LAPACK may loop for ever on what is not finite.
      if (.not. (residual < huge(residual) .and. maxval(abs(equations%matrix)) < huge(residual))) return
      if (now%island) then
         call dgels('N', m, n, 1, equations%matrix, m, equations%rest, m, work, size(work), info)
         step = equations%rest(:n)
      else
         constraint(1, :) = equations%load_row
         missing = load*lattice%area - equations%integral(now)
         call dgglse(m, n, 1, equations%matrix, m, constraint, 1, equations%rest, missing, step, work, &
                     size(work), info)
      end if
      if (info /= 0 .or. .not. maxval(abs(step)) < huge(residual)) return
      change = maxval(abs(step(shapes + 1:)))/now%shape%b(0)
      part = min(1.0_dp, longest_shape_change/max(change, tiny(change)))
      now%c = now%c + part*step(:terms)
      if (.not. now%island) now%approach = now%approach + part*step(terms + 1)
      now%shape%b = now%shape%b + part*step(shapes + 1:)
      ok = now%shape%b(0) > 0.0_dp .and. now%shape%jacobian((0.0_dp, 0.0_dp)) > least_centre_jacobian*now%shape%b(0)**2
   end subroutine gauss_newton_step

end module wavycon_gauss_newton
