!> The fields that one spot or pool causes at a point in the half-space or on its surface: README.md, section 12.
!>
!> They are integrals over the disc. Of six rules the coarsest one that resolves the kernel is taken. Next to the spot
!> or pool, where none does, the integration is along rays.
module wavycon_spot_integral
   use wavycon_disc_sources, only: disc_sources, start_disc_sources
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_tuning, only: rule_angles_factor, rule_angles_per_degree, rule_fineness, rule_radii_factor, &
      rule_radii_per_degree
   use wavycon_kinds, only: dp
   use wavycon_shape_search, only: find_edge_in_direction, find_preimage
   use wavycon_stress_kernel, only: all_fields, stress_field_count
   use wavycon_stress_rays, only: start_stress_rays, stress_rays
   implicit none (type, external)
   private

   public :: spot_integral, start_spot_integral

   !> Number of rules, from the coarsest to the finest.
   integer, parameter :: levels = 6
   !> Number of the rule for spots or pools that are far away. The coarsest rule leaves errors of 1e-7 where sharp
   !> shapes have a low degree.
   integer, parameter, public :: far_level = 2

   type :: spot_integral
      type(fitted_function) :: solution                      !! the spot or pool
      real(dp) :: radius = 0.0_dp                            !! radius of a circle around the shape [s]
      real(dp) :: digits = 0.0_dp                            !! natural logarithm of 1/accuracy
      integer, private :: kernel = 1                         !! all_fields or surface_field of wavycon_stress_kernel
      real(dp), private :: stretch = 0.0_dp                  !! upper bound of the map's derivative [s]
      integer :: radii(levels) = 0, angles(levels) = 0       !! for each rule, points on a radius and in a full turn
      type(stress_rays), private :: rays
      type(disc_sources), private :: rules(levels)           !! their points are made when they are first needed
   contains
      procedure :: add_at, is_resolved
   end type spot_integral

contains

   !> Prepares the integrals over a spot or pool, and chooses the numbers of points of the rules.
   subroutine start_spot_integral(spot, solution, accuracy, kernel)
      type(spot_integral), intent(out) :: spot
      type(fitted_function), intent(in) :: solution    !! the spot or pool
      real(dp), intent(in) :: accuracy                 !! error of the integrals over the peak pressure or displacement
      integer, intent(in) :: kernel                    !! all_fields or surface_field

      !> Factor on the radius of the shape, which is known from some points only and may be too small.
      real(dp), parameter :: radius_margin = 1.05_dp
      integer, parameter :: least_angles = 24, least_radii = 8
      integer :: i

      spot%solution = solution
      spot%kernel = kernel
      spot%digits = -log(min(max(accuracy, 1e-15_dp), 1e-2_dp)) + 2.0_dp
      spot%radius = radius_margin*solution%shape%radius()
      associate (b => solution%shape%b, fold => solution%shape%fold)
         spot%stretch = b(0)*(1.0_dp + (fold + 1)*solution%shape%clustering) &
            + sum([((fold*i - 1)*abs(b(i)), i=1, ubound(b, 1))])
      end associate
      associate (degree => solution%basis%degree)
         spot%angles = ceiling(max(least_angles, ceiling(rule_angles_per_degree*degree)) &
                               *rule_fineness**[(i, i=0, levels - 1)])
         spot%radii = ceiling(max(least_radii, ceiling(rule_radii_per_degree*degree) + 2) &
                              *rule_fineness**[(i, i=0, levels - 1)])
         call start_stress_rays(spot%rays, degree, spot%digits, kernel)
      end associate
   end subroutine start_spot_integral

   !> Adds the fields of the spot or pool at a point.
   subroutine add_at(self, z, depth, fields)
      class(spot_integral), intent(inout) :: self
      complex(dp), intent(in) :: z                             !! x + i y of the point from the centre [s]
      real(dp), intent(in) :: depth                            !! depth >= 0; 0 for the surface field [s]
      real(dp), intent(inout) :: fields(stress_field_count)    !! for the surface field only the first one is changed

      complex(dp) :: offset, origin
      integer :: level

      call locate(self, z, depth, origin, offset, level)
      if (level <= levels) then
         if (.not. allocated(self%rules(level)%x)) &
            call start_disc_sources(self%rules(level), self%solution, &
                                    self%solution%pool .and. self%kernel == all_fields, self%radii(level), &
                                    self%angles(level))
         call self%rules(level)%add_at(self%kernel, z, depth, fields)
      else
         call self%rays%add_at(self%solution, origin, [offset], [depth], fields)
      end if
   end subroutine add_at

   !> Whether the rule for far spots or pools resolves the kernel for a position on the surface.
   pure logical function is_resolved(self, z)
      class(spot_integral), intent(in) :: self
      complex(dp), intent(in) :: z                        !! the position from the centre [s]

      complex(dp) :: offset, origin
      integer :: level

      call locate(self, z, 0.0_dp, origin, offset, level)
      is_resolved = level <= far_level
   end function is_resolved

   !> Finds the coarsest rule that resolves the kernel for a point, and the origin of rays.
   pure subroutine locate(self, z, depth, origin, offset, level)
      class(spot_integral), intent(in) :: self
      complex(dp), intent(in) :: z                        !! x + i y of the point from the centre [s]
      real(dp), intent(in) :: depth                       !! depth of the point [s]
      complex(dp), intent(out) :: origin                  !! w_0, where rays start, if the point is near
      complex(dp), intent(out) :: offset                  !! z less z(w_0) [s]
      integer, intent(out) :: level                       !! number of the rule; more than `levels` if none resolves it

      real(dp), parameter :: far_from_disc = 1.5_dp
      complex(dp) :: edge, pole, v
      real(dp) :: angular, below, distance, closest, radial
      logical :: found

      offset = 0.0_dp
      if (hypot(abs(z), depth) > far_from_disc*self%radius) then
         origin = 1.0_dp
         distance = abs(z)/self%radius
         below = depth/self%radius
      else
         call find_preimage(self%solution%shape, z, v, found)
         if (.not. found) call find_edge_in_direction(self%solution%shape, z, v, edge)
         origin = v
         if (.not. found .or. abs(v) > 1.0_dp) then
            origin = v/abs(v)
            offset = z - self%solution%shape%position_of(origin)
         end if
         distance = abs(v)
         below = depth/self%stretch
      end if
      ! How fast the errors of rules over a round disc of radius 1 fall, for a point at a distance from its axis,
      ! README.md (F57): as exp(-angular) with each angle, and as exp(-radial) with each radius, where `radial` is twice
      ! the logarithm of the sum of an ellipse's half axes.
      closest = min(hypot(distance, below), 1.0_dp)
      angular = 1.0_dp + ((distance - closest)**2 + below**2)/(2*max(distance*closest, 1e-12_dp))
      angular = acosh(min(angular, 1e6_dp))
      ! Bernstein's ellipse through the nearest singularity of the integrand in |w|^2, which goes from 0 to 1.
      pole = 2*cmplx(distance, below, dp)**2 - 1.0_dp
      radial = abs(pole + sqrt(pole - 1.0_dp)*sqrt(pole + 1.0_dp))
      radial = 2*log(max(radial, 1/radial))
      do level = 1, levels
         if (self%angles(level)*angular >= rule_angles_factor*self%digits .and. &
             self%radii(level)*radial >= rule_radii_factor*self%digits) exit
      end do
   end subroutine locate

end module wavycon_spot_integral
