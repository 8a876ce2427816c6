!> The description of a table of results: its name, its columns, the keys that ask for it, and the procedure that writes
!> its rows. src/README.md describes how to add a table.
module wavycon_table
   use wavycon_contact_solver, only: solver_traits
   use wavycon_error, only: error_type
   use wavycon_formula_kinds, only: paper_waves
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: column_list, longest_word, of_words
   use wavycon_methods, only: solvers_for
   use wavycon_output_file, only: output_file
   use wavycon_paper_wave, only: is_paper_wave
   use wavycon_plain_text, only: short_number
   use wavycon_quantities, only: quantities
   use wavycon_results, only: results_type
   use wavycon_scene, only: scene_type
   use wavycon_solution_record, only: solver_names, status_name
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: table_type

   !> A table. The type has no allocatable components, because gfortran 12 loses the memory of those in array
   !> constructors.
   type :: table_type
      character(24) :: file = ''          !! the table is <case>.<file>.dat
      character(16) :: key = ''           !! the logical key that requests the table; empty: the table has no such key
      character(9) :: group = 'output'    !! group of the key: 'output', 'load', 'stress' or 'interface'
      character(160) :: meaning = ''      !! one sentence for the reference of keys of &output
      character(2048) :: columns = ''     !! name[unit] of each column, with a blank between two
      !> Keys of `group` that together request the table, in place of `key`. A key requests if it is a logical key that
      !> is .true., a text other than 'none', or a number that is given. A key of another group has the name of that
      !> group and a dot before it. A table without `key` and `asked_by` is always written; one of the groups stress and
      !> interface only if the deck has the group.
      character(16) :: asked_by(2) = ''
      logical :: of_adhesion = .false.    !! whether the contacts are those with adhesion
      logical :: needs_fields = .false.   !! whether the table is made from fields, edges or details of the solutions
      logical :: needs_spots = .false.    !! whether `spots` of the results must be found first
      logical :: needs_slopes = .false.   !! whether `slopes` of the results must be found first
      !> Whether the table needs the whole surface, with a p* and a Delta that are not zero.
      logical :: needs_surface = .true.
      !> Whether all ranks write the table together; null: the first rank writes the table.
      procedure(by_all_interface), pointer, nopass :: written_by_all => null()
      integer :: blocks = 0               !! number of blocks of a table that does not have rows of each load; else 0
      !> The procedure that writes the table: either `put_load`, which writes the rows of a load or one of `blocks`, or
      !> `write_all`, which opens, writes and finishes the table. A table whose columns are all quantities of the
      !> solution needs neither.
      procedure(load_interface), pointer, nopass :: put_load => null()
      procedure(write_interface), pointer, pass(table) :: write_all => null()
   contains
      procedure :: name, is_requested, refusal, is_written_by_all
      procedure :: write => write_table
   end type table_type

   abstract interface
      !> `written_by_all`: whether all ranks write the table together. See `is_written_by_all` below.
      logical function by_all_interface(results)
         import :: results_type
         type(results_type), intent(in) :: results
      end function by_all_interface

      !> `put_load`: writes the rows of one load, or one of `blocks` blocks.
      subroutine load_interface(results, load, file)
         import :: output_file, results_type
         type(results_type), intent(in) :: results
         integer, intent(in) :: load                !! number of the load in the deck's order, or number of the block
         type(output_file), intent(inout) :: file   !! with the columns of the table
      end subroutine load_interface

      !> `write_all`: opens the table, writes it and finishes it. Errors: exit_file_trouble.
      subroutine write_interface(table, results, error)
         import :: error_type, results_type, table_type
         class(table_type), intent(in) :: table
         type(results_type), intent(in) :: results
         type(error_type), allocatable, intent(out) :: error
      end subroutine write_interface
   end interface

