!> Surfaces: the gap h before deformation, and of periodic ones the pressure that closes it.
module wavycon_surface
   use wavycon_assertion, only: assert
   use wavycon_constants, only: pi, sqrt2
   use wavycon_fourier_series, only: divide_series, divided, fourier_series, weighted
   use wavycon_grid_points, only: point_angle
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_roughness, only: roughness_of, roughness_type
   use wavycon_series_peak, only: find_peak
   use wavycon_series_samples, only: sample_series
   use wavycon_rotated_series, only: to_sum_angles
   implicit none (type, external)
   private

   public :: surface_type, surface_of_ball, surface_of_series, surface_of_points

   !> Which wave of Johnson, Greenwood & Higginson (1985) a surface is, and in which angles. Straight: eq. (3) or (21)
   !> with phi = X, theta = Y. Rotated: eq. (21) with phi = (X + Y)/2, theta = (X - Y)/2.
   integer, parameter, public :: no_paper_wave = 0, straight_paper_wave = 1, rotated_paper_wave = 2

   !> Coefficients of a shape that differ by less than this are equal.
   real(dp), parameter :: rounding = 1e-13_dp

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
      !> With free edges: h/Delta contains the paraboloid form(1) (X - pi/2)^2 + form(2) (Y - pi/2)^2 about the map's
      !> centre, less its mean.
      real(dp) :: form(2) = 0.0_dp
      real(dp) :: crest(2) = 0.0_dp             !! X, Y of a peak of the shape [rad]
      real(dp) :: stiffness = 1.0_dp            !! pressure [p*] over displacement [Delta] of a wave, times wavelength
      real(dp) :: full_contact_peak = 1.0_dp    !! largest p - pbar in full contact [p*]; the least is -1
      real(dp) :: hardness = huge(1.0_dp)       !! H, the largest pressure that it bears [p*]; huge: it stays elastic
   contains
      procedure :: parts
      procedure :: sides
      procedure :: nominal_area
      procedure :: is_height_map
      procedure :: is_ball
      procedure :: radii
      procedure :: is_distributed
      procedure :: has_hardness
      procedure :: crest_curvature
      procedure :: full_contact_pressure
      procedure :: shape_at
      procedure :: sample_shape
      procedure :: sample_gap
      procedure :: form_gap
      procedure :: subtract_form
      procedure :: roughness
      procedure :: pressure_of
      procedure :: displacement_of
      procedure :: full_contact_energy
      procedure :: full_contact_series
      procedure :: paper_wave
      procedure :: is_paper_wave
      procedure :: paper_wavelength
      procedure :: paper_angles
      procedure :: has_smaller_cell
      procedure :: smaller_cell
   end type surface_type

