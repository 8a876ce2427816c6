!> Partial slip under a fixed normal load, by Ciavarella's and Jaeger's superposition: the tangential tractions are
!> friction times the difference of two normal contacts; and how unlike bodies shear. Equations (I..) are those of
!> README.md in this directory.
module wavycon_partial_slip
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_status, only: not_found
   use wavycon_kinds, only: dp
   use wavycon_solution_record, only: no_solution
   implicit none (type, external)
   private

   public :: partial_slip, solve_partial_slip, cycle_energy, relative_displacement, dundurs_beta, shear_factors

   !> Loads of the loading curve, from no tangential load to the whole.
   integer, parameter :: curve_points = 33

   type :: partial_slip
      real(dp) :: tangential = 0.0_dp   !! Q [p*]
      !> The contact at P* = P - Q/f (I9), whose area sticks. Without a solution where Q > f P.
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
      if (rest < 0.0_dp .or. .not. solution%is_good()) then
         slip%stick%solution_record = no_solution(rest, solution%solver, not_found)
         return
      end if
      call solver%solve(rest, slip%stick)
      if (.not. with_curve) return
      allocate (slip%approach_change(curve_points), source=0.0_dp)
      associate (change => slip%approach_change, approach => solution%measures%approach_over_amplitude)
         do i = 2, curve_points - 1
            associate (part => real(i - 1, dp)/(curve_points - 1))
               call solver%solve(solution%pbar_over_pstar - part*tangential/friction, on_the_way)
            end associate
            change(i) = approach - on_the_way%measures%approach_over_amplitude
         end do
         change(curve_points) = approach - slip%stick%measures%approach_over_amplitude
      end associate
   end subroutine solve_partial_slip

   !> The relative tangential displacement of the bodies over kappa f [Delta] (I11), and its error estimate.
   pure function relative_displacement(solution, stick) result(answer)
      type(contact_solution), intent(in) :: solution   !! at P
      type(contact_solution), intent(in) :: stick      !! at P*
      real(dp) :: answer(2)

      answer(1) = solution%measures%approach_over_amplitude - stick%measures%approach_over_amplitude
      answer(2) = solution%measures%mean_gap_error + stick%measures%mean_gap_error
   end function relative_displacement

   !> The energy that a cycle between Q and -Q takes per nominal area, over kappa f^2 [p* Delta] (I14a), and its error
   !> estimate. The approach stands for -G, which free edges do not have.
   pure function cycle_energy(solution, stick) result(answer)
      type(contact_solution), intent(in) :: solution   !! at P
      type(contact_solution), intent(in) :: stick      !! at P*
      real(dp) :: answer(2)

      associate (p => solution%pbar_over_pstar + stick%pbar_over_pstar, u => solution%measures, &
                 u_stick => stick%measures)
         answer = p*relative_displacement(solution, stick)
         answer(1) = 4*(answer(1) - 2*(u%elastic_energy - u_stick%elastic_energy))
         answer(2) = 4*(answer(2) + 2*(u%elastic_energy_error + u_stick%elastic_energy_error))
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

      beta = sum([((-1)**(i - 1)*(1.0_dp + nu(i))*(1.0_dp - 2*nu(i))/e(i), i=1, size(e))]) &
             /(2*sum((1.0_dp - nu**2)/e))
   end function dundurs_beta

end module wavycon_partial_slip
