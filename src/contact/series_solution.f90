!> Solutions whose pressure is a Fourier series. The displacement follows from it.
module wavycon_series_solution
   use wavycon_contact_fields, only: contact_fields, series_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_fourier_series, only: fourier_series
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: series_solution

   type, extends(contact_solution), abstract :: series_solution
   contains
      procedure :: fields
      procedure(series_of_solution), deferred :: pressure
   end type series_solution

   abstract interface
      !> p/p* in X and Y. Not allocated (series%c) if the fields were not kept.
      subroutine series_of_solution(self, series)
         import :: fourier_series, series_solution
         class(series_solution), intent(in) :: self
         type(fourier_series), intent(out) :: series
      end subroutine series_of_solution
   end interface

contains

   subroutine fields(self, surface, answer)
      class(series_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(series_fields), allocatable :: both

      allocate (both)
      call self%pressure(both%pressure)
      if (.not. allocated(both%pressure%c)) return
      both%displacement = surface%displacement_of(both%pressure)
      call move_alloc(both, answer)
   end subroutine fields

end module wavycon_series_solution
