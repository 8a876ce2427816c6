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
   use wavycon_wave_stiffness, only: wave_stiffness
   implicit none (type, external)
   private

   public :: compliance_operator

   type :: compliance_operator
      integer :: transform_pairs = 0               !! number of applications so far
      integer :: points(2) = 0                     !! of the grid that it was started on
      !> Whether the points are those of a quarter of an even surface's cell.
      logical :: even = .true.
      type(wave_stiffness) :: kernel               !! of the surface, with the unit of length surface%stiffness
      !> Stiffness of a harmonic of the half-space whose wavelength is a step in x or y [p*/Delta].
      real(dp) :: stiffness_per_step(2) = 0.0_dp
      logical :: is_free = .false.                 !! whether the surface has free edges: displacements have a mean
      type(convolution_dp), private :: in_double
      type(convolution_sp), private :: in_single
      type(convolution_sp), private :: with_images   !! of a surface with free edges, in single precision
   contains
      procedure :: start
      !> From a pressure [p*] to its displacement [Delta], in place: u - ubar, with free edges u.
      generic :: displacement => displacement_dp, displacement_sp
      procedure :: pressure
      procedure, private :: displacement_dp
      procedure, private :: displacement_sp
   end type compliance_operator

contains

   subroutine start(self, surface, points, part)
      class(compliance_operator), intent(out) :: self
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)   !! M, N >= 1, of the whole cell, or of a quarter of an even surface's cell
      integer, intent(in), optional :: part(2)   !! points of the part of this grid that it is for, of free edges

      real(dp), allocatable :: love(:, :)
      real(dp) :: per_wave(2), step(2)

      self%even = surface%shape%is_even()
      self%points = points
      if (present(part)) self%points = part
      ! Frequencies are times the stiffness below.
      self%kernel = surface%kernel%in_unit(surface%stiffness)
      self%is_free = surface%has_free_edges
      step = surface%length/(merge(2, 1, self%even)*points)
      if (points(2) == 1) step(2) = surface%length(2)
      self%stiffness_per_step = surface%stiffness/step
      ! Stiffness over wavelength: of the order of one in any unit of length.
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

   subroutine displacement_dp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(inout), contiguous :: field(:, :)   !! the own columns of the slab
      logical, intent(in), optional :: nonzero(:)   !! own columns that may not be zero; default: all
      logical, intent(in), optional :: wanted(:)    !! own columns of the result that are needed, others are undefined

      call self%in_double%apply(field, -1, threads_for(size(field)), nonzero, wanted)
      self%transform_pairs = self%transform_pairs + 1
   end subroutine displacement_dp

   !> As `displacement_dp`.
   subroutine displacement_sp(self, field, nonzero, wanted)
      class(compliance_operator), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)
      logical, intent(in), optional :: nonzero(:), wanted(:)

      call self%in_single%apply(field, -1, threads_for(size(field)), nonzero, wanted)
      self%transform_pairs = self%transform_pairs + 1
   end subroutine displacement_sp

   !> From a displacement [Delta] to its pressure p - pbar [p*] on a periodic surface, in place. Free edges have that of
   !> the mirror images.
   subroutine pressure(self, field)
      class(compliance_operator), intent(inout) :: self
      real(sp), intent(inout), contiguous :: field(:, :)   !! the own columns of the slab

      if (self%is_free) then
         call self%with_images%apply(field, 1, threads_for(size(field)))
      else
         call self%in_single%apply(field, 1, threads_for(size(field)))
      end if
      self%transform_pairs = self%transform_pairs + 1
   end subroutine pressure

end module wavycon_compliance_operator
