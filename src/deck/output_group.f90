!> The &output group: which files are written, and where.
module wavycon_output_group
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_key, key_group, key_group_type, key_type, logical_key, text_key
   use wavycon_problems, only: problem_list_type
   use wavycon_solver_list, only: get_solvers, solver_item
   use wavycon_surface, only: surface_type
   use wavycon_tables, only: all_tables, table_item
   implicit none (type, external)
   private

   public :: output_table, check_output_group, plain_directory

   !> Bytes of a directory's name. The default, 'outputs/' and the name of the case, must fit.
   integer, parameter, public :: longest_directory = 250

contains

   !> The table of keys of &output: the directory, and a logical key for each table that can be requested.
   function output_table() result(table)
      type(key_group_type) :: table

      type(table_item), allocatable :: tables(:)
      type(key_type), allocatable :: rows(:)
      integer :: i

      call all_tables(tables)
      allocate (rows(0))
      do i = 1, size(tables)
         if (tables(i)%table%key() == '') cycle
         rows = [rows, logical_key(tables(i)%table%key(), '.false.', tables(i)%table%meaning())]
      end do
      table = key_group('output', 'which files are written, and where', [ &
         text_key('directory', "'outputs/<case>'", &
            'Where the results go, relative to where the program is started; made if it is not there.', &
            longest_directory), rows, &
         integer_key('points_per_wavelength', '128', 'Points of lines and maps along a side of the cell.', &
                     8, 4096)])
   end function output_table

   !> Sets the directory and checks the tables against the solver and the surface.
   subroutine check_output_group(values, case, solver, surface, problems)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: case     !! name of the case; the default directory is outputs/<case>
      character(*), intent(in) :: solver   !! of &method
      type(surface_type), allocatable, intent(in) :: surface   !! not allocated if it has problems
      type(problem_list_type), intent(inout) :: problems

      type(solver_item), allocatable :: solvers(:)
      type(table_item), allocatable :: tables(:)
      character(:), allocatable :: key, refusal
      integer :: i, k

      call values%set_default('directory', 'outputs/'//case)
      call values%set('directory', plain_directory(values%text('directory')))
      if (.not. allocated(surface)) return
      call get_solvers(solvers)
      call all_tables(tables)
      do k = 1, size(solvers)
         if (solvers(k)%solver%name() /= solver) cycle
         do i = 1, size(tables)
            key = tables(i)%table%key()
            if (key == '') cycle
            if (.not. values%logical(key)) cycle
            refusal = tables(i)%table%refusal(solvers(k)%solver, surface)
            if (refusal /= '') call values%complain(problems, key, key//' cannot be written: '//refusal)
         end do
      end do
   end subroutine check_output_group

   !> The path of a directory without superfluous './' and '/', so that equal paths are equal texts.
   pure function plain_directory(name) result(plain)
      character(*), intent(in) :: name
      character(:), allocatable :: plain

      plain = trim(name)//'/'
      call drop('//', 1)
      call drop('/./', 2)
      if (index(plain, './') == 1) plain = plain(3:)
      if (plain == '') plain = './'
      if (len(plain) > 1) plain = plain(:len(plain) - 1)

   contains

      !> Removes the first `bytes` bytes of each occurrence of a text.
      pure subroutine drop(text, bytes)
         character(*), intent(in) :: text
         integer, intent(in) :: bytes

         integer :: i

         i = index(plain, text)
         do while (i > 0)
            plain = plain(:i - 1)//plain(i + bytes:)
            i = index(plain, text)
         end do
      end subroutine drop

   end function plain_directory

end module wavycon_output_group
