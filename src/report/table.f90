!> The type that all tables of results extend. src/README.md describes how to add a table.
module wavycon_table
   use wavycon_contact_solver, only: solver_traits
   use wavycon_error, only: error_type
   use wavycon_results, only: results_type
   use wavycon_scene, only: scene_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: table_type

   !> A table of results. Of the procedures below the deferred ones must be written; the others have defaults.
   type, abstract :: table_type
   contains
      procedure(words_of_table), deferred, nopass :: key
      procedure(words_of_table), deferred, nopass :: meaning
      procedure, nopass :: group => output_group
      procedure :: name
      procedure :: is_requested
      procedure :: refusal
      procedure :: needs_fields
      procedure :: needs_surface
      procedure :: is_written_by_all
      procedure :: is_for_flat_surfaces
      procedure(write_table), deferred, nopass :: write
   end type table_type

   abstract interface
      !> `key`: the logical key of its group that requests the table; empty if it has none.
      !> `meaning`: one sentence for the key reference.
      pure function words_of_table() result(words)
         character(:), allocatable :: words
      end function words_of_table

      !> `write`: writes the table. Errors: exit_file_trouble.
      subroutine write_table(results, error)
         import :: error_type, results_type
         type(results_type), intent(in) :: results   !! with a solution for each load
         type(error_type), allocatable, intent(out) :: error
      end subroutine write_table
   end interface

contains

   !> The group that has the key: 'output' or 'stress'. Here it is 'output'.
   pure function output_group() result(words)
      character(:), allocatable :: words

      words = 'output'
   end function output_group

   !> The name of the table: its key, that of &stress with 'stress_' before it. A table without a key overrides it.
   function name(self) result(words)
      class(table_type), intent(in) :: self
      character(:), allocatable :: words

      words = self%key()
      if (self%group() == 'stress') words = 'stress_'//words
   end function name

   !> Whether the table is written. Here it is if its key is .true. and, without a key, always; never if the deck does
   !> not have its group &stress.
   logical function is_requested(self, scene)
      class(table_type), intent(in) :: self
      type(scene_type), intent(in) :: scene

      if (self%group() == 'stress') then
         is_requested = allocated(scene%stress_setting)
         if (is_requested) is_requested = scene%stress%logical(self%key())
      else
         is_requested = self%key() == ''
         if (.not. is_requested) is_requested = scene%output%logical(self%key())
      end if
   end function is_requested

   !> `refusal`: why the table cannot be written for a solver and a surface, as a sentence for a message; empty if it
   !> can. Here it is empty.
   function refusal(self, traits, surface) result(words)
      class(table_type), intent(in) :: self
      type(solver_traits), intent(in) :: traits   !! started or not
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      associate (unused => self, unused_too => traits, also_unused => surface); end associate
      words = ''
   end function refusal

   !> Whether the table is made from fields, edges or details of the solutions. Here it is not.
   pure logical function needs_fields(self)
      class(table_type), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .false.
   end function needs_fields

   !> Whether the table is made from the whole surface. Here it is.
   pure logical function needs_surface(self)
      class(table_type), intent(in) :: self

      associate (unused => self); end associate
      needs_surface = .true.
   end function needs_surface

   !> Whether all ranks write the table together, each from its columns of grids that are spread; called before the
   !> loads are solved and after. Here the first rank writes it.
   logical function is_written_by_all(self, results)
      class(table_type), intent(in) :: self
      type(results_type), intent(in) :: results   !! started, before the loads are solved without solutions

      associate (unused => self, unused_too => results); end associate
      is_written_by_all = .false.
   end function is_written_by_all

   !> Whether the table is written for a flat surface, whose p* and Delta are zero. Here it is not.
   pure logical function is_for_flat_surfaces(self)
      class(table_type), intent(in) :: self

      associate (unused => self); end associate
      is_for_flat_surfaces = .false.
   end function is_for_flat_surfaces

end module wavycon_table
