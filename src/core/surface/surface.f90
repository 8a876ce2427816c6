!> A surface: the gap h before deformation, its values at points, the sides of its cell, its roughness, and of a
!> periodic one the pressure that closes it.
module wavycon_surface
   use wavycon_assertion, only: assert
   use wavycon_constants, only: pi
   use wavycon_fourier_series, only: fourier_series, weighted
   use wavycon_grid_points, only: point_angle
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_paraboloid, only: paraboloid
   use wavycon_roughness, only: roughness_of, roughness_type
   use wavycon_series_peak, only: find_peak
   use wavycon_series_samples, only: sample_series
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: surface_type

   !> h/Delta = 1 - shape(X, Y),  X = 2 pi x/L_x,  Y = 2 pi y/L_y. The shape has mean 0 and peak 1: the surfaces first
   !> touch at its peaks. Delta is the mean gap before load, which is the amplitude of the paper's waves.
   type :: surface_type
      integer :: dimension = 2
      real(dp) :: length(2) = 1.0_dp            !! L_x, L_y, sides of the periodic cell [length]
      real(dp) :: amplitude = 1.0_dp            !! Delta [length], >= 0
      !> If the points of a height map are distributed it has the own waves, see is_distributed.
      type(fourier_series) :: shape
      integer :: points(2) = 0                  !! of the grid of a height map on the cell; zeros for a sum of waves
      !> Whether the cell consists of a height map and its mirror images. The map is then the quarter 0 <= X, Y <= pi.
      logical :: mirrored = .false.
      !> Whether the map alone exists: nothing repeats it, and h has no images. Its points are those of a mirrored map,
      !> which also interpolates its heights. p* is only a unit then, that of `stiffness` = the square root of its area,
      !> in 1-D its length: there is no full contact.
      logical :: has_free_edges = .false.
      !> With free edges, whether the map has two heights at most, as that of a punch: it then consists of blocks, the
      !> cells of its points. The series of such heights would swing beside their steps.
      logical :: has_steps = .false.
      type(paraboloid) :: form                  !! with free edges: the paraboloid in h/Delta
      real(dp) :: crest(2) = 0.0_dp             !! X, Y of a peak of the shape [rad]
      type(wave_stiffness) :: kernel            !! of the bodies under it
      !> Pressure [p*] over displacement [Delta] of a wave of the half-space, times wavelength [length].
      real(dp) :: stiffness = 1.0_dp
      real(dp) :: full_contact_peak = 1.0_dp    !! largest p - pbar in full contact [p*]; the least is -1
      real(dp) :: hardness = huge(1.0_dp)       !! H, the largest pressure that it bears [p*]; huge: it stays elastic
   contains
      procedure :: parts
      procedure :: sides
      procedure :: nominal_area
      procedure :: is_height_map
      procedure :: is_distributed
      procedure :: has_hardness
      procedure :: crest_curvature
      procedure :: full_contact_pressure
      procedure :: shape_at
      procedure :: sample_shape
      procedure :: sample_gap
      procedure :: roughness
   end type surface_type

