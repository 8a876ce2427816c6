!> A spot or an island as many point sources: the points of a rule over the whole disc.
module wavycon_disc_sources
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule, start_disc_rule
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: disc_sources, start_disc_sources

   type :: disc_sources
      complex(dp), allocatable :: place(:)               !! from the centre, shape (n) [s]
      real(dp), allocatable :: strength(:)               !! of the expansion there, with area and weight, shape (n)
   contains
      procedure :: sum_at
   end type disc_sources

contains

   !> Sets the sources of a rule over the whole disc.
   subroutine start_disc_sources(sources, solution, radii, angles)
      type(disc_sources), intent(out) :: sources
      type(expansion), intent(in) :: solution
      integer, intent(in) :: radii         !! points per radius, >= 1
      integer, intent(in) :: angles        !! and per turn, rounded up to a multiple of 2 fold

      type(disc_rule) :: rule
      real(dp), allocatable :: density(:), values(:, :)
      complex(dp) :: turn
      integer :: fold, g, n

      fold = solution%basis%fold
      call start_disc_rule(rule, solution%basis%power, fold, radii, (angles + 2*fold - 1)/(2*fold))
      n = size(rule%point)
      allocate (values(n, solution%basis%terms), density(n))
      call solution%basis%evaluate(n, rule%point, values)
      density = matmul(values, solution%c)*rule%weight/(2*fold)*solution%shape%jacobian(rule%point)
      allocate (sources%place(2*fold*n), sources%strength(2*fold*n))
      do g = 0, fold - 1
         turn = exp(cmplx(0.0_dp, 2*pi*g/fold, dp))
         sources%place(2*g*n + 1:(2*g + 1)*n) = solution%shape%place(turn*rule%point)
         sources%place((2*g + 1)*n + 1:(2*g + 2)*n) = solution%shape%place(turn*conjg(rule%point))
         sources%strength(2*g*n + 1:(2*g + 1)*n) = density
         sources%strength((2*g + 1)*n + 1:(2*g + 2)*n) = density
      end do
   end subroutine start_disc_sources

   !> The sum of strength/r^power at z.
   pure real(dp) function sum_at(self, z, power)
      class(disc_sources), intent(in) :: self
      complex(dp), intent(in) :: z         !! from the centre of the spot or island [s]
      integer, intent(in) :: power         !! 1 or 3

      real(dp), dimension(size(self%place)) :: inverse_square

      inverse_square = 1.0_dp/((z%re - self%place%re)**2 + (z%im - self%place%im)**2)
      if (power == 1) then
         sum_at = dot_product(self%strength, sqrt(inverse_square))
      else
         sum_at = dot_product(self%strength, sqrt(inverse_square)*inverse_square)
      end if
   end function sum_at

end module wavycon_disc_sources
