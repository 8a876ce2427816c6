!> The &method group: how the contact is computed.
module wavycon_method_group
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_group_input, only: group_input_type
   use wavycon_key_table, only: choice_key, integer_key, key_group, key_group_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: method_group_type, method_table, read_method_group, write_method_group

   !> What &method says. The two counts are 0 until the surface's dimension settles their defaults.
   type :: method_group_type
      character(12) :: solver = ''         !! 'beale', 'grid', 'fitted' or 'auto'
      integer :: harmonics = 0             !! n, highest harmonic of the pressure, in each direction
      integer :: constraint_points = 0     !! points on 0..pi, ends included, in each direction
      character(12) :: symmetry = 'full'   !! 'full', 'diagonal' or 'none'; of no meaning in 1-D
      real(dp) :: edge_level = 0.1_dp      !! the isobar taken as the edge of contact [p*]
      real(dp) :: accuracy = 1.0e-3_dp     !! of the summary's numbers, in their units; 0 for that of a grid given
      integer :: grid_points(2) = 0        !! of the whole cell, of 'grid'; zeros: by the accuracy or the file
   end type method_group_type

   !> The paper's numbers, for 1-D and 2-D waves.
   integer, parameter :: default_harmonics(2) = [10, 9], default_constraint_points(2) = [26, 27]

   !> Bounds of the time and memory that a slip of the hand can cost, for 1-D and 2-D waves.
   integer, parameter :: most_harmonics = 60, most_constraint_points(2) = [6001, 601]

   character(17), parameter :: of_beale(*) = ['harmonics        ', 'constraint_points', 'symmetry         ', &
                                              'edge_level       ']

