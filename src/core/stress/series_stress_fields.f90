!> The stresses below a pressure that is a Fourier series. The series is that of full contact, that of the paper's
!> method, or the one through the pressures at the points of a grid.
!>
!> Equations (S1) to (S5), (S9) and, for free edges, (S11) of README.md in this directory.
module wavycon_series_stress_fields
   use wavycon_fourier_series, only: fourier_series, turn
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, ieee_is_nan, pi
   use wavycon_load_tree, only: load_tree, plant_load_tree
   use wavycon_pressure_wave_sums, only: deepest, pressure_wave_sums
   use wavycon_series_samples, only: sample_series
   use wavycon_stress_fields, only: start_point, stress_fields
   use wavycon_stress_kernel, only: nu_terms_of
   use wavycon_stress_tensor, only: elastic_body, no_waves, von_mises, zz
   use wavycon_stress_tuning, only: coarsest, least_depth, least_pressure, noise_part, octave_factor, plane_points, &
      plane_ratio, pressure_part, shallow_planes, shift_of_smooth, steps_in_shift, taylor_order, told_of_edges, &
      waves_in_depth, window_depth, window_points
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: series_stress_fields, start_series_stress_fields

   !> Points across the middle part of a window, where its stresses are compared with others.
   integer, parameter :: middle = window_points/2

   !> The eight sums (S4) and the three sums of the error (S5).
   integer, parameter :: number_of_sums = 11

   !> The depth of one step times the wave number from which the last octave begins.
   real(dp), parameter :: step_in_octave = 0.5_dp*pi

   !> Pressures below this part of the largest one are rounding.
   real(dp), parameter :: rounding = 1e-13_dp

   !> The Taylor series (S9) of the sums about a point.
   type :: taylor_series
      complex(dp), allocatable :: moment(:, :, :)   !! M_abc at the centre, as of `find_moments` [p*]
      real(dp) :: centre(3) = 0.0_dp                !! X, Y, Z of the point [rad]
   end type taylor_series

   type, extends(stress_fields) :: series_stress_fields
      private
      type(pressure_wave_sums) :: waves              !! the waves of the pressure that (S4) adds up
      real(dp) :: pressure_error = 0.0_dp            !! error estimate of the pressure [p*]; NaN if there is none
      real(dp) :: wave_error = huge(1.0_dp)          !! E_e of (S15) [p*^2]; huge if it is unknown
      real(dp) :: edge_density = 0.0_dp              !! length of the edge of contact over the area, (S15a) [1/rad]
      real(dp) :: edge_pressure = 0.0_dp             !! mean pressure of the points of a grid next to the edge [p*]
      real(dp) :: image_error = 0.0_dp               !! with free edges the part of `pressure_error` that images leave
      type(taylor_series), allocatable :: known(:)   !! series made by `expand` so far
      integer :: used = 0                            !! number of the one that `near` takes
      real(dp) :: first(3) = 0.0_dp                  !! X, Y, 0: the surface's position of the series' origin [rad]
      !> With free edges only: the smooth part of the stresses, (S11), which `waves` lack.
      type(load_tree), allocatable :: load
      !> With free edges only: the waves of the whole pressure, with its mean.
      type(pressure_wave_sums), allocatable :: whole
   contains
      procedure :: remove_images, at, expand, near, on_line, on_plane, pressure_error_at, ringing_left, start_points
   end type series_stress_fields

