!> A solution of low degree at a load, by continuation from a load for which there is an approximation: the asymptotes
!> of light load and of nearly full contact.
module wavycon_load_continuation
   use wavycon_constants, only: pi
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_disc_polynomials, only: start_disc_polynomials
   use wavycon_expansion, only: expansion
   use wavycon_fitted_answer, only: fitted_answer, fitted_less_exact
   use wavycon_fitted_tuning, only: degree_step, first_degree, heavy_load_start, load_step_ratio, &
      start_degree
   use wavycon_gauss_newton, only: change_per_square, solve_equations
   use wavycon_kinds, only: dp
   use wavycon_lattice_images, only: lattice_images
   use wavycon_expansion_size, only: merging_ratio
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: crack_pool, hertz_spot, is_start, start_at_load

   !> Relative change of the shape at which Newton's method stops during continuation: the next load makes smaller ones
   !> useless.
   real(dp), parameter :: start_shape_change = 1e-2_dp

contains

   !> An approximation at a load, and the degree to go on with.
   !>
   !> A solution of a load that is within one step is scaled to the load. Otherwise an asymptote is followed in steps
   !> of the load to the one wanted: Hertz's for a spot, a penny-shaped crack for a pool. Where it touches its
   !> neighbours on the way, the regime has ended.
   subroutine start_at_load(lattice, load, pool, now, degree, iterations, found, merged, start)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load                    !! P
      logical, intent(in) :: pool                   !! the regime
      type(expansion), intent(out) :: now
      integer, intent(out) :: degree
      integer, intent(inout) :: iterations            !! Gauss-Newton steps are added
      logical, intent(out) :: found
      logical, intent(out) :: merged                  !! whether there is no start because the regime has ended
      type(fitted_answer), intent(in), optional :: start   !! a solution of another load

      real(dp) :: first_load

      degree = first_degree
      merged = .false.
      if (present(start)) then
         found = is_start(lattice, start, load, pool)
         if (found) then
            now = scaled_to_load(lattice, start%solution, start%pbar_over_pstar, load)
            ! Degrees below the last load's, or a sweep would never come down to lower ones again.
            degree = max(first_degree, start%degree - 3*degree_step)
            return
         end if
      end if
      if (pool) then
         first_load = max(load, heavy_load_start*lattice%closing_pressure)
         now = crack_pool(lattice, first_load)
      else
         ! From heavier ones Newton's method would start too far off.
         first_load = min(load, 0.06_dp)
         now = hertz_spot(lattice, first_load)
      end if
      call follow_load(lattice, first_load, load, now, iterations, found, merged)
   end subroutine start_at_load

   !> Whether a solution of another load is a start: in the same regime, within one step, and still apart from its
   !> neighbours when it is scaled to the load.
   logical function is_start(lattice, start, load, pool)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: start
      real(dp), intent(in) :: load                    !! P
      logical, intent(in) :: pool                   !! the regime

      is_start = start%status <= fitted_less_exact .and. (start%pool .eqv. pool)
      if (is_start) is_start = load_steps(lattice, start%pbar_over_pstar, load, pool) <= 1
      if (is_start) is_start = &
         merging_ratio(lattice, scaled_to_load(lattice, start%solution, start%pbar_over_pstar, load)) < 1.0_dp
   end function is_start

   !> Solves at one load after the other, from a first approximation to the load wanted.
   subroutine follow_load(lattice, first_load, last_load, now, iterations, found, merged)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: first_load, last_load   !! P
      type(expansion), intent(inout) :: now           !! at the first load; at the last one
      integer, intent(inout) :: iterations
      logical, intent(out) :: found
      logical, intent(out) :: merged                  !! as of start_at_load

      type(contact_equations) :: equations
      type(lattice_images) :: images
      real(dp) :: change, contraction, load, misfit, next, remaining, residual

      load = first_load
      merged = .false.
      do
         call images%prepare(lattice, now, 1.1_dp, start_shape_change**2)
         call start_equations(equations, now, 0.0_dp, images)
         contraction = 0.0_dp
         call solve_equations(equations, lattice, load, now, change_per_square*start_shape_change**2, contraction, &
                              change, remaining, residual, misfit, iterations, found)
         if (.not. found) exit
         ! The start of a load that was solved has come to a ratio of 0.92 at most, of many next to merging.
         merged = merging_ratio(lattice, now) >= 1.0_dp
         found = .not. merged
         if (merged .or. load_steps(lattice, load, last_load, now%pool) == 0) exit
         next = last_load
         if (load_steps(lattice, load, last_load, now%pool) > 1) then
            next = load_step_ratio*load
            if (now%pool) next = lattice%closing_pressure - load_step_ratio*(lattice%closing_pressure - load)
         end if
         now = scaled_to_load(lattice, now, load, next)
         load = next
      end do
   end subroutine follow_load

   !> Number of steps from one load to the other: of the ratio of P or, for pools, of the closing pressure less P.
   pure integer function load_steps(lattice, from, to, pool) result(steps)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: from, to      !! P
      logical, intent(in) :: pool

      real(dp) :: ratio

      ratio = to/from
      if (pool) ratio = (lattice%closing_pressure - to)/(lattice%closing_pressure - from)
      steps = ceiling(abs(log(ratio))/log(load_step_ratio))
   end function load_steps

   !> A Hertzian spot, elliptical where the curvatures of the crest differ: README.md (F41); paper, (23).
   function hertz_spot(lattice, load) result(spot)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load   !! P > 0
      type(expansion) :: spot

      real(dp) :: curvature(2), radius
      integer :: i

      curvature = 4*pi**2*[(sum(lattice%wave(i, :)**2*lattice%amplitude), i=1, 2)]
      radius = (3*pi*load*lattice%area/(4*sqrt(product(curvature))))**(1.0_dp/3)
      ! About the exact relation, which has elliptic integrals.
      spot = ellipse(.false., lattice%fold, radius, (curvature(1)/curvature(2))**0.6_dp)
      ! The first polynomial is constant, and (1 - rho^2)^(1/2) has the integral 2 pi/3.
      spot%c(1) = load*lattice%area/spot%shape%area()/sqrt(2*pi/3)*pi
      spot%approach = sqrt(product(curvature))*radius**2
   end function hertz_spot

   !> The opening of a penny-shaped crack at a trough, elliptical where the curvatures of the full contact's pressure
   !> differ: README.md (F42); paper, (24) and (A4)-(A8).
   function crack_pool(lattice, load) result(pool)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load  !! P < the closing pressure
      type(expansion) :: pool

      real(dp) :: curvature(2), missing, radius
      integer :: i

      curvature = -4*pi**2*[(sum(lattice%wave(i, :)**2*lattice%pressure*lattice%phase%re), i=1, 2)]
      missing = lattice%closing_pressure - load
      radius = sqrt(3*missing/sqrt(product(curvature)))
      ! Exact for slender ellipses.
      pool = ellipse(.true., lattice%trough_fold, radius, sqrt(curvature(1)/curvature(2)))
      ! The opening is g_0 (1 - rho^2)^(3/2), g_0 = (8/3) b (closing pressure - P), b the radius.
      pool%c(1) = 8*missing*radius/3*sqrt(0.4_dp*pi)
   end function crack_pool

   !> An expansion of low degree without coefficients, over a circle or, with two-fold symmetry, an ellipse.
   function ellipse(pool, fold, radius, ratio) result(now)
      logical, intent(in) :: pool
      integer, intent(in) :: fold          !! of the symmetry
      real(dp), intent(in) :: radius       !! mean of the semi-axes [s]
      real(dp), intent(in) :: ratio        !! of the axes along y and x
      type(expansion) :: now

      now%pool = pool
      call start_disc_polynomials(now%basis, fold, start_degree, merge(1.5_dp, 0.5_dp, pool))
      allocate (now%c(now%basis%terms), source=0.0_dp)
      now%shape%fold = fold
      allocate (now%shape%b(0:1))
      now%shape%b(:) = [radius, 0.0_dp]
      if (fold == 2) now%shape%b(1) = radius*(1.0_dp - ratio)/(1.0_dp + ratio)
   end function ellipse

   !> An approximation at another load: lengths, pressures and gaps are scaled as in the asymptotes.
   function scaled_to_load(lattice, from, old_load, new_load) result(scaled)
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: from
      real(dp), intent(in) :: old_load, new_load  !! P
      type(expansion) :: scaled

      real(dp) :: factor

      scaled = from
      if (from%pool) then
         factor = sqrt((lattice%closing_pressure - new_load)/(lattice%closing_pressure - old_load))
         scaled%c = from%c*factor**3
      else
         factor = (new_load/old_load)**(1.0_dp/3)
         scaled%c = from%c*factor
         scaled%approach = from%approach*factor**2
      end if
      scaled%shape%b = from%shape%b*factor
   end function scaled_to_load

end module wavycon_load_continuation
