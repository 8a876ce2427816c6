!> solver = 'fitted': expansions fitted to the edge of contact.
module wavycon_fitted_method
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_tuning, only: largest_aspect_ratio, largest_curvature_ratio
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_grid_keys, only: accuracy_key
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: fitted_method

   type, extends(solver_method) :: fitted_method
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: refusal
      procedure, nopass :: advice
      procedure, nopass :: traits
      procedure, nopass :: make
      procedure, nopass :: describe
   end type fitted_method

contains

   pure function name() result(words)
      character(:), allocatable :: words

      words = 'fitted'
   end function name

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'expansions fitted to the edge of contact, of spots or of open islands'
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [accuracy_key()]
   end function keys

   function refusal(surface) result(words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      type(fitted_frame) :: frame

      call find_frame(surface, frame)
      words = ''
      if (surface%has_hardness()) words = 'has no solution with a hardness'
      ! A flat surface is in full contact at every load: no expansion is needed.
      if (.not. frame%is_found() .and. surface%amplitude > 0.0_dp) words = 'has expansions for '//its_surfaces()
   end function refusal

   !> The surfaces that have a frame, for messages and the key reference.
   pure function its_surfaces() result(words)
      character(:), allocatable :: words

      words = "the paper's wave, also with two wavelengths up to "//short_number(largest_aspect_ratio)// &
              ':1, for crossed waves with crest curvatures up to '//short_number(largest_curvature_ratio)// &
              ':1 and for three equal waves at 60 degrees'
   end function its_surfaces

   function advice(key) result(words)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      words = ''
      if (key == 'grid_points') words = ': it has no grid'
   end function advice

   type(solver_traits) function traits()
      type(fitted_contact) :: solver

      traits = solver%traits()
   end function traits

   subroutine make(values, surface, keep_fields, solver)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver

      type(fitted_contact), allocatable :: own

      allocate (own)
      call own%start(surface, values%real('accuracy'), keep_fields)
      call move_alloc(own, solver)
   end subroutine make

   function describe(values, surface, traits) result(words)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      type(solver_traits), intent(in) :: traits
      character(:), allocatable :: words

      associate (unused => surface, unused_too => traits); end associate
      words = 'boundary-fitted expansions to within '//short_number(values%real('accuracy'))
   end function describe

end module wavycon_fitted_method
