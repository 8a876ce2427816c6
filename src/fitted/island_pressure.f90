!> Pressure in the contact around the open islands.
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

   !> Pressure at a crest: that of full contact less 1/(4 pi^2) times the integral of the kernel's Laplacian times the
   !> gap. Two islands of a cell are mirrored by the crest.
   real(dp) function crest_pressure(lattice, rule, load, now) result(pressure)
      type(wave_lattice), intent(in) :: lattice
      type(disc_rule), intent(in) :: rule       !! with the weight of the expansion
      real(dp), intent(in) :: load              !! P
      type(expansion), intent(in) :: now        !! an island's gap

      complex(dp), dimension(size(rule%point)) :: z
      real(dp), dimension(size(rule%point)) :: cubes, strength, x, y
      real(dp) :: values(size(rule%point), now%basis%terms), total
      complex(dp) :: turn
      integer :: g, mirrored

      call now%basis%evaluate(size(rule%point), rule%point, values)
      strength = rule%weight*now%shape%jacobian(rule%point)*matmul(values, now%c)
      z = now%shape%place(rule%point)
      total = 0.0_dp
      do mirrored = 1, 2
         do g = 0, now%basis%fold - 1
            turn = exp(cmplx(0.0_dp, 2*pi*g/now%basis%fold, dp))
            x = lattice%trough%re + real(turn*z, dp)
            y = lattice%trough%im + aimag(turn*z)
            call lattice%kernel%laplacian(size(z), x, y, cubes)
            total = total + sum(strength*cubes)
         end do
         z = conjg(z)
      end do
      pressure = load - lattice%closing_pressure + lattice%pressure_rise(-lattice%trough) &
         - lattice%troughs*total/(2*now%basis%fold)/(4*pi**2)
   end function crest_pressure

end module wavycon_island_pressure
