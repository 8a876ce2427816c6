!> First approximations for Gauss-Newton's method: the asymptotes of light load and of nearly full contact.
module wavycon_start_expansion
   use wavycon_constants, only: pi
   use wavycon_disc_polynomials, only: start_disc_polynomials
   use wavycon_expansion, only: expansion
   use wavycon_fitted_tuning, only: start_degree
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: hertz_spot, crack_pool, scaled_to_load

contains

   !> A Hertzian spot, elliptical where the curvatures of the crest differ: README.md (F41); paper, (23).
   function hertz_spot(lattice, load) result(spot)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load   !! P > 0
      type(expansion) :: spot

      real(dp) :: curvature(2), radius
      integer :: i

      curvature = 4*pi**2*[(sum(lattice%wave(i, :)**2*lattice%amplitude), i=1, 2)]
      radius = (3*pi*load*lattice%area/(4*sqrt(product(curvature))))**(1.0_dp/3)
      ! About the exact relation, which has elliptic integrals.
      spot = ellipse(.false., lattice%fold, radius, (curvature(1)/curvature(2))**0.6_dp)
      ! The first polynomial is constant, and (1 - rho^2)^(1/2) has the integral 2 pi/3.
      spot%c(1) = load*lattice%area/spot%shape%area()/sqrt(2*pi/3)*pi
      spot%approach = sqrt(product(curvature))*radius**2
   end function hertz_spot

   !> The opening of a penny-shaped crack at a trough, elliptical where the curvatures of the full contact's pressure
   !> differ: README.md (F42); paper, (24) and (A4)-(A8).
   function crack_pool(lattice, load) result(pool)
      type(wave_lattice), intent(in) :: lattice
      real(dp), intent(in) :: load  !! P < the closing pressure
      type(expansion) :: pool

      real(dp) :: curvature(2), missing, radius
      integer :: i

      curvature = -4*pi**2*[(sum(lattice%wave(i, :)**2*lattice%pressure*lattice%phase%re), i=1, 2)]
      missing = lattice%closing_pressure - load
      radius = sqrt(3*missing/sqrt(product(curvature)))
      ! Exact for slender ellipses.
      pool = ellipse(.true., lattice%trough_fold, radius, sqrt(curvature(1)/curvature(2)))
      ! The opening is g_0 (1 - rho^2)^(3/2), g_0 = (8/3) b (closing pressure - P), b the radius.
      pool%c(1) = 8*missing*radius/3*sqrt(0.4_dp*pi)
   end function crack_pool

   !> An expansion of low degree without coefficients, over a circle or, with two-fold symmetry, an ellipse.
   function ellipse(pool, fold, radius, ratio) result(now)
      logical, intent(in) :: pool
      integer, intent(in) :: fold          !! of the symmetry
      real(dp), intent(in) :: radius       !! mean of the semi-axes [s]
      real(dp), intent(in) :: ratio        !! of the axes along y and x
      type(expansion) :: now

      now%pool = pool
      call start_disc_polynomials(now%basis, fold, start_degree, merge(1.5_dp, 0.5_dp, pool))
      allocate (now%c(now%basis%terms), source=0.0_dp)
      now%shape%fold = fold
      allocate (now%shape%b(0:1))
      now%shape%b(:) = [radius, 0.0_dp]
      if (fold == 2) now%shape%b(1) = radius*(1.0_dp - ratio)/(1.0_dp + ratio)
   end function ellipse

   !> An approximation at another load: lengths, pressures and gaps are scaled as in the asymptotes.
   function scaled_to_load(lattice, from, old_load, new_load) result(scaled)
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: from
      real(dp), intent(in) :: old_load, new_load  !! P
      type(expansion) :: scaled

      real(dp) :: factor

      scaled = from
      if (from%pool) then
         factor = sqrt((lattice%closing_pressure - new_load)/(lattice%closing_pressure - old_load))
         scaled%c = from%c*factor**3
      else
         factor = (new_load/old_load)**(1.0_dp/3)
         scaled%c = from%c*factor
         scaled%approach = from%approach*factor**2
      end if
      scaled%shape%b = from%shape%b*factor
   end function scaled_to_load

end module wavycon_start_expansion
