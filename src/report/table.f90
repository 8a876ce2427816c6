!> What a table of results is, as data: its name, its columns, who asks for it, and the procedures that write its rows.
!> src/README.md describes how to add a table.
module wavycon_table
   use wavycon_assertion, only: assert
   use wavycon_contact_solver, only: solver_traits
   use wavycon_error, only: error_type
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_scene, only: scene_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: table_type

   integer, parameter :: longest_column = 48

   type :: table_type
      character(16) :: file = ''          !! the table is <case>.<file>.dat
      character(16) :: key = ''           !! the logical key that requests it; empty: it has none of its own
      character(9) :: group = 'output'    !! of the key: 'output', 'stress' or 'interface'
      character(:), allocatable :: meaning      !! one sentence for the key reference
      character(longest_column), allocatable :: columns(:)
      logical :: needs_fields = .false.   !! whether it is made from fields, edges or details of the solutions
      logical :: needs_surface = .true.   !! whether it is made from the whole surface
      logical :: is_for_flat_surfaces = .false.   !! whether it is written where p* and Delta are zero
      !> Null: it is written if its key is .true. and, without a key, always; never without its group &stress or
      !> &interface.
      procedure(request_interface), pointer, nopass :: requested => null()
      procedure(refusal_interface), pointer, nopass :: refuse => null()        !! null: it can always be written
      procedure(by_all_interface), pointer, nopass :: written_by_all => null() !! null: rank 0 writes it
      !> One of these two: the rows of a load, for a table that has rows of each load; or all of the table.
      procedure(load_interface), pointer, nopass :: put_load => null()
      procedure(write_interface), pointer, nopass :: write_all => null()
   contains
      procedure :: set_columns
      procedure :: name
      procedure :: is_requested
      procedure :: refusal
      procedure :: is_written_by_all
      procedure :: write => write_table
   end type table_type

   abstract interface
      !> `requested`: whether a scene asks for the table.
      logical function request_interface(scene)
         import :: scene_type
         type(scene_type), intent(in) :: scene
      end function request_interface

      !> `refuse`: why the table cannot be written, as `refusal` below.
      subroutine refusal_interface(traits, surface, words)
         import :: solver_traits, surface_type
         type(solver_traits), intent(in) :: traits   !! started or not
         type(surface_type), intent(in) :: surface
         character(:), allocatable, intent(out) :: words
      end subroutine refusal_interface

      !> `written_by_all`: as `is_written_by_all` below.
      logical function by_all_interface(results)
         import :: results_type
         type(results_type), intent(in) :: results
      end function by_all_interface

      !> `put_load`: writes the rows of one load.
      subroutine load_interface(results, load, file)
         import :: output_file, results_type
         type(results_type), intent(in) :: results
         integer, intent(in) :: load                !! number in the deck's order
         type(output_file), intent(inout) :: file   !! with the columns of the table
      end subroutine load_interface

      !> `write_all`: opens the table, writes it and finishes it. Errors: exit_file_trouble.
      subroutine write_interface(results, error)
         import :: error_type, results_type
         type(results_type), intent(in) :: results
         type(error_type), allocatable, intent(out) :: error
      end subroutine write_interface
   end interface

contains

   !> Declares the columns.
   pure subroutine set_columns(self, columns)
      class(table_type), intent(inout) :: self
      character(*), intent(in) :: columns(:)   !! name[unit], units as of `unit_in_words` of the results

      call assert(all(len_trim(columns) <= longest_column), 'no column is cut short')
      allocate (self%columns(size(columns)))
      self%columns = columns
   end subroutine set_columns

   !> The name that programs ask for: the key, that of &stress with 'stress_' before it; without a key that of the file.
   elemental function name(self) result(words)
      class(table_type), intent(in) :: self
      character(24) :: words

      words = self%key
      if (self%key == '') words = self%file
      if (self%group == 'stress') words = 'stress_'//self%key
   end function name

   !> Whether a scene asks for the table.
   logical function is_requested(self, scene)
      class(table_type), intent(in) :: self
      type(scene_type), intent(in) :: scene

      is_requested = self%group == 'output' .or. (self%group == 'stress' .and. allocated(scene%stress_setting)) &
         .or. (self%group == 'interface' .and. allocated(scene%interface_setting))
      if (.not. is_requested) return
      if (associated(self%requested)) then
         is_requested = self%requested(scene)
      else if (self%group == 'stress') then
         is_requested = scene%stress%logical(trim(self%key))
      else if (self%group == 'interface' .and. self%key /= '') then
         is_requested = scene%interface%logical(trim(self%key))
      else if (self%key /= '') then
         is_requested = scene%output%logical(trim(self%key))
      end if
   end function is_requested

   !> Why the table cannot be written for a solver and a surface, as a sentence for a message; empty if it can.
   function refusal(self, traits, surface) result(words)
      class(table_type), intent(in) :: self
      type(solver_traits), intent(in) :: traits   !! started or not
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      words = ''
      if (associated(self%refuse)) call self%refuse(traits, surface, words)
   end function refusal

   !> Whether all ranks write the table together, each from its columns of grids that are distributed; called before the
   !> loads are solved and after.
   logical function is_written_by_all(self, results)
      class(table_type), intent(in) :: self
      type(results_type), intent(in) :: results   !! started, before the loads are solved without solutions

      is_written_by_all = .false.
      if (associated(self%written_by_all)) is_written_by_all = self%written_by_all(results)
   end function is_written_by_all

   !> Writes the table, to a file or to the memory table of the results. Errors: exit_file_trouble.
   subroutine write_table(self, results, error)
      class(table_type), intent(in) :: self
      type(results_type), intent(in) :: results   !! with a solution for each load
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: load

      if (associated(self%write_all)) then
         call self%write_all(results, error)
         return
      end if
      call results%open_table(trim(self%file), self%columns, file)
      do load = 1, size(results%loads)
         call self%put_load(results, load, file)
      end do
      call file%finish(error)
   end subroutine write_table

end module wavycon_table
