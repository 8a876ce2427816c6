!> Finds an approximation of low degree at a load or, with adhesion, at an area. It is found by continuation from
!> another solution, or from a load or area at which an asymptote is accurate: that of light load or of nearly full
!> contact.
module wavycon_load_continuation
   use wavycon_contact_equations, only: contact_equations, start_equations
   use wavycon_disc_polynomials, only: start_disc_polynomials
   use wavycon_fitted_function, only: fitted_function
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

   public :: asymptote, find_start, is_start

   !> Relative change of the shape at which Newton's method stops during continuation. A smaller one would be of no use,
   !> as the next load changes the shape by more.
   real(dp), parameter :: start_shape_change = 1e-2_dp
   !> Largest area fraction at which a spot or pool with adhesion starts from an asymptote.
   real(dp), parameter :: small_area = 0.03_dp

contains

   !> Finds an approximation at a load or, with adhesion, at an area, and the degree with which to continue.
   !>
   !> A solution of another load or area that is within one step is moved to this one. Otherwise the continuation starts
   !> from an asymptote, that of light load for a spot and that of nearly full contact for a pool, and goes on in steps.
   !> If the shape touches its neighbours on the way, there is no separate spot or pool at this load.
   subroutine find_start(lattice, now, degree, iterations, found, merged, start)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(inout) :: now
         !! on entry the goal: `pool` and load or, with adhesion, `work` and area; on exit the approximation
      integer, intent(out) :: degree                  !! degree of the first solution
      integer, intent(inout) :: iterations            !! the number of Gauss-Newton steps is added
      logical, intent(out) :: found                   !! whether there is an approximation
      logical, intent(out) :: merged                  !! whether there is none because the shape touches its neighbours
      type(fitted_answer), intent(in), optional :: start
         !! a solution of another load or area, of the same lattice and work

      type(contact_equations) :: equations
      type(fitted_function) :: goal, next
      type(newton_steps) :: newton
      logical :: adhesive
      integer :: steps

      goal = now
      next = now
      adhesive = goal%work > 0.0_dp
      degree = first_degree
      merged = .false.
      if (present(start)) then
         found = is_start(lattice, start, goal)
         if (found) then
            now = moved(lattice, start, goal)
            ! The first degree is below that of the last load. Otherwise a series of loads would never come back to low
            ! degrees.
            degree = max(first_degree, nint(start%value(polynomial_degree)) - merge(2, 3, adhesive)*degree_step)
            return
         end if
      end if
      ! At heavier loads the asymptote of a spot is too far from the solution for Newton's method.
      next%load = min(goal%load, 0.06_dp)
      if (goal%pool) next%load = max(goal%load, heavy_load_start*lattice%closing_pressure)
      next%area = min(goal%area, small_area*lattice%area)
      now = asymptote(lattice, next)
      do
         call equations%images%prepare(lattice, now, 1.1_dp, start_shape_change**2)
         call start_equations(equations, now, 0.0_dp)
         newton%contraction = 0.0_dp
         call newton%solve(equations, lattice, now, change_per_square*start_shape_change**2)
         found = newton%valid
         if (.not. found) exit
         ! In many loads next to merging that were solved the merging ratio of the start was 0.92 at most.
         merged = .not. adhesive .and. merging_ratio(lattice, now) >= 1.0_dp
         found = .not. merged
         steps = steps_to(lattice, now, goal)
         if (merged .or. steps == 0) exit
         next = goal
         if (steps > 1) then
            next%area = load_step_ratio*now%area
            next%load = load_step_ratio*now%load
            if (goal%pool) next%load = lattice%closing_pressure - load_step_ratio*(lattice%closing_pressure - now%load)
         end if
         now = scaled(lattice, now, next)
      end do
      iterations = iterations + newton%iterations
   end subroutine find_start

   !> Whether a solution of another load or area can be the start for a goal: it is a spot or pool as asked for, it is
   !> within one step, and its shape does not touch the neighbours when it is moved to the goal.
   logical function is_start(lattice, start, goal)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: start        !! the solution
      type(fitted_function), intent(in) :: goal       !! as of find_start

      is_start = start%status <= fitted_less_exact .and. (start%pool .eqv. goal%pool)
      if (is_start) is_start = steps_to(lattice, start%solution, goal) <= 1
      if (is_start) is_start = merging_ratio(lattice, moved(lattice, start, goal)) < 1.0_dp
   end function is_start

   !> The number of steps from one load or area to another. A step multiplies P, for pools the closing pressure less P
   !> or, with adhesion, the area by at most `load_step_ratio`.
   pure integer function steps_to(lattice, from, to) result(steps)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: from, to   !! spots or pools of the same kind

      real(dp) :: ratio

      if (to%work > 0.0_dp) then
         ratio = to%area/from%area
      else if (to%pool) then
         ratio = (lattice%closing_pressure - to%load)/(lattice%closing_pressure - from%load)
      else
         ratio = to%load/from%load
      end if
      steps = ceiling(abs(log(ratio))/log(load_step_ratio))
   end function steps_to

   !> A solution moved to another load or area: scaled or, with adhesion, extrapolated by its derivatives.
   function moved(lattice, start, goal) result(now)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: start
      type(fitted_function), intent(in) :: goal       !! as of find_start
      type(fitted_function) :: now

      now = start%solution
      if (goal%work > 0.0_dp) then
         call add_step(now, (goal%area - now%area)*start%area_change)
         now%area = goal%area
      else
         now = scaled(lattice, now, goal)
      end if
   end function moved

   !> The asymptote of small spots or pools, as a fitted function of low degree over a circle.
   !>
   !> A spot is a Hertzian contact at a crest: README.md (F41) and (23) of the paper. A pool is the opening of a
   !> penny-shaped crack at a trough: (F42), and (24), (A4)-(A8) of the paper. With adhesion at a given area they are
   !> those of (F71), (F72). With two-fold symmetry, where the two curvatures of the crest or of the pressure in full
   !> contact differ, the circle is an ellipse.
   function asymptote(lattice, goal) result(now)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: goal   !! as of find_start
      type(fitted_function) :: now

      real(dp), allocatable :: inside(:), values(:, :)
      real(dp) :: curvature(2), mean, missing, radius, ratio   ! ratio: of the axes along y and x
      type(disc_rule) :: rule

      now = goal
      associate (adhesive => goal%work > 0.0_dp, pool => goal%pool, area => goal%area, load => goal%load, &
                 work => goal%work)
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
         if (adhesive) radius = sqrt(area/pi)
         now%shape%fold = merge(lattice%trough_fold, lattice%fold, pool)
         allocate (now%shape%b(0:1))
         now%shape%b(:) = [radius, 0.0_dp]
         if (now%shape%fold == 2) now%shape%b(1) = radius*(1.0_dp - ratio)/(1.0_dp + ratio)
         ! The power of 1 - |w|^2 at the edge: see wavycon_fitted_function.
         call start_disc_polynomials(now%basis, now%shape%fold, start_degree, &
                                     merge(1.5_dp, 0.5_dp, pool) - merge(1.0_dp, 0.0_dp, adhesive))
         allocate (now%c(now%basis%terms), source=0.0_dp)
         if (adhesive) then
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
      end associate
   end function asymptote

   !> A spot or pool scaled to another load or, with adhesion, to another area: lengths, pressures and gaps change with
   !> the load as those of the asymptotes, with the area lengths only.
   function scaled(lattice, from, goal)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: from
      type(fitted_function), intent(in) :: goal      !! as of find_start
      type(fitted_function) :: scaled

      real(dp) :: factor

      scaled = from
      if (goal%work > 0.0_dp) then
         scaled%area = goal%area
         factor = sqrt(goal%area/from%shape%area())
      else if (goal%pool) then
         scaled%load = goal%load
         factor = sqrt((lattice%closing_pressure - goal%load)/(lattice%closing_pressure - from%load))
         scaled%c = from%c*factor**3
      else
         scaled%load = goal%load
         factor = (goal%load/from%load)**(1.0_dp/3)
         scaled%c = from%c*factor
         scaled%approach = from%approach*factor**2
      end if
      scaled%shape%b = from%shape%b*factor
   end function scaled

end module wavycon_load_continuation
