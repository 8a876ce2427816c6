!> The &load group: the loads to solve for, by force, mean pressure, mean gap, approach, contact area or stress.
module wavycon_load_group
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_key, key_group, key_group_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_scene, only: by_approach, by_contact_area, by_mean_gap, by_pressure, by_yield
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: load_table, check_load_group, check_loads_of_surface, given_loads, pressures_of_loads

   !> Largest load accepted. Contact is full from 1 on: a load far above it is most likely a mistake of units.
   real(dp), parameter :: largest_pbar_over_pstar = 1.0e6_dp

   integer, parameter :: most_loads = 100000

   character(11), parameter :: sweep_keys(*) = ['sweep_from ', 'sweep_to   ', 'sweep_steps']
   character(*), parameter :: forms = &
      'pbar_over_pstar, mean_pressure, force, mean_gap_over_amplitude, mean_gap, approach, contact_area_fraction, '// &
      'contact_area or yield, or sweep_from, sweep_to and sweep_steps'
   character(23), parameter :: lists(*) = [character(23) :: 'pbar_over_pstar', 'mean_pressure', &
                                           'mean_gap_over_amplitude', 'mean_gap', 'contact_area_fraction', 'yield', &
                                           'force', 'approach', 'contact_area']
   integer, parameter :: list_is(*) = [by_pressure, by_pressure, by_mean_gap, by_mean_gap, by_contact_area, by_yield, &
                                       by_pressure, by_approach, by_contact_area]
   !> The loads that need p*, full contact or the mean gap of a surface that is repeated.
   character(23), parameter :: periodic_lists(*) = [character(23) :: 'pbar_over_pstar', 'mean_gap_over_amplitude', &
                                                    'mean_gap']

