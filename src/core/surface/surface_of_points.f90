!> Makes surfaces through given heights at the points of a grid.
module wavycon_surface_of_points
   use wavycon_assertion, only: assert
   use wavycon_fourier_series, only: divide_series, weighted
   use wavycon_free_edges, only: form_of_radii, set_units_without_closure
   use wavycon_full_contact, only: set_closure
   use wavycon_grid_points, only: point_angle
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, pi
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: surface_of_points

contains

   !> Makes the surface through given heights on a grid. Between the points the heights are interpolated by their
   !> Fourier series. Crest, full-contact pressure and curvature are extremes over the points. If the grid is
   !> distributed over processes, the shape of the surface is distributed too; its other components are those of the
   !> whole grid.
   !>
   !> The grid is that of the whole cell, with the first point at X = Y = 0, or that of a quarter of the cell, which is
   !> continued by mirror images: equation (M6) of src/core/map/README.md.
   !>
   !> With free edges the map may lie on a ball. Then a paraboloid of the given radii about the centre of the map is
   !> subtracted from the heights.
   type(surface_type) function surface_of_points(sides, height, mirrored, points, has_free_edges, radii) result(surface)
      real(dp), intent(in) :: sides(2)                 !! sides of the map along x and y [length], > 0
      !> Heights [length], shape (M, N), N = 1 for a profile, or (M, columns of the grid's slab).
      real(dp), intent(in), contiguous :: height(:, :)
      logical, intent(in), optional :: mirrored        !! whether mirror images continue the map; .false. if absent
      integer, intent(in), optional :: points(2)       !! M, N if the grid may be distributed; shape of height if absent
      logical, intent(in), optional :: has_free_edges  !! .false. if absent; .true. implies mirrored
      real(dp), intent(in), optional :: radii(2)       !! radii of the ball [length], > 0, huge for a plane

      type(grid_transform) :: transform
      real(dp), allocatable :: values(:, :)
      real(dp) :: extremes(2)
      integer :: crest(2), grid(2)

      grid = shape(height)
      if (present(points)) grid = points
      if (grid(2) == 1) surface%dimension = 1
      if (present(mirrored)) surface%mirrored = mirrored
      if (present(has_free_edges)) surface%has_free_edges = has_free_edges
      surface%mirrored = surface%mirrored .or. surface%has_free_edges
      call assert(all(sides > 0.0_dp), 'sides > 0')
      surface%length = surface%maps_in_cell()*sides
      surface%points = surface%maps_in_cell()*grid
      call transform%start(grid, even=surface%mirrored)
      call transform%series(height, surface%shape)
      call surface%shape%set_mean(0.0_dp)
      if (present(radii)) surface%form = form_of_radii(surface, radii)
      if (surface%has_free_edges) then
         ! The map has steps if it has no height between the largest and the least. A flat map on a ball has none: the
         ! surface is the smooth ball.
         extremes = transform%slab%extremes(height)
         surface%has_steps = .not. transform%slab%any(any(height < extremes(1) .and. height > -extremes(2))) .and. &
                             (sum(extremes) > 0.0_dp .or. surface%form%is_flat())
         allocate (values, source=height)
         call surface%form%subtract_from( &
            values, point_angle([1, transform%slab%first], transform%points, transform%even), 2*pi/surface%points)
         call transform%slab%find_largest(values, surface%amplitude, crest)
      else
         allocate (values, mold=height)
         call transform%slab%find_largest(height, surface%amplitude, crest)
      end if
      surface%amplitude = surface%amplitude - transform%slab%sum_of(height)/product(real(grid, dp))
      if (surface%has_steps .and. surface%amplitude <= 0.0_dp) then
         ! A flat map is a punch with h = 0. As it has no height of its own, a length of the map is taken as the unit.
         surface%amplitude = surface%nominal_area()**(1.0_dp/surface%dimension)
         call surface%shape%set_mean(surface%amplitude)
      end if
      surface%crest = point_angle(crest, transform%points, transform%even)
      if (surface%dimension == 1) surface%crest(2) = 0.0_dp
      if (surface%amplitude <= 0.0_dp) return
      call divide_series(surface%shape, surface%amplitude)
      surface%form%c = surface%form%c/surface%amplitude
      call transform%sample(weighted(surface%shape, surface%length), values)
      extremes = transform%slab%extremes(values)
      surface%crest_curvature = extremes(1)
      if (surface%has_free_edges) then
         call set_units_without_closure(surface)
      else
         surface%ridges = surface%shape%parallel_slopes(surface%length)
         call set_closure(surface)
      end if
   end function surface_of_points

end module wavycon_surface_of_points