contains

   !> The surface whose height over its mean plane is a series.
   type(surface_type) function surface_of_series(length, height) result(surface)
      real(dp), intent(in) :: length(2)            !! L_x, L_y [length], > 0
      type(fourier_series), intent(in) :: height   !! [length]; its mean is ignored

      type(fourier_series) :: waves
      real(dp) :: lowest, unused(2)

      waves = height
      waves%c(0, 0) = 0.0_dp
      surface%length = length
      surface%dimension = merge(1, 2, ubound(height%c, 2) == 0)
      call find_peak(waves, surface%amplitude, surface%crest)
      if (.not. surface%amplitude > 0.0_dp) surface%amplitude = 0.0_dp
      surface%shape = divided(waves, surface%amplitude)
      if (surface%amplitude <= 0.0_dp) return
      waves = weighted(surface%shape, surface%length, 1)
      call find_peak(waves, surface%full_contact_peak, unused)
      call find_peak(divided(waves, -1.0_dp), lowest, unused)
      surface%stiffness = 1.0_dp/lowest
      surface%full_contact_peak = surface%full_contact_peak/lowest
   end function surface_of_series

   !> The surface through given heights on a grid. Between the points it is their Fourier series. Crest, full-contact
   !> pressure and curvature are the extremes over the points. If the grid is distributed so is the surface; its numbers
   !> are those of the whole grid.
   !>
   !> The grid is that of the whole cell, with the first point at X = Y = 0, or that of a quarter, which mirror images
   !> continue: equation (M6) of src/core/map/README.md.
   !>
   !> With free edges the map may lie on a ball: a paraboloid of the given radii about its centre is subtracted.
   type(surface_type) function surface_of_points(sides, height, mirrored, points, has_free_edges, radii) result(surface)
      real(dp), intent(in) :: sides(2)                 !! of the map along x and y [length], > 0
      !> [length], shape (M, N), N = 1 for a profile, or (M, columns of the grid's slab).
      real(dp), intent(in), contiguous :: height(:, :)
      logical, intent(in), optional :: mirrored        !! whether mirror images continue it; .false. if absent
      integer, intent(in), optional :: points(2)       !! M, N if the grid may be distributed; shape of height if absent
      logical, intent(in), optional :: has_free_edges  !! .false. if absent; then mirrored too
      real(dp), intent(in), optional :: radii(2)       !! of the ball [length], > 0, huge for a plane

      type(grid_transform) :: transform
      real(dp), allocatable :: values(:, :)
      real(dp) :: extremes(2), mean(1), per_wave(2)
      integer :: crest(2), grid(2)

      grid = shape(height)
      if (present(points)) grid = points
      surface%dimension = merge(1, 2, grid(2) == 1)
      if (present(mirrored)) surface%mirrored = mirrored
      if (present(has_free_edges)) surface%has_free_edges = has_free_edges
      surface%mirrored = surface%mirrored .or. surface%has_free_edges
      call assert(all(sides > 0.0_dp), 'sides > 0')
      surface%length = surface%parts()*sides
      surface%points = surface%parts()*grid
      call transform%start(grid, even=surface%mirrored)
      call transform%series(height, surface%shape)
      if (lbound(surface%shape%c, 1) == 0) surface%shape%c(0, 0) = 0.0_dp
      mean = transform%slab%column_totals(reshape(sum(height, dim=1), [1, size(height, 2)]))/product(real(grid, dp))
      if (present(radii)) surface%form = half_curvatures(surface, radii)
      ! A flat map on a ball is the ball.
      extremes = [maxval(height), -minval(height)]
      call transform%slab%largest(extremes)
      surface%has_steps = .not. transform%slab%any(any(height < extremes(1) .and. height > -extremes(2)))
      surface%has_steps = surface%has_steps .and. surface%has_free_edges .and. &
                          (sum(extremes) > 0.0_dp .or. all(surface%form <= 0.0_dp))
      allocate (values, source=height)
      call surface%subtract_form(values, [transform%x_angle(1), transform%y_angle(transform%slab%first)], &
                                 2*pi/surface%points)
      call transform%slab%find_largest(values, surface%amplitude, crest)
      surface%amplitude = surface%amplitude - mean(1)
      if (surface%has_steps .and. surface%amplitude <= 0.0_dp) then
         ! A flat map is a punch, h = 0. It has no depth: a length of the map is the unit.
         surface%amplitude = surface%nominal_area()**(1.0_dp/surface%dimension)
         surface%shape%c(0, 0) = surface%amplitude
      end if
      surface%crest = point_angle(crest, transform%points, transform%even)
      if (surface%dimension == 1) surface%crest(2) = 0.0_dp
      if (surface%amplitude <= 0.0_dp) return
      call divide_series(surface%shape, surface%amplitude)
      surface%form = surface%form/surface%amplitude
      per_wave = 1.0_dp/surface%length
      if (.not. surface%has_free_edges) then
         call transform%sample(surface%shape, values, 1, per_wave)
         extremes = [maxval(values), -minval(values)]
         call transform%slab%largest(extremes)
         surface%stiffness = 1.0_dp/extremes(2)
         surface%full_contact_peak = extremes(1)*surface%stiffness
      end if
      if (surface%has_free_edges) call set_units_without_closure(surface)
   end function surface_of_points

   !> A paraboloid with free edges, about the middle of a rectangle: a ball near its lowest point, in 1-D a roller.
   type(surface_type) function surface_of_ball(sides, radii, dimension) result(surface)
      real(dp), intent(in) :: sides(2)       !! of the rectangle along x and y [length], > 0
      real(dp), intent(in) :: radii(2)       !! along x and y [length], > 0; the second is ignored in 1-D
      integer, intent(in) :: dimension       !! 1 or 2

      surface%dimension = dimension
      surface%mirrored = .true.
      surface%has_free_edges = .true.
      surface%length = surface%parts()*sides
      allocate (surface%shape%c(0:0, 0:0), source=0.0_dp)
      surface%form = half_curvatures(surface, radii)
      surface%amplitude = sum(surface%form)*pi**2/12
      surface%form = surface%form/surface%amplitude
      surface%crest = 0.5_dp*pi
      if (dimension == 1) surface%crest(2) = 0.0_dp
      call set_units_without_closure(surface)
   end function surface_of_ball

   !> Half the curvatures of a paraboloid over the square of an angle [length].
   pure function half_curvatures(surface, radii) result(form)
      type(surface_type), intent(in) :: surface   !! with its sides
      real(dp), intent(in) :: radii(2)
      real(dp) :: form(2)

      form = 0.0_dp
      where (radii < huge(radii)) form = 0.5_dp*(surface%length/(2*pi))**2/radii
      if (surface%dimension == 1) form(2) = 0.0_dp
   end function half_curvatures

   !> Sets what of a surface with free edges does not follow from its shape alone.
   pure subroutine set_units_without_closure(surface)
      type(surface_type), intent(inout) :: surface

      surface%stiffness = surface%nominal_area()**(1.0_dp/surface%dimension)
      surface%full_contact_peak = huge(1.0_dp)
   end subroutine set_units_without_closure

   !> What the paraboloid adds to h/Delta: its mean over the map is zero.
   elemental real(dp) function form_gap(self, x, y) result(gap)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y [rad], anywhere

      gap = 0.0_dp
      if (all(self%form <= 0.0_dp)) return
      gap = one_way(self%form(1), x) + one_way(self%form(2), y)

   contains

      pure real(dp) function one_way(form, angle) result(gap)
         real(dp), intent(in) :: form, angle

         ! The mirror image of an angle within the map.
         gap = form*((0.5_dp*pi - abs(pi - modulo(angle, 2*pi)))**2 - pi**2/12)
      end function one_way

   end function form_gap

   !> Subtracts the paraboloid from a field over points that are equally spaced.
   pure subroutine subtract_form(self, field, first, step)
      class(surface_type), intent(in) :: self
      real(dp), intent(inout) :: field(:, :)
      real(dp), intent(in) :: first(2), step(2)   !! X, Y of the first point, and of a step [rad]

      integer :: i, j

      if (all(self%form <= 0.0_dp)) return
      do j = 1, size(field, 2)
         do i = 1, size(field, 1)
            field(i, j) = field(i, j) - self%form_gap(first(1) + (i - 1)*step(1), first(2) + (j - 1)*step(2))
         end do
      end do
   end subroutine subtract_form

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

   !> Whether the surface is a paraboloid without roughness.
   pure logical function is_ball(self)
      class(surface_type), intent(in) :: self

      is_ball = self%has_free_edges .and. any(self%form > 0.0_dp) .and. all(abs(self%shape%c) <= 0.0_dp)
   end function is_ball

   !> The radii of the paraboloid along x and y [length]; infinite where there is none.
   pure function radii(self)
      class(surface_type), intent(in) :: self
      real(dp) :: radii(2)

      radii = huge(radii)
      where (self%form > 0.0_dp) radii = 0.5_dp*(self%length/(2*pi))**2/(self%amplitude*self%form)
   end function radii

   !> Whether the shape has the coefficients of own wave numbers in X only, see wavycon_own_waves. Then only
   !> `sample_gap` can evaluate it; `gather_series` gathers the shape. All other components are those of the
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
      real(dp) :: largest(1), unused(2)

      if (self%is_height_map()) then
         call transform%start(self%points/self%parts(), even=self%mirrored)
         allocate (values(transform%points(1), transform%slab%columns()))
         call transform%sample(self%shape, values, 2, 1.0_dp/self%length)
         largest = maxval(values)
         call transform%slab%largest(largest)
      else
         call find_peak(weighted(self%shape, self%length, 2), largest(1), unused)
      end if
      curvature = largest(1)
      if (self%has_free_edges) curvature = curvature + 2*sum(self%form/self%length**2)
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
      shape_at = self%shape%at(point(1), point(2)) - self%form_gap(x, y)
   end function shape_at

   !> 1 - h/Delta at points of the part that tables refer to, as of `sample_series`.
   subroutine sample_shape(self, points, offset, values)
      class(surface_type), intent(in) :: self
      integer, intent(in) :: points(2)                     !! N_x, N_y >= 1; N_y = 1 in 1-D
      real(dp), intent(in) :: offset(2)                    !! of the first point, in steps
      real(dp), allocatable, intent(out) :: values(:, :)   !! shape (N_x, N_y)

      call sample_series(self%shape, points, offset, values, self%parts())
      if (self%has_steps) call sample_blocks(self, offset, values)
      call self%subtract_form(values, 2*pi*offset/(self%parts()*points), 2*pi/(self%parts()*points))
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
      call self%subtract_form(h, [transform%x_angle(1), transform%y_angle(slab%first)], 2*pi/(self%parts()*slab%points))
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

   !> The pressure (p - pbar)/p* of a displacement (u - ubar)/Delta: Johnson, Greenwood & Higginson (1985), App. 1.
   type(fourier_series) function pressure_of(self, displacement) result(pressure)
      class(surface_type), intent(in) :: self
      type(fourier_series), intent(in) :: displacement

      pressure = divided(weighted(displacement, self%length, 1), 1.0_dp/self%stiffness)
   end function pressure_of

   !> The displacement (u - ubar)/Delta of a pressure (p - pbar)/p*: the inverse of `pressure_of`.
   type(fourier_series) function displacement_of(self, pressure) result(displacement)
      class(surface_type), intent(in) :: self
      type(fourier_series), intent(in) :: pressure

      displacement = divided(weighted(pressure, self%length, -1), self%stiffness)
   end function displacement_of

   !> The elastic energy per nominal area in full contact, half the mean of p times the shape [p* Delta], by Parseval.
   real(dp) function full_contact_energy(self)
      class(surface_type), intent(in) :: self

      type(roughness_type) :: roughness

      roughness = roughness_of(self%shape, 1.0_dp, self%length, self%points)
      full_contact_energy = 0.5_dp*self%stiffness*roughness%frequency_moment
   end function full_contact_energy

   !> p/p* in full contact, where the displacement is the shape; eq. (22) for the paper's wave.
   type(fourier_series) function full_contact_series(self, pbar_over_pstar) result(pressure)
      class(surface_type), intent(in) :: self
      real(dp), intent(in) :: pbar_over_pstar   !! P >= 1

      pressure = self%pressure_of(self%shape)
      pressure%c(0, 0) = pbar_over_pstar
   end function full_contact_series

   !> Whether the surface is a wave of the paper: no_paper_wave, straight_paper_wave or rotated_paper_wave. A
   !> distributed surface counts as none.
   pure integer function paper_wave(self)
      class(surface_type), intent(in) :: self

      real(dp) :: longest(0:1, 0:1)   ! coefficients of the longest waves
      integer :: highest(2)

      paper_wave = no_paper_wave
      if (self%is_distributed() .or. self%has_free_edges .or. .not. self%shape%is_even()) return
      if (self%dimension == 2 .and. .not. is_square(self)) return
      longest = 0.0_dp
      highest = min(1, ubound(self%shape%c))
      longest(:highest(1), :highest(2)) = self%shape%c(:highest(1), :highest(2))
      select case (count(abs(self%shape%c) > rounding))
      case (1)
         if (abs(longest(1, self%dimension - 1) - 1.0_dp) <= rounding) paper_wave = straight_paper_wave
      case (2)
         if (all(abs([longest(1, 0), longest(0, 1)] - 0.5_dp) <= rounding)) paper_wave = rotated_paper_wave
      end select
   end function paper_wave

   !> Whether the surface is a wave of the paper. A flat surface that is not a height map counts as one of amplitude 0
   !> in 1-D and on a square cell.
   pure logical function is_paper_wave(self)
      class(surface_type), intent(in) :: self

      is_paper_wave = self%paper_wave() /= no_paper_wave
      if (.not. (self%amplitude > 0.0_dp .or. self%has_free_edges)) is_paper_wave = .not. self%is_height_map() .and. &
         (self%dimension == 1 .or. is_square(self))
   end function is_paper_wave

   !> The wavelength lambda of eq. (3) or (21) [length].
   pure real(dp) function paper_wavelength(self)
      class(surface_type), intent(in) :: self   !! a wave of the paper

      paper_wavelength = self%length(1)
      if (self%paper_wave() == rotated_paper_wave) paper_wavelength = sqrt2*self%length(1)
   end function paper_wavelength

   !> The angles phi and theta of eq. (3) or (21) at a point.
   pure subroutine paper_angles(self, x, y, phi, theta)
      class(surface_type), intent(in) :: self   !! a wave of the paper
      real(dp), intent(in) :: x, y              !! X, Y [rad]
      real(dp), intent(out) :: phi, theta       !! [rad]

      phi = x
      theta = y
      if (self%paper_wave() == rotated_paper_wave) then
         phi = 0.5_dp*(x + y)
         theta = 0.5_dp*(x - y)
      end if
   end subroutine paper_angles

   !> Whether the surface is periodic on a square of half the area, rotated by 45 degrees, and there even and symmetric
   !> under exchange of the directions. A height map is taken as it is.
   pure logical function has_smaller_cell(self)
      class(surface_type), intent(in) :: self

      integer :: i, j, n

      n = ubound(self%shape%c, 1)
      has_smaller_cell = .not. (self%is_height_map() .or. self%has_free_edges) .and. self%dimension == 2 .and. &
                         self%shape%is_even() .and. is_square(self) .and. n == ubound(self%shape%c, 2)
      if (.not. has_smaller_cell) return
      has_smaller_cell = all(abs(self%shape%c - transpose(self%shape%c)) <= rounding)
      do j = 0, n
         do i = 0, n
            if (mod(i + j, 2) == 1) has_smaller_cell = has_smaller_cell .and. abs(self%shape%c(i, j)) <= rounding
         end do
      end do
   end function has_smaller_cell

   !> The same surface on its smaller cell, see has_smaller_cell: the angles of that cell are X + Y and X - Y.
   type(surface_type) function smaller_cell(self) result(surface)
      class(surface_type), intent(in) :: self   !! has_smaller_cell() is true

      surface = self
      surface%shape = to_sum_angles(self%shape)
      surface%length = self%length/sqrt2
      surface%crest = [self%crest(1) + self%crest(2), self%crest(1) - self%crest(2)]
   end function smaller_cell

   pure logical function is_square(surface)
      class(surface_type), intent(in) :: surface

      is_square = abs(surface%length(1) - surface%length(2)) <= rounding*surface%length(1)
   end function is_square

end module wavycon_surface
