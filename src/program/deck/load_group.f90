!> The &load group: the loads to solve for, by force, mean pressure, mean gap, approach, contact area, stress or
!> percolation.
module wavycon_load_group
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
   use wavycon_find_percolation, only: percolations
   use wavycon_full_contact, only: mean_compliance
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: choice_value, integer_value, key_type, real_value
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_scene, only: by_approach, by_contact_area, by_mean_gap, by_percolation, by_pressure, &
      by_yield
   use wavycon_scene_groups, only: load_group
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_load_group, given_loads, list_load_keys

   !> Largest mean pressure over p* that is accepted. Contact is full from 1 on, and a load far above 1 is most likely a
   !> mistake of units.
   real(dp), parameter :: largest_pbar_over_pstar = 1.0e6_dp

   integer, parameter :: most_loads = 100000

   !> Relative excess over a limit that is allowed: a user may copy a number of six digits from the log, and rounding
   !> may have raised it by this part.
   real(dp), parameter :: rounding = 5e-6_dp

   !> The quantity that each key of loads gives. These keys are the first of the table, in this order.
   integer, parameter :: list_is(*) = [by_pressure, by_pressure, by_mean_gap, by_mean_gap, by_contact_area, by_yield, &
                                       by_pressure, by_approach, by_contact_area, by_percolation, by_pressure]
   !> Keys whose loads refer to p* or to the mean gap, which only a surface without free edges has.
   character(23), parameter :: periodic_lists(*) = [character(23) :: 'pbar_over_pstar', 'sweep_from', 'mean_gap', &
                                                    'mean_gap_over_amplitude']

