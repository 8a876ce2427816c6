!> Guaranteed bounds of the complementary energy, of the approach and of the mean gap, from any pressure and any gap at
!> the points of a grid: (E18) to (E26) of README.md in this directory. They bound the contact of the surface itself,
!> not that on the grid. They hold for every pressure and gap; if these are far from a solution the bounds are wide, but
!> never false.
module wavycon_energy_bounds
   use wavycon_alias_sums, only: alias_sums
   use wavycon_assertion, only: assert
   use wavycon_fourier_series, only: fourier_series, turn
   use wavycon_full_contact, only: mean_compliance
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, ieee_is_finite, ieee_is_nan, not_a_number, pi
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: bounding_grid, energy_bounds

   !> Lower and upper bound of each value; NaN if there is no bound. The defaults are the values without load.
   type :: energy_bounds
      real(dp) :: energy(2) = 0.0_dp     !! complementary energy F per area [p* Delta]
      real(dp) :: approach(2) = 0.0_dp   !! delta = F'(P) [Delta]
      real(dp) :: mean_gap(2) = 1.0_dp   !! G [Delta]
   end type energy_bounds

   !> The tables of one grid of a periodic surface.
   type :: bounding_grid
      integer :: points(2) = 0          !! points of the grid, as in `start`
      integer :: cell(2) = 0            !! points of the grid on the whole cell
      real(dp), private :: place(2) = 0.0_dp   !! X, Y of the first point; 0 for a quarter
      logical :: is_fine_enough = .false.   !! whether the grid has all waves of the surface; if not there are no bounds
      type(grid_transform), private :: transform
      type(alias_sums), private :: sums
      real(dp), private :: eta = 0.0_dp   !! rounding error of a transform over the norm, (E25)
   contains
      procedure :: start, bound
   end type bounding_grid

   !> Bound of the relative rounding error of the sums of `alias_sums`. Each is a sum of positive terms and takes less
   !> than 200 operations.
   real(dp), parameter :: table_rounding = 400*epsilon(1.0_dp)
   !> Factor of (E25): the rounding error of a Fourier transform of n numbers, relative to the norm, is at most this
   !> times 2 + log2 n.
   real(dp), parameter :: transform_rounding = 16*epsilon(1.0_dp)
   !> Gaps in Delta that are larger in size count as this, as any gap gives bounds: the squares of such gaps are numbers
   !> yet, while an overflow would have no bounds.
   real(dp), parameter :: most_gap = 1e100_dp

