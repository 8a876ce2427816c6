!> Point sources of pressure or gap at the points of a quadrature rule over the mapped disc, and their copies by
!> symmetry.
module wavycon_disc_sources
   use wavycon_gauss_rules, only: disc_rule, start_disc_rule
   use wavycon_fitted_function, only: fitted_function
   use wavycon_kinds, only: dp, pi
   use wavycon_shape_map, only: shape_map
   use wavycon_stress_kernel, only: add_sources, of_gap, of_gradient, of_pressure, stress_field_count
   implicit none (type, external)
   private

   public :: copies, disc_sources, find_density, linearise_sources, source_power, start_disc_sources

   !> A whole spot or pool as point sources.
   type :: disc_sources
      integer :: source = of_pressure              !! kind of the sources, as of wavycon_stress_kernel
      real(dp), allocatable :: x(:), y(:)          !! positions from the centre of the spot or pool, shape (n) [s]
      real(dp), allocatable :: strength(:, :)
         !! strengths times area, shape (n, 2): a spot's pressure or a pool's gap, and 0; or the gap's gradient
   contains
      procedure :: add_at
   end type disc_sources

contains

   !> Makes the sources of a solution at the points of a rule over the whole disc.
   subroutine start_disc_sources(sources, solution, gradient, radii, angles)
      type(disc_sources), intent(out) :: sources
      type(fitted_function), intent(in) :: solution
      logical, intent(in) :: gradient      !! whether the sources are the gradient of a pool's gap; false for a spot
      integer, intent(in) :: radii         !! number of points on a radius, >= 1
      integer, intent(in) :: angles        !! number of points in a full turn, rounded up to a multiple of 2 fold

      type(disc_rule) :: rule
      complex(dp), allocatable :: density(:), strength(:), z(:)

      if (solution%pool) sources%source = merge(of_gradient, of_gap, gradient)
      associate (fold => solution%basis%fold)
         call start_disc_rule(rule, source_power(solution, gradient), fold, radii, (angles + 2*fold - 1)/(2*fold))
         allocate (density(size(rule%point)))
         call find_density(solution, gradient, size(density), rule%point, &
                           (1.0_dp - abs(rule%point))*(1.0_dp + abs(rule%point)), density)
         density = density*rule%weight/(2*fold)
         z = copies(fold, solution%shape%position_of(rule%point))
         ! A gradient is a vector: it is rotated and mirrored with its position.
         if (gradient) strength = copies(fold, density)
         if (.not. gradient) strength = reshape(density, [size(z)], pad=density)
      end associate
      sources%x = z%re
      sources%y = z%im
      sources%strength = reshape([strength%re, strength%im], [size(z), 2])
   end subroutine start_disc_sources

   !> The density of sources on the disc, without its singular factor: the source times the Jacobian, J p, J g or, for
   !> the gap's gradient, README.md (F54), divided by the power of 1 - |w|^2 that the source is proportional to at the
   !> edge, `source_power`.
   subroutine find_density(solution, gradient, n, w, inside, density)
      type(fitted_function), intent(in) :: solution
      logical, intent(in) :: gradient              !! whether the source is the gradient of the gap
      integer, intent(in) :: n
      complex(dp), intent(in) :: w(n)              !! points of the disc
      real(dp), intent(in) :: inside(n)            !! 1 - |w|^2, accurate also next to the edge
      complex(dp), intent(out) :: density(n)       !! real unless the source is a gradient

      real(dp), dimension(n, solution%basis%terms) :: slope_x, slope_y, values
      complex(dp), dimension(n) :: conjugate_slope, f_slope, slope
      real(dp) :: f(n)

      call solution%basis%evaluate(n, w, values)
      call solution%shape%slopes(n, w, slope, conjugate_slope)
      f = matmul(values, solution%c)
      if (gradient) then
         call solution%basis%slopes(n, w, values, slope_x, slope_y)
         f_slope = inside*cmplx(matmul(slope_x, solution%c), matmul(slope_y, solution%c), dp) &
                   - 2*solution%basis%power*f*w
         density = slope*f_slope - conjugate_slope*conjg(f_slope)
      else
         density = f*(slope%re**2 + slope%im**2 - (conjugate_slope%re**2 + conjugate_slope%im**2))
      end if
   end subroutine find_density

   !> The power of 1 - |w|^2 to which a source is proportional at the edge. It is 1/2 both for a pressure and for the
   !> gradient of a gap, with adhesion -1/2, so that one rule serves both: README.md, section 13.
   pure real(dp) function source_power(solution, gradient)
      type(fitted_function), intent(in) :: solution
      logical, intent(in) :: gradient              !! whether the source is the gradient of the gap

      source_power = solution%basis%power
      if (gradient) source_power = source_power - 1.0_dp
   end function source_power

   !> Adds the fields of all sources at one point.
   pure subroutine add_at(self, kernel, place, depth, fields)
      class(disc_sources), intent(in) :: self
      integer, intent(in) :: kernel                     !! as of add_sources
      complex(dp), intent(in) :: place                  !! x + i y of the point from the centre [s]
      real(dp), intent(in) :: depth                     !! >= 0 [s]
      real(dp), intent(inout) :: fields(stress_field_count)

      call add_sources(kernel, self%source, size(self%x), place%re - self%x, place%im - self%y, depth, &
                       self%strength(:, 1), self%strength(:, 2), fields)
   end subroutine add_at

   !> All copies of n positions or vectors by the symmetry. For each rotation by 2 pi g/fold, g = 0, .., fold-1, the n
   !> rotated ones come first, and then those that are mirrored at the x axis before the rotation.
   pure function copies(fold, z) result(copied)
      integer, intent(in) :: fold                  !! order of the rotational symmetry
      complex(dp), intent(in) :: z(:)              !! x + i y, shape (n)
      complex(dp) :: copied(2*fold*size(z))

      complex(dp) :: turn
      integer :: g, n

      n = size(z)
      do g = 0, fold - 1
         turn = exp(cmplx(0.0_dp, 2*pi*g/fold, dp))
         copied(2*n*g + 1:2*n*g + n) = turn*z
         copied(2*n*g + n + 1:2*n*(g + 1)) = turn*conjg(z)
      end do
   end function copies

   !> The strengths of the sources of one sector, which are the terms of a fitted function times weight and area, and
   !> the derivatives of strengths and positions with respect to the shape.
   pure subroutine linearise_sources(map, rule, values, c, weighted, strength_slope, moment_x, moment_y)
      type(shape_map), intent(in) :: map
      type(disc_rule), intent(in) :: rule              !! a rule for the weight of the fitted function
      real(dp), intent(in) :: values(:, :)             !! the basis at the rule's points, shape (n, N)
      real(dp), intent(in) :: c(:)                     !! coefficients of the fitted function, shape (N)
      real(dp), intent(out) :: weighted(:, :)          !! strength of each term, shape (n, N) [s^2]
      real(dp), intent(out) :: strength_slope(:, 0:)   !! d(strength of the fitted function)/d b_k, shape (n, 0:K) [s]
      real(dp), intent(out), dimension(:, 0:) :: moment_x, moment_y
         !! strength of the fitted function times dz/d b_k, real and imaginary part, shape (n, 0:K) [s^2]

      complex(dp), dimension(size(rule%point)) :: conjugate_slope, slope
      complex(dp) :: place_slope(0:ubound(map%b, 1))
      real(dp), dimension(size(rule%point)) :: density, jacobian
      real(dp) :: power(size(rule%point), 2, ubound(map%b, 1)), step(size(rule%point), 2)
      integer :: i, k, n

      n = size(rule%point)
      density = rule%weight*matmul(values, c)
      call map%slopes(n, rule%point, slope, conjugate_slope)
      call map%linearise_slopes(n, rule%point, power, step)
      jacobian = slope%re**2 + slope%im**2 - (conjugate_slope%re**2 + conjugate_slope%im**2)
      strength_slope(:, 0) = 2*density*(slope%re**2 + slope%im**2)/map%b(0)
      do k = 1, ubound(map%b, 1)
         strength_slope(:, k) = -2*density*(conjugate_slope%re*power(:, 1, k) - conjugate_slope%im*power(:, 2, k))
      end do
      do i = 1, n
         call map%linearise_position(rule%point(i), place_slope)
         weighted(i, :) = rule%weight(i)*jacobian(i)*values(i, :)
         moment_x(i, :) = density(i)*jacobian(i)*place_slope%re
         moment_y(i, :) = density(i)*jacobian(i)*place_slope%im
      end do
   end subroutine linearise_sources

end module wavycon_disc_sources
