!> solver = 'fitted': expansions fitted to the edge of contact.
module wavycon_fitted_method
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_tuning, only: largest_aspect_ratio, largest_curvature_ratio
   use wavycon_fitted_contact, only: fitted_contact, fitted_options
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_grid_method, only: accuracy_key
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: fitted_method, fitted_in_words

contains

   type(solver_method) function fitted_method() result(method)
      type(fitted_contact) :: solver

      method%name = 'fitted'
      method%meaning = 'collocation fitted to the edge of contact, of spots or of closed pools of gap'
      allocate (method%keys, source=[accuracy_key()])
      method%traits = solver%traits()
      method%refusal => refusal
      method%make => make
   end function fitted_method

   subroutine refusal(surface, words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      type(fitted_frame) :: frame

      call find_frame(surface, frame)
      words = ''
      if (surface%has_hardness()) words = 'has no solution with a hardness'
      ! A flat surface is in full contact at every load: no expansion is needed.
      if (.not. frame%is_found() .and. surface%amplitude > 0.0_dp) words = &
         "is for the paper's wave, also with two wavelengths up to "//short_number(largest_aspect_ratio)// &
         ':1, for crossed waves with crest curvatures up to '//short_number(largest_curvature_ratio)// &
         ':1 and for three equal waves at 60 degrees'
   end subroutine refusal

   subroutine make(values, surface, keep_fields, solver, description)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver
      character(:), allocatable, intent(out) :: description

      type(fitted_contact), allocatable :: own

      allocate (own)
      call own%start(surface, fitted_options(values%real('accuracy')), keep_fields)
      call move_alloc(own, solver)
      description = fitted_in_words(values)
   end subroutine make

   !> The expansions in words.
   pure function fitted_in_words(values) result(words)
      type(group_values), intent(in) :: values   !! of &method
      character(:), allocatable :: words

      words = 'collocation fitted to the edge to within '//short_number(values%real('accuracy'))
   end function fitted_in_words

end module wavycon_fitted_method
