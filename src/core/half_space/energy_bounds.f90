!> Guaranteed bounds of the complementary energy and of the approach, from any pressure and any gap on the points of a
!> grid, (E18) to (E26) of README.md in this directory. They are bounds of the contact of the surface itself, not of
!> that on the grid, and hold for every pressure and gap: those of no solution make them wide, never false.
module wavycon_energy_bounds
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use wavycon_alias_sums, only: alias_sums
   use wavycon_assertion, only: assert
   use wavycon_fourier_series, only: fourier_series
   use wavycon_full_contact, only: mean_compliance
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: bounding_grid, energy_bounds

   !> The least and the largest value that they can have.
   type :: energy_bounds
      real(dp) :: energy(2) = 0.0_dp     !! complementary energy F per area [p* Delta]; NaN: no bound
      real(dp) :: approach(2) = 0.0_dp   !! delta = F'(P) [Delta]; NaN: no bound
      real(dp) :: mean_gap(2) = 1.0_dp   !! [Delta]; NaN: no bound
   end type energy_bounds

   !> One grid of a periodic surface.
   type :: bounding_grid
      integer :: points(2) = 0          !! as given to `start`
      integer :: cell(2) = 0            !! points of the whole cell
      type(grid_transform), private :: transform
      type(alias_sums), private :: sums
   contains
      procedure :: start
      procedure :: bound
   end type bounding_grid

   !> Rounding of the sums of `alias_sums`, relative: each is a sum of positive terms of less than 200 operations.
   real(dp), parameter :: table_rounding = 400*epsilon(1.0_dp)
   !> Rounding of a Fourier transform, relative to its norm, over the logarithm to base 2 of its length: (E26).
   real(dp), parameter :: transform_rounding = 16*epsilon(1.0_dp)

