!> solver = 'beale': the paper's truncated Fourier series.
module wavycon_beale_method
   use wavycon_beale_contact, only: beale_contact, paper_constraint_points, paper_harmonics, qp_options
   use wavycon_constraint_points, only: choose_points
   use wavycon_contact_solver, only: contact_solver
   use wavycon_fourier_terms, only: choose_terms, fourier_terms, symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: choice_key, integer_key, real_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   use wavycon_wave_kinds, only: paper_waves
   implicit none (type, external)
   private

   public :: beale_method

   !> Largest values accepted from a deck, for 1-D and 2-D waves, so that a mistyped number does not run for hours.
   integer, parameter :: most_harmonics = 60, most_constraint_points(2) = [6001, 601]
   !> Most elements of the constraints' matrix. A few copies of it exist at a time, each of 160 MB.
   real(dp), parameter :: most_elements = 2.0e7_dp

contains

   type(solver_method) function beale_method() result(method)
      type(beale_contact) :: solver
      type(qp_options) :: default

      method%name = 'beale'
      method%meaning = "the paper's truncated Fourier series, for its waves; their default. The key minimiser "// &
         "says how its quadratic programme is solved: by default not by Beale's method"
      allocate (method%keys, source=[ &
            integer_key('harmonics', '9 (2-D), 10 (1-D)', 'highest harmonic of the pressure, in each direction.', &
               1, most_harmonics), &
            integer_key('constraint_points', 'in proportion to harmonics', &
               'equally spaced points on half a wavelength, ends included, in each direction, '// &
               'at which the pressure is constrained. More than harmonics; at most 601 in 2-D. The default is '// &
               "3 harmonics in 2-D and 2.5 harmonics + 1 in 1-D: the paper's 27 for 9 and 26 for 10.", 2, &
               maxval(most_constraint_points)), &
            choice_key('symmetry', "'full'", &
               "in 2-D, symmetry of the pressure. 'full': alike in x and y and at both crests (29 unknowns, 196 "// &
               "points by default); 'diagonal': at both crests (49, 378); 'none' (99, 729).", &
               ['full    ', 'diagonal', 'none    ']), &
            choice_key('minimiser', "'dual'", &
               "how the minimum of the energy is found, which is one and the same. 'dual': Goldfarb and Idnani's "// &
               "method, from the load before; 'beale': Beale's method as in the paper, "// &
               "each load from an even pressure.", &
               ['dual ', 'beale']), &
            real_key('edge_level', short_number(default%edge_level), 'p*', &
               'the isobar that is taken as the edge of contact.', above=0.0_dp, below=1.0_dp)])
      method%traits = solver%traits()
      method%refusal => refusal
      method%check => check
      method%make => make
   end function beale_method

   subroutine refusal(surface, words)
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      words = ''
      if (.not. surface%is_paper_wave()) words = 'is for the waves of the paper: '//paper_waves
   end subroutine refusal

   subroutine check(values, surface, problems)
      type(group_values), intent(inout) :: values
      type(surface_type), intent(in) :: surface
      type(problem_list_type), intent(inout) :: problems

      integer :: constraints, harmonics, points, unknowns

      call values%set_default('harmonics', [real(paper_harmonics(surface%dimension), dp)])
      call values%set_default('constraint_points', &
                              [real(paper_constraint_points(surface%dimension, values%integer('harmonics')), dp)])
      if (surface%dimension == 1) then
         call values%leave_out('symmetry')
         if (values%has('symmetry')) call values%complain(problems, 'symmetry', &
                                                          'symmetry means nothing in 1-D: leave it out')
      end if
      if (values%is_bad('harmonics') .or. values%is_bad('constraint_points')) return
      harmonics = values%integer('harmonics')
      points = values%integer('constraint_points')
      if (points > most_constraint_points(surface%dimension)) then
         call values%complain(problems, 'constraint_points', 'constraint_points must be at most '// &
            integer_text(most_constraint_points(surface%dimension))//' in '//integer_text(surface%dimension)// &
            '-D, got '//integer_text(points))
      else if (points <= harmonics) then
         call problems%add(max(values%place_of('harmonics'), values%place_of('constraint_points')), &
            'constraint_points must be more than harmonics, got '//integer_text(points)//' and '// &
            integer_text(harmonics)//trim(merge('              ', ' (the default)', values%has('harmonics'))))
      else if (.not. values%is_bad('symmetry')) then
         call find_size(values, surface, unknowns, constraints)
         if (real(unknowns, dp)*constraints*merge(2, 1, surface%has_hardness()) > most_elements) &
            call values%complain(problems, 'constraint_points', 'harmonics = '//integer_text(harmonics)// &
               ' and constraint_points = '//integer_text(points)//' make '//integer_text(unknowns)// &
               ' unknowns and '//integer_text(constraints)//' constraints: too many for the memory. Give fewer '// &
               'constraint_points (harmonics + 1 serve well), or a symmetry')
      end if
   end subroutine check

   !> The size of the quadratic programme.
   subroutine find_size(values, surface, unknowns, constraints)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      integer, intent(out) :: unknowns, constraints   !! without those of a hardness, which are as many again

      type(fourier_terms) :: terms
      integer, allocatable :: k(:), l(:)

      terms = choose_terms(surface%dimension, values%integer('harmonics'), symmetry_of(values))
      call choose_points(surface%dimension, values%integer('constraint_points'), symmetry_of(values), k, l)
      unknowns = terms%count()
      constraints = size(k)
   end subroutine find_size

   pure integer function symmetry_of(values) result(symmetry)
      type(group_values), intent(in) :: values

      select case (values%text('symmetry'))
      case ('none')
         symmetry = symmetry_none
      case ('diagonal')
         symmetry = symmetry_diagonal
      case default
         symmetry = symmetry_full
      end select
   end function symmetry_of

   subroutine make(values, surface, keep_fields, solver, description)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver
      character(:), allocatable, intent(out) :: description

      type(beale_contact), allocatable :: own
      integer :: constraints, unknowns

      associate (fields_are_always_kept => keep_fields); end associate
      allocate (own)
      call own%start(surface, qp_options(values%integer('harmonics'), values%integer('constraint_points'), &
                                         symmetry_of(values), values%real('edge_level'), &
                                         values%text('minimiser') == 'beale'))
      call move_alloc(own, solver)
      call find_size(values, surface, unknowns, constraints)
      description = integer_text(values%integer('harmonics'))//' harmonics ('//integer_text(unknowns)// &
                    ' unknowns), '//integer_text(constraints*merge(2, 1, surface%has_hardness()))// &
                    ' constraint points, edge_level[p*] = '//short_number(values%real('edge_level'))
   end subroutine make

end module wavycon_beale_method
