!> The fields that a spot or pool causes at a point close to it, by integration along rays: README.md, section 13.
!>
!> The rays start at w_0, which is the preimage of the point's position on the surface or, if this is outside of the
!> disc, a point of the edge. Directions and points on the rays are dense where the integrand varies fast: along the
!> edge if w_0 is near the edge, and where the kernel is nearly singular. The number of points grows as the logarithm of
!> the distances.
module wavycon_stress_rays
   use wavycon_disc_sources, only: find_density, source_power
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_tuning, only: ray_angles_of_strain, ray_angles_per_unit, ray_points, ray_points_per_degree, &
      ray_points_per_unit, ray_points_per_unit_and_degree
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp, pi
   use wavycon_stress_kernel, only: add_sources, all_fields, h_field, l_field, of_gap, of_gradient, of_pressure, &
      stress_field_count
   implicit none (type, external)
   private

   public :: stress_rays, start_stress_rays

   !> Gauss rules have multiples of `rule_step` points, up to `most_rules` times this number.
   integer, parameter :: rule_step = 4, most_rules = 64

   type :: gauss_rule
      real(dp), allocatable :: node(:), weight(:)     !! Gauss-Legendre rule on -1 to 1
   end type gauss_rule

   type :: stress_rays
      integer, private :: kernel = all_fields                  !! all_fields or surface_field of wavycon_stress_kernel
      real(dp), private :: least_points = 0.0_dp               !! least points on a ray, least directions in a quarter
      real(dp), private :: angles_per_unit = 0.0_dp            !! further directions for each unit of x, (F61)
      real(dp), private :: points_per_unit = 0.0_dp            !! further points for each unit of eta, (F60)
      type(gauss_rule), private :: rules(most_rules)           !! rules of 4, 8, 12, .. points, made when first needed
   contains
      procedure :: add_at
   end type stress_rays

   !> A distance of w_0 from the edge, in 1 - |w|^2, that counts as zero.
   real(dp), parameter :: at_edge = 1e-16_dp

