!> solver = 'closed_form': Westergaard's solution of the 1-D wave.
module wavycon_closed_form_method
   use wavycon_closed_form_contact, only: closed_form_contact, closed_form_exists
   use wavycon_contact_solver, only: contact_solver
   use wavycon_group_values, only: group_values
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: closed_form_method

   character(*), parameter, public :: closed_form_in_words = "closed form (Westergaard's solution)"

contains

   type(solver_method) function closed_form_method() result(method)
      type(closed_form_contact) :: solver

      method%name = 'closed_form'
      method%meaning = "Westergaard's solution of the 1-D wave"
      allocate (method%keys(0))
      method%traits = solver%traits()
      method%refusal => refusal
      method%make => make
   end function closed_form_method

   subroutine refusal(surface, words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      words = ''
      if (surface%has_hardness()) words = 'has no solution with a hardness'
      if (.not. closed_form_exists(surface)) words = 'is for the 1-D wave'
   end subroutine refusal

   subroutine make(values, surface, keep_fields, solver, description)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver
      character(:), allocatable, intent(out) :: description

      type(closed_form_contact), allocatable :: own

      associate (there_are_none => values, fields_need_no_memory => keep_fields); end associate
      allocate (own)
      call own%start(surface)
      call move_alloc(own, solver)
      description = closed_form_in_words
   end subroutine make

end module wavycon_closed_form_method
