!> The elastic half-space on a grid: displacement from pressure and pressure from displacement, eq. (E9) of README.md in
!> this directory.
!>
!> Where it is periodic a harmonic of wavelength w satisfies  p = stiffness u/w  (Johnson, Greenwood & Higginson 1985,
!> App. 1). Where its surface has free edges the displacement is that of (E15), and the pressure of a displacement that
!> of the mirror images, as a preconditioner needs it.
module wavycon_compliance_operator
   use wavycon_free_kernel, only: free_kernel, transform_of_kernel
   use wavycon_grid_convolution_dp, only: convolution_dp => grid_convolution
   use wavycon_grid_convolution_sp, only: convolution_sp => grid_convolution
   use wavycon_kinds, only: dp, sp
   use wavycon_surface, only: surface_type
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: compliance_operator

   type :: compliance_operator
      integer :: transform_pairs = 0               !! number of applications so far to fields in double precision
      integer :: single_pairs = 0                  !! the same in single precision
      integer :: points(2) = 0                     !! of the grid that it was started on
      !> Whether the points are those of a quarter of an even surface's cell.
      logical :: even = .true.
      !> Stiffness of a harmonic whose wavelength is a step in x or y [p*/Delta].
      real(dp) :: stiffness_per_step(2) = 0.0_dp
      logical :: is_free = .false.                 !! whether the surface has free edges: displacements have a mean
      type(convolution_dp), private :: in_double
      type(convolution_sp), private :: in_single
      type(convolution_dp), private :: free_double
      type(convolution_sp), private :: free_single
   contains
      procedure :: start
      !> From a pressure [p*] to its displacement [Delta], in place: u - ubar, with free edges u.
      generic :: displacement => displacement_dp, displacement_sp
      !> From a displacement [Delta] to its pressure p - pbar [p*] on a periodic surface, in place.
      generic :: pressure => pressure_dp, pressure_sp
      procedure, private :: displacement_dp
      procedure, private :: displacement_sp
      procedure, private :: pressure_dp
      procedure, private :: pressure_sp
   end type compliance_operator

contains

   subroutine start(self, surface, points, part)
      class(compliance_operator), intent(out) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! M, N >= 1, of the whole cell, or of a quarter of an even surface's cell
      integer, intent(in), optional :: part(2)   !! points of the part of this grid that it is for, of free edges

      real(dp), allocatable :: kernel(:, :), square_x(:), square_y(:)
      real(dp) :: frequency(2), step(2)
      integer :: i

      self%even = surface%shape%is_even()
      self%points = points
      if (present(part)) self%points = part
      self%is_free = surface%has_free_edges
      step = surface%length/(merge(2, 1, self%even)*points)
      if (points(2) == 1) step(2) = surface%length(2)
      self%stiffness_per_step = surface%stiffness/step
      associate (points => self%points, stiffness => surface%stiffness)
         ! Stiffness over wavelength, squared: of the order of one in any unit of length.
         frequency = stiffness/(merge(2, 1, self%even .and. points > 1)*points*step)
         square_x = (frequency(1)*[(wave(i, points(1)), i=0, points(1) - 1)])**2
         square_y = (frequency(2)*[(wave(i, points(2)), i=0, points(2) - 1)])**2
         call self%in_double%start(self%even, square_x, square_y)
         call self%in_single%start(self%even, square_x, square_y)
         if (.not. self%is_free) return
         call free_kernel(points, step, kernel)
         kernel = kernel/stiffness
      end associate
      call transform_of_kernel(kernel)
      call self%free_double%start_free(kernel)
      call self%free_single%start_free(kernel)

   contains

      !> The wave number of an index of the spectrum, without sign.
      pure integer function wave(index, length)
         integer, intent(in) :: index    !! from 0
         integer, intent(in) :: length

         wave = merge(index, min(index, length - index), self%even)
      end function wave

   end subroutine start

   subroutine displacement_dp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(inout), contiguous :: field(:, :)   !! the own columns of the slab
      logical, intent(in), optional :: nonzero(:)   !! own columns that may not be zero; default: all
      logical, intent(in), optional :: wanted(:)    !! own columns of the result that are needed, others are undefined

      if (self%is_free) then
         call self%free_double%apply_free(field, threads_for(size(field)), nonzero, wanted)
      else
         call self%in_double%apply(field, -1, threads_for(size(field)), nonzero, wanted)
      end if
      self%transform_pairs = self%transform_pairs + 1
   end subroutine displacement_dp

   !> As `displacement_dp`.
   subroutine displacement_sp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)
      logical, intent(in), optional :: nonzero(:), wanted(:)

      if (self%is_free) then
         call self%free_single%apply_free(field, threads_for(size(field)), nonzero, wanted)
      else
         call self%in_single%apply(field, -1, threads_for(size(field)), nonzero, wanted)
      end if
      self%single_pairs = self%single_pairs + 1
   end subroutine displacement_sp

   !> As `displacement_dp`.
   subroutine pressure_dp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(inout), contiguous :: field(:, :)
      logical, intent(in), optional :: nonzero(:), wanted(:)

      call self%in_double%apply(field, 1, threads_for(size(field)), nonzero, wanted)
      self%transform_pairs = self%transform_pairs + 1
   end subroutine pressure_dp

   !> As `displacement_dp`.
   subroutine pressure_sp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)
      logical, intent(in), optional :: nonzero(:), wanted(:)

      call self%in_single%apply(field, 1, threads_for(size(field)), nonzero, wanted)
      self%single_pairs = self%single_pairs + 1
   end subroutine pressure_sp

end module wavycon_compliance_operator
