!> Partial slip under a fixed normal load, by the superposition of Ciavarella and Jaeger: the tangential tractions are
!> the coefficient of friction times the difference of two normal pressures, (I9). Also the elastic constants of unlike
!> bodies in shear. Equations (I..) are those of README.md in this directory.
module wavycon_partial_slip
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach, elastic_energy, gap_curvature, gap_slope, is_known, mean_gap, or_nan, &
      quantities, unknown
   use wavycon_solution_record, only: no_solution, not_found
   implicit none (type, external)
   private

   public :: partial_slip, solve_partial_slip, cycle_energy, relative_displacement, dundurs_beta, shear_factors

   !> Number of points of the loading curve, from no tangential load to the whole one.
   integer, parameter :: curve_points = 33

   type :: partial_slip
      real(dp) :: tangential = 0.0_dp   !! mean tangential traction Q [p*]
      logical :: slides = .false.       !! whether Q > f P
      !> The status of the normal load's solution or, if this one is good, of `stick`; not_found if the bodies slide.
      integer :: status = not_found
      !> The contact at the load P* = P - Q/f, (I9), whose area sticks. It has no numbers if the bodies slide.
      type(contact_solution) :: stick
      !> At equal steps of the tangential load up to Q: the approach at P less that at P* of the step [Delta]. Allocated
      !> only if the curve is asked for.
      real(dp), allocatable :: approach_change(:)
   end type partial_slip

