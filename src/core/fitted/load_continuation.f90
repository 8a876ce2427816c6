!> A solution of low degree at a load, by continuation from a load for which there is an approximation: the asymptotes
!> of light load and of nearly full contact.
module wavycon_load_continuation
   use wavycon_constants, only: pi
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_disc_polynomials, only: start_disc_polynomials
   use wavycon_expansion, only: edge_power, expansion
   use wavycon_fitted_answer, only: fitted_answer, fitted_less_exact
   use wavycon_fitted_tuning, only: degree_step, first_degree, heavy_load_start, load_step_ratio, start_degree
   use wavycon_gauss_newton, only: add_step, change_per_square, newton_steps
   use wavycon_gauss_rules, only: disc_rule, start_disc_rule
   use wavycon_kinds, only: dp
   use wavycon_expansion_size, only: merging_ratio
   use wavycon_quantities, only: polynomial_degree
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: asymptote, is_start, start_at_area, start_at_load

   !> Relative change of the shape at which Newton's method stops during continuation: the next load makes smaller ones
   !> useless.
   real(dp), parameter :: start_shape_change = 1e-2_dp
   !> Area fraction up to which a spot or pool with adhesion starts from an asymptote.
   real(dp), parameter :: small_area = 0.03_dp

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

      type(contact_equations) :: equations
      type(newton_steps) :: newton
      real(dp) :: at, next
      integer :: steps

      degree = first_degree
      merged = .false.
      if (present(start)) then
         found = is_start(lattice, start, load, pool)
         if (found) then
            now = scaled_to_load(lattice, start%solution, start%pbar_over_pstar, load)
            ! Degrees below the last load's, or a sweep would never come down to lower ones again.
            degree = max(first_degree, nint(start%value(polynomial_degree)) - 3*degree_step)
            return
         end if
      end if
      ! From heavier loads on a spot Newton's method would start too far off.
      at = min(load, 0.06_dp)
      if (pool) at = max(load, heavy_load_start*lattice%closing_pressure)
      now = asymptote(lattice, at, pool)
      do
         call equations%images%prepare(lattice, now, 1.1_dp, start_shape_change**2)
         call start_equations(equations, now, 0.0_dp)
         newton%contraction = 0.0_dp
         call newton%solve(equations, lattice, now, change_per_square*start_shape_change**2)
         found = newton%valid
         if (.not. found) exit
         ! The start of a load that was solved has come to a ratio of 0.92 at most, of many next to merging.
         merged = merging_ratio(lattice, now) >= 1.0_dp
         found = .not. merged
         steps = load_steps(lattice, at, load, pool)
         if (merged .or. steps == 0) exit
         next = load
         if (steps > 1) then
            next = load_step_ratio*at
            if (pool) next = lattice%closing_pressure - load_step_ratio*(lattice%closing_pressure - at)
         end if
         now = scaled_to_load(lattice, now, at, next)
         at = next
      end do
      iterations = iterations + newton%iterations
   end subroutine start_at_load

   !> An approximation at an area with adhesion, and the degree to go on with.
   !>
   !> A solution of an area that is within one step is carried on along its derivatives. Otherwise the asymptotes of
   !> small spots or pools are followed in steps of the area.
   subroutine start_at_area(lattice, pool, work, area, now, degree, iterations, found, start)
      type(wave_lattice), intent(in) :: lattice
      logical, intent(in) :: pool                     !! the regime
      real(dp), intent(in) :: work                    !! W > 0
      real(dp), intent(in) :: area                    !! of the spot or pool [s^2]
      type(expansion), intent(out) :: now
      integer, intent(out) :: degree
      integer, intent(inout) :: iterations            !! Gauss-Newton steps are added
      logical, intent(out) :: found
      type(fitted_answer), intent(in), optional :: start   !! a solution of the same lattice and work

      type(contact_equations) :: equations
      type(newton_steps) :: newton
      real(dp) :: at

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
      at = min(area, small_area*lattice%area)
      now = asymptote(lattice, 0.0_dp, pool, work, at)
      do
         call equations%images%prepare(lattice, now, 1.1_dp, start_shape_change**2)
         call start_equations(equations, now, 0.0_dp)
         newton%contraction = 0.0_dp
         call newton%solve(equations, lattice, now, change_per_square*start_shape_change**2)
         found = newton%valid
         if (.not. found .or. at >= area) exit
         at = min(load_step_ratio*at, area)
         now = scaled_to_area(now, at)
      end do
      iterations = iterations + newton%iterations
   end subroutine start_at_area

   !> A spot or pool with adhesion at another area, with the same pressures and gaps.
   pure function scaled_to_area(from, area) result(scaled)
      type(expansion), intent(in) :: from
      real(dp), intent(in) :: area      !! [s^2]
      type(expansion) :: scaled

      scaled = from
      scaled%shape%b = from%shape%b*sqrt(area/from%shape%area())
      scaled%area = area
   end function scaled_to_area

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

   !> An expansion of low degree over a circle or, with two-fold symmetry, an ellipse: a Hertzian spot at a crest,
   !> README.md (F41) and (23) of the paper, or the opening of a penny-shaped crack at a trough, (F42) and (24),
   !> (A4)-(A8) of the paper; elliptical where the curvatures of the crest, or of the full contact's pressure, differ.
   !> With adhesion at a given area: (F71), (F72).
   function asymptote(lattice, load, pool, work, area) result(now)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load   !! P > 0, of a crack less than the closing pressure; without adhesion
      logical, intent(in) :: pool
      real(dp), intent(in), optional :: work, area   !! with adhesion: W > 0, and the area of the spot or pool [s^2]
      type(expansion) :: now

      real(dp), allocatable :: inside(:), values(:, :)
      real(dp) :: curvature(2), mean, missing, radius, ratio   ! ratio: of the axes along y and x
      type(disc_rule) :: rule

      curvature = lattice%curvatures(pool)
      mean = sqrt(product(curvature))
      missing = lattice%closing_pressure - load
      if (pool) then
         radius = sqrt(3*missing/mean)
         ! Exact for slender ellipses.
         ratio = sqrt(curvature(1)/curvature(2))
      else
         radius = (3*pi*load*lattice%area/(4*mean))**(1.0_dp/3)
         ! About the exact relation, which has elliptic integrals.
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

   !> An approximation at another load: lengths, pressures and gaps are scaled as in the asymptotes.
   function scaled_to_load(lattice, from, old_load, new_load) result(scaled)
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: from
      real(dp), intent(in) :: old_load, new_load  !! P
      type(expansion) :: scaled

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
