!> Pressures, gaps and stresses of solved loads of a session, in the deck's units, in arrays of the caller; and
!> guaranteed bounds from such arrays. Loads without a solution have NaN.
!>
!> All procedures have these errors: exit_bad_input if no load was solved, if the session does not keep fields, and for
!> numbers of points and coordinates that are out of range or not finite; exit_file_trouble if there is not enough
!> memory.
module wavycon_session_fields
   use wavycon_cell_file, only: map_offset, map_points
   use wavycon_deck_session, only: check_ready, deck_session, solved_load
   use wavycon_energy_bounds, only: bounding_grid, energy_bounds
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: key_index
   use wavycon_kinds, only: dp, ieee_is_finite, int64, not_a_number
   use wavycon_plain_text, only: integer_text
   use wavycon_scene_groups, only: stress_group
   use wavycon_stress_group, only: lateral_of, list_stress_keys
   use wavycon_stress_tensor, only: elastic_body, no_waves
   use wavycon_system, only: has_memory_for
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: bounds_from_fields, check_number, fields_at, fields_on_grid, map_grid, own_points, stresses_at, &
      stresses_on_plane

   !> Most points of a grid or plane.
   integer, parameter :: most_points = 8192**2

   !> How many double precision numbers are in memory for each point: fields or stresses, and the work space of
   !> transforms.
   integer(int64), parameter :: numbers_of_fields = 8, numbers_of_stresses = 28, numbers_of_bounds = 16

