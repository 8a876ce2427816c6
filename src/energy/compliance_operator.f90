!> The elastic half-space on a periodic grid: displacement from pressure and pressure from displacement, eq. (E9) of
!> README.md in this directory.
!>
!> A harmonic of wavelength w satisfies  p = stiffness u/w  (Johnson, Greenwood & Higginson 1985, App. 1).
module wavycon_compliance_operator
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: compliance_operator

   type :: compliance_operator
      integer :: transform_pairs = 0               !! number of applications so far
      type(grid_transform) :: transform
      real(dp), private :: stiffness = 1.0_dp
      real(dp), allocatable, private :: square_x(:), square_y(:)   !! squared frequencies of the spectrum's indices
   contains
      procedure :: start
      procedure :: displacement
      procedure :: pressure
   end type compliance_operator

contains

   subroutine start(self, surface, points)
      class(compliance_operator), intent(inout) :: self   !! not started before
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)                    !! M, N of the transform, on a quarter of an even surface

      call self%transform%start(points, surface%shape%is_even())
      self%stiffness = surface%stiffness
      self%square_x = surface%frequency(self%transform%wave_x, 0)**2
      self%square_y = surface%frequency(0, self%transform%wave_y)**2
   end subroutine start

   !> From a pressure [p*] to its displacement u - ubar [Delta], in place.
   subroutine displacement(self, field)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(inout), contiguous :: field(:, :)   !! shape (M, N)

      call apply(self, field, stiff=.false.)
   end subroutine displacement

   !> From a displacement [Delta] to its pressure p - pbar [p*], in place.
   subroutine pressure(self, field)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(inout), contiguous :: field(:, :)   !! shape (M, N)

      call apply(self, field, stiff=.true.)
   end subroutine pressure

   subroutine apply(self, field, stiff)
      type(compliance_operator), intent(inout) :: self
      real(dp), intent(inout), contiguous :: field(:, :)
      logical, intent(in) :: stiff

      integer :: j

      call self%transform%forward(field)
      !$omp parallel do num_threads(threads_for(size(field))) schedule(static)
      do j = 1, size(self%square_y)
         call weigh(j)
      end do
      call self%transform%backward(field)
      self%transform_pairs = self%transform_pairs + 1

   contains

      subroutine weigh(column)
         integer, intent(in) :: column

         real(dp) :: weight(size(self%square_x))

         weight = sqrt(self%square_x + self%square_y(column))
         if (column == 1) weight(1) = 1.0_dp
         if (stiff) then
            weight = weight*self%stiffness/self%transform%factor
         else
            weight = 1.0_dp/(weight*self%stiffness*self%transform%factor)
         end if
         ! The mean is left out of both fields.
         if (column == 1) weight(1) = 0.0_dp
         if (self%transform%even) then
            self%transform%cosines(:, column) = weight*self%transform%cosines(:, column)
         else
            self%transform%waves(:, column) = weight*self%transform%waves(:, column)
         end if
      end subroutine weigh

   end subroutine apply

end module wavycon_compliance_operator
