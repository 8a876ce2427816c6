!> Partial slip under a fixed normal load, by Ciavarella's and Jaeger's superposition: the tangential tractions are
!> friction times the difference of two normal contacts; and how unlike bodies shear. Equations (I..) are those of
!> README.md in this directory.
module wavycon_partial_slip
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_status, only: not_found
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach, elastic_energy, gap_curvature, gap_slope, is_known, mean_gap, or_nan, &
      quantities, unknown
   use wavycon_solution_record, only: no_solution
   implicit none (type, external)
   private

   public :: partial_slip, solve_partial_slip, cycle_energy, relative_displacement, dundurs_beta, shear_factors

   !> Loads of the loading curve, from no tangential load to the whole.
   integer, parameter :: curve_points = 33

   type :: partial_slip
      real(dp) :: tangential = 0.0_dp   !! Q [p*]
      logical :: slides = .false.       !! whether Q > f P
      integer :: status = not_found     !! of the normal load, or if that is solved as requested of `stick`
      !> The contact at P* = P - Q/f (I9), whose area sticks. Without numbers where the bodies slide.
      type(contact_solution) :: stick
      !> The approach less that at P* [Delta] at equal steps of the tangential load; not allocated unless asked for.
      real(dp), allocatable :: approach_change(:)
   end type partial_slip

contains

   !> Solves one tangential load.
   subroutine solve_partial_slip(solver, friction, solution, tangential, with_curve, slip)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: friction                      !! f > 0
      type(contact_solution), intent(in) :: solution        !! of the normal load
      real(dp), intent(in) :: tangential                    !! Q >= 0 [p*]
      logical, intent(in) :: with_curve
      type(partial_slip), intent(inout) :: slip

      !> Q = f P up to rounding is full slip.
      real(dp), parameter :: rounding = 4*epsilon(1.0_dp)
      type(contact_solution) :: on_the_way
      real(dp) :: rest
      integer :: i

      slip%tangential = tangential
      rest = solution%pbar_over_pstar - tangential/friction
      if (abs(rest) <= rounding*solution%pbar_over_pstar) rest = 0.0_dp
      slip%slides = rest < 0.0_dp
      slip%status = merge(not_found, solution%status, slip%slides .and. solution%is_good())
      slip%stick%solution_record = no_solution(rest, solution%solver, slip%status)
      if (slip%slides .or. .not. solution%has_numbers()) return
      call solver%solve(rest, slip%stick)
      if (solution%is_good()) slip%status = slip%stick%status
      if (.not. with_curve) return
      allocate (slip%approach_change(curve_points), source=0.0_dp)
      associate (change => slip%approach_change)
         do i = 2, curve_points - 1
            associate (part => real(i - 1, dp)/(curve_points - 1))
               call solver%solve(solution%pbar_over_pstar - part*tangential/friction, on_the_way)
            end associate
            change(i) = solution%value(approach) - approach_of(on_the_way)
         end do
         change(curve_points) = solution%value(approach) - approach_of(slip%stick)
      end associate
   end subroutine solve_partial_slip

   !> The approach [Delta]; NaN without numbers.
   pure real(dp) function approach_of(solution)
      type(contact_solution), intent(in) :: solution

      approach_of = or_nan(merge(solution%value(approach), unknown, solution%has_numbers()))
   end function approach_of

   !> The relative tangential displacement of the bodies over kappa f [Delta] (I11), and its error estimate.
   pure function relative_displacement(solution, stick) result(answer)
      type(contact_solution), intent(in) :: solution   !! at P
      type(contact_solution), intent(in) :: stick      !! at P*
      real(dp) :: answer(2)

      answer(1) = solution%value(approach) - stick%value(approach)
      ! With rounding: each approach is 1 - G unless there are free edges.
      answer(2) = solution%error(mean_gap) + stick%error(mean_gap) + epsilon(1.0_dp)* &
                  (2.0_dp + solution%value(approach) + stick%value(approach))
   end function relative_displacement

   !> The energy that a cycle between Q and -Q takes per nominal area, over kappa f^2 [p* Delta], and its error
   !> estimate: by (I14a) or, where that is more accurate because little slips, (I14b). The approach stands for -G,
   !> which free edges do not have.
   pure function cycle_energy(solution, stick, slopes) result(answer)
      type(contact_solution), intent(in) :: solution   !! at P
      type(contact_solution), intent(in) :: stick      !! at P*
      type(quantities), intent(in) :: slopes(2)  !! of both
      real(dp) :: answer(2)

      real(dp) :: bend, errors(2), half, rise

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

   !> kappa for shear across and along the ridges of a wave (I12), and their mean (I13).
   pure function shear_factors(e, nu) result(kappa)
      real(dp), intent(in) :: e(:)    !! Young's moduli of the bodies that are not rigid
      real(dp), intent(in) :: nu(:)   !! their Poisson's ratios
      real(dp) :: kappa(3)

      kappa(1) = 1.0_dp
      kappa(2) = sum((1.0_dp + nu)/e)/sum((1.0_dp - nu**2)/e)
      kappa(3) = 0.5_dp*(kappa(1) + kappa(2))
   end function shear_factors

   !> Dundurs' second parameter (I14) of two bodies; of one and a rigid body.
   pure real(dp) function dundurs_beta(e, nu) result(beta)
      real(dp), intent(in) :: e(:)    !! Young's moduli, shape (1 or 2)
      real(dp), intent(in) :: nu(:)   !! Poisson's ratios

      integer :: i

      beta = sum([((-1)**(i - 1)*(1.0_dp + nu(i))*(1.0_dp - 2*nu(i))/e(i), i=1, size(e))])/(2*sum((1.0_dp - nu**2)/e))
   end function dundurs_beta

end module wavycon_partial_slip
