!> Hertz's contact of a ball with free edges (src/core/contact/hertz_ball.f90). The measures, the fields at the surface
!> and the edge of contact are closed forms, and so are the stresses below a round ball. Those of unequal radii are
!> computed on grids, on a rectangle in proportion to the contact.
!>
!> Numbers (C..) are the equations of README.md in this directory.
module wavycon_ball_source
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon_contact_contours, only: contact_contour
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_field_source, only: field_source
   use wavycon_free_edges, only: ball_radii, surface_of_ball
   use wavycon_free_kernel, only: integral_to_corner
   use wavycon_gauss_rules, only: disc_rule, start_disc_rule
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_gsl, only: gsl_sf_ellint_RD, gsl_sf_ellint_RF
   use wavycon_hertz_ball, only: hertz_ball, hertz_contact
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: approach, area_slope, contact_area, elastic_energy, gap_curvature, gap_slope, &
      mean_gap, peak_pressure, quantities
   use wavycon_round_spot_stress, only: round_spot_stress
   use wavycon_solution_record, only: by_closed_form, closed_form
   use wavycon_stress_fields, only: start_point, stress_fields
   use wavycon_stress_tensor, only: elastic_body
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: ball_source, solve_ball

   type, extends(field_source) :: ball_source
      !> The contact, lengths in [length] and pressures in E*. With adhesion its approach includes the effect of the
      !> tension.
      type(hertz_ball) :: contact
      real(dp) :: accuracy = 0.0_dp     !! of unequal radii: accuracy of the grids for the stresses, as in grid_options
   contains
      procedure :: fields, contact_contours, stresses, derivatives
   end type ball_source

   type, extends(contact_fields) :: ball_fields
      type(surface_type) :: surface
      type(hertz_ball) :: contact
   contains
      procedure :: at
   end type ball_fields

   !> Stresses below a ball of unequal radii, computed on a smaller rectangle with the crest at the same angles. Angles
   !> X, Y, Z [rad] are 2 pi times a length over a side of the cell.
   type, extends(stress_fields) :: ball_stress_fields
      class(stress_fields), allocatable :: own   !! the stresses on the smaller rectangle, in its units
      real(dp) :: angle_ratio(3) = 1.0_dp        !! angles X, Y, Z on the smaller rectangle over those on the surface
      real(dp) :: unit = 1.0_dp                  !! p* of the smaller rectangle over that of the surface
   contains
      procedure :: at => stress_at
      procedure :: start_points
   end type ball_stress_fields

   !> Stresses below a round ball, with adhesion or without. Their mean pressure is 0, as nothing acts far away.
   type, extends(stress_fields) :: round_ball_stress_fields
      real(dp) :: to_radius(2) = 0.0_dp             !! x and y of X = Y = 1 over the radius of contact
      real(dp) :: hertz = 0.0_dp, punch = 0.0_dp    !! as of round_spot_stress [p*]; punch is 0 without adhesion
   contains
      procedure :: at => stress_of_round_ball
      procedure :: start_points => start_below_round_ball
   end type round_ball_stress_fields

