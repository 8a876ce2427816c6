!> What a table of results is, as data: its name, its columns, who asks for it, and the procedure that writes its rows.
!> src/README.md describes how to add a table.
module wavycon_table
   use wavycon_contact_solver, only: solver_traits
   use wavycon_contact_status, only: status_name
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
   use wavycon_solution_record, only: solver_names
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: table_type

   !> It has no allocatable components, of which gfortran 12 loses those of array constructors.
   type :: table_type
      character(16) :: file = ''          !! the table is <case>.<file>.dat
      character(16) :: key = ''           !! the key that requests it; empty: it has none of its own
      character(9) :: group = 'output'    !! of the key: 'output', 'stress' or 'interface'
      character(160) :: meaning = ''      !! one sentence for the reference of keys of &output
      character(2048) :: columns = ''     !! name[unit] of each, with a blank between two
      !> Keys that together ask for it, in place of `key`: a logical one that is .true., a text other than 'none', a
      !> number that is given; with the name of another group and a dot before the key of that. Without any it is
      !> written always, but never without its group &stress or &interface.
      character(16) :: asked_by(2) = ''
      logical :: of_adhesion = .false.    !! whether the contacts are those with adhesion
      logical :: needs_fields = .false.   !! whether it is made from fields, edges or details of the solutions
      logical :: needs_surface = .true.   !! whether it needs the whole surface, with a p* and a Delta that are not zero
      procedure(by_all_interface), pointer, nopass :: written_by_all => null() !! null: rank 0 writes it
      integer :: blocks = 0               !! of a table that has a block of each of these in place of rows of each load
      !> One of these: the rows of a load, or the block of `blocks`; or the table with its file. Neither for a table
      !> whose columns are quantities of the solution.
      procedure(load_interface), pointer, nopass :: put_load => null()
      procedure(write_interface), pointer, pass(table) :: write_all => null()
   contains
      procedure :: name
      procedure :: is_requested
      procedure :: refusal
      procedure :: is_written_by_all
      procedure :: write => write_table
   end type table_type

   abstract interface
      !> `written_by_all`: as `is_written_by_all` below.
      logical function by_all_interface(results)
         import :: results_type
         type(results_type), intent(in) :: results
      end function by_all_interface

      !> `put_load`: writes the rows of one load or the block of one of `blocks`.
      subroutine load_interface(results, load, file)
         import :: output_file, results_type
         type(results_type), intent(in) :: results
         integer, intent(in) :: load                !! number in the deck's order; or the number of the block
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

   !> The name that programs ask for: the key, that of &stress with 'stress_' before it; without a key that of the file.
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
      type(solver_traits), intent(in) :: traits   !! started or not
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      !> Its fourth power must be a number.
      real(dp), parameter :: largest_length = 1.0e75_dp
      character(:), allocatable :: lack, others

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
      ! Which solvers of the surface do, or have, what this one lacks.
      others = solvers_for(surface, trim(self%file))
      words = "solver = '"//trim(solver_names(traits%solver))//"' "//lack
      if (others == '') then
         words = words//', nor does any other for this surface'
      else
         words = words//'; '//others//' '//lack(:index(lack, ' ') - 1)
      end if
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
      type(results_type), intent(inout) :: results   !! with a solution for each load; unchanged afterwards
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: load

      if (self%of_adhesion) call results%swap_contacts()
      if (associated(self%write_all)) then
         call self%write_all(results, error)
      else
         call results%open_table(trim(self%file), self%columns, file)
         do load = 1, merge(self%blocks, size(results%loads), self%blocks > 0)
            if (associated(self%put_load)) then
               call self%put_load(results, load, file)
            else
               call put_quantities(self, results, load, file)
            end if
         end do
         call file%finish(error)
      end if
      if (self%of_adhesion) call results%swap_contacts()
   end subroutine write_table

   !> Writes the row of a load whose columns are all quantities of its solution.
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
