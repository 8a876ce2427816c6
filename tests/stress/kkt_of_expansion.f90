!> The contact conditions of an expansion fitted to the edge, by independent integrals at independent points.
!>
!> Below merging the gap, above merging the pressure, is computed from the pressure, or gap, of the expansion at points
!> where it must be zero. The integrals are taken along rays from the point, on which the kernels 1/r and 1/r^3 are
!> integrated exactly; the smooth rest of the periodic kernels is Ewald's sum.
module stress_kkt_of_expansion
   use stress_random_numbers, only: random_stream
   use wavycon_constants, only: pi
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_fields, only: fitted_fields, start_fitted_fields
   use wavycon_gauss_rules, only: gauss_jacobi
   use wavycon_kinds, only: dp
   use wavycon_shape_search, only: find_preimage
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: check_expansion, expansion_kkt

   !> Violations; pressures in pi E* Delta/s, s the cell's shorter side.
   type :: expansion_kkt
      real(dp) :: contact = huge(1.0_dp)   !! largest |gap| of a spot [Delta], largest |pressure| of a pool
      real(dp) :: noise = huge(1.0_dp)     !! change of `contact` with half as many rays
      real(dp) :: tension = huge(1.0_dp)   !! largest at random points
      real(dp) :: overlap = huge(1.0_dp)   !! likewise [Delta]
      real(dp) :: balance = huge(1.0_dp)   !! of a spot's load, of a pool's mean gap; relative, less its noise
   end type expansion_kkt

   !> Number of rays from a point, a multiple of four, and of points on a ray. Next to merging the number of rays limits
   !> the accuracy of the check, which half as many rays estimate.
   integer, parameter :: rays = 144, points = 64
   !> Range of Ewald's sums: erfc of it is 2e-17.
   real(dp), parameter :: cut_off = 6.0_dp
   !> Ewald's parameter in units of sqrt(pi/area), other than the library's.
   real(dp), parameter :: sharpness = 1.4_dp

   !> Gp, whose Fourier coefficients are 1/(A |k|), as two sums that converge fast.
   type :: ewald_type
      real(dp) :: e = 1.0_dp, area = 1.0_dp
      complex(dp), allocatable :: place(:)   !! of lattice points near by [s], the first the origin
      complex(dp), allocatable :: wave(:)    !! one of k and -k [1/s]
      real(dp), allocatable :: weight(:)     !! of those waves
      real(dp), allocatable :: bending(:)    !! of those in the Laplacian, with the opposite sign
   end type ewald_type

   !> A ray to the edge.
   type :: ray_type
      complex(dp) :: direction = 1.0_dp
      real(dp) :: length = 0.0_dp           !! [s]
      real(dp) :: distance(points) = 0.0_dp !! of a rule for what falls as a root to the edge [s]
      real(dp) :: weight(points) = 0.0_dp
      real(dp) :: value(points) = 0.0_dp    !! of pressure or gap
   end type ray_type

