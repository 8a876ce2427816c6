!> The search of one plane below a series for the points of its largest stresses. Equation (S10) of README.md in this
!> directory.
module wavycon_plane_scan
   use wavycon_constants, only: sqrt3
   use wavycon_elastic_body, only: elastic_body
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_stress_tensor, only: largest_shear, xx, xy, xz, yy, yz, zz
   use wavycon_stress_waves, only: stress_waves
   implicit none (type, external)
   private

   public :: scan_plane

contains

   !> Finds the points of a plane with the largest von Mises stress and with the largest shear stress, by (S10).
   subroutine scan_plane(waves, pbar_over_pstar, points, first, last, depth, body, place, stress)
      type(stress_waves), intent(in) :: waves
      real(dp), intent(in) :: pbar_over_pstar   !! P
      integer, intent(in) :: points(2)   !! of the plane along X and Y
      integer, intent(in) :: first(2), last(2)   !! of these the points to look at, from 0
      real(dp), intent(in) :: depth      !! Z [rad]
      type(elastic_body), intent(in) :: body
      integer, intent(out) :: place(2, 2)   !! of both points, from 0
      real(dp), intent(out) :: stress(6, 2) !! the deviators there

      complex(dp), allocatable :: spectra(:, :, :)
      real(dp) :: here(6), largest(2), mean(6), shear
      real(dp), allocatable :: above(:), below(:), squares(:), values(:, :)
      type(grid_transform) :: plane
      integer :: i, j, number

      number = merge(2, 5, waves%is_even)
      allocate (spectra(0:points(1)/2, 0:points(2) - 1, number))
      call waves%find_spectra(points, [0.0_dp, 0.0_dp], depth, body%nu, spectra)
      mean = body%stress(reshape([(0.0_dp, i=1, 12)], [6, 2]), pbar_over_pstar)
      spectra(0, 0, 2) = spectra(0, 0, 2) + mean(xx) - mean(zz)
      call plane%start(points, even=.false., whole=.true.)
      do i = 1, number
         call plane%sum_along_y(spectra(:, :, i))
      end do
      allocate (above(0:points(1) - 1), below(0:points(1) - 1), squares(first(1):last(1)), values(0:points(1) - 1, 5))
      largest = -1.0_dp
      do j = first(2), last(2)
         do i = 1, number
            call plane%sample_column(spectra(:, j, i), values(:, i))
         end do
         if (waves%is_even) then
            above = values(:, 1)
            call plane%sample_column(spectra(:, modulo(-j, points(2)), 1), below)
            do i = first(1), last(1)
               associate (a => above(i), b => above(modulo(-i, points(1))), c => below(i), &
                          d => below(modulo(-i, points(1))))
                  values(i, [1, 3, 4, 5]) = 0.25_dp*[a + b + c + d, a - b - c + d, a - b + c - d, a + b - c - d]
               end associate
            end do
         end if
         squares = values(first(1):last(1), 1)**2
         do i = 2, 5
            squares = squares + values(first(1):last(1), i)**2
         end do
         do i = first(1), last(1)
            ! A shear stress is at most 1/sqrt3 of the von Mises stress.
            if (squares(i) <= min(largest(1), 3*largest(2)**2)) cycle
            here(xx) = values(i, 2)/3 + values(i, 1)/sqrt3
            here(yy) = values(i, 2)/3 - values(i, 1)/sqrt3
            here(zz) = -2*values(i, 2)/3
            here([xy, xz, yz]) = values(i, 3:5)/sqrt3
            shear = largest_shear(here)
            if (squares(i) > largest(1)) call take(1, squares(i))
            if (shear > largest(2)) call take(2, shear)
         end do
      end do

   contains

      subroutine take(k, size)
         integer, intent(in) :: k
         real(dp), intent(in) :: size

         largest(k) = size
         place(:, k) = [i, j]
         stress(:, k) = here
      end subroutine take

   end subroutine scan_plane

end module wavycon_plane_scan
