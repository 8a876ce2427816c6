!> The data that the tables of one scene are written from, and the header lines that all tables have.
module wavycon_results
   use wavycon_contact_solution, only: contact_solution_item
   use wavycon_contact_solver, only: contact_solver
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: escaped, exact_number, integer_text
   use wavycon_scene, only: scene_type
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: results_type

   type :: results_type
      type(scene_type), allocatable :: scene
      class(contact_solver), allocatable :: solver
      type(contact_solution_item), allocatable :: loads(:)   !! in the deck's order
   contains
      procedure :: open_table
      procedure :: put_load_heading
      procedure :: mean_pressure
   end type results_type

contains

   !> Opens a table <case>.<kind>.dat and writes the header lines that all tables have. Errors show in file%finish.
   subroutine open_table(self, kind, file)
      class(results_type), intent(in) :: self
      character(*), intent(in) :: kind         !! name of the table, such as 'summary'
      type(output_file), intent(out) :: file

      call file%open(self%scene%directory, self%scene%case//'.'//kind//'.dat')
      call file%put('# wavycon '//version//' ('//revision//')')
      call file%put('# deck: '//escaped(self%scene%deck_path))
      if (self%scene%title /= '') call file%put('# title: '//escaped(self%scene%title))
      associate (surface => self%scene%surface)
         call file%put('# surface: '//self%scene%surface_kind// &
                       ', Delta[length] = '//exact_number(surface%amplitude)//cell_sides())
         call file%put('# material: e_star[pressure] = '//exact_number(self%scene%e_star)// &
                       ', p*[pressure] = '//exact_number(self%scene%p_star))
         call file%put('# method: '//self%solver%name()//', '//self%solver%describe())
      end associate

   contains

      function cell_sides() result(words)
         character(:), allocatable :: words

         words = ', cell_x[length] = '//exact_number(self%scene%surface%length(1))
         if (self%scene%surface%dimension == 2) &
            words = words//', cell_y[length] = '//exact_number(self%scene%surface%length(2))
      end function cell_sides

   end subroutine open_table

   !> Begins the block of a load: two blank lines, which separate the data sets of gnuplot's `index`, and a comment with
   !> the load.
   subroutine put_load_heading(self, file, load, first)
      class(results_type), intent(in) :: self
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load    !! number in the deck's order
      logical, intent(in) :: first   !! whether it is the first block of the file: no blank lines

      if (.not. first) then
         call file%put('')
         call file%put('')
      end if
      associate (solution => self%loads(load)%solution)
         call file%put('# load '//integer_text(load)//': pbar/p* = '//exact_number(solution%pbar_over_pstar)//', '// &
                       trim(solution%status))
      end associate
   end subroutine put_load_heading

   !> The mean pressure of a load [pressure]. If the deck gives it, exactly that number.
   pure real(dp) function mean_pressure(self, load)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load

      if (allocated(self%scene%mean_pressure)) then
         mean_pressure = self%scene%mean_pressure(load)
      else
         mean_pressure = self%scene%p_star*self%loads(load)%solution%pbar_over_pstar
      end if
   end function mean_pressure

end module wavycon_results