contains

   !> Solves a load by Hertz's equations. They hold if the ellipse of contact lies within the rectangle and the peak
   !> pressure is below the hardness; otherwise `solved` is false and the solution is not changed.
   subroutine solve_ball(surface, pbar_over_pstar, accuracy, solution, solved)
      type(surface_type), intent(in) :: surface      !! a ball without roughness
      real(dp), intent(in) :: pbar_over_pstar        !! P > 0
      real(dp), intent(in) :: accuracy               !! accuracy of the grids for the stresses, as in grid_options
      type(contact_solution), intent(inout) :: solution
      logical, intent(out) :: solved                 !! whether Hertz's equations hold

      type(ball_source), allocatable :: source
      real(dp) :: over_delta   ! the approach [Delta]

      allocate (source)
      source%accuracy = accuracy
      associate (contact => source%contact, unit => surface%full_contact_pressure(1.0_dp))
         contact = hertz_contact(ball_radii(surface), 1.0_dp, force=pbar_over_pstar*unit*surface%nominal_area())
         solved = all(2*contact%half_axis < surface%sides()) .and. contact%peak_pressure < surface%hardness*unit
         if (.not. solved) return
         over_delta = contact%approach/surface%amplitude
         solution%pbar_over_pstar = pbar_over_pstar
         solution%status = closed_form
         solution%solver = by_closed_form
         solution%value(mean_gap) = 1.0_dp - over_delta + mean_displacement(surface, contact)
         solution%value(approach) = over_delta
         solution%value(contact_area) = contact%contact_area()/surface%nominal_area()
         solution%value(peak_pressure) = contact%peak_pressure/unit
         ! The energy is the integral of the force over the approach. The force is proportional to approach^(3/2).
         solution%value(elastic_energy) = 0.4_dp*pbar_over_pstar*over_delta
         solution%error(elastic_energy) = 0.0_dp
      end associate
      call move_alloc(source, solution%source)
   end subroutine solve_ball

   !> The displacement's mean over the rectangle [Delta]. By reciprocity the integral of the displacement over the
   !> rectangle equals the integral of the pressure times the displacement under a unit pressure on the whole
   !> rectangle. `integral_to_corner` gives the latter displacement. The rule integrates over the ellipse of contact.
   real(dp) function mean_displacement(surface, contact) result(mean)
      type(surface_type), intent(in) :: surface
      type(hertz_ball), intent(in) :: contact

      !> Points of the rule along the radius and along a quarter of the angle. Against 200 x 800 points, on a square,
      !> the error is below 2e-14 if the axis of the contact is at most 0.99 of the side, and 6e-11 if axis and side are
      !> equal.
      integer, parameter :: radii = 32, angles = 128
      type(disc_rule) :: rule
      real(dp) :: x, y
      integer :: k

      call start_disc_rule(rule, 0.5_dp, 2, radii, angles)
      associate (half => surface%sides()/2)
         mean = 0.0_dp
         do k = 1, size(rule%weight)
            x = contact%half_axis(1)*real(rule%point(k))
            y = contact%half_axis(2)*aimag(rule%point(k))
            mean = mean + rule%weight(k)*sum(integral_to_corner(half(1) + [x, x, -x, -x], half(2) + [y, -y, y, -y]))
         end do
      end associate
      mean = mean*contact%peak_pressure*product(contact%half_axis)/(pi*surface%nominal_area()*surface%amplitude)
   end function mean_displacement

   !> Makes the fields (`at`) of the ball. They need the surface, whose cell is that of the mirrored map.
   subroutine fields(self, surface, answer)
      class(ball_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      allocate (answer, source=ball_fields(maps_in_cell=surface%maps_in_cell(), surface=surface, contact=self%contact))
   end subroutine fields

   !> Hertz's pressure in contact, and the displacement (C31) outside. With adhesion the tension F is that of a flat
   !> round punch of the contact's radius a: F/(2 pi a^2) (1 - r^2/a^2)^(-1/2) is subtracted from the pressure, and
   !> F/(pi E* a) asin(a/r) from the displacement outside.
   subroutine at(self, x, y, pressure, displacement, gap)
      class(ball_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement, gap

      integer(c_int), parameter :: all_digits = 0
      real(dp) :: b, c, inside, lambda, position(2), squares(2), u, undeformed   ! position: from the crest [length]

      associate (surface => self%surface, contact => self%contact)
         ! A point beyond the map is replaced by its mirror image on the map, because the heights are mirrored too. The
         ! undeformed gap is not taken from the surface's shape, 1 - h/Delta: next to the crest h would lose its digits.
         position = (0.5_dp*pi - abs(pi - modulo([x, y], 2*pi)))*surface%length/(2*pi)
         squares = contact%half_axis**2
         undeformed = 0.5_dp*sum(position**2/ball_radii(surface))
         inside = 1.0_dp - sum(position**2/squares)
         pressure = 0.0_dp
         if (inside > 0.0_dp) pressure = (contact%peak_pressure*sqrt(inside) - contact%tension &
            /(2*pi*product(contact%half_axis)*sqrt(inside)))/surface%full_contact_pressure(1.0_dp)
         gap = 0.0_dp
         if (inside < 0.0_dp) then
            ! The positive root of lambda^2 + b lambda + c = 0.
            b = sum(squares) - sum(position**2)
            c = product(squares)*inside
            lambda = 0.5_dp*(sqrt(b**2 - 4*c) + abs(b))
            if (b > 0.0_dp) lambda = -c/lambda
            u = contact%peak_pressure*product(contact%half_axis)*( &
                gsl_sf_ellint_RF(squares(1) + lambda, squares(2) + lambda, lambda, all_digits) &
                - position(1)**2/3*gsl_sf_ellint_RD(squares(2) + lambda, lambda, squares(1) + lambda, all_digits) &
                - position(2)**2/3*gsl_sf_ellint_RD(squares(1) + lambda, lambda, squares(2) + lambda, all_digits)) &
                - contact%tension*asin(min(contact%half_axis(1)/norm2(position), 1.0_dp))/(pi*contact%half_axis(1))
            gap = max(undeformed + u - contact%approach, 0.0_dp)/surface%amplitude
         end if
         displacement = gap + (contact%approach - undeformed)/surface%amplitude
      end associate
   end subroutine at

   !> The edge of contact: the ellipse and its mirror images in the four quarters of the mirrored cell. They count as
   !> one spot.
   subroutine contact_contours(self, surface, curves)
      class(ball_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(contact_contour), allocatable, intent(out) :: curves(:)

      integer, parameter :: points = 256
      real(dp), parameter :: centres(2, 4) = 0.5_dp*pi*reshape([1, 1, 3, 1, 1, 3, 3, 3], [2, 4])
      integer :: k
      real(dp) :: axes(2), t(0:points)

      axes = 2*pi*self%contact%half_axis/surface%length
      t = [(2*pi*modulo(k, points)/points, k=0, points)]
      allocate (curves(4))
      do k = 1, size(curves)
         curves(k) = contact_contour(phi=centres(1, k) + axes(1)*cos(t), theta=centres(2, k) + axes(2)*sin(t), &
                                     turns=1, spot=1, pool=1, load=1.0_dp, area=pi*product(axes), &
                                     length=self%contact%perimeter())
      end do
   end subroutine contact_contours

   !> The stresses below the ball: closed forms (I23) of src/beyond if it is round, as it is with adhesion. Those of
   !> unequal radii are computed on grids on a rectangle whose sides are four half axes. So the step of the grid is the
   !> same part of the contact at every load.
   subroutine stresses(self, surface, answer)
      class(ball_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(ball_stress_fields), allocatable :: stress
      type(contact_solution) :: solution
      type(grid_contact) :: solver
      type(surface_type) :: own

      if (maxval(self%contact%half_axis) <= minval(self%contact%half_axis)) then
         associate (contact => self%contact, p_star => surface%full_contact_pressure(1.0_dp))
            allocate (answer, source=round_ball_stress_fields( &
               maps_in_cell=surface%maps_in_cell(), side_ratio=surface%length(2)/surface%length(1), &
               to_radius=surface%length/(2*pi*contact%half_axis), hertz=contact%peak_pressure/p_star, &
               punch=contact%tension/(2*contact%contact_area()*p_star)))
         end associate
         return
      end if
      own = surface_of_ball(4*self%contact%half_axis, ball_radii(surface))
      allocate (stress)
      stress%unit = own%full_contact_pressure(1.0_dp)/surface%full_contact_pressure(1.0_dp)
      call solver%start(own, grid_options(accuracy=self%accuracy), keep_fields=.true.)
      call solver%solve(self%record%pbar_over_pstar*surface%nominal_area()/(own%nominal_area()*stress%unit), solution)
      call solution%stresses(own, stress%own)
      stress%angle_ratio = [surface%length, surface%length(1)]/[own%length, own%length(1)]
      stress%exist = stress%own%exist
      stress%pbar_over_pstar = stress%own%pbar_over_pstar*stress%unit
      stress%side_ratio = surface%length(2)/surface%length(1)
      stress%maps_in_cell = stress%own%maps_in_cell
      call move_alloc(stress, answer)
   end subroutine stresses

   !> The stresses at a point, from those at the corresponding point below the smaller rectangle.
   subroutine stress_at(self, x, y, depth, nu_terms, error)
      class(ball_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y, depth
      real(dp), intent(out) :: nu_terms(6, 2)
      real(dp), intent(out), optional :: error

      real(dp) :: angles(3)   ! X, Y, Z on the smaller rectangle; the crest has X = Y = pi/2 on both

      angles = self%angle_ratio*[x - 0.5_dp*pi, y - 0.5_dp*pi, depth] + [0.5_dp*pi, 0.5_dp*pi, 0.0_dp]
      call self%own%at(angles(1), angles(2), angles(3), nu_terms, error)
      nu_terms = nu_terms*self%unit
      if (present(error)) error = error*self%unit
   end subroutine stress_at

   !> Start points of the search for the largest stress, converted from those on the smaller rectangle.
   subroutine start_points(self, body, places)
      class(ball_stress_fields), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      type(start_point), allocatable, intent(out) :: places(:)

      integer :: i

      call self%own%start_points(body, places)
      do i = 1, size(places)
         associate (here => places(i)%position)
            here = (here - [0.5_dp*pi, 0.5_dp*pi, 0.0_dp])/self%angle_ratio + [0.5_dp*pi, 0.5_dp*pi, 0.0_dp]
         end associate
         places(i)%stress = places(i)%stress*self%unit
      end do
      places%width = places%width/maxval(self%angle_ratio)
   end subroutine start_points

   !> The stresses at a point below a round ball.
   subroutine stress_of_round_ball(self, x, y, depth, nu_terms, error)
      class(round_ball_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y, depth
      real(dp), intent(out) :: nu_terms(6, 2)
      real(dp), intent(out), optional :: error

      !> Error of a place over the side of the cell, and of the stress over the pressures.
      real(dp), parameter :: rounding = 1e-14_dp
      real(dp) :: place(3)   ! from the middle of the contact, over its radius

      place = self%to_radius([1, 2, 1])*([x, y, depth] - [0.5_dp*pi, 0.5_dp*pi, 0.0_dp])
      call round_spot_stress(cmplx(place(1), place(2), dp), place(3), self%hertz, self%punch, nu_terms)
      if (.not. present(error)) return
      associate (from_edge => max(hypot(norm2(place(:2)) - 1.0_dp, place(3)), epsilon(error)))
         error = rounding*(self%hertz + self%punch + maxval(self%to_radius)*self%hertz/sqrt(from_edge))
         if (self%punch > 0.0_dp) error = error + rounding*maxval(self%to_radius)*maxval(abs(nu_terms))/from_edge
      end associate
   end subroutine stress_of_round_ball

   !> Places at which searches for the largest stress start: below the middle of the contact, and at the edge, where the
   !> largest stress is if Poisson's ratio is far below 0.
   subroutine start_below_round_ball(self, body, places)
      class(round_ball_stress_fields), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      type(start_point), allocatable, intent(out) :: places(:)

      !> Distances from the middle, and depths, over the radius of contact.
      real(dp), parameter :: across(*) = [0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], below(*) = [0.25_dp, 0.5_dp, 0.75_dp, 0.0_dp]
      integer :: i

      associate (radius => 1.0_dp/self%to_radius(1))
         places = [(start_point([0.5_dp*pi + across(i)*radius, 0.5_dp*pi, below(i)*radius], 0.25_dp*radius), &
                    i=1, size(across))]
      end associate
      call self%set_stresses(body, places)
   end subroutine start_below_round_ball

   !> Derivatives with respect to the load. Approach and area are both proportional to the force to the power 2/3.
   subroutine derivatives(self, surface, answer)
      class(ball_source), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(quantities), intent(out) :: answer

      associate (unused => surface, record => self%record, p => self%record%pbar_over_pstar)
         answer%value(gap_slope) = -record%value(approach)*2/(3*p)
         answer%value(area_slope) = record%value(contact_area)*2/(3*p)
         answer%value(gap_curvature) = record%value(approach)*2/(9*p**2)
         answer%error([gap_slope, area_slope, gap_curvature]) = 0.0_dp
      end associate
   end subroutine derivatives

end module wavycon_ball_source
