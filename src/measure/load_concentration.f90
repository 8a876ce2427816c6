!> How closely the load stands together: one spot, or a cluster, in a periodic cell.
module wavycon_load_concentration
   use wavycon_grid_edge, only: grid_edge
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: load_concentration

contains

   !> |mean of exp(i X)| with the pressure as weight, or of exp(i Y) if that is less: 1 if all load is at one place,
   !> about 1 - (2 pi d/L)^2/2 if it has the standard deviation d along a side L, 0 if it is distributed evenly.
   real(dp) function load_concentration(edge) result(least)
      type(grid_edge), intent(in) :: edge   !! on the whole cell or, of an even surface, its quarter

      real(dp) :: p, phi, sums(5), theta
      integer :: j, k

      sums = 0.0_dp
      do j = edge%slab%first, edge%slab%last
         do k = 1, edge%slab%points(1)
            p = edge%pressure_or_gap(k, j - edge%slab%first + 1)
            if (p <= 0.0_dp) cycle
            call edge%angles(k, j, phi, theta)
            sums = sums + p*[1.0_dp, cos(phi), sin(phi), cos(theta), sin(theta)]
         end do
      end do
      call edge%slab%add(sums)
      least = 0.0_dp
      if (.not. sums(1) > 0.0_dp) return
      sums = sums/sums(1)
      ! The sines of the other quarters are those of the first with the other sign.
      if (edge%even) sums([3, 5]) = 0.0_dp
      least = min(norm2(sums(2:3)), norm2(sums(4:5)))
   end function load_concentration

end module wavycon_load_concentration
