!> The solvers as a deck names them: their names, their keys in &method, which surfaces they cannot solve, and how a
!> solver is started from the values of its keys.
module wavycon_methods
   use wavycon_auto_contact, only: auto_contact, has_a_hardness, has_a_layer, has_closed_form, has_lattice, &
      has_neither, last_choice, points_are_given, points_are_of_the_map
   use wavycon_series_contact, only: series_contact, paper_constraint_points, paper_harmonics, qp_options
   use wavycon_closed_form_contact, only: closed_form_contact, closed_form_exists
   use wavycon_constraint_points, only: choose_points
   use wavycon_contact_solver, only: contact_solver, default_accuracy, solver_traits
   use wavycon_contact_tuning, only: largest_aspect_ratio, largest_curvature_ratio
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fitted_frame, only: crests_form_lattice
   use wavycon_formula_kinds, only: paper_waves
   use wavycon_fourier_terms, only: choose_terms, fourier_terms, symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: choice_value, integer_value, key_type, name_length, real_value, words_of
   use wavycon_kinds, only: dp
   use wavycon_paper_wave, only: has_smaller_cell, is_paper_wave
   use wavycon_plain_text, only: in_quotes, integer_text, listed, short_number
   use wavycon_scene_groups, only: load_group, method_group
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_method_group, list_method_keys, points_of_grid, solvers_for, traits_of, start_solver, why_chosen, &
      without_errors

   !> All solvers, in the order of the key reference.
   character(*), parameter :: names = 'auto beale series fitted grid closed_form'

   !> Largest numbers of harmonics and, for 1-D and 2-D waves, of constraint points that a deck may give. With larger
   !> numbers, which are most likely mistyped, the series would take hours.
   integer, parameter :: most_harmonics = 60, most_constraint_points(2) = [6001, 601]
   !> Most elements of the matrix of the series' constraints. A few copies of the matrix exist at a time, each of at
   !> most 160 MB.
   real(dp), parameter :: most_elements = 2.0e7_dp

