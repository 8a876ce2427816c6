!> The elastic half-space on a grid: the operator S from pressure to displacement and its inverse, eq. (E9) of README.md
!> in this directory.
!>
!> On a periodic surface a harmonic of wavelength w satisfies  p = stiffness u/w  (Johnson, Greenwood & Higginson 1985,
!> App. 1). On a surface with free edges the displacement is that of (E15). There the inverse is not exact: it is that
!> of the periodic mirror images, which is good enough for a preconditioner.
module wavycon_compliance_operator
   use wavycon_free_kernel, only: free_kernel, transform_of_kernel
   use wavycon_grid_convolution_dp, only: convolution_dp => grid_convolution
   use wavycon_grid_convolution_sp, only: convolution_sp => grid_convolution
   use wavycon_kinds, only: dp, pi, sp
   use wavycon_surface, only: surface_type
   use wavycon_threads, only: threads_for
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: compliance_operator

   type :: compliance_operator
      integer :: transform_pairs = 0               !! number of applications so far; each takes a pair of transforms
      integer :: points(2) = 0                     !! M, N, points of the grid
      !> Whether the points are those of a quarter of an even surface's cell.
      logical :: even = .true.
      type(wave_stiffness) :: kernel               !! kernel of the surface, unit of length surface%stiffness
      !> Stiffness of a harmonic of the half-space whose wavelength is one step along x or along y [p*/Delta].
      real(dp) :: stiffness_per_step(2) = 0.0_dp
      !> Frequency of the wave whose wave number is one over the shorter step, in the unit of `kernel`.
      real(dp) :: frequency_of_step = 0.0_dp
      !> The least power of the wave number with which the compliance goes about a wave of the grid, (E33).
      real(dp) :: steepest_order = -1.0_dp
      logical :: is_free = .false.                 !! whether the surface has free edges: displacements have a mean
      type(convolution_dp), private :: in_double     !! S in double precision
      type(convolution_sp), private :: in_single     !! S, on periodic surfaces also its inverse, in single precision
      type(convolution_sp), private :: with_images   !! inverse with mirror images, for free edges only
   contains
      procedure :: start
      !> S: replaces a pressure [p*] by its displacement [Delta], u - ubar on a periodic surface, u with free edges.
      generic :: displacement => displacement_dp, displacement_sp
      procedure :: pressure
      procedure, private :: displacement_dp, displacement_sp
   end type compliance_operator

contains

   !> Starts the operator on a grid of the surface or, with free edges, on a rectangle of the grid.
   subroutine start(self, surface, points, part)
      class(compliance_operator), intent(out) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! M, N >= 1, on the whole cell, or on a quarter of an even surface's cell
      integer, intent(in), optional :: part(2)   !! points of the rectangle, for free edges only; default: `points`

      real(dp), allocatable :: love(:, :)   ! Love's coefficients (E15), then their transform
      real(dp) :: per_wave(2), step(2)
      integer :: i

      self%even = surface%shape%is_even()
      self%points = points
      if (present(part)) self%points = part
      ! Frequencies are times the stiffness below.
      self%kernel = surface%kernel%in_unit(surface%stiffness)
      self%is_free = surface%has_free_edges
      step = surface%length/(merge(2, 1, self%even)*points)
      if (points(2) == 1) step(2) = surface%length(2)
      self%stiffness_per_step = surface%stiffness/step
      self%frequency_of_step = maxval(self%stiffness_per_step)/(2*pi)
      self%steepest_order = minval([(self%kernel%order(scale(self%frequency_of_step, -i)), &
                                     i=0, exponent(real(maxval(points))))])
      ! Frequencies are multiplied by the stiffness sigma: then they are p*/Delta, of the order of one in any unit of
      ! length.
      per_wave = surface%stiffness/(merge(2, 1, self%even .and. self%points > 1)*self%points*step)
      if (self%is_free) then
         call free_kernel(self%points, step, love)
         love = love/surface%stiffness
         call transform_of_kernel(love)
         call self%in_double%start_free(love)
         call self%in_single%start_free(love)
         call self%with_images%start(self%points, self%even, self%kernel, per_wave)
      else
         call self%in_double%start(self%points, self%even, self%kernel, per_wave)
         call self%in_single%start(self%points, self%even, self%kernel, per_wave)
      end if
   end subroutine start

   !> S in double precision.
   subroutine displacement_dp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(inout), contiguous :: field(:, :)   !! pressure, then displacement; columns of this process
      logical, intent(in), optional :: nonzero(:)   !! columns that may differ from zero; default: all
      logical, intent(in), optional :: wanted(:)    !! columns in which the result is needed, others are undefined

      call self%in_double%apply(field, -1, threads_for(size(field)), nonzero, wanted)
      self%transform_pairs = self%transform_pairs + 1
   end subroutine displacement_dp

   !> S in single precision; arguments as in `displacement_dp`.
   subroutine displacement_sp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)
      logical, intent(in), optional :: nonzero(:), wanted(:)

      call self%in_single%apply(field, -1, threads_for(size(field)), nonzero, wanted)
      self%transform_pairs = self%transform_pairs + 1
   end subroutine displacement_sp

   !> The inverse of S: replaces a displacement [Delta] by its pressure p - pbar [p*]. With free edges it is the
   !> pressure of the periodic mirror images.
   subroutine pressure(self, field)
      class(compliance_operator), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)   !! displacement, then pressure; columns of this process

      if (self%is_free) then
         call self%with_images%apply(field, 1, threads_for(size(field)))
      else
         call self%in_single%apply(field, 1, threads_for(size(field)))
      end if
      self%transform_pairs = self%transform_pairs + 1
   end subroutine pressure

end module wavycon_compliance_operator
