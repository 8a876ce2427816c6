!> What every table of results declares and does. src/README.md describes how to add one.
module wavycon_table
   use wavycon_contact_solver, only: contact_solver
   use wavycon_error, only: error_type
   use wavycon_results, only: results_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: table_type

   type, abstract :: table_type
   contains
      procedure(words_of_table), deferred, nopass :: key
      procedure(words_of_table), deferred, nopass :: meaning
      procedure :: refusal
      procedure :: needs_fields
      procedure :: is_for_flat_surfaces
      procedure(write_table), deferred, nopass :: write
   end type table_type

   abstract interface
      !> key: the logical key of &output that requests the table; '' for the one that is always written.
      !> meaning: what the table holds, for --help.
      pure function words_of_table() result(words)
         character(:), allocatable :: words
      end function words_of_table

      !> Writes the table. Errors: exit_file_trouble.
      subroutine write_table(results, error)
         import :: error_type, results_type
         type(results_type), intent(in) :: results
         type(error_type), allocatable, intent(out) :: error
      end subroutine write_table
   end interface

contains

   !> Why a deck with this solver and this surface cannot have the table; '' if it can.
   function refusal(self, solver, surface) result(words)
      class(table_type), intent(in) :: self
      class(contact_solver), intent(in) :: solver
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      associate (unused => self, unused_too => solver, also_unused => surface); end associate
      words = ''
   end function refusal

   !> Whether the table is made from fields, edges or details of the solutions.
   pure logical function needs_fields(self)
      class(table_type), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .false.
   end function needs_fields

   !> Whether the table makes sense where p* and Delta are zero.
   pure logical function is_for_flat_surfaces(self)
      class(table_type), intent(in) :: self

      associate (unused => self); end associate
      is_for_flat_surfaces = .false.
   end function is_for_flat_surfaces

end module wavycon_table
