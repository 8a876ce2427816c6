!> solver = 'closed_form': Westergaard's solution of the 1-D wave.
module wavycon_closed_form_method
   use wavycon_closed_form_contact, only: closed_form_contact, closed_form_exists
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: closed_form_method

   type, extends(solver_method) :: closed_form_method
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: refusal
      procedure, nopass :: traits
      procedure, nopass :: make
      procedure, nopass :: describe
   end type closed_form_method

contains

   pure function name() result(words)
      character(:), allocatable :: words

      words = 'closed_form'
   end function name

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = "Westergaard's solution of the 1-D wave"
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      allocate (rows(0))
   end function keys

   function refusal(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      words = ''
      if (surface%has_hardness()) words = 'has no solution with a hardness'
      if (.not. closed_form_exists(surface)) words = 'is for the 1-D wave'
   end function refusal

   type(solver_traits) function traits()
      type(closed_form_contact) :: solver

      traits = solver%traits()
   end function traits

   subroutine make(values, surface, keep_fields, solver)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver

      type(closed_form_contact), allocatable :: own

      associate (there_are_none => values, fields_need_no_memory => keep_fields); end associate
      allocate (own)
      call own%start(surface)
      call move_alloc(own, solver)
   end subroutine make

   function describe(values, surface, traits) result(words)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      type(solver_traits), intent(in) :: traits
      character(:), allocatable :: words

      associate (unused => values, unused_too => surface, also_unused => traits); end associate
      words = "closed form (Westergaard's solution)"
   end function describe

end module wavycon_closed_form_method
