!> The &method group: the solver and its parameters.
module wavycon_method_group
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_key, integer_key, key_group, key_group_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   use wavycon_surface_kinds, only: is_paper_kind, paper_waves
   implicit none (type, external)
   private

   public :: method_table, check_method_group, given_grid_points

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
            "'beale': the paper's truncated series by Beale's method, for its waves, and their default. "// &
            "'grid': ever finer grids until mean gap, area and peak pressure are accurate. 'fitted': expansions "// &
            "fitted to the edge of contact, of spots or of open islands. 'auto': the closed form in 1-D where "// &
            "there is one, else 'fitted', and 'grid' where that has no answer.", &
            [character(6) :: 'beale', 'grid', 'fitted', 'auto']), &
         real_key('accuracy', '1e-3', '-', &
            "Not of 'beale': largest error allowed of mean gap [amplitude], contact area fraction and peak "// &
            "pressure [p*]; of 'fitted' with lines, map, contours or details also of the gap at a trough. A load "// &
            'that misses it has the status not_accurate.', least=1.0e-12_dp, most=0.1_dp), &
         integer_key('grid_points', '', &
            "Of 'grid' and 'auto', in place of accuracy: points of the cell along x and y of the one grid to "// &
            'solve; one number for both. Even numbers. For a file the default is its own grid. Errors are '// &
            'estimated for multiples of 4 from 64 points a side; for others the summary shows the largest '// &
            'possible errors.', &
            8, 8192, most_values=2), &
         integer_key('harmonics', '9 (2-D), 10 (1-D)', &
            "Of 'beale': highest harmonic of the pressure, in each direction.", 1, most_harmonics), &
         integer_key('constraint_points', '27 (2-D), 26 (1-D)', &
            "Of 'beale': equally spaced points on half a wavelength, ends included, in each direction, at which "// &
            'the pressure is constrained to be >= 0. More than harmonics; at most 601 in 2-D.', &
            2, maxval(most_constraint_points)), &
         choice_key('symmetry', "'full'", &
            "Of 'beale' in 2-D: symmetry of the pressure. 'full': alike in x and y and at both crests (29 "// &
            "unknowns, 196 points by default); 'diagonal': at both crests (49, 378); 'none' (99, 729).", &
            ['full    ', 'diagonal', 'none    ']), &
         real_key('edge_level', '0.1', 'p*', "Of 'beale': the isobar that is taken as the edge of contact.", &
            above=0.0_dp, below=1.0_dp)])
   end function method_table

   !> Sets the defaults that depend on the surface and checks the keys against the solver.
   subroutine check_method_group(values, kind, surface, problems)
      type(group_values), intent(inout) :: values
      character(*), intent(in) :: kind                           !! of the surface; empty if the deck gives no good one
      type(surface_type), allocatable, intent(in) :: surface     !! not allocated if it has problems
      type(problem_list_type), intent(inout) :: problems

      integer :: dimension
      logical :: is_paper_wave, own_grid, takes_series

      ! Problems with the method that only follow from a bad surface would mislead.
      dimension = 0
      is_paper_wave = .true.
      own_grid = .false.
      if (allocated(surface)) then
         dimension = surface%dimension
         is_paper_wave = surface%is_paper_wave()
         own_grid = all(surface%points > 0)
         call values%set_default('harmonics', default_harmonics(dimension))
         call values%set_default('constraint_points', default_constraint_points(dimension))
      end if
      takes_series = kind == ''
      if (.not. takes_series) takes_series = is_paper_kind(kind)
      call values%set_default('solver', trim(merge('beale', 'auto ', takes_series .and. is_paper_wave)))
      if (.not. values%is_bad('solver')) then
         if (values%text('solver') == 'beale') then
            call check_beale(values, dimension, is_paper_wave, problems)
         else
            call check_grid_or_fitted(values, dimension, own_grid, problems)
         end if
      end if
      if (dimension == 1 .and. values%has('symmetry')) call values%complain(problems, 'symmetry', &
         "symmetry means nothing for kind = '"//kind//"': leave it out")
      if (dimension > 0) call check_constraint_points(values, dimension, problems)
   end subroutine check_method_group

   subroutine check_beale(values, dimension, is_paper_wave, problems)
      type(group_values), intent(inout) :: values
      integer, intent(in) :: dimension        !! of the surface; 0 if it has problems
      logical, intent(in) :: is_paper_wave
      type(problem_list_type), intent(inout) :: problems

      call values%leave_out('accuracy')
      call values%leave_out('grid_points')
      if (dimension == 1) call values%leave_out('symmetry')
      if (.not. is_paper_wave) call values%complain(problems, 'solver', &
         "solver = 'beale' is for the waves of the paper: "//paper_waves()//". Give 'grid' or 'auto'")
      if (values%has('accuracy')) call values%complain(problems, 'accuracy', &
         "accuracy is a key of solver = 'grid', 'fitted' and 'auto': the series of 'beale' has no error estimate")
      if (values%has('grid_points')) call values%complain(problems, 'grid_points', &
         "grid_points is a key of solver = 'grid' and 'auto'; 'beale' has harmonics and constraint_points")
   end subroutine check_beale

   subroutine check_grid_or_fitted(values, dimension, own_grid, problems)
      type(group_values), intent(inout) :: values
      integer, intent(in) :: dimension     !! of the surface; 0 if it has problems
      logical, intent(in) :: own_grid      !! whether the surface was given on a grid
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: solver
      integer :: i, points(2)

      solver = values%text('solver')
      call values%forbid(problems, 'accuracy', 'grid_points', 'give the one or the other')
      if (solver == 'fitted' .and. values%has('grid_points')) call values%complain(problems, 'grid_points', &
         "grid_points is a key of solver = 'grid' and 'auto': 'fitted' has no grid")
      if (any(mod(values%integers('grid_points'), 2) /= 0)) call values%complain(problems, 'grid_points', &
         'grid_points must be even: of surfaces that mirror themselves half of them are solved each way')
      do i = 1, size(of_beale)
         call values%leave_out(trim(of_beale(i)))
         if (values%has(trim(of_beale(i)))) call values%complain(problems, trim(of_beale(i)), &
            trim(of_beale(i))//" is a key of solver = 'beale', not of '"//solver//"'")
      end do
      points = given_grid_points(values)
      if (values%has('grid_points') .and. .not. values%is_bad('grid_points') .and. dimension > 0) &
         call values%set('grid_points', points(:dimension))
      if (values%has('accuracy') .or. .not. (own_grid .or. values%has('grid_points'))) return
      call values%set_default('accuracy', 0.0_dp)
      call values%leave_out('accuracy')
   end subroutine check_grid_or_fitted

   subroutine check_constraint_points(values, dimension, problems)
      type(group_values), intent(in) :: values
      integer, intent(in) :: dimension     !! of the surface
      type(problem_list_type), intent(inout) :: problems

      if (values%is_bad('harmonics') .or. values%is_bad('constraint_points')) return
      associate (points => values%integer('constraint_points'), harmonics => values%integer('harmonics'))
         if (points > most_constraint_points(dimension)) call values%complain(problems, 'constraint_points', &
            'constraint_points must be at most '//integer_text(most_constraint_points(dimension))//' in '// &
            integer_text(dimension)//'-D, got '//integer_text(points))
         if (points <= harmonics) &
            call problems%add(max(values%place_of('harmonics'), values%place_of('constraint_points')), &
               'constraint_points must be more than harmonics, got '//integer_text(points)// &
               by_default('constraint_points')//' and '//integer_text(harmonics)//by_default('harmonics'))
      end associate

   contains

      function by_default(key) result(words)
         character(*), intent(in) :: key
         character(:), allocatable :: words

         words = ''
         if (.not. values%has(key)) words = ' (the default)'
      end function by_default

   end subroutine check_constraint_points

   !> The grid that the deck gives, along x and y; zeros if it gives none.
   pure function given_grid_points(values) result(points)
      type(group_values), intent(in) :: values   !! of &method
      integer :: points(2)

      points = both_sides(values%integers('grid_points'))

   contains

      pure function both_sides(given) result(points)
         integer, intent(in) :: given(:)   !! at most two
         integer :: points(2)

         points = 0
         if (size(given) > 0) points = given(1)
         if (size(given) > 1) points(2) = given(2)
      end function both_sides

   end function given_grid_points

end module wavycon_method_group
