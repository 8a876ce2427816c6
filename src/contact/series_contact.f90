!> The solvers whose pressure is a series.
module wavycon_series_contact
   use wavycon_contact_fields, only: contact_fields, series_fields
   use wavycon_contact_solver, only: contact_solver, is_settled
   use wavycon_contact_state, only: contact_state
   use wavycon_fourier_series, only: fourier_series
   implicit none (type, external)
   private

   public :: series_contact

   type, extends(contact_solver), abstract :: series_contact
   contains
      procedure :: pressure
      procedure :: solved_fields
      procedure(series_of_state), deferred :: solved_pressure
   end type series_contact

   abstract interface
      !> p/p* of a state between no load and full contact.
      function series_of_state(self, state) result(field)
         import :: contact_state, fourier_series, series_contact
         class(series_contact), intent(in) :: self
         type(contact_state), intent(in) :: state
         type(fourier_series) :: field
      end function series_of_state
   end interface

contains

   !> p/p* of a state.
   function pressure(self, state) result(field)
      class(series_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(fourier_series) :: field

      type(series_fields) :: both

      if (is_settled(state)) then
         both = self%settled_fields(state)
         field = both%pressure
      else
         field = self%solved_pressure(state)
      end if
   end function pressure

   subroutine solved_fields(self, state, fields)
      class(series_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      class(contact_fields), allocatable, intent(out) :: fields

      type(series_fields), allocatable :: both

      allocate (both)
      both%pressure = self%solved_pressure(state)
      both%displacement = self%surface%displacement_of(both%pressure)
      call move_alloc(both, fields)
   end subroutine solved_fields

end module wavycon_series_contact
