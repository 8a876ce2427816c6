!> A surface: the gap h before deformation, its values at points, the sides of its cell, its roughness and, if the
!> surface is periodic, the pressure p* that closes the gap.
module wavycon_surface
   use wavycon_assertion, only: assert
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_points, only: point_angle
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, pi
   use wavycon_paraboloid, only: paraboloid
   use wavycon_roughness, only: roughness_of, roughness_type
   use wavycon_series_samples, only: sample_series
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: surface_type

   !> h/Delta = 1 - shape(X, Y),  X = 2 pi x/L_x,  Y = 2 pi y/L_y. The shape has the mean 0 and the peak 1: the surfaces
   !> first touch at its peaks. Delta is the mean gap before load, which is the amplitude of the paper's waves.
   type :: surface_type
      integer :: dimension = 2                  !! 1: a profile, constant along y; 2: a surface
      real(dp) :: length(2) = 1.0_dp            !! L_x, L_y, sides of the periodic cell [length]
      real(dp) :: amplitude = 1.0_dp            !! Delta [length], >= 0
      !> Fourier series of the shape. If the points of a height map are distributed over processes, each process has the
      !> coefficients of some wave numbers in X: see is_distributed.
      type(fourier_series) :: shape
      integer :: points(2) = 0                  !! points of a height map's grid on the whole cell; 0 for a sum of waves
      !> Whether the cell consists of a height map and its mirror images. The map is then the quarter 0 <= X, Y <= pi.
      logical :: mirrored = .false.
      !> Whether the map ends at its borders: nothing repeats the map, and h has no images. The points and the
      !> interpolation between them are those of a mirrored map. There is no full contact, and p* is only a unit, with
      !> `stiffness` = the square root of the map's area, in 1-D its length.
      logical :: has_free_edges = .false.
      !> With free edges, whether the map has at most two different heights, as that of a punch. The height is then
      !> constant in the cell of each point. A Fourier series of such heights would oscillate beside the steps.
      logical :: has_steps = .false.
      type(paraboloid) :: form                  !! with free edges: the paraboloid that is part of h/Delta
      real(dp) :: crest(2) = 0.0_dp             !! X, Y of a peak of the shape [rad]
      type(wave_stiffness) :: kernel            !! stiffness of the bodies for each wave
      !> Ratio of the pressure [p*] to the displacement [Delta] in a wave on a half-space, times wavelength [length].
      real(dp) :: stiffness = 1.0_dp
      real(dp) :: full_contact_peak = 1.0_dp    !! largest p - pbar in full contact [p*]; the least is -1
      !> The largest sum of the two principal curvatures over 4 pi^2 Delta [1/length^2]; of a map at its points.
      real(dp) :: crest_curvature = 0.0_dp
      !> Parallel ridges: sizes of the slopes of the shape along X and Y, `parallel_slopes` of its series; 0 if crests
      !> of waves are not nearly parallel, and with free edges.
      real(dp) :: ridges(2) = 0.0_dp
      real(dp) :: hardness = huge(1.0_dp)       !! H, upper bound of the pressure [p*]; huge if the bodies stay elastic
   contains
      procedure :: maps_in_cell, sides, nominal_area, is_height_map, is_distributed, has_hardness
      procedure :: waves_on_step, full_contact_pressure, shape_at, sample_shape, sample_gap, roughness
   end type surface_type

