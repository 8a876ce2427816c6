!> The list of all solvers that a deck can name. A new solver adds its line to `get_solvers`.
module wavycon_solver_list
   use wavycon_auto_contact, only: auto_contact
   use wavycon_beale_contact, only: beale_contact
   use wavycon_closed_form_contact, only: closed_form_contact
   use wavycon_contact_solver, only: contact_solver
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_grid_contact, only: grid_contact
   use wavycon_group_values, only: group_values
   use wavycon_key_alternatives, only: alternative_type
   use wavycon_key_table, only: in_quotes, listed
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: solver_item, get_solvers, keys_of_solvers, default_solver, solvers_for, solvers_with_coefficients, &
      solvers_with_details, start_solver

   type :: solver_item
      class(contact_solver), allocatable :: solver
   end type solver_item

contains

   !> All solvers, not started, in the order of the key reference.
   subroutine get_solvers(solvers)
      type(solver_item), allocatable, intent(out) :: solvers(:)

      allocate (solvers(5))
      allocate (beale_contact :: solvers(1)%solver)
      allocate (grid_contact :: solvers(2)%solver)
      allocate (fitted_contact :: solvers(3)%solver)
      allocate (closed_form_contact :: solvers(4)%solver)
      allocate (auto_contact :: solvers(5)%solver)
   end subroutine get_solvers

   !> The name and the keys of each solver.
   subroutine keys_of_solvers(solvers, alternatives)
      type(solver_item), intent(in) :: solvers(:)
      type(alternative_type), allocatable, intent(out) :: alternatives(:)

      integer :: i

      allocate (alternatives(size(solvers)))
      do i = 1, size(solvers)
         alternatives(i)%name = solvers(i)%solver%name()
         alternatives(i)%meaning = solvers(i)%solver%meaning()
         alternatives(i)%keys = solvers(i)%solver%keys()
      end do
   end subroutine keys_of_solvers

   !> The name of the default solver of a surface.
   function default_solver(surface, kind) result(name)
      type(surface_type), intent(in) :: surface
      character(*), intent(in) :: kind           !! of the surface, as the deck names it
      character(:), allocatable :: name

      type(solver_item), allocatable :: solvers(:)
      integer :: i

      call get_solvers(solvers)
      name = ''
      do i = 1, size(solvers)
         if (.not. solvers(i)%solver%is_default_for(surface, kind)) cycle
         name = solvers(i)%solver%name()
         return
      end do
   end function default_solver

   !> The solvers that can solve a surface, such as "'grid' or 'auto'".
   function solvers_for(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      type(solver_item), allocatable :: solvers(:)
      integer :: i

      call get_solvers(solvers)
      words = names_of(solvers, [(solvers(i)%solver%refusal(surface) == '', i=1, size(solvers))])
   end function solvers_for

   !> The solvers whose solutions have details.
   function solvers_with_details() result(words)
      character(:), allocatable :: words

      type(solver_item), allocatable :: solvers(:)
      integer :: i

      call get_solvers(solvers)
      words = names_of(solvers, [(solvers(i)%solver%has_details(), i=1, size(solvers))])
   end function solvers_with_details

   !> The solvers whose solutions have the coefficients of a series.
   function solvers_with_coefficients() result(words)
      character(:), allocatable :: words

      type(solver_item), allocatable :: solvers(:)
      integer :: i

      call get_solvers(solvers)
      words = names_of(solvers, [(solvers(i)%solver%has_coefficients(), i=1, size(solvers))])
   end function solvers_with_coefficients

   function names_of(solvers, selected) result(words)
      type(solver_item), intent(in) :: solvers(:)
      logical, intent(in) :: selected(:)   !! of each solver
      character(:), allocatable :: words

      character(12) :: names(size(solvers))
      integer :: i

      do i = 1, size(solvers)
         names(i) = solvers(i)%solver%name()
      end do
      words = listed(in_quotes(pack(names, selected)), ' or ')
   end function names_of

   !> Makes the solver that &method names and starts it. Not allocated if no solver has that name.
   subroutine start_solver(surface, values, keep_fields, solver)
      type(surface_type), intent(in) :: surface
      type(group_values), intent(in) :: values       !! of &method, without problems
      logical, intent(in) :: keep_fields             !! whether fields, edges or details of solutions will be needed
      class(contact_solver), allocatable, intent(out) :: solver

      type(solver_item), allocatable :: solvers(:)
      integer :: i

      call get_solvers(solvers)
      do i = 1, size(solvers)
         if (solvers(i)%solver%name() /= values%text('solver')) cycle
         call move_alloc(solvers(i)%solver, solver)
         call solver%start_from_keys(surface, values, keep_fields)
         return
      end do
   end subroutine start_solver

end module wavycon_solver_list