contains

   !> Makes the tables of a grid, if the grid is fine enough.
   subroutine start(self, surface, points, even, offset)
      class(bounding_grid), intent(out) :: self
      type(surface_type), intent(in) :: surface   !! periodic or mirrored, not distributed
      !> Points M, N on the whole cell, N = 1 in 1-D; or on a quarter of an even surface's cell,
      !> see wavycon_grid_points.
      integer, intent(in) :: points(2)
      logical, intent(in) :: even                 !! whether the points are those of a quarter
      !> X, Y of the first point on the whole cell, in steps, at most 1 in size: larger ones turn waves with larger
      !> rounding errors. Absent: 0.
      real(dp), intent(in), optional :: offset(2)

      type(fourier_series) :: series

      call assert(.not. (surface%has_free_edges .or. surface%is_distributed()), 'a periodic surface, whole')
      call assert(surface%shape%is_even() .or. .not. even, 'a quarter is that of an even surface')
      call self%transform%start(points, even, whole=.true.)
      call self%transform%new_series(series)
      self%points = points
      self%cell = points
      where (even .and. points > 1) self%cell = 2*points
      if (present(offset) .and. .not. even) self%place = 2*pi*offset/points
      self%eta = transform_rounding*(2 + sum(log(real(self%cell, dp)))/log(2.0_dp))
      self%is_fine_enough = all(surface%shape%last([1, 2]) <= series%last([1, 2]))
      if (self%is_fine_enough) call self%sums%start(self%cell, surface%length, series%last([1, 2]), surface%kernel)
   end subroutine start

   !> Computes the bounds at a mean pressure P, from any pressure and gap. Negative pressures are first set to zero, and
   !> so are negative gaps without a hardness; the pressure is then changed so that its mean is P. A contact that lies
   !> between the points has no pressure at any of them: the points with the smallest gap then bear the load. On a grid
   !> that is not fine enough, with a gap that is NaN, or without a finite pressure the bounds are NaN.
   subroutine bound(self, surface, pressure, gap, pbar_over_pstar, answer)
      class(bounding_grid), intent(in) :: self
      type(surface_type), intent(in) :: surface       !! surface of `start`
      real(dp), intent(in) :: pressure(:, :)          !! p/p* at the points, shape of the grid
      !> gap/Delta at the points. With a hardness H it is negative, h + u - delta, where the pressure is H.
      real(dp), intent(in) :: gap(:, :)
      real(dp), intent(in) :: pbar_over_pstar         !! P >= 0, below the hardness
      type(energy_bounds), intent(out) :: answer

      real(dp), parameter :: outwards(2) = [-1.0_dp, 1.0_dp]
      ! The lower bound (first its energy <u S^-1 u>/2) and the upper bound of F; U and V; H <max(-g, 0)>; eta.
      real(dp) :: compression, dual, factor, half_pu, mean_p, nan, overlap, ph, primal, rounding, share, width
      real(dp), allocatable :: g(:, :), p(:, :)

      if (pbar_over_pstar <= 0.0_dp) return
      nan = not_a_number()
      answer = energy_bounds(nan, nan, nan)
      p = min(max(pressure, 0.0_dp), surface%hardness)
      if (.not. (self%is_fine_enough .and. all(ieee_is_finite(pressure))) .or. any(ieee_is_nan(gap))) return
      g = min(max(gap, -most_gap), most_gap)
      if (.not. any(p > 0.0_dp)) then
         where (g <= minval(g)) p = min(1.0_dp, surface%hardness)
      end if
      if (.not. surface%has_hardness()) g = max(g, 0.0_dp)
      rounding = self%eta + epsilon(1.0_dp)*sum(self%cell)
      mean_p = mean(self, p)
      call energies(self, surface, p, g, rounding, half_pu, ph, dual)
      ! The pressure is multiplied by a factor that gives it the mean P. With a hardness a factor above 1 might exceed
      ! H; then the uniform pressure share*H is added instead, which has no elastic energy, and factor + share = 1.
      factor = pbar_over_pstar/mean_p
      share = 0.0_dp
      if (surface%has_hardness() .and. factor > 1.0_dp) then
         share = (pbar_over_pstar - mean_p)/(surface%hardness - mean_p)
         factor = 1.0_dp - share
      end if
      half_pu = max(half_pu*factor**2*(1.0_dp + 4*rounding), tiny(1.0_dp))
      ph = ph*factor + share*surface%hardness + 4*rounding*(abs(ph*factor) + share*surface%hardness)
      overlap = 0.0_dp
      if (surface%has_hardness()) overlap = surface%hardness*mean(self, max(-g, 0.0_dp))
      primal = half_pu + ph
      dual = pbar_over_pstar*(1.0_dp - mean(self, g) - rounding*(1.0_dp + mean(self, abs(g)))) &
             - overlap*(1.0_dp + rounding) - dual
      answer%energy = [dual, primal] + outwards*rounding*abs([dual, primal])
      ! (E23): the chords from the lower bound at P to the upper bounds at (1 - e) P and (1 + e) P, with the best e.
      width = max(answer%energy(2) - answer%energy(1), tiny(1.0_dp))
      associate (e => min(sqrt(width/half_pu), [1.0_dp, huge(1.0_dp)]), middle => 2*half_pu + ph)
         answer%approach = (middle + outwards*width/e + outwards*e*half_pu &
                            + outwards*rounding*(middle + width/e(2)))/pbar_over_pstar
      end associate
      ! With a hardness (1 + e) p is not admissible: there is no upper bound of the approach. Without a hardness the
      ! mean gap 1 - delta is not negative.
      if (surface%has_hardness()) then
         answer%approach(2) = nan
      else
         answer%approach(2) = min(answer%approach(2), 1.0_dp)
         answer%mean_gap = 1.0_dp - answer%approach(2:1:-1)
      end if
      ! What the mean pressure does to a layer, (E31).
      compression = mean_compliance(surface)*pbar_over_pstar
      answer%approach = answer%approach + compression*(1.0_dp + outwards*rounding)
      answer%energy = answer%energy + 0.5_dp*compression*pbar_over_pstar*(1.0_dp + outwards*rounding)
   end subroutine bound

   !> Upper bounds of the three energies in (E18a), by the sums over waves (E20) and (E21) and with the rounding (E26).
   subroutine energies(self, surface, p, g, rounding, half_pu, ph, half_uq)
      type(bounding_grid), intent(in) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: p(:, :), g(:, :)    !! pressure [p*] and gap [Delta] at the points
      real(dp), intent(in) :: rounding            !! eta and the rounding of sums, relative
      real(dp), intent(out) :: half_pu            !! bound of <p S p>/2 [p* Delta]
      real(dp), intent(out) :: ph                 !! bound of <p h> [p* Delta]
      real(dp), intent(out) :: half_uq            !! bound of <u S^-1 u>/2 [p* Delta], u = g - h less its mean

      complex(dp), allocatable, dimension(:) :: of_g, of_p, of_shape, turn_x
      integer :: k, l, last(2), with_shape
      ! `folded` is 2 for a wave that is its own alias along one axis, 4 along both, otherwise 1. `half` has the weights
      ! with which squared amplitudes give mean squares.
      real(dp), allocatable :: folded(:), half(:)
      real(dp) :: largest(2), norm(3), sums(4)
      type(fourier_series) :: gap, pressure

      call self%transform%series(p, pressure)
      call self%transform%series(g, gap)
      last = pressure%last([1, 2])
      with_shape = surface%shape%last(1)
      allocate (half, source=[1.0_dp, (0.5_dp, k=1, last(1))])
      allocate (of_shape(0:last(1)), source=(0.0_dp, 0.0_dp))
      turn_x = turn([(k*self%place(1), k=0, with_shape)])   ! the surface is moved, so that the first point is at 0
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
            if (abs(l) <= surface%shape%last(2)) &
               of_shape(:with_shape) = surface%shape%row(l, with_shape)*turn_x*turn(l*self%place(2))
            sums(1) = sums(1) + sum(half*folded*compliance*abs(of_p)**2)
            sums(2) = sums(2) + sum(half*folded*w*real(of_p*conjg(of_shape)))
            sums(3) = sums(3) + sum(half*(f*abs(folded*w*of_g + of_shape)**2 &
                                          + folded*(stiffness + (1 - folded)*w**2*f)*abs(of_g)**2))
            sums(4) = sums(4) + sum(half*abs(of_shape)**2)
            largest = max(largest, [maxval(folded*compliance), maxval(folded*(stiffness + w**2*f))])
         end associate
      end do
      norm = sqrt([mean(self, p**2), sums(4), mean(self, g**2) + sums(4)])
      sums([1, 3]) = sqrt(sums([1, 3])*(1.0_dp + table_rounding + rounding)) + 2*self%eta*sqrt(largest)*norm([1, 3])
      half_pu = 0.5_dp*sums(1)**2/surface%stiffness
      half_uq = 0.5_dp*sums(3)**2*surface%stiffness
      ph = mean(self, p) - sums(2) + 2*rounding*norm(1)*(1.0_dp + norm(2))
   end subroutine energies

   !> The mean of a field. Its rounding error is below `rounding` times the mean of the absolute values.
   real(dp) function mean(self, field)
      type(bounding_grid), intent(in) :: self
      real(dp), intent(in) :: field(:, :)

      mean = self%transform%slab%sum_of(field)/size(field)
   end function mean

end module wavycon_energy_bounds
