!> The list of all solvers that a deck can name. A new solver adds its line to `get_methods`.
module wavycon_method_list
   use wavycon_auto_method, only: auto_method
   use wavycon_beale_method, only: beale_method
   use wavycon_closed_form_method, only: closed_form_method
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_fitted_method, only: fitted_method
   use wavycon_grid_method, only: grid_method
   use wavycon_group_values, only: group_values
   use wavycon_key_alternatives, only: alternative_type
   use wavycon_plain_text, only: in_quotes, listed
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: method_item, get_methods, get_method, keys_of_methods, default_solver, solvers_for, &
      solvers_with_coefficients, solvers_with_details, start_solver

   type :: method_item
      class(solver_method), allocatable :: method
   end type method_item

contains

   !> All solvers, in the order of the key reference.
   subroutine get_methods(methods)
      type(method_item), allocatable, intent(out) :: methods(:)

      allocate (methods(0))
      call add(methods, beale_method())
      call add(methods, grid_method())
      call add(methods, fitted_method())
      call add(methods, closed_form_method())
      call add(methods, auto_method())
   end subroutine get_methods

   subroutine add(methods, method)
      type(method_item), allocatable, intent(inout) :: methods(:)
      class(solver_method), intent(in) :: method

      type(method_item), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(methods) + 1))
      do i = 1, size(methods)
         call move_alloc(methods(i)%method, longer(i)%method)
      end do
      allocate (longer(size(longer))%method, source=method)
      call move_alloc(longer, methods)
   end subroutine add

   !> The method that &method names; not allocated if there is none of that name.
   subroutine get_method(values, method)
      type(group_values), intent(in) :: values   !! of &method
      class(solver_method), allocatable, intent(out) :: method

      type(method_item), allocatable :: methods(:)
      integer :: i

      call get_methods(methods)
      do i = 1, size(methods)
         if (methods(i)%method%name() == values%text('solver')) call move_alloc(methods(i)%method, method)
         if (allocated(method)) return
      end do
   end subroutine get_method

   !> The name and the keys of each solver.
   subroutine keys_of_methods(methods, alternatives)
      type(method_item), intent(in) :: methods(:)
      type(alternative_type), allocatable, intent(out) :: alternatives(:)

      integer :: i

      allocate (alternatives(size(methods)))
      do i = 1, size(methods)
         alternatives(i)%name = methods(i)%method%name()
         alternatives(i)%meaning = methods(i)%method%meaning()
         alternatives(i)%keys = methods(i)%method%keys()
      end do
   end subroutine keys_of_methods

   !> The name of the default solver of a surface.
   function default_solver(surface, kind) result(name)
      type(surface_type), intent(in) :: surface
      character(*), intent(in) :: kind           !! of the surface, as the deck names it
      character(:), allocatable :: name

      type(method_item), allocatable :: methods(:)
      integer :: i

      call get_methods(methods)
      name = ''
      do i = 1, size(methods)
         if (.not. methods(i)%method%is_default_for(surface, kind)) cycle
         name = methods(i)%method%name()
         return
      end do
   end function default_solver

   !> The solvers that can solve a surface, such as "'grid' or 'auto'".
   function solvers_for(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      type(method_item), allocatable :: methods(:)
      integer :: i

      call get_methods(methods)
      words = names_of(methods, [(methods(i)%method%refusal(surface) == '', i=1, size(methods))])
   end function solvers_for

   !> The solvers whose solutions have details.
   function solvers_with_details() result(words)
      character(:), allocatable :: words

      type(method_item), allocatable :: methods(:)
      type(solver_traits), allocatable :: traits(:)

      call get_methods(methods)
      allocate (traits, source=traits_of(methods))
      words = names_of(methods, traits%has_details)
   end function solvers_with_details

   !> The solvers whose solutions have the coefficients of a series.
   function solvers_with_coefficients() result(words)
      character(:), allocatable :: words

      type(method_item), allocatable :: methods(:)
      type(solver_traits), allocatable :: traits(:)

      call get_methods(methods)
      allocate (traits, source=traits_of(methods))
      words = names_of(methods, traits%has_coefficients)
   end function solvers_with_coefficients

   function traits_of(methods) result(traits)
      type(method_item), intent(in) :: methods(:)
      type(solver_traits) :: traits(size(methods))

      integer :: i

      do i = 1, size(methods)
         traits(i) = methods(i)%method%traits()
      end do
   end function traits_of

   function names_of(methods, selected) result(words)
      type(method_item), intent(in) :: methods(:)
      logical, intent(in) :: selected(:)   !! of each
      character(:), allocatable :: words

      character(12) :: names(size(methods))
      integer :: i

      do i = 1, size(methods)
         names(i) = methods(i)%method%name()
      end do
      words = listed(in_quotes(pack(names, selected)), ' or ')
   end function names_of

   !> Makes the solver that &method names and starts it. Not allocated if no solver has that name.
   subroutine start_solver(surface, values, keep_fields, solver, description)
      type(surface_type), intent(in) :: surface
      type(group_values), intent(in) :: values       !! of &method, without problems
      logical, intent(in) :: keep_fields             !! whether fields, edges or details of solutions will be needed
      class(contact_solver), allocatable, intent(out) :: solver
      character(:), allocatable, intent(out), optional :: description   !! the discretisation in words

      class(solver_method), allocatable :: method

      call get_method(values, method)
      if (.not. allocated(method)) return
      call method%make(values, surface, keep_fields, solver)
      if (present(description)) description = method%describe(values, surface, solver%traits())
   end subroutine start_solver

end module wavycon_method_list
