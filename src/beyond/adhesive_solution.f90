!> A point of the curve of adhesive contacts as a solution, whose source has its fields and its edge. Equations (I..) are
!> those of README.md in this directory.
module wavycon_adhesive_solution
   use wavycon_adhesive_contact, only: adhesive_point, adhesive_problem, at_approach, at_load, closed, not_solved, &
      separated
   use wavycon_ball_source, only: ball_source
   use wavycon_closed_form_contact, only: closed_form_source
   use wavycon_constants, only: pi
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_status, only: full_contact, not_found
   use wavycon_fitted_source, only: fitted_source
   use wavycon_free_edges, only: ball_radii, is_ball
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach, contact_area, is_known, mean_gap, or_nan
   use wavycon_solution_record, only: no_solution, no_solver
   implicit none (type, external)
   private

   public :: make_adhesive_solution

contains

   !> Bodies that are separated, or whose load is not known, have no fields: the status is not_found.
   subroutine make_adhesive_solution(problem, point, solution)
      type(adhesive_problem), intent(in) :: problem
      type(adhesive_point), intent(in) :: point         !! of this problem
      type(contact_solution), intent(out) :: solution   !! numbers: load, area, approach and mean gap

      type(fitted_source), allocatable :: fitted
      type(hertz_ball) :: contact

      associate (surface => problem%surface, p => point%value(at_load))
         solution%solution_record = no_solution(or_nan(p), no_solver, not_found)
         if (point%kind == closed .and. is_known(p)) solution%status = full_contact
         if (any(point%kind == [closed, not_solved, separated])) return
         solution%status = point%status
         solution%value([contact_area, approach, mean_gap]) = &
            [point%area, point%value(at_approach), 1.0_dp - point%value(at_approach)]
         if (is_ball(surface)) then
            contact = hertz_contact(ball_radii(surface), 1.0_dp, area=point%area*surface%nominal_area())
            contact%tension = contact%force - p*surface%full_contact_pressure(1.0_dp)*surface%nominal_area()
            contact%approach = point%value(at_approach)*surface%amplitude
            allocate (solution%source, source=ball_source(contact=contact))
         else if (problem%has_closed_form) then
            allocate (solution%source, source=closed_form_source(tension=sin(0.5_dp*pi*point%area)**2 - p))
         else
            allocate (fitted)
            fitted%frame = problem%frame
            fitted%answer = point%answer
            fitted%accuracy = problem%accuracy
            call move_alloc(fitted, solution%source)
         end if
      end associate
      solution%source%record = solution%solution_record
   end subroutine make_adhesive_solution

end module wavycon_adhesive_solution
