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

   !> A ray is the part of a chord from w_0 on. The chord has the half length l, and the coordinate -cos(alpha) from -1
   !> to 1 along it, so that the root of 1 - |w|^2 is l sin(alpha); alpha_0 belongs to w_0. The kernel is singular at
   !> two complex values of sigma = alpha - alpha_0. The variable eta with sigma = r + width sinh(eta) moves them to eta
   !> = +-i pi/2, (F60).
   type :: ray
      complex(dp) :: stretch = 0.0_dp                       !! dz/dt at w_0 [s]
      real(dp) :: squared = 0.0_dp                          !! |dz/dt|^2 [s^2]
      real(dp) :: half = 0.0_dp, forward = 0.0_dp           !! l; the length of the ray
      real(dp) :: alpha = 0.0_dp, length = 0.0_dp           !! alpha_0; pi less alpha_0
      real(dp) :: first = 0.0_dp, last = 0.0_dp             !! eta at w_0 and at the end of the ray
      real(dp) :: width = 0.0_dp                            !! scale of eta
   end type ray

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

      complex(dp) :: at_origin(1), normal, slope(1), conjugate_slope(1)   ! slopes: dz/dw and dz/d(conj w) at w_0 [s]
      real(dp) :: cosine, distance, edge, kappa, last, sine, width, x   ! edge: 1 - |w_0|^2, at least at_edge
      integer :: closest, i, quarter, rule
      !> Whether the closest point is z(w_0) itself, and stresses are asked for: their integrals are principal values.
      !> `at_origin` then is the density at w_0, with its power of 1 - |w|^2.
      logical :: is_singular

      closest = minloc(hypot(abs(offset), depth), 1)
      distance = hypot(abs(offset(closest)), depth(closest))
      is_singular = self%kernel == all_fields .and. distance <= epsilon(1.0_dp)**2*solution%shape%b(0)
      edge = max((1.0_dp - abs(origin))*(1.0_dp + abs(origin)), at_edge)
      call solution%shape%slopes(1, [origin], slope, conjugate_slope)
      if (is_singular) then
         call find_density(solution, solution%pool, 1, [origin], [edge], at_origin)
         at_origin = at_origin*sqrt(edge)**nint(2*source_power(solution, solution%pool))
      end if
      ! For a point outside the integrand varies along the edge over its distance from the edge.
      width = sqrt(edge)
      if (edge <= at_edge) width = max(width, 0.5_dp*distance/(abs(slope(1)) + abs(conjugate_slope(1))))
      width = min(width, 1.0_dp)
      normal = 1.0_dp
      if (abs(origin) > 0.0_dp) normal = origin/abs(origin)
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
      if (is_singular .and. .not. solution%pool) fields(h_field, 1) = fields(h_field, 1) + at_origin(1)%re &
         /(slope(1)%re**2 + slope(1)%im**2 - (conjugate_slope(1)%re**2 + conjugate_slope(1)%im**2))

   contains

      !> Adds the integral along one ray.
      subroutine add_ray(cosine, direction, weight)
         real(dp), intent(in) :: cosine                !! cosine of the angle between ray and outward normal
         complex(dp), intent(in) :: direction          !! e^(i phi)
         real(dp), intent(in) :: weight                !! weight of the ray in the integral over phi

         !> Factor on the number of points if n > 1: on rays along the edge the singularities of the other points are
         !> half as far from the real axis.
         real(dp), parameter :: points_of_others = 1.5_dp
         integer :: n, of_ray
         type(ray) :: along

         along = ray_from(cosine, direction)
         of_ray = rule_for(self, self%least_points + merge(1.0_dp, points_of_others, size(offset) == 1) &
                           *self%points_per_unit*(along%last - along%first))
         n = size(self%rules(of_ray)%node)
         block
            complex(dp), dimension(n) :: density, difference, step, w
            real(dp) :: analytic(n, 2), differences(n, 2, ubound(solution%shape%b, 1))
            real(dp), dimension(n) :: at_t, eta, root, sigma, t   ! at_t: weights in the integral over t
            complex(dp) :: kernel
            integer :: k, source

            associate (alpha => along%alpha, length => along%length, first => along%first, last => along%last)
               eta = first + 0.5_dp*(last - first)*(1.0_dp + self%rules(of_ray)%node)
               ! sigma = r + width sinh(eta), written without cancellation next to w_0.
               sigma = 2*along%width*cosh(0.5_dp*(eta + first))*sinh(0.5_dp*(eta - first))
               root = along%half*merge(sin(alpha + sigma), sin(length - sigma), alpha < length)
               t = 2*along%half*sin(0.5_dp*sigma) &
                  *merge(sin(alpha + 0.5_dp*sigma), sin(length - 0.5_dp*sigma), alpha < length)
               ! dt = root dsigma.
               at_t = weight*0.5_dp*(last - first)*self%rules(of_ray)%weight*along%width*cosh(eta)*root
            end associate
            step = t*direction
            w = origin + step
            call solution%shape%find_differences(n, origin, w, analytic, differences)
            associate (b => solution%shape%b)
               difference = b(0)*step*cmplx(analytic(:, 1), analytic(:, 2), dp) + conjg(step*cmplx( &
                  matmul(differences(:, 1, :), b(1:)), matmul(differences(:, 2, :), b(1:)), dp))
            end associate
            source = of_pressure
            if (solution%pool) source = merge(of_gradient, of_gap, self%kernel == all_fields)
            call find_density(solution, source == of_gradient, n, w, root**2, density)
            ! The density is multiplied by its power of 1 - |w|^2.
            density = density*(at_t*root*t)*root**nint(2*source_power(solution, source == of_gradient) - 1.0_dp)
            do k = 1, size(offset)
               call add_sources(self%kernel, source, n, offset(k)%re - difference%re, offset(k)%im - difference%im, &
                                depth(k), density%re, density%im, fields(:, k))
            end do
            if (is_singular) then
               ! The principal value: the term 1/t times the value at t = 0 is subtracted, as its integral from a small
               ! circle in z is known.
               associate (stretch => along%stretch, squared => along%squared, remainder => &
                          weight*log(along%forward*sqrt(along%squared)/solution%shape%b(0)) - sum(at_t/t))
                  kernel = stretch**2/squared**2/pi*at_origin(1)
                  if (solution%pool) then
                     kernel = -conjg(stretch)*at_origin(1)/sqrt(squared)**3/(4*pi**2)
                     fields(h_field, 1) = fields(h_field, 1) + remainder*kernel%re
                     kernel = stretch*at_origin(1)/sqrt(squared)**3/(4*pi**2)
                  end if
                  fields(l_field:l_field + 1, 1) = fields(l_field:l_field + 1, 1) + remainder*[kernel%re, kernel%im]
               end associate
            end if
         end block
      end subroutine add_ray

      !> A ray, and the variable eta along it for the point closest to z(w_0).
      pure type(ray) function ray_from(cosine, direction) result(along)
         real(dp), intent(in) :: cosine                !! cosine of the angle between ray and outward normal
         complex(dp), intent(in) :: direction          !! e^(i phi)

         real(dp), parameter :: least_scale = 1e-25_dp
         complex(dp) :: pole
         real(dp) :: ahead, back, behind, middle, outward, r

         along%stretch = slope(1)*direction + conjugate_slope(1)*conjg(direction)
         along%squared = along%stretch%re**2 + along%stretch%im**2
         outward = sqrt(max(1.0_dp - edge, 0.0_dp))*cosine
         along%half = sqrt(edge + outward**2)
         if (outward > 0.0_dp) then
            back = along%half + outward
            along%forward = edge/back
         else
            along%forward = along%half - outward
            back = edge/along%forward
         end if
         behind = min(back/(2*along%half), 1.0_dp)
         ahead = min(along%forward/(2*along%half), 1.0_dp)
         along%alpha = 2*atan2(sqrt(behind), sqrt(ahead))
         along%length = 2*atan2(sqrt(ahead), sqrt(behind))
         r = 0.0_dp
         along%width = along%alpha
         if (.not. is_singular) then
            associate (to => offset(closest), below => depth(closest), stretch => along%stretch, &
                       squared => along%squared)
               middle = (to%re*stretch%re + to%im*stretch%im)/squared
               pole = cmplx(middle, sqrt(max((to%re**2 + to%im**2 + below**2)/squared - middle**2, 0.0_dp)), dp)
            end associate
            pole = 2*asin(sqrt(behind + pole/(2*along%half)))
            r = pole%re - along%alpha
            along%width = abs(pole%im)
         end if
         along%width = max(along%width, least_scale)
         along%first = asinh(-r/along%width)
         along%last = asinh((along%length - r)/along%width)
      end function ray_from

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
