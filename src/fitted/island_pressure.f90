!> Pressure in the contact around the open islands of the square lattice.
module wavycon_island_pressure
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: crest_pressure

contains

   !> Pressure at a crest, p = P + 1 - (1/4 pi^2) times the integral of the kernel's Laplacian times the gap.
   !>
   !> The crest's symmetry is that of an island: a sector of the rule is enough.
   real(dp) function crest_pressure(lattice, rule, load, now) result(pressure)
      type(wave_lattice), intent(in) :: lattice
      type(disc_rule), intent(in) :: rule       !! with the weight of the expansion
      real(dp), intent(in) :: load              !! P
      type(expansion), intent(in) :: now        !! an island's gap

      complex(dp), dimension(size(rule%point)) :: z
      real(dp), dimension(size(rule%point)) :: cubes, x, y
      real(dp) :: values(size(rule%point), now%basis%terms)

      z = now%shape%place(rule%point)
      x = 0.5_dp - z%re
      y = 0.5_dp - z%im
      call lattice%kernel%laplacian(size(z), x, y, cubes)
      call now%basis%evaluate(size(z), rule%point, values)
      pressure = load + 1.0_dp &
         - sum(rule%weight*now%shape%jacobian(rule%point)*matmul(values, now%c)*cubes)/(4*pi**2)
   end function crest_pressure

end module wavycon_island_pressure
