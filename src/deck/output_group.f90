!> The &output group: which files are written, and where.
module wavycon_output_group
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_group_input, only: group_input_type
   use wavycon_key_table, only: integer_key, key_group, key_group_type, logical_key, text_key
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: output_group_type, output_table, read_output_group, write_output_group, plain_directory

   !> More than the longest name of a case: the default must fit.
   integer, parameter, public :: longest_directory = 250

   !> What &output says.
   type :: output_group_type
      character(longest_directory) :: directory = ''   !! where results go; never empty in a deck read
      logical :: lines = .false.                       !! pressures and gaps along lines
      logical :: map = .false.                         !! pressures and gaps over the cell
      logical :: contours = .false.                    !! the edge of contact as closed curves
      logical :: coefficients = .false.                !! the Fourier coefficients of the pressure
      logical :: theory = .false.                      !! the closed forms beside the numbers
      logical :: details = .false.                     !! all numbers of the boundary-fitted expansions
      integer :: points_per_wavelength = 128           !! of lines and maps
   end type output_group_type

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

   !> Reads the group; a directory that is not given takes its name from the case.
   subroutine read_output_group(input, case, solver, paper_wave, group, problems)
      type(group_input_type), intent(in) :: input
      character(*), intent(in) :: case     !! that the default directory is named after
      character(*), intent(in) :: solver   !! of &method
      logical, intent(in) :: paper_wave    !! whether there are closed forms of the surface
      type(output_group_type), intent(out) :: group
      type(problem_list_type), intent(inout) :: problems

      character(len(group%directory)) :: directory
      logical :: coefficients, contours, details, lines, map, theory
      integer :: points_per_wavelength, status
      character(200) :: message
      namelist /output/ directory, lines, map, contours, coefficients, theory, details, points_per_wavelength

      directory = 'outputs/'//case
      lines = group%lines
      map = group%map
      contours = group%contours
      coefficients = group%coefficients
      theory = group%theory
      details = group%details
      points_per_wavelength = group%points_per_wavelength
      read (input%record, nml=output, iostat=status, iomsg=message)
      if (status /= 0) call problems%add(input%place, trim(message))
      group = output_group_type(plain_directory(directory), lines, map, contours, coefficients, theory, &
         details, points_per_wavelength)
      if (group%coefficients .and. solver /= 'beale') call problems%add(input%place_of('coefficients'), &
         "coefficients are those of the series of solver = 'beale'; '"//solver//"' has none")
      if (group%details .and. solver /= 'fitted') call problems%add(input%place_of('details'), &
         "details are those of the expansions of solver = 'fitted'; '"//solver//"' has none for every load")
      if (group%theory .and. .not. paper_wave) call problems%add(input%place_of('theory'), &
         'theory is known of the waves of the paper alone: wave_1d, wave_2d with one wavelength, crossed_1d '// &
         'with equal waves')
   end subroutine read_output_group

   subroutine write_output_group(group, writer)
      type(output_group_type), intent(in) :: group
      type(deck_writer_type), intent(inout) :: writer

      call writer%open_group(output_table())
      call writer%put('directory', group%directory)
      call writer%put('lines', group%lines)
      call writer%put('map', group%map)
      call writer%put('contours', group%contours)
      call writer%put('coefficients', group%coefficients)
      call writer%put('theory', group%theory)
      call writer%put('details', group%details)
      call writer%put('points_per_wavelength', group%points_per_wavelength)
      call writer%close_group()
   end subroutine write_output_group

   !> The name of a directory without any './', '//' and '/' at its end that say nothing, so that one place has
   !> one name.
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

      !> Takes so many bytes off each place where there is some text.
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