contains

   !> The keys of &load.
   subroutine list_load_keys(values, keys)
      type(load_group), intent(in), target :: values   !! the record of the group, to which the list points
      type(key_list), intent(out) :: keys

      keys = key_list('load', 'the loads to solve for: a list of one kind, or a sweep', values%key_group, &
                      required=.true.)
      call keys%add(values%pbar_over_pstar, key_type(real_value, 'pbar_over_pstar', '', '-', &
         'Mean pressures over p*, the mean pressure that just closes the gap everywhere. Tensions, < 0, need '// &
         'work_of_adhesion of &interface, as do those of mean_pressure and force.', most=largest_pbar_over_pstar, &
         most_values=most_loads, way=100, required=.true.))
      call keys%add(values%mean_pressure, key_type(real_value, 'mean_pressure', '', 'unit of e_star', &
         'Mean pressures, over the nominal area.', most_values=most_loads, way=101))
      call keys%add(values%mean_gap_over_amplitude, key_type(real_value, 'mean_gap_over_amplitude', '', '-', &
         'Mean gaps over the mean gap before load, which is the amplitude of a wave; the program finds their '// &
         'loads. Above 1 they need work_of_adhesion of &interface.', least=0, most_values=most_loads, way=102))
      call keys%add(values%mean_gap, key_type(real_value, 'mean_gap', '', 'length', &
         'Mean gaps; the program finds their loads.', least=0, most_values=most_loads, way=103))
      call keys%add(values%contact_area_fraction, key_type(real_value, 'contact_area_fraction', '', '-', &
         'Fractions of the nominal area in contact; the program finds their loads.', least=0, most=1, &
         most_values=most_loads, way=104))
      call keys%add(values%yield, key_type(real_value, 'yield', '', '-', &
         'Largest equivalent stresses in the bodies over the yield stress of &stress; the program finds the '// &
         'least loads that reach them. 1 is first yield.', above=0, most_values=most_loads, way=105))
      call keys%add(values%force, key_type(real_value, 'force', '', 'unit of e_star times length^2', &
         'Forces on the nominal area; of a profile per depth.', most_values=most_loads, way=106))
      call keys%add(values%approach, key_type(real_value, 'approach', '', 'length', &
         'Approaches of the bodies from first touch; the program finds their loads. Below 0 they need '// &
         'work_of_adhesion of &interface.', most_values=most_loads, way=107))
      call keys%add(values%contact_area, key_type(real_value, 'contact_area', '', 'length^2', &
         'Areas in contact, of a profile lengths; the program finds their loads.', least=0, &
         most_values=most_loads, way=108))
      call keys%add(values%percolates, key_type(choice_value, 'percolates', '', '', &
         'The least load at which the contact percolates, has a path from cell to cell, or from which on the gap '// &
         'does not. contact is along x or y, gap along neither; the others are along one axis.', &
         choices='contact contact_x contact_y gap gap_x gap_y', way=109))
      call keys%add(values%sweep_from, key_type(real_value, 'sweep_from', '', '-', &
         'First mean pressure over p* of a sweep in equal steps.', least=0, most=largest_pbar_over_pstar, way=110, &
         needs='sweep_to sweep_steps'))
      call keys%add(values%sweep_to, key_type(real_value, 'sweep_to', '', '-', &
         'Last mean pressure over p* of the sweep, above or below the first.', least=0, &
         most=largest_pbar_over_pstar, way=110, needs='sweep_from'))
      call keys%add(values%sweep_steps, key_type(integer_value, 'sweep_steps', '', '', &
         'Number of loads of the sweep, both ends included; 1 only if the ends are equal.', 1, most_loads, way=110, &
         needs='sweep_from'))
   end subroutine list_load_keys

   !> Checks the keys and, if the group has no problems, converts its loads to the program's normalisation. Tensions and
   !> separations without adhesion or with friction, and contradictions, are reported. So are loads that the surface
   !> cannot have: a mean gap above that before load, an area above the nominal area, a pressure above
   !> largest_pbar_over_pstar p*, a gap or an area on a flat surface, and on a surface with free edges loads that refer
   !> to p*. A gap, approach or area may exceed its limit by rounding. On a flat surface, whose p* is 0, loads over p*
   !> are reported too.
   subroutine check_load_group(values, surface, e_star, with_adhesion, with_friction, loads_by, target, mean_pressure)
      type(load_group), intent(inout) :: values
      type(surface_type), intent(in), optional :: surface        !! absent if it could not be made
      real(dp), intent(in) :: e_star                             !! E* [pressure]; 0 if &material is bad
      logical, intent(in) :: with_adhesion                       !! whether tensions and separations are allowed
      logical, intent(in) :: with_friction                       !! whether partial slip, without adhesion, is asked for
      integer, intent(out) :: loads_by                           !! by_pressure or another name of wavycon_scene
      real(dp), allocatable, intent(out) :: target(:)            !! the component of scene_type
      real(dp), allocatable, intent(out) :: mean_pressure(:)     !! [pressure]; allocated for by_pressure

      !> Words where an adhesive contact would have to slip.
      character(*), parameter :: no_slip = &
         ', and partial slip is computed without adhesion: leave friction of &interface out'
      character(:), allocatable :: key, limit, load   ! limit: the limit in words; load: the heaviest load in words
      integer :: position
      real(dp) :: compression, p_star   ! compression: of a layer under p* [Delta]
      real(dp) :: most   ! largest value allowed, and unit of the target, in the unit of the key

      loads_by = by_pressure
      if (values%problems%number > 0 .or. values%position == 0 .or. values%any_bad) return
      call given_loads(values, key, position, loads_by, target)
      call check_beside_keys()
      if (.not. present(surface) .or. e_star <= 0.0_dp .or. values%problems%number > 0) return
      p_star = surface%full_contact_pressure(e_star)
      call check_on_surface()
      if (p_star <= 0.0_dp .and. values%problems%number > 0) return
      call find_limit()
      load = key//' = '//short_number(maxval(target))
      compression = 0.0_dp
      if (loads_by == by_approach .and. .not. surface%has_free_edges) compression = mean_compliance(surface)
      if (p_star <= 0.0_dp) then
         ! On a flat surface, whose p* is 0, contact is full at every load: P is infinite, and 1 without load.
         target = 1.0_dp
         where (mean_pressure > 0.0_dp) target = ieee_value(1.0_dp, ieee_positive_inf)
      else if (loads_by == by_approach .and. (surface%has_hardness() .or. surface%has_free_edges .or. &
                                              compression > 0.0_dp)) then
         ! Beyond full contact the approach grows by the layer's mean compression alone.
         if (compression > 0.0_dp .and. maxval(target)/most > 1.0_dp + largest_pbar_over_pstar*compression) &
            call values%problems%add(position, load//' is more than that of '// &
                                     short_number(largest_pbar_over_pstar)//' times p*. Do the units agree?')
         target = target/most
      else
         if (limit /= '' .and. maxval(target) > (1 + rounding)*most) then
            if (loads_by /= by_mean_gap .or. .not. with_adhesion) then
               call values%problems%add(position, load//' is more than '//limit//'. Do the units agree?')
            else if (with_friction) then
               ! With adhesion such a gap is one in tension.
               call values%problems%add(position, load//' is more than '//limit//no_slip)
            end if
         end if
         if (loads_by /= by_pressure) then
            target = target/most
            if (all(loads_by /= [by_yield, by_percolation]) .and. .not. (loads_by == by_mean_gap .and. &
                                                                         with_adhesion)) target = min(target, 1.0_dp)
         else if (limit /= '') then
            target = mean_pressure/p_star
         end if
      end if

   contains

      !> Reports loads that contradict other keys: tensions, searches with adhesion, a sweep of one load.
      subroutine check_beside_keys()
         character(:), allocatable :: load   ! the lightest load in words

         load = key//' = '//short_number(minval(target))//' is a tension'
         if (loads_by == by_approach) load = key//' = '//short_number(minval(target))//' is a separation'
         if (minval(target) < 0.0_dp .and. .not. with_adhesion) call values%problems%add(position, &
            load//': without work_of_adhesion of &interface it is >= 0')
         if (minval(target) < 0.0_dp .and. with_adhesion .and. with_friction) &
            call values%problems%add(position, load//no_slip)
         if (with_adhesion .and. any(loads_by == [by_yield, by_percolation])) call values%problems%add(position, &
            'the load of '//key//' is found without adhesion: leave '//key//' or work_of_adhesion of &interface out')
         if (nint(values%sweep_steps%number) == 1 .and. abs(values%sweep_to%number - values%sweep_from%number) > 0) &
            call values%complain(values%sweep_steps, &
               'sweep_steps = 1 leaves out sweep_to: the ends count as loads; give at least 2')
      end subroutine check_beside_keys

      !> Reports a quantity that the surface does not have.
      subroutine check_on_surface()
         if (surface%has_free_edges .and. any(periodic_lists == key)) then
            call values%problems%add(position, key//' needs a surface that is repeated: one with free edges '// &
               'has no p* and no mean gap. Give force, mean_pressure, approach or contact_area')
         else if (surface%has_free_edges .and. loads_by == by_approach .and. surface%dimension == 1) then
            call values%problems%add(position, 'the approach of a profile with free edges is not defined: it '// &
               'grows with the logarithm of the length over which it is measured. Give force or contact_area')
         end if
         if (loads_by == by_percolation .and. (surface%has_free_edges .or. surface%dimension == 1)) &
            call values%problems%add(position, 'percolates needs a surface that is repeated along x and y, whose '// &
               'contact or gap may go on from cell to cell: this one has free edges or is a profile')
         if (p_star <= 0.0_dp .and. all(key /= ['mean_pressure', 'force        '])) call values%problems%add( &
            position, 'the surface is flat, and its p* is 0: give mean_pressure or force in place of '//key)
      end subroutine check_on_surface

      !> Sets the limit of the loads, empty if the table of keys has it as a bound, and the mean pressures.
      subroutine find_limit()
         real(dp) :: area   ! the loads are mean pressures times this

         limit = ''
         most = 1.0_dp
         select case (key)
         case ('pbar_over_pstar', 'sweep_from')
            mean_pressure = p_star*target
         case ('mean_pressure', 'force')
            area = 1.0_dp
            if (key == 'force') area = surface%nominal_area()
            mean_pressure = target/area
            most = largest_pbar_over_pstar*p_star*area
            limit = short_number(largest_pbar_over_pstar)//' times p* = '//short_number(p_star)
            ! With free edges p_star is only a unit, a modulus times a slope: do not call it p*.
            if (surface%has_free_edges) &
               limit = short_number(largest_pbar_over_pstar)//' times what presses the map flat'
         case ('mean_gap')
            most = surface%amplitude
            limit = 'the mean gap before load, '//short_number(most)
         case ('mean_gap_over_amplitude')
            limit = '1, the mean gap before load'
         case ('approach')
            most = surface%amplitude
            limit = 'that of full contact, the mean gap before load, '//short_number(most)
         case ('contact_area')
            most = surface%nominal_area()
            limit = 'the nominal area, '//short_number(most)
         end select
      end subroutine find_limit

   end subroutine check_load_group

   !> The loads in the deck's order; none if the group does not give loads.
   subroutine given_loads(values, key, position, loads_by, loads)
      type(load_group), intent(in), target :: values        !! without bad values
      character(:), allocatable, intent(out) :: key         !! key that gives the loads; 'sweep_from' for a sweep
      integer, intent(out) :: position                      !! position of the key in the deck's text
      integer, intent(out) :: loads_by                      !! by_pressure or another name of wavycon_scene
      real(dp), allocatable, intent(out) :: loads(:)        !! [unit of the key]

      integer :: k
      type(key_list) :: keys

      call list_load_keys(values, keys)
      do k = 1, size(list_is) - 1
         if (keys%keys(k)%value%is_given) exit
      end do
      key = trim(keys%rows(k)%name)
      loads_by = list_is(k)
      position = keys%keys(k)%value%position
      loads = keys%keys(k)%value%numbers
      if (loads_by == by_percolation) &
         loads = [real(dp) :: findloc(percolations == keys%keys(k)%value%text, .true.)]
      if (key /= 'sweep_from' .or. .not. values%sweep_steps%is_given) return
      associate (from => values%sweep_from%number, to => values%sweep_to%number, &
                 last => nint(values%sweep_steps%number) - 1)
         loads = [((from*(last - k) + to*k)/max(1, last), k=0, last)]
         ! Set both ends exactly: the formula rounds them.
         loads(last + 1) = to
         loads(1) = from
      end associate
   end subroutine given_loads

end module wavycon_load_group
