!> solver = 'grid': grids, refined to an accuracy or with a given number of points.
module wavycon_grid_method
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_grid_contact, only: grid_contact
   use wavycon_grid_keys, only: describe_grid, grid_keys, points_of_grid, set_grid_defaults, check_grid_points
   use wavycon_group_values, only: group_values
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: grid_method

   type, extends(solver_method) :: grid_method
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys => grid_keys
      procedure, nopass :: set_defaults => set_grid_defaults
      procedure, nopass :: check => check_grid_points
      procedure, nopass :: traits
      procedure, nopass :: make
      procedure, nopass :: describe => describe_grid
   end type grid_method

contains

   pure function name() result(words)
      character(:), allocatable :: words

      words = 'grid'
   end function name

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'ever finer grids until mean gap, area and peak pressure are accurate'
   end function meaning

   type(solver_traits) function traits()
      type(grid_contact) :: solver

      traits = solver%traits()
   end function traits

   subroutine make(values, surface, keep_fields, solver)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver

      type(grid_contact), allocatable :: own

      allocate (own)
      call own%start(surface, values%real('accuracy'), keep_fields, points_of_grid(values, surface), &
                     values%real('residual'))
      call move_alloc(own, solver)
   end subroutine make

end module wavycon_grid_method