contains

   !> Checks a solution at some random points.
   type(expansion_kkt) function check_expansion(lattice, answer, stream, samples) result(kkt)
      type(wave_lattice), intent(in) :: lattice
      type(fitted_answer), intent(in) :: answer       !! solved
      type(random_stream), intent(inout) :: stream
      integer, intent(in) :: samples

      !> Largest fraction of the distance to the edge: nearer to it the ends of the rays are too close to the point.
      real(dp), parameter :: farthest = 0.8_dp
      type(ewald_type) :: ewald
      type(fitted_fields) :: fields
      type(ray_type) :: ray(rays)
      complex(dp) :: place
      real(dp) :: displacement, gap, pressure, violation(2)
      integer :: i

      call start_fitted_fields(fields, lattice, answer)
      call start_ewald(ewald, lattice)
      kkt = expansion_kkt(0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
      do i = 1, samples
         place = answer%solution%shape%place(farthest*sqrt(stream%uniform()) &
                                             *exp(cmplx(0.0_dp, 2*pi*stream%uniform(), dp)))
         call cast_rays(fields, place, ray)
         if (answer%pool) then
            violation = [bending(ewald, ray), bending(ewald, ray(::2))]
            if (lattice%troughs == 2) violation = violation + &
               [bending_of_other(ewald, ray, lattice%trough + place), &
                bending_of_other(ewald, ray(::2), lattice%trough + place)]
            violation = answer%pbar_over_pstar - lattice%closing_pressure + lattice%pressure_rise(place) &
                        - violation/(4*pi**2)
         else
            violation = lattice%undeformed_gap(fields%centre + place) - (1.0_dp - answer%mean_gap) &
                        + [potential(ewald, ray), potential(ewald, ray(::2))]
         end if
         kkt%contact = max(kkt%contact, abs(violation(1)))
         kkt%noise = max(kkt%noise, abs(violation(1) - violation(2)))
         place = cmplx(stream%uniform() + stream%uniform()*lattice%rows%shift, &
                       stream%uniform()*lattice%rows%spacing, dp)
         call fields%at(place, pressure, displacement, gap)
         kkt%tension = max(kkt%tension, -pressure)
         kkt%overlap = max(kkt%overlap, -gap)
      end do

      call cast_rays(fields, (0.0_dp, 0.0_dp), ray)
      if (answer%pool) then
         violation = lattice%troughs*[moment(ray), moment(ray(::2))]/(lattice%area*answer%mean_gap) - 1.0_dp
      else
         violation = [moment(ray), moment(ray(::2))]/(lattice%area*answer%pbar_over_pstar) - 1.0_dp
      end if
      kkt%balance = max(abs(violation(1)) - abs(violation(1) - violation(2)), 0.0_dp)
   end function check_expansion

   !> Rays from a place inside a spot or a pool, from its centre.
   subroutine cast_rays(fields, place, ray)
      type(fitted_fields), intent(inout) :: fields
      complex(dp), intent(in) :: place
      type(ray_type), intent(out) :: ray(:)

      real(dp), dimension(points) :: node, weight
      real(dp) :: displacement, gap, pressure
      integer :: i, j

      call gauss_jacobi(0.0_dp, 0.0_dp, node, weight)
      node = 0.5_dp*(1.0_dp + node)
      weight = 0.5_dp*weight
      do i = 1, size(ray)
         ray(i)%direction = exp(cmplx(0.0_dp, 2*pi*(i - 1)/size(ray), dp))
         ray(i)%length = way_out(fields, place, ray(i)%direction)
         ! With 1 - t^2 the fraction of the ray, the square root of the distance to the edge is smooth in t.
         ray(i)%distance = ray(i)%length*(1.0_dp - node**2)
         ray(i)%weight = ray(i)%length*2*node*weight
         do j = 1, points
            call fields%at(fields%centre + place + ray(i)%distance(j)*ray(i)%direction, pressure, displacement, gap)
            ray(i)%value(j) = merge(gap, pressure, fields%answer%pool)
         end do
      end do
   end subroutine cast_rays

   !> The distance of the edge, by bisection: the map may not extend far beyond the edge.
   real(dp) function way_out(fields, place, direction) result(low)
      type(fitted_fields), intent(in) :: fields
      complex(dp), intent(in) :: place, direction

      integer, parameter :: steps = 20
      real(dp), parameter :: close = 1e-12_dp
      real(dp) :: high, middle, step

      step = fields%answer%solution%shape%b(0)/steps
      low = 0.0_dp
      do while (is_inside(low + step))
         low = low + step
      end do
      high = low + step
      do while (high - low > close*step)
         middle = 0.5_dp*(low + high)
         if (is_inside(middle)) then
            low = middle
         else
            high = middle
         end if
      end do

   contains

      logical function is_inside(distance) result(inside)
         real(dp), intent(in) :: distance

         complex(dp) :: w

         call find_preimage(fields%answer%solution%shape, place + distance*direction, w, inside)
         inside = inside .and. abs(w) <= 1.0_dp
      end function is_inside

   end function way_out

   !> Integral of the value over the spot or the pool, about its centre.
   pure real(dp) function moment(ray)
      type(ray_type), intent(in) :: ray(:)

      integer :: i

      moment = 0.0_dp
      do i = 1, size(ray)
         moment = moment + sum(ray(i)%weight*ray(i)%distance*ray(i)%value)
      end do
      moment = 2*pi/size(ray)*moment
   end function moment

   !> Integral of Gp times the value.
   real(dp) function potential(ewald, ray)
      type(ewald_type), intent(in) :: ewald
      type(ray_type), intent(in) :: ray(:)

      integer :: i, j

      potential = 0.0_dp
      do i = 1, size(ray)
         do j = 1, points
            potential = potential + ray(i)%weight(j)*ray(i)%value(j) &
                        *kernel_by_distance(ewald, ray(i)%distance(j)*ray(i)%direction)
         end do
      end do
      potential = 2*pi/size(ray)*potential
   end function potential

   !> Finite part of the integral of the Laplacian of Gp times the value.
   real(dp) function bending(ewald, ray)
      type(ewald_type), intent(in) :: ewald
      type(ray_type), intent(in) :: ray(:)

      integer :: i, j

      bending = 0.0_dp
      do i = 1, size(ray)
         do j = 1, points
            bending = bending + ray(i)%weight(j)*ray(i)%value(j) &
                      *smooth_laplacian_by_distance(ewald, ray(i)%distance(j)*ray(i)%direction)
         end do
      end do
      do i = 1, size(ray)/2
         bending = bending + finite_part(ray(i), ray(i + size(ray)/2))
      end do
      bending = 2*pi/size(ray)*bending
   end function bending

   !> The same of a cell's other pool, this one turned by half a turn about a crest.
   real(dp) function bending_of_other(ewald, ray, place) result(bending)
      type(ewald_type), intent(in) :: ewald
      type(ray_type), intent(in) :: ray(:)
      complex(dp), intent(in) :: place       !! the rays' origin, from the crest

      complex(dp) :: apart
      integer :: i, j

      bending = 0.0_dp
      do i = 1, size(ray)
         do j = 1, points
            apart = 2*place + ray(i)%distance(j)*ray(i)%direction
            bending = bending + ray(i)%weight(j)*ray(i)%distance(j)*ray(i)%value(j)*laplacian(ewald, apart)
         end do
      end do
      bending = 2*pi/size(ray)*bending
   end function bending_of_other

   !> Finite part of the integral of value/r^2 over two opposite rays.
   !>
   !> Of sqrt(1 - t^2) U_n(t), with Chebyshev's polynomial of the second kind, over (t - x)^2 it is
   !> -pi (n + 1) U_n(x) (Kaya & Erdogan, Q. Appl. Math. 45 (1987) 105-122). The coefficients of these come from the
   !> rays' rules.
   real(dp) function finite_part(one, other) result(part)
      type(ray_type), intent(in) :: one, other

      real(dp) :: angle(points), coefficient, half, middle, x
      integer :: n

      half = 0.5_dp*(one%length + other%length)
      middle = 0.5_dp*(one%length - other%length)
      x = acos(-middle/half)
      part = 0.0_dp
      do n = 0, points/2
         angle = acos((one%distance - middle)/half)
         coefficient = sum(one%weight*one%value*sin((n + 1)*angle)/sin(angle))
         angle = acos((-other%distance - middle)/half)
         coefficient = coefficient + sum(other%weight*other%value*sin((n + 1)*angle)/sin(angle))
         part = part - pi*(n + 1)*sin((n + 1)*x)/sin(x)*coefficient*2/(pi*half)
      end do
      part = part/half
   end function finite_part

   subroutine start_ewald(ewald, lattice)
      type(ewald_type), intent(out) :: ewald
      type(wave_lattice), intent(in) :: lattice

      integer, parameter :: far = 20
      complex(dp) :: k, place
      integer :: i, j

      associate (height => lattice%rows%spacing, shift => lattice%rows%shift)
         ewald%area = height
         ewald%e = sharpness*sqrt(pi/height)
         ewald%place = [(0.0_dp, 0.0_dp)]
         allocate (ewald%wave(0), ewald%weight(0))
         do j = -far, far
            do i = -far, far
               if (i == 0 .and. j == 0) cycle
               place = rotated(cmplx(i + shift*j, height*j, dp))
               ! The two points are less than two cells apart.
               if (ewald%e*(abs(place) - 1.25_dp*(1.0_dp + height)) < cut_off) ewald%place = [ewald%place, place]
               k = rotated(cmplx(i, (j - shift*i)/height, dp))
               if (j < 0 .or. (j == 0 .and. i < 0) .or. pi*abs(k)/ewald%e > cut_off) cycle
               ewald%wave = [ewald%wave, k]
               ewald%weight = [ewald%weight, 2*erfc(pi*abs(k)/ewald%e)/(height*abs(k))]
            end do
         end do
         ewald%bending = (2*pi*abs(ewald%wave))**2*ewald%weight
      end associate

   contains

      pure complex(dp) function rotated(z)
         complex(dp), intent(in) :: z   !! with rows along x

         rotated = z
         if (lattice%rows%along_y) rotated = cmplx(z%im, z%re, dp)
      end function rotated

   end subroutine start_ewald

   !> r Gp.
   pure real(dp) function kernel_by_distance(ewald, place) result(kernel)
      type(ewald_type), intent(in) :: ewald
      complex(dp), intent(in) :: place

      real(dp) :: r(size(ewald%place))

      r = abs(place - ewald%place)
      kernel = erfc(ewald%e*r(1)) + r(1)*(sum(erfc(ewald%e*r(2:))/r(2:)) + wave_sum(ewald, ewald%weight, place) &
                                          - 2*sqrt(pi)/(ewald%area*ewald%e))
   end function kernel_by_distance

   !> r times the Laplacian of Gp - 1/r.
   pure real(dp) function smooth_laplacian_by_distance(ewald, place) result(kernel)
      type(ewald_type), intent(in) :: ewald
      complex(dp), intent(in) :: place

      associate (e => ewald%e, r => abs(place))
         kernel = e**2*screened_part(e*r) + r*far_laplacian(ewald, place)
      end associate
   end function smooth_laplacian_by_distance

   !> The Laplacian of Gp, away from the lattice's points.
   pure real(dp) function laplacian(ewald, place)
      type(ewald_type), intent(in) :: ewald
      complex(dp), intent(in) :: place

      laplacian = far_laplacian(ewald, place) + screened_laplacian(ewald%e, abs(place))
   end function laplacian

   !> Its smooth part at the origin.
   pure real(dp) function far_laplacian(ewald, place) result(laplacian)
      type(ewald_type), intent(in) :: ewald
      complex(dp), intent(in) :: place

      laplacian = sum(screened_laplacian(ewald%e, abs(place - ewald%place(2:)))) - wave_sum(ewald, ewald%bending, place)
   end function far_laplacian

   !> The Laplacian of erfc(e r)/r.
   elemental real(dp) function screened_laplacian(e, r) result(laplacian)
      real(dp), intent(in) :: e, r   !! > 0

      laplacian = erfc(e*r)/r**3 + 2*e/sqrt(pi)*exp(-(e*r)**2)*(1/r**2 + 2*e**2)
   end function screened_laplacian

   !> x times the Laplacian of -erf(x)/x.
   elemental real(dp) function screened_part(x) result(part)
      real(dp), intent(in) :: x   !! > 0

      integer, parameter :: terms = 20
      real(dp) :: power
      integer :: n

      if (x > 1.0_dp) then
         part = -erf(x)/x**2 + 2/sqrt(pi)*exp(-x**2)*(1/x + 2*x)
         return
      end if
      ! These terms nearly cancel.
      part = 0.0_dp
      power = -1.0_dp/x
      do n = 1, terms
         power = -power*x**2/n
         part = part + power*4*n**2/(2*n + 1)
      end do
      part = 2/sqrt(pi)*part
   end function screened_part

   pure real(dp) function wave_sum(ewald, weight, place)
      type(ewald_type), intent(in) :: ewald
      real(dp), intent(in) :: weight(:)     !! of each wave
      complex(dp), intent(in) :: place

      wave_sum = sum(weight*cos(2*pi*(ewald%wave%re*place%re + ewald%wave%im*place%im)))
   end function wave_sum

end module stress_kkt_of_expansion
