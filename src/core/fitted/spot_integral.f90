!> Integrals over one spot or pool for a place in the half-space or on its surface: README.md, section 12.
!>
!> They are taken by the coarsest of some rules over the disc that resolves the kernel or, next to the spot or pool,
!> along rays.
module wavycon_spot_integral
   use wavycon_disc_sources, only: disc_sources, start_disc_sources
   use wavycon_expansion, only: expansion
   use wavycon_fitted_tuning, only: rule_angles_factor, rule_angles_per_degree, rule_fineness, rule_radii_factor, &
      rule_radii_per_degree
   use wavycon_kinds, only: dp
   use wavycon_shape_search, only: find_edge_in_direction, find_preimage
   use wavycon_stress_kernel, only: all_fields, stress_fields
   use wavycon_stress_rays, only: start_stress_rays, stress_rays
   implicit none (type, external)
   private

   public :: spot_integral, start_spot_integral

   !> Rules of rising fineness, before rays are taken.
   integer, parameter :: levels = 6
   !> The rule for spots or pools that are far. The coarsest one leaves 1e-7 where sharp shapes have a low degree.
   integer, parameter, public :: far_level = 2

   type :: spot_integral
      type(expansion) :: solution
      real(dp) :: radius = 0.0_dp                            !! of a circle about the shape [s]
      real(dp) :: digits = 0.0_dp                            !! natural logarithm of 1/accuracy
      integer, private :: kernel = 1                         !! as of wavycon_stress_kernel
      real(dp), private :: stretch = 0.0_dp                  !! largest derivative of the shape's map, about [s]
      integer :: radii(levels) = 0, angles(levels) = 0       !! points of the rules
      ! Made when first needed.
      type(stress_rays), allocatable, private :: rays
      type(disc_sources), private :: rules(levels)
   contains
      procedure :: add_at
      procedure :: is_resolved
      procedure, private :: locate
   end type spot_integral

contains

   subroutine start_spot_integral(spot, solution, accuracy, kernel)
      type(spot_integral), intent(out) :: spot
      type(expansion), intent(in) :: solution
      real(dp), intent(in) :: accuracy             !! of the integrals over the peak of the pressure or displacement
      integer, intent(in) :: kernel                !! all_fields or surface_field

      !> Factor on a shape's radius, which is that of some of its points.
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
      end associate
   end subroutine start_spot_integral

   !> Adds the fields at a place.
   subroutine add_at(self, z, depth, fields)
      class(spot_integral), intent(inout) :: self
      complex(dp), intent(in) :: z                        !! the place from the centre [s]
      real(dp), intent(in) :: depth                       !! >= 0; 0 for the surface field [s]
      real(dp), intent(inout) :: fields(stress_fields)    !! of the surface field the first one

      complex(dp) :: offset, origin
      integer :: level

      call self%locate(z, depth, origin, offset, level)
      if (level <= levels) then
         if (.not. allocated(self%rules(level)%x)) &
            call start_disc_sources(self%rules(level), self%solution, &
                                    self%solution%pool .and. self%kernel == all_fields, self%radii(level), &
                                    self%angles(level))
         call self%rules(level)%add_at(self%kernel, z, depth, fields)
      else
         if (.not. allocated(self%rays)) then
            allocate (self%rays)
            call start_stress_rays(self%rays, self%solution%basis%degree, self%digits, self%kernel)
         end if
         call self%rays%add_at(self%solution, origin, [offset], [depth], fields)
      end if
   end subroutine add_at

   !> Whether the rule of far spots or pools resolves the kernel for a place on the surface.
   pure logical function is_resolved(self, z)
      class(spot_integral), intent(in) :: self
      complex(dp), intent(in) :: z                        !! the place from the centre [s]

      complex(dp) :: offset, origin
      integer :: level

      call self%locate(z, 0.0_dp, origin, offset, level)
      is_resolved = level <= far_level
   end function is_resolved

   !> Where a place lies with respect to the disc, and the coarsest rule that resolves the kernel there.
   pure subroutine locate(self, z, depth, origin, offset, level)
      class(spot_integral), intent(in) :: self
      complex(dp), intent(in) :: z                        !! from the centre [s]
      real(dp), intent(in) :: depth
      complex(dp), intent(out) :: origin                  !! w_0 of rays, if the place is near
      complex(dp), intent(out) :: offset                  !! the place as seen from z(w_0) [s]
      integer, intent(out) :: level                       !! more than `levels` if none does

      real(dp), parameter :: far_from_disc = 1.5_dp
      complex(dp) :: edge, pole, v
      real(dp) :: angular, below, distance, nearest, radial
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
            offset = z - self%solution%shape%place(origin)
         end if
         distance = abs(v)
         below = depth/self%stretch
      end if
      ! Decay of the error of rules over a round disc of radius 1, at a distance from its axis, README.md (F57): theta
      ! for each angle and, for each radius, twice the logarithm of the sum of the half axes of an ellipse.
      nearest = min(hypot(distance, below), 1.0_dp)
      angular = 1.0_dp + ((distance - nearest)**2 + below**2)/(2*max(distance*nearest, 1e-12_dp))
      angular = acosh(min(angular, 1e6_dp))
      ! Bernstein's ellipse through the nearest singularity in |w|^2, between 0 and 1.
      pole = 2*cmplx(distance, below, dp)**2 - 1.0_dp
      radial = abs(pole + sqrt(pole - 1.0_dp)*sqrt(pole + 1.0_dp))
      radial = 2*log(max(radial, 1/radial))
      do level = 1, levels
         if (self%angles(level)*angular >= rule_angles_factor*self%digits .and. &
             self%radii(level)*radial >= rule_radii_factor*self%digits) exit
      end do
   end subroutine locate

end module wavycon_spot_integral
