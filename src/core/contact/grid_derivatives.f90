!> How a solution on a grid changes with the load, from solutions of the same grid at loads near by: (C29) of README.md
!> in this directory.
module wavycon_grid_derivatives
   use wavycon_contact_measures, only: is_known, load_derivatives, unknown
   use wavycon_contact_tuning, only: load_difference
   use wavycon_grid_sequence, only: sequence_answer, solve_by_sequence
   use wavycon_kinds, only: dp
   use wavycon_solution_record, only: solution_record
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: differentiate_on_grid

contains

   !> Solves four loads and takes differences. Unknown if a load is not solved.
   subroutine differentiate_on_grid(surface, points, record, answer)
      type(surface_type), intent(in) :: surface      !! whose cell was solved
      integer, intent(in) :: points(2)               !! of the grid on the whole cell; the second is ignored in 1-D
      type(solution_record), intent(in) :: record    !! of the solution on this grid, between no load and full contact
      type(load_derivatives), intent(out) :: answer

      integer :: grid(2), i
      real(dp) :: area(-2:2), gap(-2:2), step, unused(2)
      type(sequence_answer) :: nearby

      grid = points
      if (surface%dimension == 1) grid(2) = 1
      step = record%pbar_over_pstar
      if (.not. surface%has_free_edges) step = min(step, 1.0_dp - step)
      step = load_difference*step
      do i = -2, 2
         ! The measures of the record may be of another sequence of grids, and differ within the residual.
         call solve_by_sequence(surface, record%pbar_over_pstar + i*step, 0.0_dp, grid, nearby)
         if (.not. nearby%state%converged .or. .not. allocated(nearby%edge)) return
         gap(i) = -nearby%state%approach
         if (.not. surface%has_free_edges) gap(i) = nearby%state%open_gap()
         area(i) = nearby%values(2)
      end do
      call differentiate(gap, step, answer%gap_slope, answer%gap_slope_error, answer%gap_curvature, &
                         answer%gap_curvature_error)
      call differentiate(area, step, answer%area_slope, answer%area_slope_error, unused(1), unused(2))
      ! Where the grid hardly resolves gap or contact, their part that is wrong is that of their derivatives too.
      associate (of_gap => record%measures%mean_gap_error/max(abs(gap(0)), tiny(step)), &
                 of_area => record%measures%contact_area_error/max(min(area(0), 1.0_dp - area(0)), tiny(step)))
         answer%gap_slope_error = answer%gap_slope_error + abs(answer%gap_slope)*of_gap
         answer%area_slope_error = answer%area_slope_error + abs(answer%area_slope)*of_area
         if (is_known(answer%gap_curvature)) &
            answer%gap_curvature_error = answer%gap_curvature_error + abs(answer%gap_curvature)*of_gap
      end associate
   end subroutine differentiate_on_grid

   !> The first two derivatives of a function from five values at equal steps, and their errors (C29).
   !>
   !> The points of a grid enter the contact one after another, which makes the values scatter: by how much is estimated
   !> from third and fourth differences. They show errors of the differences too.
   pure subroutine differentiate(f, step, slope, slope_error, curvature, curvature_error)
      real(dp), intent(in) :: f(-2:2), step
      real(dp), intent(out) :: slope, slope_error, curvature, curvature_error

      !> Scatter below which the contact is the same at all loads: the solutions are linear in the load.
      real(dp), parameter :: unchanged = 1e-5_dp
      real(dp) :: fourth, scatter, third

      slope = (8*(f(1) - f(-1)) - (f(2) - f(-2)))/(12*step)
      curvature = (16*(f(1) + f(-1)) - (f(2) + f(-2)) - 30*f(0))/(12*step**2)
      third = f(2) - f(-2) - 2*(f(1) - f(-1))
      fourth = f(2) + f(-2) - 4*(f(1) + f(-1)) + 6*f(0)
      ! In third differences of random numbers there are 10 of their squares, in fourth ones 70.
      scatter = max(abs(third)/sqrt(10.0_dp), abs(fourth)/sqrt(70.0_dp))
      ! The root sums of squares in slope and curvature are .95 and 3.1; twice that.
      slope_error = 2*scatter/step
      curvature_error = 6*scatter/step**2
      if (scatter > unchanged*abs(f(2) - f(-2))) return
      curvature = unknown
      curvature_error = unknown
   end subroutine differentiate

end module wavycon_grid_derivatives