contains

   function method_table() result(table)
      type(key_group_type) :: table

      table = key_group('method', 'how the contact is computed', [ &
         choice_key('solver', "'beale', or 'auto'", &
            "'beale': the paper's truncated series by Beale's method, for its waves. 'grid': ever finer grids "// &
            "until mean gap, area and peak pressure are accurate. 'fitted': expansions fitted to the edge of "// &
            "contact, of spots or of open islands. 'auto': the closed form for wave_1d, else 'fitted' and, where that "// &
            "cannot, 'grid'.", &
            [character(6) :: 'beale', 'grid', 'fitted', 'auto']), &
         real_key('accuracy', '1e-3', '-', &
            "Not of 'beale': largest error allowed of mean gap [amplitude], contact area fraction and peak "// &
            "pressure [p*]; where lines, a map, contours or details are asked for, of 'fitted' the gap at a "// &
            'trough as well. A load that cannot be had so accurately says so.', least=1.0e-12_dp, most=0.1_dp), &
         integer_key('grid_points', '', &
            "Of 'grid' and 'auto', in place of accuracy: points of the cell along x and y of the one grid to "// &
            'solve; one number for both. Even numbers. For a file the default is its own grid. Errors are '// &
            'estimated from 64 points a side on, multiples of 4; of others the largest possible are shown.', &
            8, 8192, most_values=2), &
         integer_key('harmonics', '9 (2-D), 10 (1-D)', &
            'Highest harmonic of the pressure, in each direction.', 1, most_harmonics), &
         integer_key('constraint_points', '27 (2-D), 26 (1-D)', &
            'Equally spaced points on half a wavelength, ends included, in each direction, at which the '// &
            'pressure is kept from being negative. More than harmonics; at most 601 in 2-D.', &
            2, maxval(most_constraint_points)), &
         choice_key('symmetry', "'full'", &
            "Of the pressure, 2-D only. 'full': alike in x and y and at both crests (29 unknowns, 196 "// &
            "points by default); 'diagonal': at both crests (49, 378); 'none' (99, 729).", &
            ['full    ', 'diagonal', 'none    ']), &
         real_key('edge_level', '0.1', 'p*', 'The isobar that is taken as the edge of contact.', &
            above=0.0_dp, below=1.0_dp)])
   end function method_table

   subroutine read_method_group(input, dimension, paper_wave, from_file, group, problems)
      type(group_input_type), intent(in) :: input
      integer, intent(in) :: dimension      !! of the surface, 1 or 2; 0 if that is not known
      logical, intent(in) :: paper_wave     !! whether it is one that 'beale' solves
      logical, intent(in) :: from_file      !! whether it has a grid of its own
      type(method_group_type), intent(out) :: group
      type(problem_list_type), intent(inout) :: problems

      character(len(group%solver)) :: solver
      character(len(group%symmetry)) :: symmetry
      integer :: constraint_points, grid_points(2), harmonics, status
      real(dp) :: accuracy, edge_level
      character(200) :: message
      namelist /method/ solver, harmonics, constraint_points, symmetry, edge_level, accuracy, grid_points

      solver = merge('beale', 'auto ', paper_wave)
      grid_points = group%grid_points
      symmetry = group%symmetry
      edge_level = group%edge_level
      accuracy = group%accuracy
      harmonics = group%harmonics
      constraint_points = group%constraint_points
      if (dimension > 0) then
         harmonics = default_harmonics(dimension)
         constraint_points = default_constraint_points(dimension)
      end if
      read (input%record, nml=method, iostat=status, iomsg=message)
      if (status /= 0) call problems%add(input%place, trim(message))
      if (input%values_of('grid_points') == 1) grid_points(2) = grid_points(1)
      if (.not. input%has('accuracy') .and. (from_file .or. input%has('grid_points'))) accuracy = 0.0_dp
      group = method_group_type(solver, harmonics, constraint_points, symmetry, edge_level, accuracy, grid_points)
      call check_solver_keys()

      if (dimension == 0) return
      if (dimension == 1 .and. input%has('symmetry')) call problems%add(input%place_of('symmetry'), &
         "symmetry means nothing for kind = 'wave_1d': leave it out")
      if (input%is_bad('harmonics') .or. input%is_bad('constraint_points')) return
      if (constraint_points > most_constraint_points(dimension)) &
         call problems%add(input%place_of('constraint_points'), 'constraint_points must be at most '// &
            integer_text(most_constraint_points(dimension))//' in '//integer_text(dimension)//'-D, got '// &
            integer_text(constraint_points))
      if (constraint_points <= harmonics) &
         call problems%add(max(input%place_of('harmonics'), input%place_of('constraint_points')), &
            'constraint_points must be more than harmonics, got '//integer_text(constraint_points)// &
            by_default('constraint_points')//' and '//integer_text(harmonics)//by_default('harmonics'))

   contains

      subroutine check_solver_keys()
         integer :: i

         if (input%is_bad('solver')) return
         if (solver == 'beale') then
            if (.not. paper_wave .and. dimension > 0) call problems%add(input%place_of('solver'), &
               "solver = 'beale' is for the waves of the paper: wave_1d, wave_2d with one wavelength, "// &
               "crossed_1d with equal waves. Give 'grid' or 'auto'")
            if (input%has('accuracy')) call problems%add(input%place_of('accuracy'), &
               "accuracy is a key of solver = 'grid', 'fitted' and 'auto': the series of 'beale' has no error "// &
               'estimate')
            if (input%has('grid_points')) call problems%add(input%place_of('grid_points'), &
               "grid_points is a key of solver = 'grid' and 'auto'; 'beale' has harmonics and constraint_points")
            return
         end if
         call input%forbid(problems, 'accuracy', 'grid_points', 'give the one or the other')
         if (solver == 'fitted' .and. input%has('grid_points')) call problems%add(input%place_of('grid_points'), &
            "grid_points is a key of solver = 'grid' and 'auto': 'fitted' has no grid")
         if (any(mod(grid_points, 2) /= 0)) call problems%add(input%place_of('grid_points'), &
            'grid_points must be even: of surfaces that mirror themselves half of them are solved each way')
         do i = 1, size(of_beale)
            if (input%has(trim(of_beale(i)))) call problems%add(input%place_of(trim(of_beale(i))), &
               trim(of_beale(i))//" is a key of solver = 'beale', not of '"//trim(solver)//"'")
         end do
      end subroutine check_solver_keys

      function by_default(key) result(words)
         character(*), intent(in) :: key
         character(:), allocatable :: words

         words = ''
         if (.not. input%has(key)) words = ' (the default)'
      end function by_default

   end subroutine read_method_group

   subroutine write_method_group(group, dimension, writer)
      type(method_group_type), intent(in) :: group
      integer, intent(in) :: dimension  !! of the surface, 1 or 2
      type(deck_writer_type), intent(inout) :: writer

      call writer%open_group(method_table())
      call writer%put('solver', group%solver)
      if (group%solver == 'beale') then
         call writer%put('harmonics', group%harmonics)
         call writer%put('constraint_points', group%constraint_points)
         if (dimension == 2) call writer%put('symmetry', group%symmetry)
         call writer%put('edge_level', group%edge_level)
      else if (all(group%grid_points > 0)) then
         call writer%put('grid_points', group%grid_points(:dimension))
      else if (group%accuracy > 0.0_dp) then
         call writer%put('accuracy', group%accuracy)
      end if
      call writer%close_group()
   end subroutine write_method_group

end module wavycon_method_group
