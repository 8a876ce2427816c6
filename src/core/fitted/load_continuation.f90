!> Finds an approximation of low degree at a load or, with adhesion, at an area. It is found by continuation from
!> another solution, or from a load or area at which an asymptote is accurate: that of light load or of nearly full
!> contact.
module wavycon_load_continuation
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_disc_polynomials, only: start_disc_polynomials
   use wavycon_fitted_function, only: edge_power, fitted_function
   use wavycon_fitted_answer, only: fitted_answer, fitted_less_exact
   use wavycon_fitted_tuning, only: degree_step, first_degree, heavy_load_start, load_step_ratio, start_degree
   use wavycon_gauss_newton, only: add_step, change_per_square, newton_steps
   use wavycon_gauss_rules, only: disc_rule, start_disc_rule
   use wavycon_fitted_size, only: merging_ratio
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: polynomial_degree
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: asymptote, is_start, start_at_area, start_at_load

   !> Relative change of the shape at which Newton's method stops during continuation. A smaller one would be of no use,
   !> as the next load changes the shape by more.
   real(dp), parameter :: start_shape_change = 1e-2_dp
   !> Largest area fraction at which a spot or pool with adhesion starts from an asymptote.
   real(dp), parameter :: small_area = 0.03_dp

contains

   !> Finds an approximation at a load, and the degree with which to continue.
   !>
   !> A solution of another load that is within one step is scaled to this load. Otherwise the continuation starts from
   !> an asymptote, Hertz's contact for a spot and a penny-shaped crack for a pool, and goes on in steps of the load. If
   !> the shape touches its neighbours on the way, there is no separate spot or pool at this load.
   subroutine start_at_load(lattice, load, pool, now, degree, iterations, found, merged, start)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load                    !! mean pressure P
      logical, intent(in) :: pool                     !! true: for a pool; false: for a spot
      type(fitted_function), intent(out) :: now       !! the approximation
      integer, intent(out) :: degree                  !! degree of the first solution
      integer, intent(inout) :: iterations            !! the number of Gauss-Newton steps is added
      logical, intent(out) :: found                   !! whether there is an approximation
      logical, intent(out) :: merged                  !! whether there is none because the shape touches its neighbours
      type(fitted_answer), intent(in), optional :: start   !! a solution of another load

      type(contact_equations) :: equations
      type(newton_steps) :: newton
      real(dp) :: reached, next
      integer :: steps

      degree = first_degree
      merged = .false.
      if (present(start)) then
         found = is_start(lattice, start, load, pool)
         if (found) then
            now = scaled_to_load(lattice, start%solution, start%pbar_over_pstar, load)
            ! The first degree is below that of the last load. Otherwise a series of loads would never come back to low
            ! degrees.
            degree = max(first_degree, nint(start%value(polynomial_degree)) - 3*degree_step)
            return
         end if
      end if
      ! At heavier loads the asymptote of a spot is too far from the solution for Newton's method.
      reached = min(load, 0.06_dp)
      if (pool) reached = max(load, heavy_load_start*lattice%closing_pressure)
      now = asymptote(lattice, reached, pool)
      do
         call equations%images%prepare(lattice, now, 1.1_dp, start_shape_change**2)
         call start_equations(equations, now, 0.0_dp)
         newton%contraction = 0.0_dp
         call newton%solve(equations, lattice, now, change_per_square*start_shape_change**2)
         found = newton%valid
         if (.not. found) exit
         ! In many loads next to merging that were solved the merging ratio of the start was 0.92 at most.
         merged = merging_ratio(lattice, now) >= 1.0_dp
         found = .not. merged
         steps = load_steps(lattice, reached, load, pool)
         if (merged .or. steps == 0) exit
         next = load
         if (steps > 1) then
            next = load_step_ratio*reached
            if (pool) next = lattice%closing_pressure - load_step_ratio*(lattice%closing_pressure - reached)
         end if
         now = scaled_to_load(lattice, now, reached, next)
         reached = next
      end do
      iterations = iterations + newton%iterations
   end subroutine start_at_load

   !> Finds an approximation at an area with adhesion, and the degree with which to continue.
   !>
   !> A solution of another area that is within one step is extrapolated by its derivatives. Otherwise the continuation
   !> starts from the asymptote of a small spot or pool and goes on in steps of the area.
   subroutine start_at_area(lattice, pool, work, area, now, degree, iterations, found, start)
      type(wave_lattice), intent(in) :: lattice
      logical, intent(in) :: pool                     !! true: for a pool; false: for a spot
      real(dp), intent(in) :: work                    !! work of adhesion W > 0 [pi E* Delta^2/s]
      real(dp), intent(in) :: area                    !! area of the spot or pool [s^2]
      type(fitted_function), intent(out) :: now       !! the approximation
      integer, intent(out) :: degree                  !! degree of the first solution
      integer, intent(inout) :: iterations            !! the number of Gauss-Newton steps is added
      logical, intent(out) :: found                   !! whether there is an approximation
      type(fitted_answer), intent(in), optional :: start   !! a solution of another area, of the same lattice and work

      type(contact_equations) :: equations
      type(newton_steps) :: newton
      real(dp) :: reached

      degree = first_degree
      found = present(start)
      if (found) found = start%status <= fitted_less_exact .and. (start%pool .eqv. pool)
      if (found) found = abs(log(area/start%solution%area)) <= log(load_step_ratio)
      if (found) then
         now = start%solution
         call add_step(now, (area - now%area)*start%area_change)
         now%area = area
         found = merging_ratio(lattice, now) < 1.0_dp
         degree = max(first_degree, nint(start%value(polynomial_degree)) - 2*degree_step)
         return
      end if
      reached = min(area, small_area*lattice%area)
      now = asymptote(lattice, 0.0_dp, pool, work, reached)
      do
         call equations%images%prepare(lattice, now, 1.1_dp, start_shape_change**2)
         call start_equations(equations, now, 0.0_dp)
         newton%contraction = 0.0_dp
         call newton%solve(equations, lattice, now, change_per_square*start_shape_change**2)
         found = newton%valid
         if (.not. found .or. reached >= area) exit
         reached = min(load_step_ratio*reached, area)
         now%shape%b = now%shape%b*sqrt(reached/now%shape%area())
         now%area = reached
      end do
      iterations = iterations + newton%iterations
   end subroutine start_at_area

   !> Whether a solution of another load can be the start for a load: it is a spot or pool as asked for, its load is
   !> within one step, and its shape does not touch the neighbours when it is scaled to the load.
   logical function is_start(lattice, start, load, pool)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: start        !! the solution of another load
      real(dp), intent(in) :: load                    !! mean pressure P
      logical, intent(in) :: pool                     !! true: for a pool; false: for a spot

      is_start = start%status <= fitted_less_exact .and. (start%pool .eqv. pool)
      if (is_start) is_start = load_steps(lattice, start%pbar_over_pstar, load, pool) <= 1
      if (is_start) is_start = &
         merging_ratio(lattice, scaled_to_load(lattice, start%solution, start%pbar_over_pstar, load)) < 1.0_dp
   end function is_start

   !> The number of steps from one load to another. A step multiplies P, or for pools the closing pressure less P, by at
   !> most `load_step_ratio`.
   pure integer function load_steps(lattice, from, to, pool) result(steps)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: from, to      !! mean pressures P
      logical, intent(in) :: pool           !! true: for a pool; false: for a spot

      real(dp) :: ratio

      ratio = to/from
      if (pool) ratio = (lattice%closing_pressure - to)/(lattice%closing_pressure - from)
      steps = ceiling(abs(log(ratio))/log(load_step_ratio))
   end function load_steps

   !> The asymptote of small spots or pools, as a fitted function of low degree over a circle.
   !>
   !> A spot is a Hertzian contact at a crest: README.md (F41) and (23) of the paper. A pool is the opening of a
   !> penny-shaped crack at a trough: (F42), and (24), (A4)-(A8) of the paper. With adhesion at a given area they are
   !> those of (F71), (F72). With two-fold symmetry, where the two curvatures of the crest or of the pressure in full
   !> contact differ, the circle is an ellipse.
   function asymptote(lattice, load, pool, work, area) result(now)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load   !! P > 0, for a pool < closing pressure; not used with adhesion
      logical, intent(in) :: pool    !! true: a pool; false: a spot
      real(dp), intent(in), optional :: work, area   !! with adhesion: W > 0, and the area of the spot or pool [s^2]
      type(fitted_function) :: now

      real(dp), allocatable :: inside(:), values(:, :)
      real(dp) :: curvature(2), mean, missing, radius, ratio   ! ratio: of the axes along y and x
      type(disc_rule) :: rule

      curvature = lattice%curvatures(pool)
      mean = sqrt(product(curvature))
      missing = lattice%closing_pressure - load
      if (pool) then
         radius = sqrt(3*missing/mean)
         ! This ratio of the axes is exact for slender ellipses.
         ratio = sqrt(curvature(1)/curvature(2))
      else
         radius = (3*pi*load*lattice%area/(4*mean))**(1.0_dp/3)
         ! An approximation of the exact relation, which has elliptic integrals.
         ratio = (curvature(1)/curvature(2))**0.6_dp
      end if
      if (present(area)) then
         now%work = work
         now%area = area
         radius = sqrt(area/pi)
      end if
      now%pool = pool
      now%shape%fold = merge(lattice%trough_fold, lattice%fold, pool)
      allocate (now%shape%b(0:1))
      now%shape%b(:) = [radius, 0.0_dp]
      if (now%shape%fold == 2) now%shape%b(1) = radius*(1.0_dp - ratio)/(1.0_dp + ratio)
      call start_disc_polynomials(now%basis, now%shape%fold, start_degree, edge_power(pool, present(area)))
      allocate (now%c(now%basis%terms), source=0.0_dp)
      now%load = load
      if (present(area)) then
         now%shape%b = now%shape%b*sqrt(area/now%shape%area())
         call start_disc_rule(rule, now%basis%power, now%shape%fold, start_degree, start_degree)
         allocate (inside(size(rule%point)), values(size(rule%point), now%basis%terms))
         call now%basis%evaluate(size(rule%point), rule%point, values)
         inside = (1.0_dp - abs(rule%point))*(1.0_dp + abs(rule%point))
         if (pool) then
            now%load = lattice%closing_pressure - mean*radius**2/3 - sqrt(work/(2*radius))
            inside = 8*mean*radius**3/9*inside + 4*sqrt(0.5_dp*work*radius)
         else
            now%approach = mean*radius**2 - pi*sqrt(2*work*radius)
            inside = 2*mean*radius/pi**2*inside - sqrt(2*work/radius)/pi
         end if
         now%c = matmul(rule%weight*inside, values)
      else if (pool) then
         ! The opening is g_0 (1 - rho^2)^(3/2), g_0 = (8/3) b (closing pressure - P), b the radius.
         now%c(1) = 8*missing*radius/3*sqrt(0.4_dp*pi)
      else
         ! The first polynomial is constant, and (1 - rho^2)^(1/2) has the integral 2 pi/3.
         now%c(1) = load*lattice%area/now%shape%area()/sqrt(2*pi/3)*pi
         now%approach = mean*radius**2
      end if
   end function asymptote

   !> A spot or pool scaled to another load: lengths, pressures and gaps change with the load as those of the
   !> asymptotes.
   function scaled_to_load(lattice, from, old_load, new_load) result(scaled)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: from
      real(dp), intent(in) :: old_load, new_load  !! mean pressures P
      type(fitted_function) :: scaled

      real(dp) :: factor

      scaled = from
      scaled%load = new_load
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