contains

   !> Fields at n points. The pressure is exactly 0 outside contact, and the gap is exactly 0 in contact. Only the
   !> truncated series of the solvers 'beale' and 'series' differ: they are returned as they are.
   !> Beyond a surface with free edges the pressure is 0, and gap and displacement are NaN.
   subroutine fields_at(session, solved, n, x, y, error, pressure, gap, displacement)
      type(deck_session), intent(in) :: session
      type(solved_load), intent(inout) :: solved                     !! a load that the session has solved
      integer, intent(in) :: n                                       !! number of points, >= 1
      real(dp), intent(in) :: x(n), y(n)                             !! coordinates of the points [length]
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(out), optional :: pressure(n)                 !! [pressure]
      real(dp), intent(out), optional :: gap(n), displacement(n)     !! [length]; displacement less its mean

      real(dp) :: angles(2), values(3)
      integer :: i

      call prepare_fields(session, solved, error)
      if (.not. allocated(error)) call check_places(session, x, y, [0.0_dp], error)
      if (allocated(error)) return
      do i = 1, n
         values = [solved%mean_pressure, 0.0_dp, 0.0_dp]
         if (session%scale%p_star > 0.0_dp) then
            angles = session%scale%angles([x(i), y(i)])
            call solved%fields%at(angles(1), angles(2), values(1), values(2), values(3))
            values = [session%scale%p_star, session%scale%amplitude, session%scale%amplitude]*values
         end if
         if (is_beyond(session, [x(i), y(i)]/session%scale%sides)) values = [0.0_dp, not_a_number(), not_a_number()]
         if (present(pressure)) pressure(i) = values(1)
         if (present(displacement)) displacement(i) = values(2)
         if (present(gap)) gap(i) = values(3)
      end do
   end subroutine fields_at

   !> Fields as in fields_at, at the points of a grid: x = L_x (k + offset(1))/N_x, k = 0 .. N_x - 1, and y likewise,
   !> with the sides L_x, L_y of the surface.
   subroutine fields_on_grid(session, solved, points, offset, error, pressure, gap, displacement)
      type(deck_session), intent(in) :: session
      type(solved_load), intent(inout) :: solved          !! a load that the session has solved
      integer, intent(in) :: points(2)                    !! N_x, N_y >= 1; N_y = 1 for a profile
      real(dp), intent(in), optional :: offset(2)         !! position of the first point, in steps; absent: 0
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(out), optional, dimension(points(1), points(2)) :: pressure, gap, displacement

      integer :: k, l
      real(dp) :: first(2)
      real(dp), allocatable :: g(:, :), p(:, :), u(:, :)

      call prepare_fields(session, solved, error)
      if (.not. allocated(error)) call check_points(session, points, offset, 0.0_dp, numbers_of_fields, first, error)
      if (allocated(error)) return
      if (session%scale%p_star > 0.0_dp) then
         call solved%fields%on_grid(points, first, p, u, g)
         p = session%scale%p_star*p
      else
         allocate (g(points(1), points(2)), source=0.0_dp)
         u = g
         p = g + solved%mean_pressure
      end if
      do l = 1, merge(0, points(2), session%scale%repeats)
         do k = 1, points(1)
            if (.not. is_beyond(session, ([k, l] - 1 + first)/points)) cycle
            p(k, l) = 0.0_dp
            u(k, l) = not_a_number()
            g(k, l) = not_a_number()
         end do
      end do
      if (present(pressure)) pressure = p
      if (present(gap)) gap = session%scale%amplitude*g
      if (present(displacement)) displacement = session%scale%amplitude*u
   end subroutine fields_on_grid

   !> Whether a place lies beyond a surface with free edges, where there is no surface.
   pure logical function is_beyond(session, place)
      type(deck_session), intent(in) :: session
      real(dp), intent(in) :: place(2)   !! x, y over the sides of the surface

      real(dp), parameter :: rounding = 1e-9_dp

      associate (n => session%results%solver%surface%dimension)
         is_beyond = .not. session%scale%repeats .and. any(abs(place(:n) - 0.5_dp) > 0.5_dp + rounding)
      end associate
   end function is_beyond

   !> The grid on which the load was solved, as arguments of fields_on_grid: there the fields are the numbers that the
   !> solver has computed. Zeros if the solver has no grid.
   subroutine own_points(session, solved, points, offset, error)
      type(deck_session), intent(in) :: session
      type(solved_load), intent(inout) :: solved
      integer, intent(out) :: points(2)
      real(dp), intent(out) :: offset(2)
      type(error_type), allocatable, intent(out) :: error

      points = 0
      offset = 0.0_dp
      call prepare_fields(session, solved, error)
      if (allocated(error)) return
      points = solved%fields%own_points
      offset = solved%fields%own_offset
   end subroutine own_points

   !> The grid of the table `map`, as arguments of fields_on_grid.
   subroutine map_grid(session, solved, points, offset, error)
      type(deck_session), intent(inout) :: session
      type(solved_load), intent(inout) :: solved
      integer, intent(out) :: points(2)
      real(dp), intent(out) :: offset(2)
      type(error_type), allocatable, intent(out) :: error

      call own_points(session, solved, points, offset, error)
      if (allocated(error)) return
      points = map_points(session%results)
      call solved%solution%move_to(session%results%loads(1))
      offset = map_offset(session%results, points)
      call session%results%loads(1)%move_to(solved%solution)
   end subroutine map_grid

   !> Guaranteed bounds of the contact of the surface under a mean pressure, from any pressure and gap at the points of
   !> a grid over the whole surface: (E18) to (E26) of the page of src/core/half_space. The bounds hold for any given
   !> arrays; they are close if the arrays are those of a solution. Negative pressures count as 0, negative gaps too if
   !> there is no hardness, and the pressure is scaled to the mean pressure. Further errors: exit_bad_input for a flat
   !> surface, for free edges, and for a grid that does not have all waves of the surface.
   subroutine bounds_from_fields(session, mean_pressure, points, offset, pressure, gap, error, bounds)
      type(deck_session), intent(in) :: session
      real(dp), intent(in) :: mean_pressure     !! > 0, below the hardness [pressure]
      integer, intent(in) :: points(2)          !! as in fields_on_grid
      !> As in fields_on_grid, at most 1 in size. Of a mirrored map, whose points are half a step from its borders, it
      !> is 0.5, also if absent.
      real(dp), intent(in), optional :: offset(2)
      real(dp), intent(in) :: pressure(points(1), points(2))   !! [pressure]
      !> [length]. With a hardness the gap may be negative where the pressure is the hardness: the bodies overlap there.
      real(dp), intent(in) :: gap(points(1), points(2))
      type(error_type), allocatable, intent(out) :: error
      !> Lower and upper bound of the complementary energy [pressure*length^3, of a profile pressure*length^2], then of
      !> the approach and of the mean gap [length]. NaN: no bound.
      real(dp), intent(out) :: bounds(6)

      !> Places that were computed in single precision are at most this far off [step].
      real(dp), parameter :: tolerance = 1e-3_dp

      character(:), allocatable :: trouble
      integer :: least(2)
      real(dp) :: first(2), pbar_over_pstar, unit
      type(bounding_grid) :: grid
      type(energy_bounds) :: answer
      type(table_type) :: table   ! that of bounds, which refuses the same surfaces

      call check_ready(session, error)
      if (.not. allocated(error)) call check_points(session, points, offset, 0.0_dp, numbers_of_bounds, first, error)
      if (allocated(error)) return
      table = table_type('bounds')
      trouble = ''
      associate (units => session%scale, surface => session%results%solver%surface, traits => session%results%traits)
         if (.not. units%p_star > 0.0_dp) then
            trouble = 'a flat surface has no bounds'
         else if (table%refusal(traits, surface) /= '') then
            trouble = table%refusal(traits, surface)
         else if (.not. (mean_pressure > 0.0_dp .and. mean_pressure/units%p_star < surface%hardness)) then
            trouble = 'the mean pressure must be above 0 and below the hardness'
         else if (.not. (all(ieee_is_finite(pressure)) .and. all(ieee_is_finite(gap)))) then
            trouble = 'pressures and gaps must be finite numbers'
         else if (.not. any(pressure > 0.0_dp)) then
            trouble = 'no pressure is above 0'
         else if (any(abs(first) > 1.0_dp)) then
            trouble = 'the first point must be at most a step from x = y = 0'
         else if (surface%mirrored .and. present(offset) .and. &
                  any(abs(first(:surface%dimension) - 0.5_dp) > tolerance)) then
            trouble = 'on a mirrored map the first point is half a step from its borders'
         else
            call grid%start(surface, points, surface%mirrored, first)
            least = surface%shape%last([1, 2])
            least = max(2*least, 1)
            if (surface%mirrored) least = surface%shape%last([1, 2]) + 1
            if (.not. grid%is_fine_enough) trouble = 'this grid lacks waves of the surface, which need at least '// &
               integer_text(least(1))//' points along x and '//integer_text(least(2))//' along y'
         end if
         if (trouble /= '') call fatal_error(error, exit_bad_input, trouble)
         if (allocated(error)) return
         pbar_over_pstar = mean_pressure/units%p_star
         ! Without a hardness only the ratios of pressures matter: dividing by the largest keeps their squares in range.
         unit = maxval(pressure)
         if (surface%has_hardness()) unit = units%p_star
         call grid%bound(surface, pressure/unit, gap/units%amplitude, pbar_over_pstar, answer)
         bounds = units%amplitude*[units%p_star*units%nominal_area*answer%energy, answer%approach, answer%mean_gap]
      end associate
   end subroutine bounds_from_fields

   !> The stresses at n points in a body. Tension is positive, and z points into the body. For many points at one depth
   !> stresses_on_plane is faster.
   subroutine stresses_at(session, solved, n, x, y, depth, nu, lateral, stress, error, stress_error)
      type(deck_session), intent(in) :: session
      type(solved_load), intent(inout) :: solved   !! a load that the session has solved
      integer, intent(in) :: n                 !! number of points, >= 1
      real(dp), intent(in) :: x(n), y(n)       !! coordinates of the points [length]
      real(dp), intent(in) :: depth(n)         !! depths of the points, >= 0 [length]
      real(dp), intent(in) :: nu               !! Poisson's ratio of the body, -1 < nu <= 1/2
      character(*), intent(in) :: lateral      !! value of the key `lateral` of &stress
      real(dp), intent(out) :: stress(6, n)    !! components xx, yy, zz, xy, xz, yz [pressure]
      type(error_type), allocatable, intent(out) :: error
      !> Estimate of the largest error of a component [pressure]; NaN if the solver does not estimate errors.
      real(dp), intent(out), optional :: stress_error(n)

      type(elastic_body) :: body
      real(dp) :: angles(2), point_error
      real(dp) :: terms(6, 2)   ! stress of the waves over p*: terms(:, 1) + nu*terms(:, 2)
      integer :: i

      call prepare_stresses(session, solved, nu, lateral, body, error)
      if (.not. allocated(error)) call check_places(session, x, y, depth, error)
      if (allocated(error)) return
      do i = 1, n
         if (allocated(solved%stresses)) then
            angles = session%scale%angles([x(i), y(i)])
            call solved%stresses%at(angles(1), angles(2), session%scale%depth_angle(depth(i)), terms, point_error)
            stress(:, i) = session%scale%p_star*body%stress(terms, solved%stresses%pbar_over_pstar)
            point_error = session%scale%p_star*point_error
         else
            stress(:, i) = body%stress(no_waves, solved%mean_pressure)
            point_error = 0.0_dp
         end if
         if (present(stress_error)) stress_error(i) = point_error
      end do
   end subroutine stresses_at

   !> The stresses as in stresses_at, at the points of a grid at one depth.
   subroutine stresses_on_plane(session, solved, points, offset, depth, nu, lateral, stress, error, stress_error)
      type(deck_session), intent(in) :: session
      type(solved_load), intent(inout) :: solved
      integer, intent(in) :: points(2)            !! as in fields_on_grid
      real(dp), intent(in), optional :: offset(2) !! as in fields_on_grid
      real(dp), intent(in) :: depth               !! depth of the plane, >= 0 [length]
      real(dp), intent(in) :: nu                  !! as in stresses_at
      character(*), intent(in) :: lateral         !! as in stresses_at
      real(dp), intent(out) :: stress(6, points(1), points(2))
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(out), optional :: stress_error(points(1), points(2))

      integer :: i
      type(elastic_body) :: body
      real(dp) :: first(2)
      real(dp), allocatable :: errors(:, :), over_p_star(:, :, :)

      call prepare_stresses(session, solved, nu, lateral, body, error)
      if (.not. allocated(error)) call check_points(session, points, offset, depth, numbers_of_stresses, first, error)
      if (allocated(error)) return
      if (allocated(solved%stresses)) then
         call solved%stresses%on_plane(points, first, session%scale%depth_angle(depth), body, over_p_star, errors)
         do i = 1, 6
            stress(i, :, :) = session%scale%p_star*over_p_star(:, :, i)
         end do
         if (present(stress_error)) stress_error = session%scale%p_star*errors
      else
         stress = spread(spread(body%stress(no_waves, solved%mean_pressure), 2, points(1)), 3, points(2))
         if (present(stress_error)) stress_error = 0.0_dp
      end if
   end subroutine stresses_on_plane

   !> Makes the fields of a solved load at their first use.
   subroutine prepare_fields(session, solved, error)
      type(deck_session), intent(in) :: session
      type(solved_load), intent(inout) :: solved
      type(error_type), allocatable, intent(out) :: error

      call check_ready(session, error, solved)
      if (allocated(error)) return
      if (.not. session%results%keeps_fields) then
         call fatal_error(error, exit_bad_input, 'there are no fields: keep_fields is not set')
      else if (.not. allocated(solved%fields)) then
         call solved%solution%fields(session%results%solver%surface, solved%fields)
      end if
   end subroutine prepare_fields

   !> Makes the stresses of a solved load at their first use, and the body. On a flat surface `solved%stresses` stays
   !> not allocated: its stresses are those of the mean pressure. Bad values get the same messages as in decks.
   subroutine prepare_stresses(session, solved, nu, lateral, body, error)
      type(deck_session), intent(in) :: session
      type(solved_load), intent(inout) :: solved
      real(dp), intent(in) :: nu             !! as in stresses_at
      character(*), intent(in) :: lateral    !! as in stresses_at
      type(elastic_body), intent(out) :: body
      type(error_type), allocatable, intent(out) :: error

      !> How many numbers are in memory for each point of the solver's grid: series, their waves, and copies of them.
      integer(int64), parameter :: numbers = 8
      type(key_list) :: keys
      type(stress_group), target :: values

      call prepare_fields(session, solved, error)
      if (.not. allocated(error)) then
         if (session%results%solver%surface%kernel%has_layer()) call fatal_error(error, exit_bad_input, &
            'stresses are computed in half-spaces, not in a layer')
      end if
      if (allocated(error)) return
      call list_stress_keys(values, keys)
      call keys%close()
      call keys%start('')
      call keys%take_value(key_index(keys%rows, 'nu'), number=nu)
      call keys%take_value(key_index(keys%rows, 'lateral'), text=lateral)
      if (values%problems%number > 0) then
         call fatal_error(error, exit_bad_input, '&stress: '//values%problems%items(1)%words)
         return
      end if
      body = elastic_body(nu, lateral_of(values))
      if (allocated(solved%stresses) .or. .not. session%scale%p_star > 0.0_dp) return
      if (has_memory_for(numbers*product(int(solved%fields%own_points, int64)))) then
         call solved%solution%stresses(session%results%solver%surface, solved%stresses)
      else
         call fatal_error(error, exit_file_trouble, 'there is not enough memory for the stresses')
      end if
   end subroutine prepare_stresses

   !> Checks a number of points. Errors: exit_bad_input if it is below 1 or above `most_points`.
   subroutine check_number(points, error)
      integer, intent(in) :: points
      type(error_type), allocatable, intent(out) :: error

      if (points < 1 .or. points > most_points) &
         call fatal_error(error, exit_bad_input, 'points must be from 1 to 8192*8192')
   end subroutine check_number

   !> Checks coordinates and depths of points. Errors: exit_bad_input if one is not finite, or a depth negative.
   subroutine check_places(session, x, y, depth, error)
      type(deck_session), intent(in) :: session
      real(dp), intent(in) :: x(:), y(:), depth(:)   !! [length]
      type(error_type), allocatable, intent(out) :: error

      call check_number(size(x), error)
      if (allocated(error)) return
      associate (period => session%scale%period)
         if (.not. all(ieee_is_finite([x/period(1), y/period(2), depth/period(1)]))) then
            call fatal_error(error, exit_bad_input, 'places, offsets and depths must be finite numbers')
         else if (any(depth < 0.0_dp)) then
            call fatal_error(error, exit_bad_input, 'depths must be 0 or more: z points into the body')
         end if
      end associate
   end subroutine check_places

   !> Checks a grid at a depth, and whether there is enough memory for it. Errors: exit_bad_input, exit_file_trouble.
   subroutine check_points(session, points, offset, depth, numbers, first, error)
      type(deck_session), intent(in) :: session
      integer, intent(in) :: points(2)
      real(dp), intent(in), optional :: offset(2)
      real(dp), intent(in) :: depth            !! [length]
      integer(int64), intent(in) :: numbers    !! how many double precision numbers each point takes
      real(dp), intent(out) :: first(2)        !! the offset in effect: 0 if absent, and 0 along y of a profile
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: size_words   ! such as '64 x 64'

      first = 0.0_dp
      if (present(offset)) first = offset
      size_words = integer_text(points(1))//' x '//integer_text(points(2))
      if (any(points < 1) .or. product(int(points, int64)) > most_points) then
         call fatal_error(error, exit_bad_input, 'a grid needs 1 or more points a side and at most '// &
                          integer_text(most_points)//' in all, got '//size_words)
      else if (session%results%solver%surface%dimension == 1 .and. points(2) /= 1) then
         call fatal_error(error, exit_bad_input, 'a grid on a profile needs 1 point along y, got '//size_words)
      else if (.not. has_memory_for(numbers*product(int(points, int64)))) then
         call fatal_error(error, exit_file_trouble, 'there is not enough memory for '//size_words//' points')
      else
         call check_places(session, first(1:1), first(2:2), [depth], error)
      end if
      if (session%results%solver%surface%dimension == 1) first(2) = 0.0_dp
   end subroutine check_points

end module wavycon_session_fields
