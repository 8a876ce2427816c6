!> solver = 'grid': grids, refined to an accuracy or with a given number of points.
module wavycon_grid_method
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_grid_contact, only: grid_contact
   use wavycon_grid_keys, only: accuracy_key, check_grid_points, describe_grid, grid_points_key, residual_key, &
      set_grid_defaults, start_on_grids
   use wavycon_group_values, only: group_values
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: grid_method

contains

   type(solver_method) function grid_method() result(method)
      type(grid_contact) :: solver

      method%name = 'grid'
      method%meaning = 'ever finer grids until mean gap, area and peak pressure are accurate'
      allocate (method%keys, source=[accuracy_key(), grid_points_key(), residual_key()])
      method%traits = solver%traits()
      method%set_defaults => set_grid_defaults
      method%check => check_grid_points
      method%make => make
      method%describe => describe_grid
   end function grid_method

   subroutine make(values, surface, keep_fields, solver)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver

      type(grid_contact), allocatable :: own

      allocate (own)
      call start_on_grids(values, surface, keep_fields, own)
      call move_alloc(own, solver)
   end subroutine make

end module wavycon_grid_method
