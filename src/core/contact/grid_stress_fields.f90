!> The stresses below a pressure that was solved on a grid: those of the series through the pressures at the points.
!>
!> Between the points the series rings about edges of contact. At the surface the vertical stress is the pressure, which
!> is known without the ringing there. The difference of the two is an error of the series that (S5) may not see: of
!> waves that come from several edges the sums (S5) may cancel.
module wavycon_grid_stress_fields
   use wavycon_grid_fields, only: grid_fields
   use wavycon_kinds, only: dp, ieee_is_nan, pi
   use wavycon_series_stress_fields, only: series_stress_fields
   use wavycon_stress_tensor, only: elastic_body, zz
   implicit none (type, external)
   private

   public :: grid_stress_fields

   type, extends(series_stress_fields) :: grid_stress_fields
      type(grid_fields) :: fields     !! pressures between the points of the grid
   contains
      procedure :: on_line, on_plane
      procedure, private :: add_ringing
   end type grid_stress_fields

   !> Part of the ringing at the surface that is left one step deep. Deeper it is not added.
   real(dp), parameter :: least_left = 0.18_dp

contains

   !> The stresses along a line, with the ringing in their errors.
   subroutine on_line(self, start, direction, t, depth, nu_terms, error)
      class(grid_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: start(2)
      integer, intent(in) :: direction(2)
      real(dp), intent(in) :: t(:), depth
      real(dp), intent(out) :: nu_terms(:, :, :), error(:)

      integer :: i
      real(dp) :: at_surface(6, 2, size(t)), unused(size(t))

      call self%series_stress_fields%on_line(start, direction, t, depth, nu_terms, error)
      if (self%ringing_left(depth) < least_left) return
      at_surface = nu_terms
      if (depth > 0.0_dp) call self%series_stress_fields%on_line(start, direction, t, 0.0_dp, at_surface, unused)
      call self%add_ringing(reshape([(start + direction*t(i), i=1, size(t))], [2, size(t)]), depth, &
                            at_surface(zz, 1, :) - self%pbar_over_pstar, error)
   end subroutine on_line

   !> The stresses on a plane, with the ringing in their errors.
   subroutine on_plane(self, points, offset, depth, body, stress, error)
      class(grid_stress_fields), intent(inout) :: self
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: offset(2), depth
      type(elastic_body), intent(in) :: body
      real(dp), allocatable, intent(out) :: stress(:, :, :), error(:, :)

      integer :: k, l
      real(dp) :: places(2, points(1)), steps(2)
      real(dp), allocatable :: at_surface(:, :, :), unused(:, :)

      call self%series_stress_fields%on_plane(points, offset, depth, body, stress, error)
      if (self%ringing_left(depth) < least_left) return
      at_surface = stress
      if (depth > 0.0_dp) call self%series_stress_fields%on_plane(points, offset, 0.0_dp, body, at_surface, unused)
      steps = 2*pi/(self%maps_in_cell*points)
      places(1, :) = ([(k, k=1, points(1))] - 1 + offset(1))*steps(1)
      do l = 1, points(2)
         places(2, :) = (l - 1 + offset(2))*steps(2)
         call self%add_ringing(places, depth, at_surface(:, l, zz), error(:, l))
      end do
   end subroutine on_plane

   !> Adds what is left of the error of the vertical stress at places on the surface to that of the stresses, (S14).
   subroutine add_ringing(self, places, depth, vertical, error)
      class(grid_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: places(:, :)   !! X, Y [rad], shape (2, number of places)
      real(dp), intent(in) :: depth          !! Z
      real(dp), intent(in) :: vertical(:)    !! zz at the surface, with that of the mean pressure [p*]
      real(dp), intent(inout) :: error(:)    !! [p*]; NaN stays

      integer :: i
      real(dp) :: of_pressure
      real(dp), dimension(size(error)) :: no_shape, pressure, unused, unused_gap

      ! The shape would enter the displacement alone.
      no_shape = 0.0_dp
      call self%fields%at_points(places, no_shape, pressure, unused, unused_gap)
      of_pressure = self%pressure_error_at(depth)
      do i = 1, size(error)
         if (ieee_is_nan(error(i))) cycle
         ! Beyond a map with free edges the fields are those of its mirror images.
         if (self%fields%surface%has_free_edges .and. &
             any(abs(places(:self%dimension, i) - 0.5_dp*pi) > 0.5_dp*pi)) pressure(i) = 0.0_dp
         error(i) = of_pressure + hypot(error(i) - of_pressure, self%ringing_left(depth)*(vertical(i) + pressure(i)))
      end do
   end subroutine add_ringing

end module wavycon_grid_stress_fields
