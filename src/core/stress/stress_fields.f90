!> The stresses in a half-space below the pressure of one load's solution, at points, along lines and on planes.
!>
!> Positions are the angles X = 2 pi x/L_x, Y = 2 pi y/L_y of the surface's cell and the depth Z = 2 pi z/L_x, z into
!> the body. Stresses are in p*, tension positive. The arguments `nu_terms` are without the stress of the mean pressure,
!> which depends on how the body is held: `elastic_body` adds it.
module wavycon_stress_fields
   use wavycon_equivalent_points, only: equivalent_points, point_image
   use wavycon_kinds, only: dp, not_a_number, pi
   use wavycon_stress_tensor, only: elastic_body, xx, xy, xz, yy, yz, zz
   implicit none (type, external)
   private

   public :: start_point, stress_fields

   !> A place from which the search for the largest stress starts.
   type :: start_point
      real(dp) :: position(3) = 0.0_dp  !! X, Y, Z [rad]
      real(dp) :: width = 0.0_dp        !! distance over which the stress changes there, about the depth [rad]
      real(dp) :: stress(6) = 0.0_dp    !! approximation of the stress there or of its deviator [p*]
   end type start_point

   !> The stresses of one load. Extensions override `at` and `start_points` by those of a solver's solution. This type
   !> itself is that of a load without a solution: its stresses are NaN.
   type :: stress_fields
      real(dp) :: pbar_over_pstar = 0.0_dp    !! mean pressure P [p*]
      logical :: exist = .true.               !! whether the load has a solution; if not, all stresses are NaN
      integer :: dimension = 2                !! 1 if the stresses do not depend on Y, otherwise 2
      real(dp) :: side_ratio = 1.0_dp         !! L_y/L_x
      type(equivalent_points) :: symmetry = equivalent_points()   !! symmetry of the stresses, which on_plane uses
      !> How often the region of the points of `on_plane` fits into the cell along x and y: 2 for a mirrored height map,
      !> otherwise 1 (surface%maps_in_cell()).
      integer :: maps_in_cell(2) = 1
   contains
      procedure :: at, start_points, expand, near, on_line, on_plane, set_stresses, pressure_error_at
   end type stress_fields