contains

   !> How often the cell contains, along x and y, the part that decks and tables refer to: 2 for a mirrored map,
   !> otherwise 1.
   pure function parts(self)
      class(surface_type), intent(in) :: self
      integer :: parts(2)

      parts = merge(2, 1, self%mirrored)
      if (self%dimension == 1) parts(2) = 1
   end function parts

   !> The sides of that part along x and y [length].
   pure function sides(self)
      class(surface_type), intent(in) :: self
      real(dp) :: sides(2)

      sides = self%length/self%parts()
   end function sides

   !> The area that decks and tables call nominal, that of a profile per depth [area].
   pure real(dp) function nominal_area(self)
      class(surface_type), intent(in) :: self

      real(dp) :: side(2)

      side = self%sides()
      nominal_area = product(side(:self%dimension))
   end function nominal_area

   !> Whether the surface was given on a grid.
   pure logical function is_height_map(self)
      class(surface_type), intent(in) :: self

      is_height_map = all(self%points > 0)
   end function is_height_map

   !> Whether the shape has the coefficients of own wave numbers in X only, see wavycon_grid_transform. Then only
   !> `sample_gap` can evaluate it; `gather` gathers the shape. All other components are those of the
   !> whole surface.
   pure logical function is_distributed(self)
      class(surface_type), intent(in) :: self

      is_distributed = self%shape%is_distributed()
   end function is_distributed

   !> Whether the pressure has an upper bound.
   elemental logical function has_hardness(self)
      class(surface_type), intent(in) :: self

      has_hardness = self%hardness < huge(self%hardness)
   end function has_hardness

   !> The largest sum of the two curvatures over 4 pi^2 Delta [1/length^2]; of a map its largest at the points.
   real(dp) function crest_curvature(self) result(curvature)
      class(surface_type), intent(in) :: self

      type(grid_transform) :: transform
      real(dp), allocatable :: values(:, :)
      real(dp) :: extremes(2), unused(2)

      if (self%is_height_map()) then
         call transform%start(self%points/self%parts(), even=self%mirrored)
         allocate (values(transform%points(1), transform%slab%columns()))
         call transform%sample(weighted(self%shape, self%length), values)
         extremes = transform%slab%extremes(values)
      else
         call find_peak(weighted(self%shape, self%length), extremes(1), unused)
      end if
      curvature = extremes(1)
      if (self%has_free_edges) curvature = curvature + 2*sum(self%form%c/self%length**2)
   end function crest_curvature

   !> p* [pressure], the mean pressure that just closes the gap everywhere: pi E* Delta/lambda for the 1-D wave (eq. 7),
   !> sqrt2 times that for the 2-D wave (eq. 22); for any surface the largest tension, pbar - p, in full contact.
   elemental real(dp) function full_contact_pressure(self, e_star)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: e_star   !! plane-strain modulus E* [pressure]

      full_contact_pressure = pi*e_star*self%amplitude/self%stiffness
   end function full_contact_pressure

   !> 1 - h/Delta, of mean zero.
   elemental real(dp) function shape_at(self, x, y)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y [rad]

      real(dp) :: point(2)

      call assert(.not. self%is_distributed(), 'the surface is whole')
      point = [x, y]
      if (self%has_steps) point = (floor(point*self%points/(2*pi)) + 0.5_dp)*2*pi/self%points
      shape_at = self%shape%at(point(1), point(2)) - self%form%gap(x, y)
   end function shape_at

   !> 1 - h/Delta at points of the part that tables refer to, as of `sample_series`.
   subroutine sample_shape(self, points, offset, values)
      class(surface_type), intent(in) :: self
      integer, intent(in) :: points(2)                     !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)                    !! of the first point, in steps
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (N_x, N_y)

      call sample_series(self%shape, points, offset, values, self%parts())
      if (self%has_steps) call sample_blocks(self, offset, values)
      call self%form%subtract_from(values, 2*pi*offset/(self%parts()*points), 2*pi/(self%parts()*points))
   end subroutine sample_shape

   !> h/Delta at the points of a grid. Waves of the surface beyond the grid's highest wave number are left out. The
   !> digits do not depend on how the grid and the surface are distributed.
   subroutine sample_gap(self, slab, h)
      class(surface_type), intent(in) :: self
      type(grid_slab), intent(in) :: slab                !! of the grid, of a quarter of the cell if the surface is even
      real(dp), intent(out), contiguous :: h(:, :)       !! shape (M, slab%columns())

      type(grid_transform) :: transform

      call transform%start(slab%points, self%shape%is_even())
      call transform%sample(self%shape, h)
      if (self%has_steps) call sample_blocks(self, [0.5_dp, 0.5_dp], h)
      call self%form%subtract_from(h, point_angle([1, slab%first], transform%points, transform%even), &
                                   2*pi/(self%parts()*slab%points))
      h = 1.0_dp - h
   end subroutine sample_gap

   !> The shape of a map of two heights without the paraboloid: at each point that of the map's nearest one.
   subroutine sample_blocks(surface, offset, values)
      type(surface_type), intent(in) :: surface   !! with steps
      real(dp), intent(in) :: offset(2)           !! of the first point, in steps
      real(dp), intent(out) :: values(:, :)       !! at equal steps over the map

      real(dp), allocatable :: blocks(:, :)
      integer :: i, grid(2)
      type(grid_transform) :: transform

      grid = surface%points/surface%parts()
      allocate (blocks(grid(1), grid(2)))
      call transform%start(grid, even=.true., whole=.true.)
      call transform%sample(surface%shape, blocks)
      associate (n => shape(values))
         values = blocks([(modulo(floor((i + offset(1))*grid(1)/n(1)), grid(1)) + 1, i=0, n(1) - 1)], &
                         [(modulo(floor((i + offset(2))*grid(2)/n(2)), grid(2)) + 1, i=0, n(2) - 1)])
      end associate
   end subroutine sample_blocks

   !> Root mean squares of height, slope and curvature.
   type(roughness_type) function roughness(self)
      class(surface_type), intent(in) :: self

      roughness = roughness_of(self%shape, self%amplitude, self%length, self%points)
   end function roughness

end module wavycon_surface