contains

   !> The name by which programs ask for the table: its key, in the group stress with 'stress_' before it; without a key
   !> the name of its file.
   elemental function name(self) result(words)
      class(table_type), intent(in) :: self
      character(24) :: words

      words = self%key
      if (self%key == '') words = self%file
      if (self%group == 'stress') words = 'stress_'//self%key
   end function name

   !> Whether a scene asks for the table.
   pure logical function is_requested(self, scene)
      class(table_type), intent(in) :: self
      type(scene_type), intent(in) :: scene

      character(len(self%asked_by)) :: keys(2)
      integer :: i

      keys = self%asked_by
      if (keys(1) == '') keys(1) = self%key
      is_requested = all([(any(scene%asked_for == trim(self%group)//'.'//keys(i) .or. scene%asked_for == keys(i)), &
                           i=1, max(1, count(keys /= '')))])
   end function is_requested

   !> Why the table cannot be written for a solver and a surface, as a sentence for a message; empty if it can.
   function refusal(self, traits, surface) result(words)
      class(table_type), intent(in) :: self
      type(solver_traits), intent(in) :: traits   !! traits of the solver, which need not be started
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      !> The fourth power of a length must not overflow in double precision.
      real(dp), parameter :: largest_length = 1.0e75_dp
      character(:), allocatable :: alternatives, lack

      words = ''
      lack = ''
      select case (self%file)
      case ('coefficients')
         if (.not. traits%has_coefficients) lack = 'has no series of given length'
      case ('details')
         if (.not. traits%has_details) lack = 'does not compute them for every load'
      case ('spectrum')
         if (max(surface%amplitude, maxval(surface%length)) > largest_length) words = 'it has the fourth power of '// &
            'lengths, which may be up to '//short_number(largest_length)//'; choose another unit of length'
      case ('bounds')
         if (surface%has_free_edges) words = &
            'bounds are known for periodic and mirrored surfaces only, and this one has free edges'
         if (surface%kernel%layer%shear_ratio > 0.0_dp) words = &
            'bounds are known on half-spaces and on layers whose base is rigid, and this one has base_e'
      case ('theory', 'theory_lines')
         if (is_paper_wave(surface)) return
         words = 'closed forms exist only for the waves of the paper: '//paper_waves
         if (self%file == 'theory_lines') return
         words = words//', and for a ball'
         if (surface%kernel%has_layer()) words = 'closed forms are those of half-spaces, not of a layer'
         if (surface%has_free_edges .and. all(surface%form%c(:surface%dimension) > 0.0_dp)) words = ''
      end select
      if (lack == '') return
      ! The solvers for this surface that have, or do, what this solver lacks.
      alternatives = solvers_for(surface, trim(self%file))
      words = "solver = '"//trim(solver_names(traits%solver))//"' "//lack
      if (alternatives == '') then
         words = words//', nor does any other for this surface'
         if (surface%kernel%has_layer()) words = words//' on a layer'
      else
         words = words//'; '//alternatives//' '//lack(:index(lack, ' ') - 1)
      end if
   end function refusal

   !> Whether all ranks write the table together, each from its columns of distributed grids. The function is called
   !> before the loads are solved and afterwards.
   logical function is_written_by_all(self, results)
      class(table_type), intent(in) :: self
      type(results_type), intent(in) :: results   !! with the started solver; `loads` may not be allocated yet

      is_written_by_all = .false.
      if (associated(self%written_by_all)) is_written_by_all = self%written_by_all(results)
   end function is_written_by_all

   !> Writes the table to a file or, if the results have a table in memory, to that. Errors: exit_file_trouble.
   subroutine write_table(self, results, error)
      class(table_type), intent(in) :: self
      type(results_type), intent(inout) :: results   !! with a solution for each load; gets what the table needs
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: i, number

      if (self%of_adhesion) call results%swap_contacts()
      if (self%needs_spots) call results%find_spots()
      if (self%needs_slopes) call results%find_slopes()
      if (associated(self%write_all)) then
         call self%write_all(results, error)
      else
         call results%open_table(trim(self%file), self%columns, file)
         number = size(results%loads)
         if (self%blocks > 0) number = self%blocks
         do i = 1, number
            if (associated(self%put_load)) then
               call self%put_load(results, i, file)
            else
               call put_quantities(self, results, i, file)
            end if
         end do
         call file%finish(error)
      end if
      if (self%of_adhesion) call results%swap_contacts()
   end subroutine write_table

   !> Writes the row of a load in a table whose columns are all quantities of the solution.
   subroutine put_quantities(self, results, load, file)
      type(table_type), intent(in) :: self
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      integer :: i
      type(quantities) :: of_load

      of_load = results%loads(load)%quantities
      if (self%needs_fields) call results%loads(load)%details(of_load)
      associate (columns => column_list(self%columns), solution => results%loads(load))
         associate (names => pack(columns%name, columns%kind /= of_words), &
                    words => [character(longest_word) :: solver_names(solution%solver), status_name(solution%status)])
            call file%put_row([(results%number(load, trim(names(i)), of_load), i=1, size(names))], &
                              pack(words, [any(columns%name == 'solver'), .true.]))
         end associate
      end associate
   end subroutine put_quantities

end module wavycon_table