contains

   !> The table of keys of &load.
   function load_table() result(table)
      type(key_group_type) :: table

      integer, parameter :: by_sweep = size(lists) + 1

      table = key_group('load', 'the loads to solve for: a list of one kind, or a sweep', [ &
         real_key('pbar_over_pstar', '', '-', &
            'Mean pressures over p*, the mean pressure that just closes the gap everywhere. Tensions, < 0, need '// &
            'work_of_adhesion of &interface, as do those of mean_pressure and force.', &
            most=largest_pbar_over_pstar, most_values=most_loads, way=1), &
         real_key('mean_pressure', '', 'unit of e_star', 'Mean pressures, over the nominal area.', &
            most_values=most_loads, way=2), &
         real_key('mean_gap_over_amplitude', '', '-', &
            'Mean gaps over the mean gap before load, which is the amplitude of a wave; the program finds their '// &
            'loads.', least=0.0_dp, most=1.0_dp, most_values=most_loads, way=3), &
         real_key('mean_gap', '', 'length', 'Mean gaps; the program finds their loads.', least=0.0_dp, &
            most_values=most_loads, way=4), &
         real_key('contact_area_fraction', '', '-', &
            'Fractions of the nominal area in contact; the program finds their loads.', &
            least=0.0_dp, most=1.0_dp, most_values=most_loads, way=5), &
         real_key('yield', '', '-', &
            'Largest equivalent stresses in the bodies over the yield stress of &stress; the program finds the '// &
            'least loads that reach them. 1 is first yield.', above=0.0_dp, most_values=most_loads, way=6), &
         real_key('force', '', 'unit of e_star times length^2', 'Forces on the nominal area; of a profile per '// &
            'depth.', most_values=most_loads, way=7), &
         real_key('approach', '', 'length', 'Approaches of the bodies from first touch; the program finds their '// &
            'loads.', least=0.0_dp, most_values=most_loads, way=8), &
         real_key('contact_area', '', 'length^2', 'Areas in contact, of a profile lengths; the program finds their '// &
            'loads.', least=0.0_dp, most_values=most_loads, way=9), &
         real_key('sweep_from', '', '-', 'First mean pressure over p* of a sweep in equal steps.', &
            least=0.0_dp, most=largest_pbar_over_pstar, way=by_sweep), &
         real_key('sweep_to', '', '-', 'Last mean pressure over p* of the sweep, above or below the first.', &
            least=0.0_dp, most=largest_pbar_over_pstar, way=by_sweep), &
         integer_key('sweep_steps', '', &
            'Number of loads of the sweep, both ends included; 1 only if the ends are equal.', &
            1, most_loads, way=by_sweep)], required=.true.)
   end function load_table

   !> Reports loads that are not given, given in more than one way, or given by an incomplete sweep, and tensions without
   !> adhesion.
   subroutine check_load_group(values, with_adhesion, problems)
      type(group_values), intent(in) :: values
      logical, intent(in) :: with_adhesion   !! whether loads may be tensions
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: key
      logical :: has(size(sweep_keys))
      integer :: k, loads_by, ways
      real(dp), allocatable :: loads(:)

      if (values%place == 0) return
      has = [(values%has(trim(sweep_keys(k))), k=1, size(sweep_keys))]
      ways = count([any(has), (values%has(trim(lists(k))), k=1, size(lists))])
      if (ways == 0) call problems%add(values%place, '&load needs '//forms)
      if (ways > 1) call problems%add(values%place, 'loads are given in more than one way: give '//forms)
      if (ways /= 1) return
      if (.not. any(has)) then
         if (with_adhesion .or. values%any_bad()) return
         call given_loads(values, key, loads_by, loads)
         if (minval(loads) < 0.0_dp) call values%complain(problems, key, key//' = '//short_number(minval(loads))// &
            ' is a tension: without work_of_adhesion of &interface loads are >= 0')
         return
      end if
      do k = 1, size(sweep_keys)
         if (.not. has(k)) call values%complain(problems, trim(sweep_keys(findloc(has, .true., dim=1))), &
            'a sweep needs '//trim(sweep_keys(k))//' too')
      end do
      if (.not. all(has) .or. values%any_bad()) return
      if (values%integer('sweep_steps') == 1 .and. abs(values%real('sweep_to') - values%real('sweep_from')) > 0) &
         call values%complain(problems, 'sweep_steps', &
            'sweep_steps = 1 leaves out sweep_to: the ends count as loads; give at least 2')
   end subroutine check_load_group

   !> Reports loads that the surface cannot have: a mean gap above that before load, an area above the nominal one, a
   !> pressure of more than largest_pbar_over_pstar p*, a gap or an area on a flat surface, with free edges what needs
   !> p*, and on a ball without sides what needs them.
   subroutine check_loads_of_surface(values, surface, p_star, problems, has_own_sides)
      type(group_values), intent(in) :: values               !! of a &load group without problems
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p_star                         !! p* [pressure]; 0: the surface is flat
      type(problem_list_type), intent(inout) :: problems
      logical, intent(in), optional :: has_own_sides         !! whether the sides do not follow from the loads; default

      character(:), allocatable :: given, key
      integer :: loads_by
      logical :: has_area
      real(dp), allocatable :: loads(:)
      real(dp) :: worst

      has_area = .true.
      if (present(has_own_sides)) has_area = has_own_sides
      call given_loads(values, key, loads_by, loads)
      given = key
      if (values%has(trim(sweep_keys(1)))) given = trim(sweep_keys(1))
      worst = maxval(loads)
      if (surface%has_free_edges) then
         if (any(periodic_lists == key)) then
            call values%complain(problems, given, given//' needs a surface that is repeated: one with free edges '// &
               'has no p* and no mean gap. Give force, mean_pressure, approach or contact_area')
         else if (.not. has_area .and. any(key == ['mean_pressure        ', 'contact_area_fraction'])) then
            call values%complain(problems, key, key//' needs the sides of the ball, length_x and length_y: give '// &
                                 'them, or force, approach or contact_area')
         else if (loads_by == by_approach .and. surface%dimension == 1) then
            call values%complain(problems, key, 'the approach of a profile with free edges is not defined: it '// &
               'grows with the logarithm of the length over which it is measured. Give force or contact_area')
         end if
      end if
      if (p_star <= 0.0_dp) then
         if (loads_by /= by_pressure) call values%complain(problems, given, &
            'the surface is flat: give its loads by pressure, not by gap, area or yield')
      else if (any(key == ['mean_pressure', 'force        ']) .and. &
               maxval(pressures_of_loads(key, loads, surface, p_star)) > largest_pbar_over_pstar*p_star) then
         given = ' times p* = '//short_number(p_star)
         ! There p* is a modulus times a slope.
         if (surface%has_free_edges) given = ' times what presses the map flat'
         call values%complain(problems, key, key//' = '//short_number(worst)//' is more than '// &
            short_number(largest_pbar_over_pstar)//given// &
            '. Do its unit and that of e_star agree, and those of the lengths?')
      else if (key == 'mean_gap' .and. worst > surface%amplitude) then
         call values%complain(problems, key, 'mean_gap = '//short_number(worst)// &
            ' is more than the mean gap before load, '//short_number(surface%amplitude)// &
            '. Do the units of the lengths agree?')
      else if (key == 'approach' .and. worst > surface%amplitude .and. .not. surface%has_hardness() .and. &
               .not. surface%has_free_edges) then
         call values%complain(problems, key, 'approach = '//short_number(worst)// &
            ' is more than that of full contact, the mean gap before load, '//short_number(surface%amplitude)// &
            '. Do the units of the lengths agree?')
      else if (key == 'contact_area' .and. worst > surface%nominal_area()) then
         call values%complain(problems, key, 'contact_area = '//short_number(worst)// &
            ' is more than the nominal area, '//short_number(surface%nominal_area())// &
            '. Do the units of the lengths agree?')
      end if
   end subroutine check_loads_of_surface

   !> The mean pressures of loads by pressure [pressure].
   pure function pressures_of_loads(key, loads, surface, p_star) result(pressures)
      character(*), intent(in) :: key            !! 'pbar_over_pstar', 'mean_pressure' or 'force'
      real(dp), intent(in) :: loads(:)           !! [unit of the key]
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p_star             !! [pressure]
      real(dp) :: pressures(size(loads))

      pressures = loads
      if (key == 'pbar_over_pstar') pressures = p_star*loads
      if (key == 'force') pressures = loads/surface%nominal_area()
   end function pressures_of_loads

   !> The loads in the deck's order; a sweep is a list of pbar_over_pstar. None if the group does not give them.
   pure subroutine given_loads(values, key, loads_by, loads)
      type(group_values), intent(in) :: values              !! of a &load group without bad values
      character(:), allocatable, intent(out) :: key         !! the key that gives them; pbar_over_pstar for a sweep
      integer, intent(out) :: loads_by                      !! a name of wavycon_scene
      real(dp), allocatable, intent(out) :: loads(:)        !! [unit of the key]

      integer :: k

      if (all([(values%has(trim(sweep_keys(k))), k=1, size(sweep_keys))])) then
         k = 1
         loads = sweep(values%real('sweep_from'), values%real('sweep_to'), values%integer('sweep_steps'))
      else
         allocate (loads(0))
         do k = 1, size(lists) - 1
            if (values%has(trim(lists(k)))) exit
         end do
         if (values%has(trim(lists(k)))) loads = values%reals(trim(lists(k)))
      end if
      key = trim(lists(k))
      loads_by = list_is(k)
   end subroutine given_loads

   !> Equally spaced loads; both ends are exact.
   pure function sweep(from, to, steps) result(loads)
      real(dp), intent(in) :: from, to
      integer, intent(in) :: steps   !! >= 1
      real(dp) :: loads(steps)

      integer :: i, intervals

      intervals = max(1, steps - 1)
      do i = 1, steps
         loads(i) = (from*(intervals - i + 1) + to*(i - 1))/intervals
      end do
      loads(steps) = to
      loads(1) = from
   end function sweep

end module wavycon_load_group
