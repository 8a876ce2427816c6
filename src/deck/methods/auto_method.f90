!> solver = 'auto': the closed form, expansions or grids, by the surface.
module wavycon_auto_method
   use wavycon_auto_contact, only: auto_contact, has_a_hardness, has_closed_form, has_expansions, has_neither, &
      points_are_given, points_are_of_the_map
   use wavycon_closed_form_method, only: closed_form_in_words
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_fitted_method, only: fitted_in_words
   use wavycon_grid_method, only: check_grid_keys, grid_in_words, grid_keys, start_on_grids
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
      method%meaning = "the closed form where there is one, otherwise 'fitted' where it applies, with "// &
                       "'grid' for loads at which these are not accurate enough, otherwise and with a hardness 'grid'"
      allocate (method%keys, source=grid_keys())
      method%traits = solver%traits()
      method%check => check_grid_keys
      method%make => make
   end function auto_method

   subroutine make(values, surface, keep_fields, solver, description)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver
      character(:), allocatable, intent(out) :: description

      type(auto_contact), allocatable :: own
      type(solver_traits) :: traits

      allocate (own)
      call start_on_grids(values, surface, keep_fields, own)
      traits = own%traits()
      call move_alloc(own, solver)
      select case (traits%choice)
      case (has_closed_form)
         description = closed_form_in_words
      case (has_expansions)
         description = fitted_in_words(values)//', grids where it cannot'
      case default
         description = grid_in_words(values, surface)
      end select
   end subroutine make

   !> Why the solvers were taken, as a sentence for --check; empty for other solvers than 'auto'.
   pure function why_chosen(traits) result(words)
      type(solver_traits), intent(in) :: traits   !! of the started solver
      character(:), allocatable :: words

      select case (traits%choice)
      case (has_closed_form)
         words = 'the surface is the 1-D wave, which has a closed form'
      case (has_expansions)
         words = "the surface has a lattice of equal spots; grids solve the loads for which 'fitted' is not "// &
                 'accurate enough'
      case (has_neither)
         words = 'the surface has neither a closed form nor a lattice of equal spots'
      case (has_a_hardness)
         words = "neither the closed form nor 'fitted' has a hardness"
      case (points_are_given)
         words = 'the points of the grid are given'
      case (points_are_of_the_map)
         words = 'a height map is solved on its own points unless an accuracy is given'
      case default
         words = ''
      end select
   end function why_chosen

end module wavycon_auto_method
