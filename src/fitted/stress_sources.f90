!> A spot or an island as point sources of stresses: the points of a rule over the whole disc.
module wavycon_stress_sources
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule, start_disc_rule
   use wavycon_expansion, only: expansion
   use wavycon_kinds, only: dp
   use wavycon_source_density, only: find_density
   use wavycon_stress_kernel, only: add_sources, stress_fields
   implicit none (type, external)
   private

   public :: stress_sources, start_stress_sources

   type :: stress_sources
      logical :: island = .false.
      real(dp), allocatable :: x(:), y(:)                       !! from the centre, shape (n) [s]
      real(dp), allocatable :: strength(:), strength_y(:)       !! force and 0, or the gap's gradient, with area
   contains
      procedure :: add_at
   end type stress_sources

contains

   subroutine start_stress_sources(sources, solution, radii, angles)
      type(stress_sources), intent(out) :: sources
      type(expansion), intent(in) :: solution
      integer, intent(in) :: radii         !! points per radius, >= 1
      integer, intent(in) :: angles        !! and per turn, rounded up to a multiple of 2 fold

      type(disc_rule) :: rule
      complex(dp), allocatable :: density(:), place(:)
      complex(dp) :: turn
      integer :: fold, g, n

      fold = solution%basis%fold
      call start_disc_rule(rule, 0.5_dp, fold, radii, (angles + 2*fold - 1)/(2*fold))
      n = size(rule%point)
      allocate (density(n))
      call find_density(solution, n, rule%point, (1.0_dp - abs(rule%point))*(1.0_dp + abs(rule%point)), density)
      density = density*rule%weight/(2*fold)
      place = solution%shape%place(rule%point)
      sources%island = solution%island
      allocate (sources%x(2*fold*n), sources%y(2*fold*n), sources%strength(2*fold*n))
      allocate (sources%strength_y(2*fold*n), source=0.0_dp)
      do g = 0, fold - 1
         turn = exp(cmplx(0.0_dp, 2*pi*g/fold, dp))
         call set_copy(2*g, turn*place, turn*density)
         call set_copy(2*g + 1, turn*conjg(place), turn*conjg(density))
      end do

   contains

      subroutine set_copy(copy, z, gradient)
         integer, intent(in) :: copy
         complex(dp), intent(in) :: z(:), gradient(:)

         sources%x(copy*n + 1:(copy + 1)*n) = z%re
         sources%y(copy*n + 1:(copy + 1)*n) = z%im
         if (sources%island) then
            sources%strength(copy*n + 1:(copy + 1)*n) = gradient%re
            sources%strength_y(copy*n + 1:(copy + 1)*n) = gradient%im
         else
            sources%strength(copy*n + 1:(copy + 1)*n) = density%re
         end if
      end subroutine set_copy

   end subroutine start_stress_sources

   !> Adds the fields at a place.
   pure subroutine add_at(self, kernel, place, depth, fields)
      class(stress_sources), intent(in) :: self
      integer, intent(in) :: kernel                     !! as of add_sources
      complex(dp), intent(in) :: place                  !! from the centre [s]
      real(dp), intent(in) :: depth                     !! >= 0 [s]
      real(dp), intent(inout) :: fields(stress_fields)

      call add_sources(kernel, self%island, size(self%x), place%re - self%x, place%im - self%y, depth, self%strength, &
                       self%strength_y, fields)
   end subroutine add_at

end module wavycon_stress_sources
