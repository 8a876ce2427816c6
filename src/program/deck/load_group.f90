!> The &load group: the loads to solve for, by force, mean pressure, mean gap, approach, contact area or stress.
module wavycon_load_group
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_value, key_type, real_value
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_scene, only: by_approach, by_contact_area, by_mean_gap, by_pressure, by_yield
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_load_group, check_loads_of_surface, given_loads, take_loads

   !> Largest load accepted. Contact is full from 1 on: a load far above it is most likely a mistake of units.
   real(dp), parameter :: largest_pbar_over_pstar = 1.0e6_dp

   integer, parameter :: most_loads = 100000

   !> Numbers of six digits, as those of the log, may be rounded up by this part of themselves.
   real(dp), parameter :: rounding = 5e-6_dp

   !> What the lists of loads give, which are the first keys of the table.
   integer, parameter :: list_is(*) = [by_pressure, by_pressure, by_mean_gap, by_mean_gap, by_contact_area, by_yield, &
                                       by_pressure, by_approach, by_contact_area]
   !> The loads that need p*, full contact or the mean gap of a surface that is repeated.
   character(23), parameter :: periodic_lists(*) = [character(23) :: 'pbar_over_pstar', 'mean_gap_over_amplitude', &
                                                    'mean_gap']

   !> The keys of &load.
   type(key_type), parameter, public :: load_keys(*) = [ &
      key_type(real_value, 'pbar_over_pstar', '', '-', &
         'Mean pressures over p*, the mean pressure that just closes the gap everywhere. Tensions, < 0, need '// &
         'work_of_adhesion of &interface, as do those of mean_pressure and force.', most=largest_pbar_over_pstar, &
         most_values=most_loads, way=10, required=.true.), &
      key_type(real_value, 'mean_pressure', '', 'unit of e_star', &
         'Mean pressures, over the nominal area.', most_values=most_loads, way=11), &
      key_type(real_value, 'mean_gap_over_amplitude', '', '-', &
         'Mean gaps over the mean gap before load, which is the amplitude of a wave; the program finds their '// &
         'loads.', least=0, most=1, most_values=most_loads, way=12), &
      key_type(real_value, 'mean_gap', '', 'length', &
         'Mean gaps; the program finds their loads.', least=0, most_values=most_loads, way=13), &
      key_type(real_value, 'contact_area_fraction', '', '-', &
         'Fractions of the nominal area in contact; the program finds their loads.', least=0, most=1, &
         most_values=most_loads, way=14), &
      key_type(real_value, 'yield', '', '-', &
         'Largest equivalent stresses in the bodies over the yield stress of &stress; the program finds the '// &
         'least loads that reach them. 1 is first yield.', above=0, most_values=most_loads, way=15), &
      key_type(real_value, 'force', '', 'unit of e_star times length^2', &
         'Forces on the nominal area; of a profile per depth.', most_values=most_loads, way=16), &
      key_type(real_value, 'approach', '', 'length', &
         'Approaches of the bodies from first touch; the program finds their loads.', least=0, &
         most_values=most_loads, way=17), &
      key_type(real_value, 'contact_area', '', 'length^2', &
         'Areas in contact, of a profile lengths; the program finds their loads.', least=0, &
         most_values=most_loads, way=18), &
      key_type(real_value, 'sweep_from', '', '-', &
         'First mean pressure over p* of a sweep in equal steps.', least=0, most=largest_pbar_over_pstar, way=19, &
         needs='sweep_to sweep_steps'), &
      key_type(real_value, 'sweep_to', '', '-', &
         'Last mean pressure over p* of the sweep, above or below the first.', least=0, &
         most=largest_pbar_over_pstar, way=19, needs='sweep_from'), &
      key_type(integer_value, 'sweep_steps', '', '', &
         'Number of loads of the sweep, both ends included; 1 only if the ends are equal.', 1, most_loads, way=19, &
         needs='sweep_from')]