contains

   !> Prepares the stresses below a pressure that is a Fourier series. Waves that the error of the pressure hides at a
   !> depth are left out there: see `pressure_part`.
   subroutine start_series_stress_fields(stress, surface, pressure, pbar_over_pstar, pressure_error, is_sampled, &
                                         approach_error, crossings, edge_pressure)
      type(series_stress_fields), intent(out) :: stress
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(in) :: pressure    !! p/p* on the cell; its mean is not used
      real(dp), intent(in) :: pbar_over_pstar         !! mean pressure P [p*]
      real(dp), intent(in) :: pressure_error          !! estimate of the pressure's error [p*]; NaN if there is none
      logical, intent(in) :: is_sampled               !! whether the series is the one through values at a grid's points
      real(dp), intent(in), optional :: approach_error   !! estimate of the approach's error [Delta]; absent if unknown
      !> Pairs of neighbouring points of a grid between which contact ends, over the points; absent if unknown.
      real(dp), intent(in), optional :: crossings
      real(dp), intent(in), optional :: edge_pressure    !! with crossings: mean pressure of these points [p*]

      stress%pbar_over_pstar = pbar_over_pstar
      stress%dimension = surface%dimension
      stress%maps_in_cell = surface%maps_in_cell()
      stress%side_ratio = surface%length(2)/surface%length(1)
      if (surface%dimension == 1) stress%side_ratio = 1.0_dp
      call stress%waves%start(pressure, stress%side_ratio, is_sampled)
      call stress%waves%pressure%set_mean(0.0_dp)
      stress%pressure_error = pressure_error
      if (present(approach_error)) &
         stress%wave_error = 2*pbar_over_pstar*approach_error*surface%stiffness/surface%length(1)
      ! A line in any direction crosses the lines of a grid of the step h along both axes 4/(pi h) times its length.
      if (present(crossings)) then
         stress%edge_density = crossings*merge(1.0_dp, pi/4, surface%dimension == 1)*2*stress%waves%sampled_from/pi
         stress%edge_pressure = edge_pressure
      end if
      call leave_out_hidden(stress, 0.0_dp)
   end subroutine start_series_stress_fields

   !> Sets which waves are left out at a depth: those that the error of the pressure hides there.
   subroutine leave_out_hidden(stress, depth)
      class(series_stress_fields), intent(inout) :: stress
      real(dp), intent(in) :: depth   !! Z

      associate (error => stress%pressure_error_at(depth))
         if (.not. ieee_is_nan(error)) &
            stress%waves%faintest = log(pressure_part/min(max(error, pressure_part*exp(-deepest)), coarsest))
      end associate
   end subroutine leave_out_hidden

   !> Removes the stresses of the images from those of a surface with free edges, (S11).
   !>
   !> The pressure's series is that of a cell of twice the sides of the map, so that the series repeats the pressure. On
   !> exit `waves` have only the first part of (S11), and `load` computes the second one from point forces.
   subroutine remove_images(self, first)
      class(series_stress_fields), intent(inout) :: self   !! just started, with the mean pressure of the cell
      real(dp), intent(in) :: first(2)                     !! X, Y of the surface at the origin of the series [rad]

      real(dp), allocatable :: pressure(:, :)
      real(dp) :: ratios(2), shift
      integer :: points(2)

      self%first(:2) = first
      ratios = [1.0_dp, self%side_ratio]
      self%whole = self%waves
      call self%whole%pressure%set_mean(self%pbar_over_pstar)
      shift = pi*minval(ratios)*shift_of_smooth
      points = 2*self%waves%pressure%last([1, 2])
      points = points*ceiling(2*pi*ratios*steps_in_shift/(points*shift))
      call sample_series(self%whole%pressure, points, [0.0_dp, 0.0_dp], pressure, [1, 1])
      ! Set the pressures outside of contact to zero where they are rounding: blocks without force cost nothing. Where
      ! the points are finer than those of the series, the series oscillates all over the cell, and no value is zero.
      where (abs(pressure) <= rounding*maxval(pressure)) pressure = 0.0_dp
      pressure = cshift(cshift(pressure, -points(1)/4, 1), -points(2)/4, 2)
      allocate (self%load)
      associate (step => 2*pi*ratios/points)
         call plant_load_tree(self%load, pressure, first*ratios - (points/4)*step, step, shift)
      end associate
      call self%waves%pressure%multiply(self%load%left_out(self%waves%pressure%frequencies(ratios)))
      self%image_error = 120*self%pbar_over_pstar*shift_of_smooth**4
      self%pressure_error = self%pressure_error + self%image_error
      self%pbar_over_pstar = 0.0_dp
   end subroutine remove_images

   !> The stress at one point: that on a line of a single point.
   subroutine at(self, x, y, depth, nu_terms, error)
      class(series_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y, depth
      real(dp), intent(out) :: nu_terms(6, 2)
      real(dp), intent(out), optional :: error

      real(dp) :: errors(1), nu_terms_on_line(6, 2, 1)

      call self%on_line([x, y], [0, 0], [0.0_dp], depth, nu_terms_on_line, errors)
      nu_terms = nu_terms_on_line(:, :, 1)
      if (present(error)) error = errors(1)
   end subroutine at

   !> Chooses the Taylor series (S9) that `near` takes around a place. The known series with the closest centre is
   !> chosen if its error is below `noise_part` of the change of the stress over the distance `reach`. Otherwise a
   !> series about the place is made.
   subroutine expand(self, place, width, reach, noise)
      class(series_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: place(3), width, reach
      real(dp), intent(out) :: noise

      real(dp), allocatable :: distances(:)
      integer :: i

      if (.not. allocated(self%known)) allocate (self%known(0))
      distances = [(norm2(place - self%known(i)%centre), i=1, size(self%known))]
      self%used = minloc(distances, dim=1)
      noise = huge(noise)
      if (self%used > 0) noise = noise_at(distances(self%used))
      if (noise <= noise_part*(reach/width)**2) return
      call leave_out_hidden(self, place(3))
      self%known = [self%known, taylor_series(centre=place)]
      self%used = size(self%known)
      call self%waves%find_moments(place - self%first, taylor_order, self%known(self%used)%moment)
      noise = noise_at(0.0_dp)

   contains

      !> The error of a series over the stress, at most `reach` from the place: (r/w)^9/8, see (S9).
      pure real(dp) function noise_at(distance)
         real(dp), intent(in) :: distance   !! of the place from the centre of a series [rad]

         noise_at = ((distance + reach)/min(width, max(place(3), least_width(self))))**(taylor_order + 1)/8
      end function noise_at

   end subroutine expand

   !> The least distance over which the stress at the surface changes [rad]: half of the shortest wavelength.
   pure real(dp) function least_width(stress)
      class(series_stress_fields), intent(in) :: stress

      least_width = pi/max(plane_points/2.0_dp, maxval(stress%waves%pressure%last([1, 2])/[1.0_dp, stress%side_ratio]))
   end function least_width

   !> The stress near a place, by the Taylor series that `expand` chose.
   subroutine near(self, place, nu_terms)
      class(series_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: place(3)
      real(dp), intent(out) :: nu_terms(6, 2)

      associate (known => self%known(self%used), to_series => [1.0_dp, self%side_ratio, 1.0_dp])
         nu_terms = nu_terms_of(sums_near(known%moment, (place - known%centre)*to_series, place(3)) &
                                + smooth_sums(self, place))
      end associate
   end subroutine near

   !> The sums (S4) at a place, by the Taylor series (S9) about a point close to the place.
   pure function sums_near(moment, move, depth) result(sums)
      complex(dp), intent(in) :: moment(0:, 0:, -2:)   !! M_abc at the point [p*]
      real(dp), intent(in) :: move(3)                  !! the place less the point: xi, eta', zeta of (S9) [rad]
      real(dp), intent(in) :: depth                    !! Z of the place [rad]
      real(dp) :: sums(8)

      !> The powers a, b, c of k, l' and q in the moment that each sum is made from.
      integer, parameter :: power(3, 8) = reshape( &
         [0, 0, 0, 0, 0, 1, 2, 0, -2, 1, 1, -2, 2, 0, -1, 1, 1, -1, 1, 0, 0, 0, 1, 0], [3, 8])
      complex(dp) :: term(0:ubound(moment, 3) - 1, 3), total
      integer :: b, c, j, last, order

      order = ubound(term, 1)
      term(0, :) = 1.0_dp
      do j = 1, order
         term(j, :) = term(j - 1, :)*[cmplx(0.0_dp, move(1), dp), cmplx(0.0_dp, move(2), dp), &
                                      cmplx(-move(3), 0.0_dp, dp)]/j
      end do
      do j = 1, 8
         total = 0.0_dp
         do c = 0, order
            do b = 0, order - c
               last = order - c - b
               associate (from => power(:, j) + [0, b, c])
                  total = total + term(b, 2)*term(c, 3)* &
                          sum(term(:last, 1)*moment(from(1):from(1) + last, from(2), from(3)))
               end associate
            end do
         end do
         sums(j) = total%re
         if (j > 6) sums(j) = -total%im
      end do
      sums = sums*[1.0_dp, -depth, -2.0_dp, -2.0_dp, -2*depth, -2*depth, depth, depth]
      ! n_y^2 - n_x^2 = 1 - 2 n_x^2.
      sums([3, 5]) = sums([3, 5]) + [sums(1), -sums(2)]
   end function sums_near

   !> The smooth part of the sums (S4), which the waves of a surface with free edges lack; zero for other surfaces.
   pure function smooth_sums(stress, place) result(sums)
      class(series_stress_fields), intent(in) :: stress
      real(dp), intent(in) :: place(3)   !! X, Y, Z [rad]
      real(dp) :: sums(8)

      sums = 0.0_dp
      if (allocated(stress%load)) sums = stress%load%sums(place*[1.0_dp, stress%side_ratio, 1.0_dp])
   end function smooth_sums

   !> Whether the waves at a place are those of an image: beyond the cell about a map with free edges.
   pure logical function is_image(stress, place)
      class(series_stress_fields), intent(in) :: stress
      real(dp), intent(in) :: place(2)   !! X, Y [rad]

      is_image = allocated(stress%load) .and. any(abs(place - 0.5_dp*pi) > pi)
   end function is_image

   !> The stresses along a line. Waves with the same wave number m = d_x k + d_y l along the line are added up first, so
   !> that each point takes a sum over m only.
   subroutine on_line(self, start, direction, t, depth, nu_terms, error)
      class(series_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: start(2)
      integer, intent(in) :: direction(2)
      real(dp), intent(in) :: t(:), depth
      real(dp), intent(out) :: nu_terms(:, :, :), error(:)

      complex(dp), allocatable :: along(:, :), turn_x(:), waves(:)
      complex(dp) :: turned, wave
      real(dp), allocatable :: q(:)
      real(dp) :: even(6), n_x, n_y, q_y, q_z, sums(number_of_sums)
      integer :: i, k, l, last(2), m

      call leave_out_hidden(self, depth)
      last = self%waves%last_waves(depth)
      m = dot_product(abs(direction), last)
      allocate (along(number_of_sums, -m:m), source=(0.0_dp, 0.0_dp))
      allocate (q(0:last(1)), turn_x(0:last(1)), waves(0:last(1)))
      turn_x(:) = turn([(k*(start(1) - self%first(1)), k=0, last(1))])
      do l = -last(2), last(2)
         q_y = l/self%side_ratio
         q(:) = sqrt([(real(k, dp)**2 + q_y**2, k=0, last(1))])
         waves(:) = exp(-q*depth)*self%waves%pressure%row(l, last(1))*turn_x*turn(l*(start(2) - self%first(2)))
         do k = merge(1, 0, l == 0), count(q*depth <= self%waves%faintest) - 1
            wave = waves(k)
            turned = cmplx(-wave%im, wave%re, dp)
            n_x = k/q(k)
            n_y = q_y/q(k)
            q_z = q(k)*depth
            even(:4) = [1.0_dp, -q_z, (n_y - n_x)*(n_y + n_x), -2*n_x*n_y]
            even(5:) = q_z*even(3:4)
            m = direction(1)*k + direction(2)*l
            along(:6, m) = along(:6, m) + even*wave
            along(7, m) = along(7, m) + k*depth*turned
            along(8, m) = along(8, m) + q_y*depth*turned
            if (q(k) > self%waves%sampled_from) &
               along(9:, m) = along(9:, m) + (1.0_dp + q_z)*[wave, n_x*turned, n_y*turned]
         end do
      end do
      do i = 1, size(t)
         sums = 0.0_dp
         if (.not. is_image(self, start + direction*t(i))) then
            do m = lbound(along, 2), ubound(along, 2)
               sums = sums + real(along(:, m)*turn(m*t(i)))
            end do
         end if
         nu_terms(:, :, i) = nu_terms_of(sums(:8) + smooth_sums(self, [start + direction*t(i), depth]))
         error(i) = error_of(self, depth, nu_terms(zz, 1, i) - self%pbar_over_pstar, sums(9:))
      end do
   end subroutine on_line

   !> The error estimate (S5) of a stress component. The vertical stress below a contact without adhesion is never a
   !> tension, so the error of a grid's series is at least the computed vertical tension. The series of full contact,
   !> which may have adhesion, is exact.
   pure real(dp) function error_of(stress, depth, vertical, octave)
      class(series_stress_fields), intent(in) :: stress
      real(dp), intent(in) :: depth       !! Z
      real(dp), intent(in) :: vertical    !! zz, with that of the mean pressure [p*]
      real(dp), intent(in) :: octave(:)   !! S, S_x, S_y [p*]; size 0 if no wave of the last octave reaches the depth

      error_of = stress%pressure_error_at(depth) + octave_factor*norm2(octave)
      if (.not. stress%waves%sampled_from < huge(1.0_dp)) return
      if (.not. ieee_is_nan(error_of)) error_of = max(error_of, vertical)
   end function error_of

   !> The error of the stresses at a depth that is the same at all places [p*]; NaN if there is no estimate. At the
   !> surface it is the error of the pressure, below a depth of one step the least of (S15), (S15a) and the sum of
   !> this error and the pressure beside the edge.
   pure real(dp) function pressure_error_at(self, depth) result(error)
      class(series_stress_fields), intent(in) :: self
      real(dp), intent(in) :: depth   !! Z

      !> Z_0 over the longer side, and the two integrals of (S15) with their factors; the factors of (S15a).
      real(dp), parameter :: last_power = 2.5_dp, of_lines = 2.25_dp, of_planes = 11.0_dp, of_one = 0.541_dp, &
         of_all = 1.125_dp
      real(dp) :: from, longer, mean_square, near_edges, sum_of_waves

      error = self%pressure_error
      if (ieee_is_nan(error) .or. .not. self%wave_error < huge(1.0_dp)) return
      if (depth*self%waves%sampled_from <= step_in_octave) return
      longer = max(1.0_dp, self%side_ratio)
      from = depth
      ! Without images there is no longest wave.
      if (.not. allocated(self%load)) from = min(depth, last_power*longer)
      sum_of_waves = of_lines*longer*(1.0_dp/from)**2
      if (self%dimension == 2) sum_of_waves = sum_of_waves + of_planes*self%side_ratio*(1.0_dp/from)**3
      error = min(self%pressure_error + self%edge_pressure, self%image_error &
                  + sqrt(self%wave_error*sum_of_waves)*depth/from*exp((from - depth)/longer))
      mean_square = of_one/depth
      if (self%dimension == 2) mean_square = of_all/(2*self%waves%sampled_from*depth)/depth   ! without overflow
      near_edges = min(1.0_dp, 2*depth*self%edge_density)
      if (near_edges > 0.0_dp) error = min(error, self%image_error &
                                           + told_of_edges*sqrt(self%wave_error*mean_square/near_edges))
   end function pressure_error_at

   !> What is left at a depth, at most, of the ringing of a grid's series at the surface, over this (S14).
   pure real(dp) function ringing_left(self, depth)
      class(series_stress_fields), intent(in) :: self
      real(dp), intent(in) :: depth   !! Z

      ringing_left = 1.0_dp
      if (.not. depth > 0.0_dp) return
      ! Without a grid no wave is missing.
      ringing_left = 0.0_dp
      if (.not. self%waves%sampled_from < huge(1.0_dp)) return
      associate (highest => 2*self%waves%sampled_from)
         ringing_left = (1.0_dp + highest*depth)*exp(-highest*depth)
      end associate
   end function ringing_left

   !> The stresses on a plane, by one transform for each component and three for the error (S5). Waves that have the
   !> same values at the points as a slower wave (aliases) are added to the slower wave. So the values at the points are
   !> exact for any number of points.
   subroutine on_plane(self, points, offset, depth, body, stress, error)
      class(series_stress_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2), depth
      type(elastic_body), intent(in) :: body
      real(dp), allocatable, intent(out) :: stress(:, :, :), error(:, :)

      complex(dp), allocatable :: waves(:, :, :)
      real(dp), allocatable :: fields(:, :, :), smooth(:, :, :)
      real(dp) :: mean(6), step(2)
      type(grid_transform) :: plane
      integer :: i, k, l, number

      call leave_out_hidden(self, depth)
      number = merge(9, 6, self%waves%octave_reaches(depth))
      mean = body%stress(no_waves, self%pbar_over_pstar)
      associate (of_cell => self%maps_in_cell*points)
         step = 2*pi/of_cell
         allocate (fields(of_cell(1), of_cell(2), number), waves(of_cell(1)/2 + 1, of_cell(2), number))
         call plane%start(of_cell, even=.false., whole=.true.)
         call self%waves%find_spectra(of_cell, offset - self%first(:2)/step, depth, body%nu, waves)
      end associate
      do i = 1, number
         call plane%sample_waves(waves(:, :, i), fields(:, :, i))
      end do
      deallocate (waves)
      allocate (stress(points(1), points(2), 6), error(points(1), points(2)))
      associate (to_series => [1.0_dp, self%side_ratio])
         if (allocated(self%load)) call self%load%sums_on_plane(offset*step*to_series, step*to_series, points, depth, &
                                                            smooth)
      end associate
      do l = 1, points(2)
         do k = 1, points(1)
            if (is_image(self, ([k, l] - 1 + offset)*step)) fields(k, l, :) = 0.0_dp
            stress(k, l, :) = fields(k, l, :6) + mean
            if (allocated(self%load)) stress(k, l, :) = stress(k, l, :) &
               + matmul(nu_terms_of(smooth(:, k, l)), [1.0_dp, body%nu])
            error(k, l) = error_of(self, depth, stress(k, l, zz), fields(k, l, 7:))
         end do
      end do
   end subroutine on_plane

   !> Proposes start places of the search: on each of a sequence of horizontal planes the points of the largest von
   !> Mises stress and of the largest shear stress.
   !>
   !> The first plane is the surface. The next ones, `shallow_planes` of them, lie above the depth of half of the
   !> shortest wavelength, and each is `plane_ratio` times as deep as the plane before. Deeper planes need fewer points.
   !> Planes no deeper than this half wavelength that lie above the largest stresses below all peaks of a grid's
   !> pressure are left out, (S16).
   !> If a few windows (squares of 64 x 64 points, README.md) contain all large pressures, the planes close to the
   !> surface are computed within these windows only, which takes less time at light loads. The surface itself is
   !> computed in the whole cell: at an edge of contact the shear stress may be the largest one where the pressure is
   !> low.
   subroutine start_points(self, body, places)
      class(series_stress_fields), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      type(start_point), allocatable, intent(out) :: places(:)

      integer, parameter :: window(2) = window_points
      real(dp), allocatable :: highest(:, :), pressure(:, :)
      !> The largest von Mises stress so far [p*]; the part of the cell's sides to be searched, from X = Y = 0; half of
      !> the shortest wavelength [rad], above whose depth there are `shallow_planes`.
      real(dp) :: largest, region, step
      type(fourier_series) :: series
      type(grid_transform) :: plane
      type(pressure_wave_sums) :: all_waves, waves
      !> `top`: number of the first plane below the surface. `last`: number of the deepest plane. `shallow`: the planes
      !> 0 to this one are those of windows; -1 without windows.
      integer :: block(2), i, last, points(2), shallow, top

      call leave_out_hidden(self, 0.0_dp)
      step = least_width(self)
      last = 1 + shallow_planes + ceiling(log(2*pi/step)/log(plane_ratio))
      allocate (places(0))
      largest = 0.0_dp
      all_waves = self%waves
      if (allocated(self%whole)) all_waves = self%whole
      points = points_of(all_waves, 0.0_dp, self%dimension)
      ! A quarter of the cell is enough for an even field; with free edges the load is in that quarter.
      region = 1.0_dp
      if (self%waves%pressure%is_even() .or. allocated(self%whole)) region = 0.5_dp
      call sample_series(all_waves%pressure, points, [0.0_dp, 0.0_dp], pressure, [1, 1])
      pressure = pressure + self%pbar_over_pstar
      top = 1
      if (all_waves%sampled_from < huge(1.0_dp)) then
         associate (width => least_half_width(pressure, 2*pi*[1.0_dp, self%side_ratio]/points))
            do while (depth_of(top) <= step .and. depth_of(top + 1) <= least_depth*width)
               top = top + 1
            end do
         end associate
      end if
      shallow = -1
      if (all(points >= 4*window)) then
         highest = highest_in_windows(pressure, min(floor(region*points) + 1, points))
         if (4.0_dp*count(highest >= least_pressure*maxval(highest))*product(window) <= product(real(points, dp))) &
            shallow = 1 + shallow_planes + floor(log(window_depth*window_points)/log(plane_ratio))
      end if
      if (shallow < top) shallow = -1
      call scan(all_waves, shallow + 1, last, [0, 0], points, 0.0_dp, region)
      if (shallow < 0) return
      call scan(all_waves, 0, 0, [0, 0], points, 0.0_dp, region)
      call plane%start(window, even=.false., whole=.true.)
      do
         block = maxloc(highest)
         ! The von Mises stress below a window is assumed to be less than the window's largest pressure (README.md,
         ! "Windows"). So the windows that are left have no larger stress than the one found.
         if (highest(block(1), block(2)) <= largest) exit
         highest(block(1), block(2)) = -1.0_dp
         associate (corner => (block - 1)*middle - middle/2, from => [(i, i=0, window_points - 1)], n => points)
            ! The window's mean pressure less the cell's acts as one long wave, (S13).
            call plane%series(pressure(modulo(corner(1) + from, n(1)) + 1, modulo(corner(2) + from, n(2)) + 1) &
                              - self%pbar_over_pstar, series)
            call waves%start(series, self%side_ratio*n(1)/n(2), is_sampled=.true.)
            call scan(waves, 0, shallow, corner, window, 0.25_dp, 0.75_dp)
         end associate
      end do

   contains

      !> The depth of a plane [rad].
      pure real(dp) function depth_of(plane)
         integer, intent(in) :: plane   !! its number; 0 is the surface

         depth_of = 0.0_dp
         if (plane > 0) depth_of = step*plane_ratio**(plane - 1 - shallow_planes)
      end function depth_of

      !> Appends to `places` the points of the largest stresses on some of the planes below the cell or below a window.
      subroutine scan(waves, first, last, corner, extent, from, to)
         type(pressure_wave_sums), intent(in) :: waves   !! of the cell's or the window's pressure
         integer, intent(in) :: first, last              !! numbers of the planes; 0 is the surface
         integer, intent(in) :: corner(2)                !! first point of the cell or window, from 0
         integer, intent(in) :: extent(2)                !! its number of points along x and y
         real(dp), intent(in) :: from, to                !! points from `from` to `to` of its sides are compared, 0 to 1

         real(dp) :: depth, stress(6, 2)
         integer :: i, k, number(2), point(2, 2)

         ! Sides of the window over those of the cell. An angle of the cell over this is the window's angle.
         associate (side => extent/real(points, dp))
            do i = first, last
               if (i > 0 .and. i < top) cycle
               depth = depth_of(i)
               number = points_of(waves, depth/side(1), self%dimension)
               ! The memory is not checked: it was for the series itself, and a plane takes less.
               call waves%scan_plane(self%pbar_over_pstar, number, nint(from*number), &
                                     min(floor(to*number), number - 1), depth/side(1), body, point, stress)
               do k = 1, 2
                  places = [places, start_point([2*pi*(corner/real(points, dp) + side*point(:, k)/number), depth] &
                                                + self%first, max(depth, step), stress(:, k))]
               end do
               largest = max(largest, von_mises(stress(:, 1)))
            end do
         end associate
      end subroutine scan

   end subroutine start_points

   !> The least half width (p/-p'')^(1/2) of the high peaks of a grid's pressure, from second differences, (S16) [rad].
   pure real(dp) function least_half_width(pressure, steps) result(width)
      real(dp), intent(in) :: pressure(:, :)   !! at the points of the cell, which repeats
      real(dp), intent(in) :: steps(2)         !! distances of the points along x and y [rad]

      integer :: i, j
      real(dp) :: around(2, 2), lowest, sharpness

      associate (m => size(pressure, 1), n => size(pressure, 2))
         lowest = least_pressure*maxval(pressure)
         sharpness = 0.0_dp
         do j = 1, n
            do i = 1, m
               associate (p => pressure(i, j))
                  if (p < lowest) cycle
                  around(:, 1) = pressure([modulo(i - 2, m) + 1, modulo(i, m) + 1], j)
                  around(:, 2) = pressure(i, [modulo(j - 2, n) + 1, modulo(j, n) + 1])
                  if (any(around > p)) cycle
                  sharpness = max(sharpness, maxval((2*p - sum(around, dim=1))/steps**2)/p)
               end associate
            end do
         end do
      end associate
      width = 1.0_dp/sqrt(max(sharpness, tiny(sharpness)))
   end function least_half_width

   !> The largest pressure in the middle part of each window, whose middle parts cover a region without overlap.
   pure function highest_in_windows(pressure, region) result(highest)
      real(dp), intent(in) :: pressure(:, :)   !! at the points of the cell
      integer, intent(in) :: region(2)         !! number of points of the region along x and y, from the first on
      real(dp) :: highest((region(1) - 1)/middle + 1, (region(2) - 1)/middle + 1)

      integer :: i, j

      highest = reshape([((maxval(pressure(i:min(i + middle, region(1)), j:min(j + middle, region(2)))), &
                           i=1, region(1), middle), j=1, region(2), middle)], shape(highest))
   end function highest_in_windows

   !> The number of points of a plane along x and y that resolve the waves that reach a depth.
   pure function points_of(waves, depth, dimension) result(number)
      type(pressure_wave_sums), intent(in) :: waves
      real(dp), intent(in) :: depth      !! Z, in the angles of the cell or window of the waves [rad]
      integer, intent(in) :: dimension   !! 1 or 2: that of the surface
      integer :: number(2)

      real(dp) :: most(2)

      most = 2.0_dp*waves%pressure%last([1, 2])
      if (depth > 0.0_dp) most = min(most, waves_in_depth/depth*[1.0_dp, waves%side_ratio])
      number = fast_length(max(plane_points, ceiling(most)))
      if (dimension == 1) number(2) = 1
   end function points_of

   !> The least multiple of 8 that is not below a number and has no prime factor above 5: transforms of such lengths are
   !> fast.
   elemental integer function fast_length(least)
      integer, intent(in) :: least

      integer :: factor, rest

      fast_length = 8*((least + 7)/8)
      do
         rest = fast_length
         do factor = 2, 5
            do while (mod(rest, factor) == 0)
               rest = rest/factor
            end do
         end do
         if (rest == 1) exit
         fast_length = fast_length + 8
      end do
   end function fast_length

end module wavycon_series_stress_fields
