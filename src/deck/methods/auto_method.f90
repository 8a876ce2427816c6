!> solver = 'auto': the closed form, expansions or grids, by the surface.
module wavycon_auto_method
   use wavycon_auto_contact, only: auto_contact, has_a_hardness, has_closed_form, has_expansions, has_neither, &
      points_are_given, points_are_of_the_map
   use wavycon_closed_form_method, only: closed_form_method
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_fitted_method, only: fitted_method
   use wavycon_grid_keys, only: check_grid_points, describe_grid, grid_keys, points_of_grid, set_grid_defaults
   use wavycon_group_values, only: group_values
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: auto_method, why_chosen

   type, extends(solver_method) :: auto_method
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys => grid_keys
      procedure, nopass :: is_default_for
      procedure, nopass :: set_defaults => set_grid_defaults
      procedure, nopass :: check => check_grid_points
      procedure, nopass :: traits
      procedure, nopass :: make
      procedure, nopass :: describe
   end type auto_method

contains

   pure function name() result(words)
      character(:), allocatable :: words

      words = 'auto'
   end function name

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = "the closed form where there is one, otherwise 'fitted' where its expansions exist, with 'grid' for "// &
              "loads at which these are not accurate enough, otherwise and with a hardness 'grid'"
   end function meaning

   !> For every surface: as the last of the list it is the default if no other solver is.
   logical function is_default_for(surface, kind)
      type(surface_type), intent(in) :: surface
      character(*), intent(in) :: kind

      associate (unused => surface, unused_too => kind); end associate
      is_default_for = .true.
   end function is_default_for

   type(solver_traits) function traits()
      type(auto_contact) :: solver

      traits = solver%traits()
   end function traits

   subroutine make(values, surface, keep_fields, solver)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver

      type(auto_contact), allocatable :: own

      allocate (own)
      call own%start(surface, values%real('accuracy'), keep_fields, points_of_grid(values, surface), &
                     values%real('residual'))
      call move_alloc(own, solver)
   end subroutine make

   function describe(values, surface, traits) result(words)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      type(solver_traits), intent(in) :: traits
      character(:), allocatable :: words

      type(closed_form_method) :: closed_form
      type(fitted_method) :: fitted

      select case (traits%choice)
      case (has_closed_form)
         words = closed_form%describe(values, surface, traits)
      case (has_expansions)
         words = fitted%describe(values, surface, traits)//', grids where these cannot'
      case default
         words = describe_grid(values, surface, traits)
      end select
   end function describe

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