contains

   !> Checks the keys, and reports tensions without adhesion.
   subroutine check_load_group(values, with_adhesion, problems)
      type(group_values), intent(inout) :: values
      logical, intent(in) :: with_adhesion   !! whether loads may be tensions
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: key
      integer :: before, loads_by
      real(dp), allocatable :: loads(:)

      before = problems%number
      call values%check_relations(problems)
      if (problems%number > before .or. values%place == 0 .or. values%any_bad()) return
      call given_loads(values, key, loads_by, loads)
      if (minval(loads) < 0.0_dp .and. .not. with_adhesion) call values%complain(problems, key, &
         key//' = '//short_number(minval(loads))// &
         ' is a tension: without work_of_adhesion of &interface loads are >= 0')
      if (with_adhesion .and. loads_by /= by_pressure) call values%complain(problems, key, key// &
         ' is found without adhesion: with work_of_adhesion of &interface give force, mean_pressure or pbar_over_pstar')
      if (values%integer('sweep_steps') == 1 .and. abs(values%real('sweep_to') - values%real('sweep_from')) > 0) &
         call values%complain(problems, 'sweep_steps', &
            'sweep_steps = 1 leaves out sweep_to: the ends count as loads; give at least 2')
   end subroutine check_load_group

   !> Reports loads that the surface cannot have: a mean gap above that before load, an area above the nominal one, a
   !> pressure of more than largest_pbar_over_pstar p*, a gap or an area on a flat surface, with free edges what needs
   !> p*. The largest gap, approach or area may be rounded up.
   subroutine check_loads_of_surface(values, surface, p_star, problems)
      type(group_values), intent(in) :: values               !! of a &load group without problems
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p_star                         !! p* [pressure]; 0: the surface is flat
      type(problem_list_type), intent(inout) :: problems

      character(:), allocatable :: given, key, limit
      integer :: loads_by
      real(dp), allocatable :: loads(:)
      real(dp) :: most   ! in the unit of the loads

      call given_loads(values, key, loads_by, loads)
      given = key
      if (values%has('sweep_from')) given = 'sweep_from'
      if (surface%has_free_edges) then
         if (any(periodic_lists == key)) then
            call values%complain(problems, given, given//' needs a surface that is repeated: one with free edges '// &
               'has no p* and no mean gap. Give force, mean_pressure, approach or contact_area')
         else if (loads_by == by_approach .and. surface%dimension == 1) then
            call values%complain(problems, key, 'the approach of a profile with free edges is not defined: it '// &
               'grows with the logarithm of the length over which it is measured. Give force or contact_area')
         end if
      end if
      if (p_star <= 0.0_dp) then
         if (loads_by /= by_pressure) call values%complain(problems, given, &
            'the surface is flat: give its loads by pressure, not by gap, area or yield')
         return
      end if
      ! The bounds of the other keys are in the table.
      select case (key)
      case ('mean_pressure', 'force')
         most = largest_pbar_over_pstar*p_star
         if (key == 'force') most = most*surface%nominal_area()
         limit = short_number(largest_pbar_over_pstar)//' times p* = '//short_number(p_star)
         ! There p* is a modulus times a slope.
         if (surface%has_free_edges) limit = short_number(largest_pbar_over_pstar)//' times what presses the map flat'
      case ('mean_gap')
         most = surface%amplitude
         limit = 'the mean gap before load, '//short_number(most)
      case ('approach')
         if (surface%has_hardness() .or. surface%has_free_edges) return
         most = surface%amplitude
         limit = 'that of full contact, the mean gap before load, '//short_number(most)
      case ('contact_area')
         most = surface%nominal_area()
         limit = 'the nominal area, '//short_number(most)
      case default
         return
      end select
      if (maxval(loads) > (1 + rounding)*most) call values%complain(problems, key, &
         key//' = '//short_number(maxval(loads))//' is more than '//limit//'. Do the units agree?')
   end subroutine check_loads_of_surface

   !> Converts loads to the program's normalisation.
   subroutine take_loads(values, surface, p_star, loads_by, target, mean_pressure)
      type(group_values), intent(in) :: values                   !! of a &load group without problems
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p_star                             !! p* [pressure]; 0: the surface is flat
      integer, intent(out) :: loads_by                           !! a name of wavycon_scene
      real(dp), allocatable, intent(out) :: target(:)            !! as of scene_type
      real(dp), allocatable, intent(out) :: mean_pressure(:)     !! [pressure]; allocated for by_pressure

      character(:), allocatable :: key

      call given_loads(values, key, loads_by, target)
      select case (key)
      case ('pbar_over_pstar')
         mean_pressure = p_star*target
      case ('mean_pressure')
         mean_pressure = target
      case ('force')
         mean_pressure = target/surface%nominal_area()
      case ('mean_gap', 'approach')
         if (p_star > 0.0_dp) target = target/surface%amplitude
      case ('contact_area')
         target = target/surface%nominal_area()
      end select
      if (loads_by == by_mean_gap .or. loads_by == by_contact_area .or. (loads_by == by_approach .and. &
          .not. (surface%has_hardness() .or. surface%has_free_edges))) target = min(target, 1.0_dp)
      if (loads_by /= by_pressure) return
      if (p_star <= 0.0_dp) then
         ! On a flat surface contact is full at every load.
         target = merge(ieee_value(1.0_dp, ieee_positive_inf), 1.0_dp, mean_pressure > 0.0_dp)
      else if (key /= 'pbar_over_pstar') then
         target = mean_pressure/p_star
      end if
   end subroutine take_loads

   !> The loads in the deck's order; a sweep is a list of pbar_over_pstar. None if the group does not give them.
   pure subroutine given_loads(values, key, loads_by, loads)
      type(group_values), intent(in) :: values              !! of a &load group without bad values
      character(:), allocatable, intent(out) :: key         !! the key that gives them; pbar_over_pstar for a sweep
      integer, intent(out) :: loads_by                      !! a name of wavycon_scene
      real(dp), allocatable, intent(out) :: loads(:)        !! [unit of the key]

      integer :: k

      if (values%has('sweep_from') .and. values%has('sweep_steps')) then
         k = 1
         loads = sweep(values%real('sweep_from'), values%real('sweep_to'), values%integer('sweep_steps'))
      else
         do k = 1, size(list_is) - 1
            if (values%has(values%table%keys(k)%name)) exit
         end do
         loads = values%reals(values%table%keys(k)%name)
      end if
      key = trim(values%table%keys(k)%name)
      loads_by = list_is(k)
   end subroutine given_loads

   !> Equally spaced loads; both ends are exact.
   pure function sweep(from, to, steps) result(loads)
      real(dp), intent(in) :: from, to
      integer, intent(in) :: steps   !! >= 1
      real(dp) :: loads(steps)

      integer :: i

      loads = [((from*(steps - 1 - i) + to*i)/max(1, steps - 1), i=0, steps - 1)]
      loads(steps) = to
      loads(1) = from
   end function sweep

end module wavycon_load_group
