!> solver = 'auto': the closed form, expansions or grids, by the surface.
module wavycon_auto_method
   use wavycon_auto_contact, only: auto_contact, has_a_hardness, has_closed_form, has_expansions, has_neither, &
      points_are_given, points_are_of_the_map
   use wavycon_closed_form_method, only: describe_closed_form
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_fitted_method, only: describe_fitted
   use wavycon_grid_keys, only: accuracy_key, check_grid_points, describe_grid, grid_points_key, residual_key, &
      set_grid_defaults, start_on_grids
   use wavycon_group_values, only: group_values
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: auto_method, why_chosen

contains

   type(solver_method) function auto_method() result(method)
      type(auto_contact) :: solver

      method%name = 'auto'
      method%meaning = "the closed form where there is one, otherwise 'fitted' where its expansions exist, with "// &
                       "'grid' for loads at which these are not accurate enough, otherwise and with a hardness 'grid'"
      allocate (method%keys, source=[accuracy_key(), grid_points_key(), residual_key()])
      method%traits = solver%traits()
      method%set_defaults => set_grid_defaults
      method%check => check_grid_points
      method%make => make
      method%describe => describe
   end function auto_method

   subroutine make(values, surface, keep_fields, solver)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver

      type(auto_contact), allocatable :: own

      allocate (own)
      call start_on_grids(values, surface, keep_fields, own)
      call move_alloc(own, solver)
   end subroutine make

   subroutine describe(values, surface, traits, words)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      type(solver_traits), intent(in) :: traits
      character(:), allocatable, intent(out) :: words

      select case (traits%choice)
      case (has_closed_form)
         call describe_closed_form(values, surface, traits, words)
      case (has_expansions)
         call describe_fitted(values, surface, traits, words)
         words = words//', grids where these cannot'
      case default
         call describe_grid(values, surface, traits, words)
      end select
   end subroutine describe

   !> Why the solvers were taken, as a sentence for --check; empty for other solvers than 'auto'.
   pure function why_chosen(traits) result(words)
      type(solver_traits), intent(in) :: traits   !! of the started solver
      character(:), allocatable :: words

      select case (traits%choice)
      case (has_closed_form)
         words = 'the surface is the 1-D wave, which has a closed form'
      case (has_expansions)
         words = 'the surface has expansions; grids solve the loads for which these are not accurate enough'
      case (has_neither)
         words = 'the surface has neither a closed form nor expansions'
      case (has_a_hardness)
         words = 'neither closed form nor expansions have a hardness'
      case (points_are_given)
         words = 'the points of the grid are given'
      case (points_are_of_the_map)
         words = 'a height map is solved on its own points unless an accuracy is given'
      case default
         words = ''
      end select
   end function why_chosen

end module wavycon_auto_method
