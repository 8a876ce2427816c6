!> What the keys of solver = 'beale', the paper's truncated Fourier series, mean: limits, checks and options.
module wavycon_beale_keys
   use wavycon_beale_contact, only: paper_constraint_points, paper_harmonics, qp_options
   use wavycon_constraint_points, only: choose_points
   use wavycon_fourier_terms, only: choose_terms, fourier_terms, symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: beale_in_words, beale_options, check_beale_keys

   !> Largest values accepted from a deck, for 1-D and 2-D waves, so that a mistyped number does not run for hours.
   integer, parameter, public :: most_harmonics = 60, most_constraint_points(2) = [6001, 601]
   !> Most elements of the constraints' matrix. A few copies of it exist at a time, each of 160 MB.
   real(dp), parameter :: most_elements = 2.0e7_dp
   !> The choices of `symmetry`, in the order of its key.
   integer, parameter :: symmetry_is(*) = [symmetry_full, symmetry_diagonal, symmetry_none]

contains

   !> Sets the defaults that depend on the surface, and reports numbers that do not fit each other or the memory.
   subroutine check_beale_keys(values, surface, problems)
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
   end subroutine check_beale_keys

   !> The size of the quadratic programme.
   subroutine find_size(values, surface, unknowns, constraints)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      integer, intent(out) :: unknowns, constraints   !! without those of a hardness, which are as many again

      type(fourier_terms) :: terms
      integer, allocatable :: k(:), l(:)

      terms = choose_terms(surface%dimension, values%integer('harmonics'), symmetry_of(values))
      call choose_points(surface%dimension, values%integer('constraint_points'), symmetry_of(values), k, l)
      unknowns = terms%count
      constraints = size(k)
   end subroutine find_size

   pure integer function symmetry_of(values) result(symmetry)
      type(group_values), intent(in) :: values

      symmetry = symmetry_is(values%choice('symmetry'))
   end function symmetry_of

   pure type(qp_options) function beale_options(values) result(options)
      type(group_values), intent(in) :: values   !! of &method

      options = qp_options(values%integer('harmonics'), values%integer('constraint_points'), symmetry_of(values), &
                           values%real('edge_level'), values%text('minimiser') == 'beale')
   end function beale_options

   !> The discretisation in words.
   function beale_in_words(values, surface) result(words)
      type(group_values), intent(in) :: values   !! of &method
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      integer :: constraints, unknowns

      call find_size(values, surface, unknowns, constraints)
      words = integer_text(values%integer('harmonics'))//' harmonics ('//integer_text(unknowns)//' unknowns), '// &
              integer_text(constraints*merge(2, 1, surface%has_hardness()))//' constraint points, edge_level[p*] = '// &
              short_number(values%real('edge_level'))
   end function beale_in_words

end module wavycon_beale_keys