contains

   !> The keys of &method.
   subroutine list_method_keys(values, keys)
      type(method_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      type(qp_options) :: usual   ! the defaults of the series

      keys = key_list('method', 'how the contact is computed', values%key_group, selector='solver')
      call keys%add(values%solver, key_type(choice_value, 'solver', "'auto'", '', &
         "'auto': the closed form where there is one, otherwise 'fitted' where it applies, with 'grid' for loads "// &
         "at which these are not accurate enough, otherwise and at a hardness 'grid'. 'beale': the paper's "// &
         "truncated Fourier series for its waves, whose energy Beale's method minimises. 'series': the same with "// &
         "Goldfarb and Idnani's dual method, for many harmonics. 'fitted': collocation fitted to the edge of "// &
         "contact, of spots or of closed pools of gap. 'grid': ever finer grids until mean gap, area and peak "// &
         "pressure are accurate. 'closed_form': Westergaard's solution of the 1-D wave, and Hertz's of a ball.", &
         choices=names))
      keys%of = 'beale series'
      call keys%add(values%harmonics, key_type(integer_value, 'harmonics', '9 (2-D), 10 (1-D)', '', &
         'highest harmonic of the pressure, in each direction.', 1, most_harmonics))
      call keys%add(values%constraint_points, key_type(integer_value, 'constraint_points', &
         'in proportion to harmonics', '', &
         'equally spaced points on half a wavelength, ends included, in each direction, at which the pressure is '// &
         'constrained. More than harmonics; at most 601 in 2-D. The default is 3 harmonics in 2-D and 2.5 '// &
         "harmonics + 1 in 1-D: the paper's 27 for 9 and 26 for 10.", 2, maxval(most_constraint_points)))
      call keys%add(values%symmetry, key_type(choice_value, 'symmetry', "'full'", '', &
         "in 2-D, symmetry of the pressure. 'full': alike in x and y and at both crests (29 unknowns, 196 points "// &
         "by default); 'diagonal': at both crests (49, 378); 'none' (99, 729).", choices='full diagonal none'))
      call keys%add(values%edge_level, key_type(real_value, 'edge_level', short_number(usual%edge_level), 'p*', &
         'the isobar that is taken as the edge of contact.', above=0, below=1))
      keys%of = 'grid fitted auto'
      call keys%add(values%accuracy, key_type(real_value, 'accuracy', short_number(default_accuracy), '-', &
         'largest error allowed of mean gap [amplitude], contact area fraction and peak pressure [p*]; of '// &
         "'fitted' with lines, map, contours, spots, histograms or details also of the gap at a trough. A "// &
         'load that misses it has the status not_accurate.', 1e-12_dp, 0.1_dp, way=100))
      keys%of = 'grid auto'
      call keys%add(values%grid_points, key_type(integer_value, 'grid_points', '', '', &
         'in place of accuracy: points of the cell along x and y of the one grid to solve; one number for both. '// &
         'Even numbers. For height maps, read or made, the default is their own grid. Errors are estimated from '// &
         '64 points a side on; those of coarser grids, and of grids with less than two points to a wave, are '// &
         'unknown.', 8, 1048576, most_values=2, way=101))
      call keys%add(values%residual, key_type(real_value, 'residual', '', '-', &
         'with grid_points or a height map on its own points: largest root mean square over the grid of gaps '// &
         'in contact and of overlaps, over the mean gap, for comparisons with other programs. The default '// &
         'keeps the iteration error below a tenth of the error estimates.', 1e-13_dp, 0.1_dp, way=101))
   end subroutine list_method_keys

   !> Why a solver cannot find the load of percolation, and what can; '' if it finds it.
   function without_errors(solver, surface) result(words)
      character(*), intent(in) :: solver          !! name of a solver
      type(surface_type), intent(in) :: surface   !! that it can solve
      character(:), allocatable :: words

      type(solver_traits) :: traits

      words = ''
      traits = traits_of(solver)
      if (.not. traits%has_errors) words = "solver = '"//solver//"' estimates no errors, without which the load of "// &
                                           'percolates is not found. Give '//solvers_for(surface, 'errors')
   end function without_errors

   !> Sets the defaults that depend on the surface and checks the keys against the solver. A solver that cannot solve
   !> the surface, or cannot find the load of percolation, is reported.
   subroutine check_method_group(values, load, surface)
      type(method_group), intent(inout) :: values
      type(load_group), intent(in) :: load
      type(surface_type), allocatable, intent(in) :: surface     !! not allocated if it could not be made

      character(:), allocatable :: solver, words

      ! All checks need the surface.
      if (.not. allocated(surface) .or. values%solver%is_bad) return
      solver = values%solver%text
      words = refusal(solver, surface)
      if (words /= '') then
         call values%complain(values%solver, "solver = '"//solver//"' "//words//'. Give '//solvers_for(surface))
         return
      end if
      if (load%percolates%is_given) then
         words = without_errors(solver, surface)
         if (words /= '') call values%complain(values%solver, words)
      end if
      select case (solver)
      case ('beale', 'series')
         call check_series_keys(values, surface)
      case ('grid', 'auto')
         call check_grid_keys(values, surface)
      end select
   end subroutine check_method_group

   !> Why a solver cannot solve a surface, as the predicate of a sentence, such as 'is for the 1-D wave'; empty if it
   !> can.
   function refusal(solver, surface) result(words)
      character(*), intent(in) :: solver   !! its name
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      words = ''
      select case (solver)
      case ('beale', 'series')
         if (.not. is_paper_wave(surface)) words = 'is for the waves of the paper: '//paper_waves
      case ('closed_form')
         if (.not. closed_form_exists(surface)) words = "is for the 1-D wave and kind = 'ball'"
      case ('fitted')
         ! A flat surface is in full contact at every load: no fitted function is needed.
         if (.not. crests_form_lattice(surface) .and. surface%amplitude > 0.0_dp) words = &
            "is for the paper's wave, also with two wavelengths up to "//short_number(largest_aspect_ratio)// &
            ':1, for crossed waves with crest curvatures up to '//short_number(largest_curvature_ratio)// &
            ':1 and for three equal waves at 60 degrees'
      end select
      if (any(solver == ['fitted     ', 'closed_form']) .and. surface%has_hardness()) &
         words = 'has no solution with a hardness'
      if (all(solver /= ['grid', 'auto']) .and. surface%kernel%has_layer()) words = 'is for half-spaces alone'
   end function refusal

   !> The solvers that can solve a surface and have a trait, such as "'grid' or 'auto'"; empty if there is none.
   function solvers_for(surface, trait) result(words)
      type(surface_type), intent(in) :: surface
      !> The trait: solutions with 'details', with 'errors', or with the 'coefficients' of a Fourier series; absent: no
      !> trait is needed.
      character(*), intent(in), optional :: trait
      character(:), allocatable :: words

      character(name_length), allocatable :: solvers(:)
      integer :: i
      type(solver_traits), allocatable :: traits(:)

      allocate (solvers, source=words_of(names))
      solvers = pack(solvers, [(refusal(trim(solvers(i)), surface) == '', i=1, size(solvers))])
      traits = [(traits_of(solvers(i)), i=1, size(solvers))]
      if (present(trait)) solvers = pack(solvers, (trait == 'details' .and. traits%has_details) .or. &
         (trait == 'errors' .and. traits%has_errors) .or. (trait == 'coefficients' .and. traits%has_coefficients))
      words = ''
      if (size(solvers) > 0) words = listed(in_quotes(solvers), ' or ')
   end function solvers_for

   !> The traits of a solver before it is started.
   type(solver_traits) function traits_of(name) result(traits)
      character(*), intent(in) :: name   !! name of the solver

      class(contact_solver), allocatable :: solver

      call allocate_solver(name, solver)
      if (allocated(solver)) traits = solver%traits()
   end function traits_of

   !> Allocates the solver of a name, without starting it.
   subroutine allocate_solver(name, solver)
      character(*), intent(in) :: name
      class(contact_solver), allocatable, intent(out) :: solver   !! not allocated if no solver has the name

      select case (name)
      case ('beale', 'series')
         allocate (series_contact :: solver)
      case ('grid')
         allocate (grid_contact :: solver)
      case ('fitted')
         allocate (fitted_contact :: solver)
      case ('closed_form')
         allocate (closed_form_contact :: solver)
      case ('auto')
         allocate (auto_contact :: solver)
      end select
   end subroutine allocate_solver

   !> Makes the solver that &method names, and starts it with a surface and the values of its keys.
   subroutine start_solver(surface, values, keep_fields, solver, description)
      type(surface_type), intent(in) :: surface      !! a surface that the solver can solve (`refusal`)
      type(method_group), intent(in) :: values       !! the values of &method, without problems
      logical, intent(in) :: keep_fields             !! whether fields, edges or details of solutions will be needed
      class(contact_solver), allocatable, intent(out) :: solver   !! not allocated if no solver has that name
      !> The discretisation in words, for the log and the heads of tables.
      character(:), allocatable, intent(out), optional :: description

      character(*), parameter :: closed_form(2) = [character(36) :: "closed form (Westergaard's solution)", &
                                                   "closed form (Hertz's contact)"]
      character(:), allocatable :: fitted, words
      integer :: constraints, unknowns
      type(solver_traits) :: traits

      call allocate_solver(values%solver%text, solver)
      if (.not. allocated(solver)) return
      words = ''
      fitted = 'collocation fitted to the edge to within '//short_number(values%accuracy%number)
      select type (solver)
      type is (series_contact)
         call solver%start(surface, qp_options( &
            nint(values%harmonics%number), nint(values%constraint_points%number), symmetry_of(values), &
            values%edge_level%number, values%solver%text == 'beale'))
         call find_size(values, surface, unknowns, constraints)
         words = integer_text(nint(values%harmonics%number))//' harmonics ('//integer_text(unknowns)// &
                 ' unknowns), '//integer_text(constraints*merge(2, 1, surface%has_hardness()))// &
                 ' constraint points, edge_level[p*] = '//short_number(values%edge_level%number)
      type is (closed_form_contact)
         call solver%start(surface)
         words = trim(closed_form(surface%dimension))
      type is (fitted_contact)
         call solver%start(surface, values%accuracy%number, keep_fields)
         words = fitted
      class is (grid_contact)
         ! Both the grid's solver and auto_contact, which extends that.
         call solver%start(surface, grid_options(values%accuracy%number, points_of_grid(values, surface), &
                                                values%residual%number), keep_fields)
         traits = solver%traits()
         words = grid_in_words(values, surface)
         if (traits%choice == has_closed_form) words = trim(closed_form(surface%dimension))
         if (traits%choice == has_lattice) words = fitted
         if (traits%choice == has_lattice .or. (traits%choice == has_closed_form .and. surface%dimension == 2)) &
            words = words//', grids where it cannot'
      end select
      if (present(description)) call move_alloc(words, description)
   end subroutine start_solver

   !> Why solver = 'auto' chose its solvers, in words for --check; empty for other solvers.
   pure function why_chosen(traits) result(words)
      type(solver_traits), intent(in) :: traits   !! traits of the started solver
      character(:), allocatable :: words

      character(112) :: reasons(0:last_choice)

      reasons = ''
      reasons(has_closed_form) = 'the surface is the 1-D wave or a ball, which has a closed form'
      reasons(has_lattice) = 'the surface has a lattice of equal spots; grids solve the loads for which '// &
                                "'fitted' is not accurate enough"
      reasons(has_neither) = 'there is neither a closed form nor a lattice of equal spots'
      reasons(has_a_hardness) = "neither the closed form nor 'fitted' has a hardness"
      reasons(has_a_layer) = "the closed forms and 'fitted' are for half-spaces, not for a layer"
      reasons(points_are_given) = 'the points of the grid are given'
      reasons(points_are_of_the_map) = 'a height map is solved on its own points unless an accuracy is given'
      words = trim(reasons(traits%choice))
   end function why_chosen

   !> Checks the keys of the series. Defaults that depend on the surface are set; numbers of harmonics and constraint
   !> points that contradict each other or need too much memory are reported.
   subroutine check_series_keys(values, surface)
      type(method_group), intent(inout) :: values
      type(surface_type), intent(in) :: surface

      character(:), allocatable :: origin
      integer :: constraints, harmonics, points, unknowns

      call values%harmonics%set_default([real(paper_harmonics(surface%dimension), dp)])
      call values%constraint_points%set_default( &
         [real(paper_constraint_points(surface%dimension, nint(values%harmonics%number)), dp)])
      if (surface%dimension == 1) then
         values%symmetry%in_effect = .false.
         if (values%symmetry%is_given) call values%complain(values%symmetry, &
                                                          'symmetry is a key of 2-D surfaces: leave it out')
      end if
      if (values%harmonics%is_bad .or. values%constraint_points%is_bad) return
      harmonics = nint(values%harmonics%number)
      points = nint(values%constraint_points%number)
      if (points > most_constraint_points(surface%dimension)) then
         call values%complain(values%constraint_points, 'constraint_points must be at most '// &
            integer_text(most_constraint_points(surface%dimension))//' in '//integer_text(surface%dimension)// &
            '-D, got '//integer_text(points))
      else if (points <= harmonics) then
         origin = ' (the default)'
         if (values%harmonics%is_given) origin = ''
         call values%problems%add(max(values%harmonics%position, values%constraint_points%position), &
            'constraint_points must be more than harmonics, got '//integer_text(points)//' and '// &
            integer_text(harmonics)//origin)
      else if (.not. values%symmetry%is_bad) then
         call find_size(values, surface, unknowns, constraints)
         if (real(unknowns, dp)*constraints*merge(2, 1, surface%has_hardness()) > most_elements) &
            call values%complain(values%constraint_points, 'harmonics = '//integer_text(harmonics)// &
               ' and constraint_points = '//integer_text(points)//' make '//integer_text(unknowns)// &
               ' unknowns and '//integer_text(constraints)//' constraints: too many for the memory. Give fewer '// &
               'constraint_points (harmonics + 1 serve well), or a symmetry')
      end if
   end subroutine check_series_keys

   !> The size of the quadratic programme that the series solves.
   subroutine find_size(values, surface, unknowns, constraints)
      type(method_group), intent(in) :: values
      type(surface_type), intent(in) :: surface
      integer, intent(out) :: unknowns      !! number of coefficients of the pressure
      integer, intent(out) :: constraints   !! number of constraints p >= 0; a hardness adds as many

      type(fourier_terms) :: terms
      integer, allocatable :: k(:), l(:)

      terms = choose_terms(surface%dimension, nint(values%harmonics%number), symmetry_of(values))
      call choose_points(surface%dimension, nint(values%constraint_points%number), symmetry_of(values), k, l)
      unknowns = terms%count
      constraints = size(k)
   end subroutine find_size

   !> The symmetry of the pressure: symmetry_full, symmetry_diagonal or symmetry_none of wavycon_fourier_terms.
   pure integer function symmetry_of(values) result(symmetry)
      type(method_group), intent(in) :: values

      symmetry = symmetry_full
      if (values%symmetry%text == 'diagonal') symmetry = symmetry_diagonal
      if (values%symmetry%text == 'none') symmetry = symmetry_none
   end function symmetry_of

   !> The numbers of points of the given grid along x and y, on the whole cell with mirror images; zeros if the accuracy
   !> decides on the grids.
   pure function points_of_grid(values, surface) result(points)
      type(method_group), intent(in) :: values     !! the values of &method after check_method_group
      type(surface_type), intent(in) :: surface
      integer :: points(2)

      points = surface%maps_in_cell()*nint(values%grid_points%pair)
   end function points_of_grid

   !> Checks the keys of grids and sets grid_points along x and y. If the deck gives neither grid_points nor an
   !> accuracy, a surface that is given at points is solved at these. A given grid takes the place of the accuracy. A
   !> residual without a given grid, and odd numbers of points, are reported.
   subroutine check_grid_keys(values, surface)
      type(method_group), intent(inout) :: values  !! the values of &method
      type(surface_type), intent(in) :: surface

      real(dp) :: points(2)

      associate (grid => values%grid_points)
         points = grid%pair
         if (size(grid%numbers) > 0) call grid%set(points(:surface%dimension))
         if (.not. surface%mirrored .and. any(mod(nint(grid%numbers), 2) /= 0)) call values%complain(grid, &
            'grid_points must be even: of surfaces with mirror symmetry half of them are solved each way')
         if (.not. (grid%is_given .or. values%accuracy%is_given) .and. all(surface%points > 0)) then
            call grid%set(real(surface%points/surface%maps_in_cell(), dp))
            grid%in_effect = .false.
         end if
         if (size(grid%numbers) > 0 .and. .not. values%accuracy%is_given) values%accuracy%in_effect = .false.
         if (values%residual%is_given .and. size(grid%numbers) == 0 .and. .not. values%accuracy%is_given) &
            call values%complain(values%residual, &
            'residual needs grid_points, or a height map on its own points: other grids have the '// &
            'residual that their accuracy takes')
      end associate
   end subroutine check_grid_keys

   !> The grid, or how grids are refined, in words for the log and the heads of tables.
   pure function grid_in_words(values, surface) result(words)
      type(method_group), intent(in) :: values     !! the values of &method
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      integer :: points(2)

      points = points_of_grid(values, surface)/surface%maps_in_cell()
      if (all(points > 0)) then
         words = 'a grid of '//integer_text(points(1))
         if (surface%dimension == 2) words = words//' x '//integer_text(points(2))
         words = words//' points'
         if (values%residual%number > 0.0_dp) words = words//' to a residual of '//short_number(values%residual%number)
      else
         words = 'grids refined until mean gap, area and peak pressure are within '// &
                 short_number(values%accuracy%number)
      end if
      if (surface%mirrored .and. .not. surface%has_free_edges) then
         words = words//', on the map without its mirror images'
      else if (surface%shape%is_even()) then
         words = words//', on a quarter of the cell'
      end if
      if (all(points == 0) .and. has_smaller_cell(surface)) words = words//' turned by 45 degrees'
   end function grid_in_words

end module wavycon_methods