contains

   !> The stress at one point, less that of the mean pressure.
   subroutine at(self, x, y, depth, nu_terms, error)
      class(stress_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y            !! X, Y [rad]
      real(dp), intent(in) :: depth           !! Z >= 0 [rad]
      !> xx, yy, zz, xy, xz, yz [p*]: the stress for Poisson's ratio nu is nu_terms(:, 1) + nu*nu_terms(:, 2).
      real(dp), intent(out) :: nu_terms(6, 2)
      !> Estimate of the largest error of the components for any 0 <= nu <= 1/2 [p*]; NaN if there is no estimate.
      real(dp), intent(out), optional :: error

      associate (unused => self, unused_too => [x, y, depth]); end associate
      nu_terms = not_a_number()
      if (present(error)) error = not_a_number()
   end subroutine at

   !> The part of the error at a depth that follows from the error of the pressure and is the same at all places [p*].
   !> NaN if it is not known; here 0.
   pure real(dp) function pressure_error_at(self, depth) result(error)
      class(stress_fields), intent(in) :: self
      real(dp), intent(in) :: depth   !! Z >= 0 [rad]

      associate (unused => self, unused_too => depth); end associate
      error = 0.0_dp
   end function pressure_error_at

   !> Proposes the places from which the search for the largest stress starts. At least one of them should be close to
   !> the largest stress of the body.
   subroutine start_points(self, body, places)
      class(stress_fields), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      type(start_point), allocatable, intent(out) :: places(:)   !! with their stresses

      associate (unused => self, unused_too => body); end associate
      allocate (places(0))
   end subroutine start_points

   !> Prepares the evaluation of stresses by `near` around a place. Here there is nothing to prepare, as `near` is `at`.
   subroutine expand(self, place, width, reach, noise)
      class(stress_fields), intent(inout) :: self
      real(dp), intent(in) :: place(3)     !! X, Y, Z [rad]
      real(dp), intent(in) :: width        !! distance over which the stress changes [rad]
      real(dp), intent(in) :: reach        !! largest distance, along each axis, at which `near` will be called [rad]
      !> Bound of the error of `near` within that distance, over the stress; 0 if `near` is as accurate as `at`.
      real(dp), intent(out) :: noise

      associate (unused => self, unused_too => [place, width, reach]); end associate
      noise = 0.0_dp
   end subroutine expand

   !> The stress at a place near that of the last call of `expand`. The error may grow with the distance of the two.
   subroutine near(self, place, nu_terms)
      class(stress_fields), intent(inout) :: self
      real(dp), intent(in) :: place(3)          !! X, Y, Z [rad]
      real(dp), intent(out) :: nu_terms(6, 2)   !! as of `at`

      call self%at(place(1), place(2), place(3), nu_terms)
   end subroutine near

   !> Sets the component `stress` of start places: the stress of a body there, with that of the mean pressure.
   subroutine set_stresses(self, body, places)
      class(stress_fields), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      type(start_point), intent(inout) :: places(:)

      real(dp) :: nu_terms(6, 2)
      integer :: i

      do i = 1, size(places)
         associate (here => places(i)%position)
            call self%at(here(1), here(2), here(3), nu_terms)
         end associate
         places(i)%stress = body%stress(nu_terms, self%pbar_over_pstar)
      end do
   end subroutine set_stresses

   !> The stresses along a line at one depth, at the points X = X_0 + d_x t, Y = Y_0 + d_y t.
   subroutine on_line(self, start, direction, t, depth, nu_terms, error)
      class(stress_fields), intent(inout) :: self
      real(dp), intent(in) :: start(2)                       !! X_0, Y_0 [rad]
      integer, intent(in) :: direction(2)                    !! d_x, d_y
      real(dp), intent(in) :: t(:)                           !! the n values of t [rad]
      real(dp), intent(in) :: depth                          !! Z >= 0 [rad]
      real(dp), intent(out) :: nu_terms(:, :, :), error(:)   !! as of `at` at each point, shapes (6, 2, n), (n)

      integer :: i

      do i = 1, size(t)
         call self%at(start(1) + direction(1)*t(i), start(2) + direction(2)*t(i), depth, nu_terms(:, :, i), error(i))
      end do
   end subroutine on_line

   !> The stresses on a plane at X = 2 pi (k + offset_x)/N_x, k = 0 .. N_x - 1, and at the Y that follow in the same
   !> way. On a mirrored height map the points are those of the map, X = pi (k + offset_x)/N_x. Of points that are
   !> equivalent by symmetry only the first one is evaluated.
   subroutine on_plane(self, points, offset, depth, body, stress, error)
      class(stress_fields), intent(inout) :: self
      integer, intent(in) :: points(2)        !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)       !! of the first point from X = Y = 0, in steps; 0 along y in 1-D
      real(dp), intent(in) :: depth           !! Z >= 0 [rad]
      type(elastic_body), intent(in) :: body
      !> xx, yy, zz, xy, xz, yz with those of the mean pressure [p*], shape (N_x, N_y, 6).
      real(dp), allocatable, intent(out) :: stress(:, :, :)
      real(dp), allocatable, intent(out) :: error(:, :)   !! as of `at` [p*], shape (N_x, N_y)

      type(point_image) :: first
      real(dp) :: here(6), nu_terms(6, 2)
      integer :: k, l

      allocate (stress(points(1), points(2), 6), error(points(1), points(2)))
      call self%symmetry%start(points, offset)
      do l = 1, points(2)
         do k = 1, points(1)
            first = self%symmetry%first_of([k, l] - 1)
            associate (i => first%point(1) + 1, j => first%point(2) + 1)
               if (i == k .and. j == l) then
                  associate (angles => 2*pi*([k, l] - 1 + offset)/(self%maps_in_cell*points))
                     call self%at(angles(1), angles(2), depth, nu_terms, error(k, l))
                  end associate
                  here = body%stress(nu_terms, self%pbar_over_pstar)
               else
                  here = stress(i, j, :)
                  error(k, l) = error(i, j)
                  if (first%exchanged) here = here([yy, xx, zz, xy, yz, xz])
                  if (first%mirrored(1)) here([xy, xz]) = -here([xy, xz])
                  if (first%mirrored(2)) here([xy, yz]) = -here([xy, yz])
               end if
               stress(k, l, :) = here
            end associate
         end do
      end do
   end subroutine on_plane

end module wavycon_stress_fields
