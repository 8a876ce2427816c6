!> The list of all solvers that a deck can name. A new solver adds its line to `get_methods`.
module wavycon_method_list
   use wavycon_auto_method, only: auto_method
   use wavycon_beale_method, only: beale_method
   use wavycon_closed_form_method, only: closed_form_method
   use wavycon_contact_solver, only: contact_solver
   use wavycon_fitted_method, only: fitted_method
   use wavycon_grid_method, only: grid_method
   use wavycon_group_values, only: group_values
   use wavycon_plain_text, only: in_quotes, listed
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   use wavycon_wave_kinds, only: paper_kinds
   implicit none (type, external)
   private

   public :: get_methods, method_of, default_solver, refusal, solvers_for, solvers_with, start_solver

   integer, parameter, public :: number_of_methods = 5

contains

   !> All solvers, in the order of the key reference.
   subroutine get_methods(methods)
      type(solver_method), intent(out) :: methods(number_of_methods)

      methods(1) = beale_method()
      methods(2) = grid_method()
      methods(3) = fitted_method()
      methods(4) = closed_form_method()
      methods(5) = auto_method()
   end subroutine get_methods

   !> The method that &method names. Its pointers are null if there is none of that name.
   type(solver_method) function method_of(values) result(method)
      type(group_values), intent(in) :: values   !! of &method

      type(solver_method) :: methods(number_of_methods)
      integer :: i

      call get_methods(methods)
      i = findloc(methods%name == values%text('solver'), .true., dim=1)
      if (i > 0) method = methods(i)
   end function method_of

   !> The name of the default solver of a surface.
   function default_solver(surface, kind) result(name)
      type(surface_type), intent(in) :: surface
      character(*), intent(in) :: kind           !! of the surface, as the deck names it
      character(:), allocatable :: name

      name = 'auto'
      ! A sum of waves that equals a wave of the paper is solved to an accuracy by default, as all other sums are.
      if (any(paper_kinds == kind) .and. surface%is_paper_wave()) name = 'beale'
   end function default_solver

   !> Why a solver cannot solve a surface; empty if it can.
   function refusal(method, surface) result(words)
      type(solver_method), intent(in) :: method
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      words = ''
      if (associated(method%refusal)) call method%refusal(surface, words)
   end function refusal

   !> The solvers that can solve a surface, such as "'grid' or 'auto'".
   function solvers_for(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      type(solver_method) :: methods(number_of_methods)
      integer :: i

      call get_methods(methods)
      words = names_of(methods, [(refusal(methods(i), surface) == '', i=1, number_of_methods)])
   end function solvers_for

   !> The solvers whose solutions have details, or the coefficients of a series.
   function solvers_with(trait) result(words)
      character(*), intent(in) :: trait   !! 'details' or 'coefficients'
      character(:), allocatable :: words

      type(solver_method) :: methods(number_of_methods)

      call get_methods(methods)
      words = names_of(methods, merge(methods%traits%has_details, methods%traits%has_coefficients, trait == 'details'))
   end function solvers_with

   function names_of(methods, selected) result(words)
      type(solver_method), intent(in) :: methods(:)
      logical, intent(in) :: selected(:)   !! of each
      character(:), allocatable :: words

      character(len(methods%name)) :: names(size(methods))

      names = methods%name
      words = listed(in_quotes(pack(names, selected)), ' or ')
   end function names_of

   !> Makes the solver that &method names and starts it. Not allocated if no solver has that name.
   subroutine start_solver(surface, values, keep_fields, solver, description)
      type(surface_type), intent(in) :: surface
      type(group_values), intent(in) :: values       !! of &method, without problems
      logical, intent(in) :: keep_fields             !! whether fields, edges or details of solutions will be needed
      class(contact_solver), allocatable, intent(out) :: solver
      character(:), allocatable, intent(out), optional :: description   !! the discretisation in words

      character(:), allocatable :: words
      type(solver_method) :: method

      method = method_of(values)
      if (.not. associated(method%make)) return
      call method%make(values, surface, keep_fields, solver, words)
      if (present(description)) call move_alloc(words, description)
   end subroutine start_solver

end module wavycon_method_list