contains

   !> Makes the tables of a grid, if it is fine enough.
   subroutine start(self, surface, points, even, is_fine_enough)
      class(bounding_grid), intent(out) :: self
      type(surface_type), intent(in) :: surface   !! periodic or mirrored, whole
      !> Points M, N of the whole cell, the first at X = Y = 0, N = 1 in 1-D; or of a quarter of an even surface's cell,
      !> see wavycon_grid_points.
      integer, intent(in) :: points(2)
      logical, intent(in) :: even                 !! whether of a quarter
      logical, intent(out) :: is_fine_enough      !! whether the grid has all waves of the surface

      type(fourier_series) :: series

      call assert(.not. (surface%has_free_edges .or. surface%is_distributed()), 'a periodic surface, whole')
      call assert(surface%shape%is_even() .or. .not. even, 'a quarter is that of an even surface')
      call self%transform%start(points, even, whole=.true.)
      call self%transform%new_series(series)
      self%points = points
      self%cell = merge(2*points, points, even .and. points > 1)
      is_fine_enough = all(surface%shape%last([1, 2]) <= series%last([1, 2]))
      if (is_fine_enough) call self%sums%start(self%cell, surface%length, series%last([1, 2]), surface%kernel)
   end subroutine start

   !> The bounds at a mean pressure, from any pressure and gap. Negative pressures, and gaps where there is no hardness,
   !> are set to zero, and the pressure is scaled to its mean.
   subroutine bound(self, surface, pressure, gap, pbar_over_pstar, answer)
      class(bounding_grid), intent(in) :: self
      type(surface_type), intent(in) :: surface       !! as of `start`
      real(dp), intent(in) :: pressure(:, :)          !! p/p* at the points, shape of the grid
      !> gap/Delta at the points. With a hardness H it is negative, h + u - delta, where the pressure is H.
      real(dp), intent(in) :: gap(:, :)
      real(dp), intent(in) :: pbar_over_pstar         !! P >= 0, below the hardness
      type(energy_bounds), intent(out) :: answer

      real(dp) :: dual, half_pu, mean_p, overlap, ph, primal, rounding, scale, share, width
      real(dp), allocatable :: g(:, :), p(:, :)

      if (pbar_over_pstar <= 0.0_dp) return
      answer%energy = ieee_value(1.0_dp, ieee_quiet_nan)
      answer%approach = answer%energy
      answer%mean_gap = answer%energy
      p = min(max(pressure, 0.0_dp), surface%hardness)
      if (.not. (all(ieee_is_finite(pressure)) .and. all(ieee_is_finite(gap)) .and. any(p > 0.0_dp))) return
      g = gap
      if (.not. surface%has_hardness()) g = max(gap, 0.0_dp)
      rounding = transform_rounding*(2 + sum(log(real(self%cell, dp)))/log(2.0_dp)) + epsilon(1.0_dp)*sum(self%cell)
      mean_p = mean(p)
      call energies(self, surface, p, g, rounding, half_pu, ph, dual)
      ! Of mean P: what is missing up to a hardness is a share of the hardness itself.
      scale = pbar_over_pstar/mean_p
      share = 0.0_dp
      if (surface%has_hardness() .and. scale > 1.0_dp) then
         share = (pbar_over_pstar - mean_p)/(surface%hardness - mean_p)
         scale = 1.0_dp - share
      end if
      half_pu = max(half_pu*scale**2*(1.0_dp + 4*rounding), tiny(1.0_dp))
      ph = ph*scale + share*surface%hardness + 4*rounding*(abs(ph*scale) + share*surface%hardness)
      overlap = 0.0_dp
      if (surface%has_hardness()) overlap = surface%hardness*mean(max(-g, 0.0_dp))
      primal = half_pu + ph
      dual = pbar_over_pstar*(1.0_dp - mean(g) - rounding*(1.0_dp + mean(abs(g)))) - overlap*(1.0_dp + rounding) - dual
      answer%energy = [dual - rounding*abs(dual), primal + rounding*abs(primal)]
      ! The chords of the parabola F((1 + e)P) from the line of the lower bound that are the steepest.
      width = max(answer%energy(2) - answer%energy(1), tiny(1.0_dp))
      associate (e => sqrt(width/half_pu), middle => 2*half_pu + ph)
         answer%approach(1) = middle - width/min(e, 1.0_dp) - min(e, 1.0_dp)*half_pu
         answer%approach(2) = middle + width/e + e*half_pu
         answer%approach = (answer%approach + [-rounding, rounding]*(middle + width/e))/pbar_over_pstar
      end associate
      ! With a hardness more pressure is not admissible everywhere. Without, the mean gap 1 - delta is not negative.
      if (surface%has_hardness()) then
         answer%approach(2) = ieee_value(1.0_dp, ieee_quiet_nan)
      else
         answer%approach(2) = min(answer%approach(2), 1.0_dp)
         answer%mean_gap = 1.0_dp - answer%approach(2:1:-1)
      end if
      ! What the mean pressure does to a layer, (E31).
      scale = mean_compliance(surface)*pbar_over_pstar
      answer%approach = answer%approach + scale*[1.0_dp - rounding, 1.0_dp + rounding]
      answer%energy = answer%energy + 0.5_dp*scale*pbar_over_pstar*[1.0_dp - rounding, 1.0_dp + rounding]

   contains

      !> The mean of a field, whose rounding is below `rounding` of that of its absolute values.
      real(dp) function mean(field)
         real(dp), intent(in) :: field(:, :)

         mean = self%transform%slab%sum_of(field)/size(field)
      end function mean

   end subroutine bound

   !> Bounds of the three energies that the bounds consist of, (E18) and (E22).
   subroutine energies(self, surface, p, g, rounding, half_pu, ph, half_uq)
      type(bounding_grid), intent(in) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p(:, :), g(:, :)    !! pressure [p*] and gap [Delta] at the points
      real(dp), intent(in) :: rounding            !! relative, of transforms and sums
      real(dp), intent(out) :: half_pu            !! above <p Sp>/2 [p* Delta]
      real(dp), intent(out) :: ph                 !! above <p h>
      real(dp), intent(out) :: half_uq            !! above <u S^-1 u>/2, u the gap less h less its mean

      complex(dp), allocatable, dimension(:) :: of_g, of_p, of_shape
      integer :: k, l, last(2), with_shape
      real(dp), allocatable :: folded(:), half(:)   ! how often a wave is its own alias; weights of mean squares
      real(dp) :: largest(2), norm(3), sums(4)
      type(fourier_series) :: gap, pressure

      call self%transform%series(p, pressure)
      call self%transform%series(g, gap)
      last = pressure%last([1, 2])
      with_shape = surface%shape%last(1)
      allocate (half, source=[1.0_dp, (0.5_dp, k=1, last(1))])
      allocate (folded(size(half)))
      allocate (of_shape(0:last(1)), source=(0.0_dp, 0.0_dp))
      sums = 0.0_dp
      largest = 0.0_dp
      do l = merge(0, -last(2), pressure%is_even()), last(2)
         if (l == 1 .and. pressure%is_even()) half = 2*half
         associate (f => self%sums%frequency(:, abs(l)), w => self%sums%weight(:, abs(l)), &
                    compliance => self%sums%compliance(:, abs(l)), stiffness => self%sums%stiffness(:, abs(l)))
            folded = [(merge(2.0_dp, 1.0_dp, 2*k == self%cell(1)), k=0, last(1))]* &
                     merge(2.0_dp, 1.0_dp, 2*abs(l) == self%cell(2))
            of_p = pressure%row(l, last(1))
            of_g = gap%row(l, last(1))
            of_shape = 0.0_dp
            if (abs(l) <= surface%shape%last(2)) of_shape(:with_shape) = surface%shape%row(l, with_shape)
            sums(1) = sums(1) + sum(half*folded*compliance*abs(of_p)**2)
            sums(2) = sums(2) + sum(half*folded*w*real(of_p*conjg(of_shape)))
            sums(3) = sums(3) + sum(half*(f*abs(folded*w*of_g + of_shape)**2 &
                                          + folded*(stiffness + (1 - folded)*w**2*f)*abs(of_g)**2))
            sums(4) = sums(4) + sum(half*abs(of_shape)**2)
            largest = max(largest, [maxval(folded*compliance), maxval(folded*(stiffness + w**2*f))])
         end associate
      end do
      associate (slab => self%transform%slab)
         norm = sqrt([slab%sum_of(p**2)/size(p), sums(4), slab%sum_of(g**2)/size(g) + sums(4)])
         sums([1, 3]) = sqrt(sums([1, 3])*(1.0_dp + table_rounding + rounding)) + 2*rounding*sqrt(largest)*norm([1, 3])
         half_pu = 0.5_dp*sums(1)**2/surface%stiffness
         half_uq = 0.5_dp*sums(3)**2*surface%stiffness
         ph = slab%sum_of(p)/size(p) - sums(2) + 2*rounding*norm(1)*(1.0_dp + norm(2))
      end associate
   end subroutine energies

end module wavycon_energy_bounds