contains

   !> Chooses the numbers of rays and points for a degree and an accuracy.
   subroutine start_stress_rays(rays, degree, e_folds, kernel)
      type(stress_rays), intent(out) :: rays
      integer, intent(in) :: degree              !! degree of the fitted function
      real(dp), intent(in) :: e_folds       !! natural logarithm of 1/accuracy
      integer, intent(in) :: kernel              !! all_fields, or surface_field for positions outside

      rays%kernel = kernel
      associate (share => e_folds/27.0_dp)
         rays%least_points = share*(ray_points + ray_points_per_degree*degree)
         rays%angles_per_unit = share*ray_angles_per_unit
         rays%points_per_unit = share*(ray_points_per_unit + ray_points_per_unit_and_degree*degree)
      end associate
   end subroutine start_stress_rays

   !> Adds the fields of a spot or pool at n points that have the same w_0. Rays and their points are chosen for the
   !> point closest to z(w_0), with more points on each ray if n > 1.
   subroutine add_at(self, solution, origin, offset, depth, fields)
      class(stress_rays), intent(inout) :: self
      type(fitted_function), intent(in) :: solution       !! the spot or pool
      complex(dp), intent(in) :: origin                   !! w_0, |w_0| <= 1
      complex(dp), intent(in) :: offset(:)                !! x + i y of the points less z(w_0), shape (n) [s]
      real(dp), intent(in) :: depth(:)                    !! depths >= 0, shape (n) [s]
      real(dp), intent(inout) :: fields(stress_field_count, size(offset))

      complex(dp) :: conjugate_slope(1), density_at_origin(1), normal, slope(1)
      real(dp) :: cosine, distance, edge, kappa, last, factor, sine, width, x
      logical :: on_surface
      integer :: i, closest, quarter, rule

      factor = solution%shape%b(0)
      closest = minloc(hypot(abs(offset), depth), 1)
      distance = hypot(abs(offset(closest)), depth(closest))
      on_surface = self%kernel == all_fields .and. distance <= epsilon(1.0_dp)**2*factor
      edge = max((1.0_dp - abs(origin))*(1.0_dp + abs(origin)), at_edge)
      call solution%shape%slopes(1, [origin], slope, conjugate_slope)
      ! For a point outside the integrand varies along the edge over its distance from the edge.
      width = sqrt(edge)
      if (edge <= at_edge) width = max(width, 0.5_dp*distance/(abs(slope(1)) + abs(conjugate_slope(1))))
      width = min(width, 1.0_dp)
      normal = 1.0_dp
      if (abs(origin) > 0.0_dp) normal = origin/abs(origin)
      density_at_origin = 0.0_dp
      if (on_surface) call find_density(solution, solution%pool, 1, [origin], [edge], density_at_origin)
      ! The integrand is singular at complex directions with the imaginary part kappa, where dz/dt vanishes.
      kappa = 0.5_dp*log(abs(slope(1))/max(abs(conjugate_slope(1)), tiny(1.0_dp)))
      ! In each quarter between the direction of the edge and the inward or outward normal a Gauss rule in x is taken,
      ! where the angle from the edge is width sinh(x): README.md (F61).
      last = asinh(0.5_dp*pi/width)
      rule = rule_for(self, (self%least_points + self%angles_per_unit*last) &
                      *max(1.0_dp, ray_angles_of_strain/sqrt(kappa)))
      do quarter = 1, merge(2, 4, edge <= at_edge)
         do i = 1, size(self%rules(rule)%node)
            x = 0.5_dp*last*(1.0_dp + self%rules(rule)%node(i))
            cosine = merge(-1, 1, quarter <= 2)*sin(width*sinh(x))
            sine = merge(1, -1, mod(quarter, 2) == 0)*cos(width*sinh(x))
            call add_ray(cosine, normal*cmplx(cosine, sine, dp), 0.5_dp*last*self%rules(rule)%weight(i)*width*cosh(x))
         end do
      end do
      if (on_surface .and. .not. solution%pool) &
         fields(h_field, 1) = fields(h_field, 1) &
         + density_at_origin(1)%re*sqrt(edge)**nint(2*source_power(solution, .false.)) &
         /(slope(1)%re**2 + slope(1)%im**2 - (conjugate_slope(1)%re**2 + conjugate_slope(1)%im**2))

   contains

      !> Adds the integral along one ray.
      !>
      !> The ray is part of a chord through w_0 of the half length l. Let -cos(alpha) be the coordinate along the chord
      !> from -1 to 1, so that the root of 1 - |w|^2 is l sin(alpha); alpha_0 belongs to w_0. The kernel is singular at
      !> two complex values of sigma = alpha - alpha_0. The variable eta with sigma = r + m sinh(eta) moves them to eta
      !> = +-i pi/2, (F60).
      subroutine add_ray(cosine, direction, weight)
         real(dp), intent(in) :: cosine                !! cosine of the angle between ray and outward normal
         complex(dp), intent(in) :: direction          !! e^(i phi)
         real(dp), intent(in) :: weight                !! weight of the ray in the integral over phi

         real(dp), parameter :: least_scale = 1e-25_dp
         !> Factor on the number of points if n > 1: on rays along the edge the singularities of the other points are
         !> half as far from the real axis.
         real(dp), parameter :: points_of_others = 1.5_dp
         complex(dp) :: pole, stretch                  ! dz/dt at w_0
         real(dp) :: ahead, alpha, along, back, behind, first, forward, half, last, length, middle, r, squared, width
         integer :: n, of_ray

         stretch = slope(1)*direction + conjugate_slope(1)*conjg(direction)
         squared = stretch%re**2 + stretch%im**2
         along = sqrt(max(1.0_dp - edge, 0.0_dp))*cosine
         half = sqrt(edge + along**2)
         if (along > 0.0_dp) then
            back = half + along
            forward = edge/back
         else
            forward = half - along
            back = edge/forward
         end if
         behind = min(back/(2*half), 1.0_dp)
         ahead = min(forward/(2*half), 1.0_dp)
         alpha = 2*atan2(sqrt(behind), sqrt(ahead))
         length = 2*atan2(sqrt(ahead), sqrt(behind))
         if (on_surface) then
            r = 0.0_dp
            width = alpha
         else
            associate (offset => offset(closest), depth => depth(closest))
               middle = (offset%re*stretch%re + offset%im*stretch%im)/squared
               pole = cmplx(middle, sqrt(max((offset%re**2 + offset%im**2 + depth**2)/squared - middle**2, 0.0_dp)), dp)
            end associate
            pole = 2*asin(sqrt(behind + pole/(2*half)))
            r = pole%re - alpha
            width = abs(pole%im)
         end if
         width = max(width, least_scale)
         first = asinh(-r/width)
         last = asinh((length - r)/width)
         of_ray = rule_for(self, self%least_points &
                           + merge(1.0_dp, points_of_others, size(offset) == 1)*self%points_per_unit*(last - first))
         n = size(self%rules(of_ray)%node)
         block
            complex(dp), dimension(n) :: density, difference, step, w
            real(dp) :: analytic(n, 2), differences(n, 2, ubound(solution%shape%b, 1))
            real(dp), dimension(n) :: at_t, eta, root, sigma, t
            complex(dp) :: kernel
            integer :: k, source

            associate (nodes => self%rules(of_ray))
               eta = first + 0.5_dp*(last - first)*(1.0_dp + nodes%node)
               ! sigma = r + width sinh(eta), written without cancellation next to w_0.
               sigma = 2*width*cosh(0.5_dp*(eta + first))*sinh(0.5_dp*(eta - first))
               root = half*merge(sin(alpha + sigma), sin(length - sigma), alpha < length)
               t = 2*half*sin(0.5_dp*sigma)*merge(sin(alpha + 0.5_dp*sigma), sin(length - 0.5_dp*sigma), alpha < length)
               step = t*direction
               w = origin + step
               call solution%shape%find_differences(n, origin, w, analytic, differences)
               associate (b => solution%shape%b)
                  difference = b(0)*step*cmplx(analytic(:, 1), analytic(:, 2), dp) &
                     + conjg(step*cmplx(matmul(differences(:, 1, :), b(1:)), matmul(differences(:, 2, :), b(1:)), dp))
               end associate
               source = of_pressure
               if (solution%pool) source = merge(of_gradient, of_gap, self%kernel == all_fields)
               call find_density(solution, source == of_gradient, n, w, root**2, density)
               ! dt = root dsigma. The density is multiplied by its power of 1 - |w|^2.
               at_t = weight*0.5_dp*(last - first)*nodes%weight*width*cosh(eta)*root
               density = density*(at_t*root*t)*root**nint(2*source_power(solution, source == of_gradient) - 1.0_dp)
               do k = 1, size(offset)
                  call add_sources(self%kernel, source, n, offset(k)%re - difference%re, offset(k)%im - difference%im, &
                                   depth(k), density%re, density%im, fields(:, k))
               end do
            end associate
            if (on_surface) then
               ! The principal value: the term 1/t times the value at t = 0 is subtracted, as its integral from a small
               ! circle in z is known.
               associate (remainder => weight*log(forward*sqrt(squared)/solution%shape%b(0)) - sum(at_t/t), &
                          at_origin => density_at_origin(1)*sqrt(edge)**nint(2*source_power(solution, solution%pool)), &
                          own => fields(:, 1))
                  if (solution%pool) then
                     kernel = -conjg(stretch)*at_origin/sqrt(squared)**3/(4*pi**2)
                     own(h_field) = own(h_field) + remainder*kernel%re
                     kernel = stretch*at_origin/sqrt(squared)**3/(4*pi**2)
                  else
                     kernel = stretch**2/squared**2/pi*at_origin
                  end if
                  own(l_field:l_field + 1) = own(l_field:l_field + 1) + remainder*[kernel%re, kernel%im]
               end associate
            end if
         end block
      end subroutine add_ray

   end subroutine add_at

   !> The number of the shortest Gauss rule with at least the given number of points, or of the longest rule. The rule
   !> is made if it is needed for the first time.
   integer function rule_for(self, points)
      type(stress_rays), intent(inout) :: self
      real(dp), intent(in) :: points   !! number of points

      rule_for = min(max(ceiling(points/rule_step), 1), most_rules)
      associate (rule => self%rules(rule_for))
         if (allocated(rule%node)) return
         allocate (rule%node(rule_step*rule_for), rule%weight(rule_step*rule_for))
         call gauss_jacobi(0.0_dp, 0.0_dp, rule%node, rule%weight)
      end associate
   end function rule_for

end module wavycon_stress_rays