contains

   !> Solves the contact under one tangential load.
   subroutine solve_partial_slip(solver, friction, solution, tangential, with_curve, slip)
      class(contact_solver), intent(inout) :: solver        !! that of the normal load
      real(dp), intent(in) :: friction                      !! coefficient of friction f > 0
      type(contact_solution), intent(in) :: solution        !! solution of the normal load P
      real(dp), intent(in) :: tangential                    !! Q >= 0 [p*]
      logical, intent(in) :: with_curve                     !! whether to compute approach_change
      type(partial_slip), intent(inout) :: slip             !! on entry as initialised

      !> Q = f P up to this relative rounding is full slip, P* = 0.
      real(dp), parameter :: rounding = 4*epsilon(1.0_dp)
      real(dp) :: stick_load   ! P*

      slip%tangential = tangential
      stick_load = solution%pbar_over_pstar - tangential/friction
      if (abs(stick_load) <= rounding*solution%pbar_over_pstar) stick_load = 0.0_dp
      slip%slides = stick_load < 0.0_dp
      slip%status = solution%status
      if (slip%slides .and. solution%is_good()) slip%status = not_found
      slip%stick%solution_record = no_solution(stick_load, solution%solver, slip%status)
      if (slip%slides .or. .not. solution%has_numbers()) return
      call solver%solve(stick_load, slip%stick)
      if (solution%is_good()) slip%status = slip%stick%status
      if (with_curve) call solve_curve(solver, friction, solution, slip)
   end subroutine solve_partial_slip

   !> Computes the loading curve. The approach at P less the tangential load over f is solved at the middle point, then
   !> in the middle between the points before, and so on. Where cubic interpolation foretells a point far within its
   !> error estimate, the points beside it are not solved but interpolated. None is extrapolated. Where solutions have
   !> no error, or no estimate of it, all points are solved.
   subroutine solve_curve(solver, friction, solution, slip)
      class(contact_solver), intent(inout) :: solver    !! that of the normal load
      real(dp), intent(in) :: friction                  !! coefficient of friction f > 0
      type(contact_solution), intent(in) :: solution    !! solution of the normal load P
      type(partial_slip), intent(inout) :: slip         !! with the stick contact; gets approach_change

      !> Largest difference of a foretold approach from the solved one, over the latter's error estimate.
      real(dp), parameter :: part_of_error = 0.1_dp
      type(contact_solution) :: on_curve
      real(dp), dimension(curve_points) :: load, x, y   ! P - Q/f of the point, its logarithm, approach [Delta]
      real(dp) :: foretold
      logical, dimension(curve_points) :: foreseen, known   ! whether y needs no points beside it; whether it is solved
      integer :: i
      integer :: middle   ! of the interval before, in which i is
      integer :: step     ! between the points to be solved

      load = [(real(i - 1, dp)/(curve_points - 1), i=1, curve_points)]
      load = solution%pbar_over_pstar - load*slip%tangential/friction
      x = log(max(load, tiny(load)))
      y(1) = solution%value(approach)
      y(curve_points) = approach_of(slip%stick)
      known = .false.
      known(1) = .true.
      known(curve_points) = slip%stick%pbar_over_pstar > 0.0_dp .and. slip%stick%has_numbers()
      step = 1
      if (is_known(solution%error(mean_gap)) .and. solution%error(mean_gap) > 0.0_dp) step = (curve_points - 1)/2
      foreseen = .false.
      do while (step > 0)
         do i = 1 + step, curve_points - 1, step
            if (known(i) .or. foreseen(i)) cycle
            middle = i - step
            if (mod((middle - 1)/step, 4) /= 2) middle = i + step
            foreseen(i) = foreseen(middle)
            if (foreseen(i)) cycle
            foretold = interpolated(pack(x, known), pack(y, known), x(i))
            call solver%solve(load(i), on_curve)
            y(i) = approach_of(on_curve)
            known(i) = on_curve%has_numbers()
            if (known(i) .and. any(known(i + 1:)) .and. count(known) > 3 .and. is_known(on_curve%error(mean_gap))) &
               foreseen(i) = abs(foretold - y(i)) < part_of_error*on_curve%error(mean_gap)
         end do
         step = step/2
      end do
      do i = 2, curve_points - 1
         if (foreseen(i) .and. .not. known(i)) y(i) = interpolated(pack(x, known), pack(y, known), x(i))
      end do
      slip%approach_change = y(1) - y
   end subroutine solve_curve

   !> The cubic through the four nearest points, two on each side where there are so many.
   pure real(dp) function interpolated(x, y, place)
      real(dp), intent(in) :: x(:), y(:)   !! the points, at least one, with falling x
      real(dp), intent(in) :: place        !! x of the answer, none of x(:)

      real(dp) :: terms(size(x))
      integer :: first, i, j, last

      first = max(1, min(count(x > place) - 1, size(x) - 3))
      last = min(first + 3, size(x))
      terms = 0.0_dp
      do i = first, last
         terms(i) = y(i)*product([((place - x(j))/(x(i) - x(j)), j=first, i - 1), &
                                  ((place - x(j))/(x(i) - x(j)), j=i + 1, last)])
      end do
      interpolated = sum(terms)
   end function interpolated

   !> The approach of a solution [Delta]; NaN if it has no numbers.
   pure real(dp) function approach_of(solution)
      type(contact_solution), intent(in) :: solution

      approach_of = or_nan(unknown)
      if (solution%has_numbers()) approach_of = or_nan(solution%value(approach))
   end function approach_of

   !> The relative tangential displacement of the bodies over kappa f, (I11), and its error estimate [Delta].
   pure function relative_displacement(solution, stick) result(answer)
      type(contact_solution), intent(in) :: solution   !! the contact at P
      type(contact_solution), intent(in) :: stick      !! the contact at P*
      real(dp) :: answer(2)                            !! value, error

      answer(1) = solution%value(approach) - stick%value(approach)
      ! The last term is rounding: each approach is computed as 1 - G unless there are free edges.
      answer(2) = solution%error(mean_gap) + stick%error(mean_gap) + epsilon(1.0_dp)* &
                  (2.0_dp + solution%value(approach) + stick%value(approach))
   end function relative_displacement

   !> The energy that a cycle between Q and -Q dissipates per nominal area, over kappa f^2, and its error estimate
   !> [p* Delta]: by (I14a) or, if its error is smaller, by (I14b), as where little slips. The approach takes the place
   !> of -G, which surfaces with free edges do not have.
   pure function cycle_energy(solution, stick, slopes) result(answer)
      type(contact_solution), intent(in) :: solution   !! the contact at P
      type(contact_solution), intent(in) :: stick      !! the contact at P*
      type(quantities), intent(in) :: slopes(2)        !! G' and G'' at P and at P*
      real(dp) :: answer(2)                            !! value, error

      !> Of (I14b): h; r and h b; the errors of these two.
      real(dp) :: half, rise, bend, errors(2)

      answer = (solution%pbar_over_pstar + stick%pbar_over_pstar)*relative_displacement(solution, stick)
      associate (u => solution%value(elastic_energy), u_stick => stick%value(elastic_energy))
         answer(1) = 4*(answer(1) - 2*(u - u_stick))
         answer(2) = 4*(answer(2) + 2*(solution%error(elastic_energy) + stick%error(elastic_energy)) &
                        + 2*epsilon(1.0_dp)*(u + u_stick))
      end associate
      if (.not. is_known(answer(2))) answer = unknown
      if (.not. all(is_known(slopes%error(gap_slope)) .and. is_known(slopes%error(gap_curvature)))) return
      half = (solution%pbar_over_pstar - stick%pbar_over_pstar)/2
      rise = (slopes(1)%value(gap_slope) - slopes(2)%value(gap_slope))/2
      bend = half*sum(slopes%value(gap_curvature))/2
      errors = [sum(slopes%error(gap_slope) - epsilon(1.0_dp)*slopes%value(gap_slope))/2, &
                half*sum(slopes%error(gap_curvature))/2]
      associate (error => 16*half**2*(abs(rise - bend)/15 + 2*errors(1)/5 + errors(2)/15))
         if (error < answer(2)) answer = [16*half**2*(2*rise/5 - bend/15), error]
      end associate
   end function cycle_energy

   !> The ratio kappa of tangential to normal compliance for shear across the ridges of a wave, along them, (I12), and
   !> the mean of both, (I13).
   pure function shear_factors(e, nu) result(kappa)
      real(dp), intent(in) :: e(:)    !! Young's moduli of the bodies that are not rigid, shape (1) or (2)
      real(dp), intent(in) :: nu(:)   !! their Poisson's ratios, of the same shape
      real(dp) :: kappa(3)

      kappa(1) = 1.0_dp
      kappa(2) = sum((1.0_dp + nu)/e)/sum((1.0_dp - nu**2)/e)
      kappa(3) = 0.5_dp*(kappa(1) + kappa(2))
   end function shear_factors

   !> Dundurs' second parameter, (I14), of two bodies, or of one body and a rigid one.
   pure real(dp) function dundurs_beta(e, nu) result(beta)
      real(dp), intent(in) :: e(:)    !! Young's moduli of the bodies that are not rigid, shape (1) or (2)
      real(dp), intent(in) :: nu(:)   !! their Poisson's ratios, of the same shape

      integer :: i

      beta = sum([((-1)**(i - 1)*(1.0_dp + nu(i))*(1.0_dp - 2*nu(i))/e(i), i=1, size(e))])/(2*sum((1.0_dp - nu**2)/e))
   end function dundurs_beta

end module wavycon_partial_slip
