!> The &output group: which files are written, and where.
module wavycon_output_group
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_key, key_group, key_group_type, logical_key, text_key
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_kinds, only: paper_waves
   implicit none (type, external)
   private

   public :: output_table, check_output_group, plain_directory

   !> Bytes. More than the longest name of a case: the default must fit.
   integer, parameter, public :: longest_directory = 250

contains

   function output_table() result(table)
      type(key_group_type) :: table

      table = key_group('output', 'which files are written, and where', [ &
         text_key('directory', "'outputs/<case>'", &
            'Where the results go, relative to where the program is started; made if it is not there.', &
            longest_directory), &
         logical_key('lines', '.false.', 'Pressures and gaps along lines.'), &
         logical_key('map', '.false.', 'Pressures and gaps over the whole cell.'), &
         logical_key('contours', '.false.', 'The edge of contact as closed curves.'), &
         logical_key('coefficients', '.false.', 'The Fourier coefficients of the pressure.'), &
         logical_key('theory', '.false.', 'The closed forms beside the numbers.'), &
         logical_key('details', '.false.', "Of solver = 'fitted': gaps at trough and saddle, energy, perimeter "// &
            "and the summary's numbers, each with its error estimate."), &
         integer_key('points_per_wavelength', '128', 'Points of lines and maps along a side of the cell.', &
                     8, 4096)])
   end function output_table

   !> Sets the directory and checks the tables against the solver and the surface.
   subroutine check_output_group(values, case, solver, surface, problems)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: case     !! that the default directory is named after
      character(*), intent(in) :: solver   !! of &method
      type(surface_type), allocatable, intent(in) :: surface   !! not allocated if it has problems
      type(problem_list_type), intent(inout) :: problems

      call values%set_default('directory', 'outputs/'//case)
      call values%set('directory', plain_directory(values%text('directory')))
      if (values%logical('coefficients') .and. solver /= 'beale') call values%complain(problems, 'coefficients', &
         "coefficients are those of the series of solver = 'beale'; '"//solver//"' has none")
      if (values%logical('details') .and. solver /= 'fitted') call values%complain(problems, 'details', &
         "details are those of the expansions of solver = 'fitted'; '"//solver//"' has none for every load")
      if (.not. values%logical('theory') .or. .not. allocated(surface)) return
      if (.not. surface%is_paper_wave()) call values%complain(problems, 'theory', &
         'theory is known of the waves of the paper alone: '//paper_waves())
   end subroutine check_output_group

   !> The name of a directory without needless './' and '/', so that one place has one name.
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

      !> Removes so many bytes wherever the text stands.
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
