!> The pressure that belongs to a displacement of the bodies' surface, and the inverse, in the units of a surface; and
!> full contact, where the displacement is the shape.
module wavycon_full_contact
   use wavycon_fourier_series, only: divide_series, fourier_series, turn, weighted
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemm
   use wavycon_roughness, only: roughness_of, roughness_type
   use wavycon_series_peak, only: find_peak
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: displacement_of, full_contact_energy, full_contact_patches, full_contact_series, mean_compliance, &
      pressure_of, set_closure

contains

   !> The pressure (p - pbar)/p* that belongs to a displacement (u - ubar)/Delta: Johnson, Greenwood & Higginson (1985),
   !> App. 1.
   type(fourier_series) function pressure_of(surface, displacement) result(pressure)
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(in) :: displacement

      pressure = weighted(displacement, surface%length, surface%kernel)
      call divide_series(pressure, 1.0_dp/surface%stiffness)
   end function pressure_of

   !> The displacement (u - ubar)/Delta that a pressure (p - pbar)/p* causes: the inverse of `pressure_of`.
   type(fourier_series) function displacement_of(surface, pressure) result(displacement)
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(in) :: pressure

      displacement = weighted(pressure, surface%length, surface%kernel, divides=.true.)
      call divide_series(displacement, surface%stiffness)
   end function displacement_of

   !> The pressure p/p* in full contact, where the displacement is the shape; eq. (22) for the paper's wave.
   type(fourier_series) function full_contact_series(surface, pbar_over_pstar) result(pressure)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: pbar_over_pstar   !! P >= 1

      pressure = pressure_of(surface, surface%shape)
      call pressure%set_mean(pbar_over_pstar)
   end function full_contact_series

   !> The pressure (p - pbar)/p* in full contact at the crossings of few lines: on each patch those of some lines along
   !> y with some along x. First the waves of each wave number in X are added for all lines along x, by products of
   !> matrices; rows of the series are weighted as they are needed, so that no second series is in memory.
   function full_contact_patches(surface, highest, x, y) result(pressure)
      type(surface_type), intent(in) :: surface   !! the shape may be distributed
      integer, intent(in) :: highest(2)           !! waves with larger wave numbers in X or Y are left out
      real(dp), intent(in) :: x(:, :), y(:, :)    !! X and Y of the lines [rad], shapes (any, patches)
      real(dp) :: pressure(size(x, 1), size(y, 1), size(x, 2))

      real(dp), allocatable :: sums(:, :, :, :)   ! (wave number in X, line, patch, real and imaginary part)
      complex(dp), dimension(size(x, 1)) :: phase, step
      integer :: j, k, last, p

      last = surface%shape%last(1)
      if (surface%is_distributed()) last = surface%shape%rows%points(2) - 1
      last = min(last, highest(1))
      allocate (sums(0:last, size(y, 1), size(y, 2), 2))
      call add_waves_along_y(surface, min(surface%shape%last(2), highest(2)), y, sums)
      sums = reshape(surface%shape%rows%total(reshape(sums, [size(sums)])), shape(sums))
      pressure = 0.0_dp
      do p = 1, size(x, 2)
         ! exp(ikX) by recurrence: the cosines of a long profile would take as long as its solution.
         phase = (1.0_dp, 0.0_dp)
         step = turn(x(:, p))
         do k = 0, last
            do j = 1, size(y, 1)
               pressure(:, j, p) = pressure(:, j, p) + phase%re*sums(k, j, p, 1) - phase%im*sums(k, j, p, 2)
            end do
            phase = phase*step
         end do
      end do
      pressure = surface%stiffness*pressure
   end function full_contact_patches

   !> The sums over l of the weighted waves (k, l) on lines along x, f_k(Y) = sum_l w_kl W_kl exp(ilY).
   subroutine add_waves_along_y(surface, last, y, sums)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: last                       !! the largest l
      real(dp), intent(in) :: y(:, :)                   !! Y of the lines [rad]
      real(dp), intent(out) :: sums(0:, :, :, :)        !! f_k at each line; zero for wave numbers of other ranks

      integer, parameter :: most_rows = 128             ! of the series in one product
      real(dp), allocatable :: factor(:), own(:, :), rows(:, :, :), squares(:)
      real(dp) :: turns(most_rows, size(y), 2)          ! cos lY, sin lY
      integer :: first, i, k, l, most, n, parts, r, waves

      associate (shape => surface%shape, length => surface%length)
         first = shape%first()
         most = min(shape%last(1), ubound(sums, 1))
         ! For l > 0 the waves of l and -l are (W_l + W_-l) cos lY + i (W_l - W_-l) sin lY; real ones have no sine.
         parts = 2
         if (shape%is_even()) parts = 1
         waves = max(most - first + 1, 0)
         n = parts*waves
         sums = 0.0_dp
         if (n == 0) return
         squares = [((k/length(1))**2, k=first, most)]
         allocate (rows(n, most_rows, parts))
         allocate (own(n, size(y)), source=0.0_dp)
         do l = 0, last, most_rows
            r = min(most_rows, last - l + 1)
            do i = 1, r
               factor = squares + ((l + i - 1)/length(2))**2
               call surface%kernel%of(factor)
               turns(i, :, 1) = reshape(cos((l + i - 1)*y), [size(y)])
               if (shape%is_even()) then
                  rows(:, i, 1) = factor*shape%c(:most, l + i - 1)
                  cycle
               end if
               if (l + i == 1) factor = 0.5_dp*factor
               turns(i, :, 2) = reshape(sin((l + i - 1)*y), [size(y)])
               associate (ahead => shape%wave(:most, l + i - 1), back => shape%wave(:most, -(l + i - 1)))
                  rows(:waves, i, 1) = factor*(ahead%re + back%re)
                  rows(waves + 1:, i, 1) = factor*(ahead%im + back%im)
                  rows(:waves, i, 2) = factor*(back%im - ahead%im)
                  rows(waves + 1:, i, 2) = factor*(ahead%re - back%re)
               end associate
            end do
            do i = 1, parts
               call dgemm('N', 'N', n, size(y), r, 1.0_dp, rows(:, :, i), n, turns(:, :, i), most_rows, 1.0_dp, own, n)
            end do
         end do
      end associate
      do i = 1, parts
         sums(first:most, :, :, i) = reshape(own((i - 1)*waves + 1:i*waves, :), [waves, size(y, 1), size(y, 2)])
      end do
   end subroutine add_waves_along_y

   !> The elastic energy per nominal area in full contact [p* Delta]: half the mean of p times the shape, as a sum over
   !> waves by Parseval's theorem, (M25a) of src/core/map/README.md.
   real(dp) function full_contact_energy(surface)
      type(surface_type), intent(in) :: surface

      type(roughness_type) :: roughness

      roughness = roughness_of(surface%shape, 1.0_dp, surface%length, surface%points, surface%kernel)
      full_contact_energy = 0.5_dp*surface%stiffness*roughness%frequency_moment
   end function full_contact_energy

   !> Sets what closes a surface: its stiffness, so that p* is its largest tension in full contact, and its largest
   !> pressure there. Of a map they are those at its points.
   subroutine set_closure(surface)
      type(surface_type), intent(inout) :: surface   !! periodic or mirrored, not flat, with its shape and kernel

      type(fourier_series) :: pressure
      type(grid_transform) :: transform
      real(dp), allocatable :: values(:, :)
      real(dp) :: largest(2), unused(2)   ! of pressure and tension

      pressure = weighted(surface%shape, surface%length, surface%kernel)
      if (surface%is_height_map()) then
         call transform%start(surface%points/surface%maps_in_cell(), even=surface%mirrored)
         allocate (values(transform%points(1), transform%slab%columns()))
         call transform%sample(pressure, values)
         largest = transform%slab%extremes(values)
      else
         call find_peak(pressure, largest(1), unused)
         call divide_series(pressure, -1.0_dp)
         call find_peak(pressure, largest(2), unused)
      end if
      surface%stiffness = 1.0_dp/largest(2)
      surface%full_contact_peak = largest(1)/largest(2)
   end subroutine set_closure

   !> How much the mean pressure p* compresses the layer under a surface [Delta]; 0 without one.
   pure real(dp) function mean_compliance(surface)
      type(surface_type), intent(in) :: surface

      mean_compliance = surface%kernel%layer%mean_compliance()/surface%stiffness
   end function mean_compliance

end module wavycon_full_contact
