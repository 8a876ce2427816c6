!> The data that a solver keeps of a partial contact, so that fields, edge of contact and stresses can be computed when
!> they are asked for. Each solver extends `field_source`; callers use `contact_solution`, which contains one.
!>
!> Positions of fields and edges are the angles X, Y of the surface's cell.
module wavycon_field_source
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_contours, only: contact_contour
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: int64
   use wavycon_quantities, only: quantities
   use wavycon_solution_record, only: solution_record
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: field_source

   !> A source contains all that its procedures need besides the surface. An extension must write the deferred
   !> procedures; the others have defaults.
   type, abstract :: field_source
      type(solution_record) :: record    !! the numbers of the solution; `solve` of contact_solver sets the record
      !> Number of points of the grid if its columns are distributed over the ranks (processes), otherwise 0.
      integer(int64) :: distributed_points = 0
   contains
      procedure(fields_of_source), deferred :: fields
      procedure(edge_of_source), deferred :: contact_contours
      procedure(stresses_of_source), deferred :: stresses
      procedure :: coefficients, details
      procedure(slopes_of_source), deferred :: derivatives
      procedure :: collect
   end type field_source

   abstract interface
      !> `fields`: pressure, displacement and gap.
      subroutine fields_of_source(self, surface, answer)
         import :: contact_fields, field_source, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! the surface that was solved
         class(contact_fields), allocatable, intent(out) :: answer
      end subroutine fields_of_source

      !> `contact_contours`: the edge of contact, closed curves in 2-D, the two ends of each strip in 1-D, with the
      !> loads of the spots if they are known.
      subroutine edge_of_source(self, surface, curves)
         import :: contact_contour, field_source, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! the surface that was solved
         type(contact_contour), allocatable, intent(out) :: curves(:)
      end subroutine edge_of_source

      !> `stresses`: the stresses below the surface.
      subroutine stresses_of_source(self, surface, answer)
         import :: field_source, stress_fields, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! the surface that was solved
         class(stress_fields), allocatable, intent(out) :: answer
      end subroutine stresses_of_source

      !> `derivatives`: derivatives of mean gap and area with respect to the load. All that is not set is unknown.
      subroutine slopes_of_source(self, surface, answer)
         import :: field_source, quantities, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! the surface that was solved
         type(quantities), intent(out) :: answer               !! gap_slope, area_slope and gap_curvature
      end subroutine slopes_of_source
   end interface

contains

   !> The Fourier series of p/p* in X and Y that the solver computed. By default there is none, and series%c is not
   !> allocated.
   subroutine coefficients(self, series)
      class(field_source), intent(in) :: self
      type(fourier_series), intent(out) :: series

      associate (unused => self, none => series); end associate
   end subroutine coefficients

   !> Adds quantities that are only computed when they are asked for. By default there are none.
   subroutine details(self, answer)
      class(field_source), intent(in) :: self
      type(quantities), intent(inout) :: answer   !! on entry the quantities of the record

      associate (unused => self, unchanged => answer); end associate
   end subroutine details

   !> Gathers data that are distributed over the ranks on the first rank. All ranks call this procedure. By default
   !> nothing is distributed.
   subroutine collect(self, is_here)
      class(field_source), intent(inout) :: self
      logical, intent(out) :: is_here                !! whether this rank has all the data afterwards

      associate (unused => self); end associate
      is_here = .true.
   end subroutine collect

end module wavycon_field_source
