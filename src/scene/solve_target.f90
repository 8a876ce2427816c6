!> Solves the load of a given mean pressure, mean gap, approach, contact area or equivalent stress.
module wavycon_solve_target
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_find_load, only: solve_for_approach, solve_for_contact_area, solve_for_mean_gap
   use wavycon_find_yield, only: solve_for_yield
   use wavycon_kinds, only: dp
   use wavycon_scene, only: by_approach, by_contact_area, by_mean_gap, by_yield
   use wavycon_stress_setting, only: stress_setting
   implicit none (type, external)
   private

   public :: solve_target

contains

   !> Solves one load, or finds the load of a given mean gap, approach, area or stress.
   subroutine solve_target(solver, loads_by, target, solution, setting)
      class(contact_solver), intent(inout) :: solver
      integer, intent(in) :: loads_by     !! a name of wavycon_scene
      real(dp), intent(in) :: target      !! as of scene_type
      type(contact_solution), intent(out) :: solution
      type(stress_setting), intent(in), optional :: setting   !! needed by_yield, with yield stresses

      select case (loads_by)
      case (by_mean_gap)
         call solve_for_mean_gap(solver, target, solution)
      case (by_approach)
         call solve_for_approach(solver, target, solution)
      case (by_contact_area)
         call solve_for_contact_area(solver, target, solution)
      case (by_yield)
         call solve_for_yield(solver, setting, target, solution)
      case default
         call solver%solve(target, solution)
      end select
   end subroutine solve_target

end module wavycon_solve_target
