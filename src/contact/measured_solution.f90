!> The measures of a solution that another process has computed, without its fields.
module wavycon_measured_solution
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_edge_curves, only: edge_curve
   use wavycon_kinds, only: dp
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: measured_solution

   !> As a solution of a solver that was started without keep_fields.
   type, extends(contact_solution) :: measured_solution
   contains
      procedure :: fields
      procedure :: edge_curves
      procedure :: stresses
   end type measured_solution

contains

   subroutine fields(self, surface, answer)
      class(measured_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      associate (unused => self, unused_too => surface); end associate
      if (allocated(answer)) return
   end subroutine fields

   subroutine edge_curves(self, surface, curves, loads)
      class(measured_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(edge_curve), allocatable, intent(out) :: curves(:)
      real(dp), allocatable, intent(out), optional :: loads(:)

      associate (unused => self, unused_too => surface); end associate
      allocate (curves(0))
      if (present(loads)) allocate (loads(0))
   end subroutine edge_curves

   subroutine stresses(self, surface, answer)
      class(measured_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      associate (unused => self, unused_too => surface); end associate
      if (allocated(answer)) return
   end subroutine stresses

end module wavycon_measured_solution