contains

   !> How often the cell contains, along x and along y, the region that decks and tables refer to: 2 for a mirrored map,
   !> otherwise 1.
   pure function maps_in_cell(self)
      class(surface_type), intent(in) :: self
      integer :: maps_in_cell(2)

      maps_in_cell = 1
      if (self%mirrored) maps_in_cell = 2
      if (self%dimension == 1) maps_in_cell(2) = 1
   end function maps_in_cell

   !> The sides along x and y of the region that decks and tables refer to [length].
   pure function sides(self)
      class(surface_type), intent(in) :: self
      real(dp) :: sides(2)

      sides = self%length/self%maps_in_cell()
   end function sides

   !> The nominal area of decks and tables [length^2]; of a profile the area over the width along y, its length
   !> [length].
   pure real(dp) function nominal_area(self)
      class(surface_type), intent(in) :: self

      real(dp) :: side(2)

      side = self%sides()
      nominal_area = product(side(:self%dimension))
   end function nominal_area

   !> Whether the surface was given by heights on a grid.
   pure logical function is_height_map(self)
      class(surface_type), intent(in) :: self

      is_height_map = all(self%points > 0)
   end function is_height_map

   !> Whether this process has only some coefficients of the shape, those of its own wave numbers in X: see
   !> wavycon_grid_transform. Then only `sample_gap` can evaluate the shape. `gather` of fourier_series makes the shape
   !> whole. All other components are those of the whole surface.
   pure logical function is_distributed(self)
      class(surface_type), intent(in) :: self

      is_distributed = self%shape%rows%is_distributed
   end function is_distributed

   !> Whether a hardness bounds the pressure.
   elemental logical function has_hardness(self)
      class(surface_type), intent(in) :: self

      has_hardness = self%hardness < huge(self%hardness)
   end function has_hardness

   !> How much a step of a grid along x and along y has of the waves of parallel ridges: (C15c) of
   !> src/core/contact/README.md. 0 for other surfaces; 1 and 0 for profiles: only the ratio is used.
   pure function waves_on_step(self, points) result(waves)
      class(surface_type), intent(in) :: self
      integer, intent(in) :: points(2)   !! points of the grid
      real(dp) :: waves(2)

      waves = [1, 0]
      if (self%dimension == 2) waves = self%ridges/points
   end function waves_on_step

   !> p* [pressure], the mean pressure that just closes the gap everywhere: pi E* Delta/lambda for the 1-D wave, eq.
   !> (7), and sqrt2 times this for the 2-D wave, eq. (22). For any surface p* is the largest value of pbar - p in full
   !> contact.
   elemental real(dp) function full_contact_pressure(self, e_star)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: e_star   !! plane-strain modulus E* [pressure]

      full_contact_pressure = pi*e_star*self%amplitude/self%stiffness
   end function full_contact_pressure

   !> The shape at a point: 1 - h/Delta, whose mean is zero.
   elemental real(dp) function shape_at(self, x, y)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y [rad]

      real(dp) :: point(2)

      call assert(.not. self%is_distributed(), 'the surface is whole')
      point = [x, y]
      if (self%has_steps) point = (floor(point*self%points/(2*pi)) + 0.5_dp)*2*pi/self%points
      shape_at = self%shape%at(point(1), point(2)) - self%form%gap(x, y)
   end function shape_at

   !> The shape 1 - h/Delta at points of the region that tables refer to, at those of `sample_series`.
   subroutine sample_shape(self, points, offset, values)
      class(surface_type), intent(in) :: self
      integer, intent(in) :: points(2)                     !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)                    !! of the first point from X = Y = 0, in steps
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (N_x, N_y)

      call sample_series(self%shape, points, offset, values, self%maps_in_cell())
      if (self%has_steps) call sample_blocks(self, offset, values)
      call self%form%subtract_from(values, 2*pi*offset/(self%maps_in_cell()*points), 2*pi/(self%maps_in_cell()*points))
   end subroutine sample_shape

   !> h/Delta at the points of a grid. Waves of the surface beyond the grid's highest wave number are left out. The
   !> digits do not depend on how the grid and the surface are distributed over processes.
   subroutine sample_gap(self, slab, h)
      class(surface_type), intent(in) :: self
      type(grid_slab), intent(in) :: slab                !! the grid's own columns; of a quarter if the surface is even
      real(dp), intent(out), contiguous :: h(:, :)       !! shape (M, slab%columns())

      type(grid_transform) :: transform

      call transform%start(slab%points, self%shape%is_even())
      call transform%sample(self%shape, h)
      if (self%has_steps) call sample_blocks(self, [0.5_dp, 0.5_dp], h)
      call self%form%subtract_from(h, point_angle([1, slab%first], transform%points, transform%even), &
                                   2*pi/(self%maps_in_cell()*slab%points))
      h = 1.0_dp - h
   end subroutine sample_gap

   !> The shape of a map of two heights, without the paraboloid: at each point that of the cell of the map's grid in
   !> which the point lies.
   subroutine sample_blocks(surface, offset, values)
      type(surface_type), intent(in) :: surface   !! has_steps
      real(dp), intent(in) :: offset(2)           !! of the first point from the map's corner, in steps of the points
      real(dp), intent(out) :: values(:, :)       !! at points with equal steps over the map

      real(dp), allocatable :: blocks(:, :)
      integer :: i, grid(2)
      type(grid_transform) :: transform

      grid = surface%points/surface%maps_in_cell()
      allocate (blocks(grid(1), grid(2)))
      call transform%start(grid, even=.true., whole=.true.)
      call transform%sample(surface%shape, blocks)
      associate (n => shape(values))
         values = blocks([(modulo(floor((i + offset(1))*grid(1)/n(1)), grid(1)) + 1, i=0, n(1) - 1)], &
                         [(modulo(floor((i + offset(2))*grid(2)/n(2)), grid(2)) + 1, i=0, n(2) - 1)])
      end associate
   end subroutine sample_blocks

   !> Root mean squares of height, slope and curvature of the surface.
   type(roughness_type) function roughness(self)
      class(surface_type), intent(in) :: self

      roughness = roughness_of(self%shape, self%amplitude, self%length, self%points)
   end function roughness

end module wavycon_surface
