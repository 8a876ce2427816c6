!> What a solver keeps of a partial contact so that fields, edge of contact and stresses can be made when they are asked
!> for. Each solver extends `field_source`; callers use `contact_solution`, which has one.
!>
!> Positions of fields and edges are the angles X, Y of the surface's cell.
module wavycon_field_source
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_contours, only: contact_contour
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: quantities
   use wavycon_solution_record, only: solution_record
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: field_source

   !> All that the procedures need besides the surface. Of the procedures the deferred ones must be written; the others
   !> have defaults.
   type, abstract :: field_source
      type(solution_record) :: record    !! the numbers of the solution: `solve` of contact_solver sets it
      !> of the grid if its columns are distributed over the ranks, otherwise 0
      integer(int64) :: distributed_points = 0
   contains
      procedure(fields_of_source), deferred :: fields
      procedure(edge_of_source), deferred :: contact_contours
      procedure(stresses_of_source), deferred :: stresses
      procedure :: coefficients
      procedure :: details
      procedure(slopes_of_source), deferred :: derivatives
      procedure :: collect
   end type field_source

   abstract interface
      !> Pressure, displacement and gap.
      subroutine fields_of_source(self, surface, answer)
         import :: contact_fields, field_source, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! that was solved
         class(contact_fields), allocatable, intent(out) :: answer
      end subroutine fields_of_source

      !> The edge of contact: closed curves in 2-D, the two ends of each strip in 1-D.
      subroutine edge_of_source(self, surface, curves, loads)
         import :: dp, contact_contour, field_source, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! that was solved
         type(contact_contour), allocatable, intent(out) :: curves(:)
         !> What each spot carries of the load, by their numbers; of no size if that is not known.
         real(dp), allocatable, intent(out) :: loads(:)
      end subroutine edge_of_source

      !> The stresses below the surface.
      subroutine stresses_of_source(self, surface, answer)
         import :: field_source, stress_fields, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! that was solved
         class(stress_fields), allocatable, intent(out) :: answer
      end subroutine stresses_of_source

      !> How the solution changes with the load.
      subroutine slopes_of_source(self, surface, answer)
         import :: field_source, quantities, surface_type
         class(field_source), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! that was solved
         type(quantities), intent(out) :: answer               !! where unknown NaN
      end subroutine slopes_of_source
   end interface

contains

   !> p/p* as the Fourier series in X and Y that the solver computed; series%c is not allocated here: there is none.
   subroutine coefficients(self, series)
      class(field_source), intent(in) :: self
      type(fourier_series), intent(out) :: series

      associate (unused => self, none => series); end associate
   end subroutine coefficients

   !> Adds the quantities that are only computed when they are asked for. Here there are none.
   subroutine details(self, answer)
      class(field_source), intent(in) :: self
      type(quantities), intent(inout) :: answer   !! with those of the record

      associate (unused => self, unchanged => answer); end associate
   end subroutine details

   !> Brings what is distributed over the ranks to the first rank. All ranks call it. Here nothing is distributed.
   subroutine collect(self, is_here)
      class(field_source), intent(inout) :: self
      logical, intent(out) :: is_here                !! whether this rank has all of it afterwards

      associate (unused => self); end associate
      is_here = .true.
   end subroutine collect

end module wavycon_field_source
