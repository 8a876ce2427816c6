!> The elastic half-space on a periodic grid: displacement from pressure and back, by FFTW.
!>
!> A harmonic of wavelength w has  p = stiffness u/w  (Johnson, Greenwood & Higginson 1985, App. 1). All surfaces so far
!> mirror themselves at the middle lines of their cell, and so do pressure and gap: a quarter of it is enough, with M x N
!> points at X = pi (i - 1/2)/M, Y = pi (j - 1/2)/N, on which an even field is a sum of cosines (DCT-II and III). N = 1 is
!> a 1-D wave.
module wavycon_compliance_operator
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int, c_null_ptr, c_ptr
   use wavycon_fftw, only: fftw_destroy_plan, FFTW_ESTIMATE, fftw_execute_r2r, fftw_plan_r2r_2d, FFTW_REDFT01, &
                           FFTW_REDFT10
   use wavycon_harmonic_surface, only: harmonic_surface
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: compliance_operator, cosine_coefficients

   type :: compliance_operator
      integer :: transform_pairs = 0                     !! made so far
      real(dp), allocatable, private :: stiffness(:, :)  !! of cos((i-1) X) cos((j-1) Y) and the transforms' own factor
      real(dp), allocatable, private :: compliance(:, :) !! likewise; zero for the mean
      real(c_double), allocatable, private :: field(:, :), spectrum(:, :)
      type(c_ptr), private :: forward = c_null_ptr, backward = c_null_ptr
   contains
      procedure :: start
      procedure :: displacement
      procedure :: pressure
      procedure, private :: apply
      final :: finish
   end type compliance_operator

contains

   subroutine start(self, surface, m, n)
      class(compliance_operator), intent(inout) :: self   !! not started before
      type(harmonic_surface), intent(in) :: surface
      integer, intent(in) :: m, n                         !! points of the quarter cell

      real(dp) :: factor
      integer :: i, j

      allocate (self%stiffness(m, n), self%compliance(m, n), self%field(m, n), self%spectrum(m, n))
      factor = 1.0_dp/(4.0_dp*m*n)
      do j = 1, n
         do i = 1, m
            self%stiffness(i, j) = surface%stiffness*surface%frequency(i - 1, j - 1)
         end do
      end do
      self%compliance = 0.0_dp
      where (self%stiffness > 0.0_dp) self%compliance = factor/self%stiffness
      self%stiffness = factor*self%stiffness
      associate (f => self%field, s => self%spectrum, rows => int(n, c_int), columns => int(m, c_int))
         self%forward = fftw_plan_r2r_2d(rows, columns, f, s, FFTW_REDFT10, FFTW_REDFT10, FFTW_ESTIMATE)
         self%backward = fftw_plan_r2r_2d(rows, columns, s, f, FFTW_REDFT01, FFTW_REDFT01, FFTW_ESTIMATE)
      end associate
   end subroutine start

   !> u - ubar of a pressure.
   subroutine displacement(self, p, u)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(in) :: p(:, :)    !! [p*], shape (m, n)
      real(dp), intent(out) :: u(:, :)   !! [Delta]

      call self%apply(self%compliance, p, u)
   end subroutine displacement

   !> p - pbar of a displacement.
   subroutine pressure(self, u, p)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(in) :: u(:, :)    !! [Delta], shape (m, n)
      real(dp), intent(out) :: p(:, :)   !! [p*]

      call self%apply(self%stiffness, u, p)
   end subroutine pressure

   subroutine apply(self, symbol, from, to)
      class(compliance_operator), intent(inout) :: self
      real(dp), intent(in) :: symbol(:, :), from(:, :)
      real(dp), intent(out) :: to(:, :)

      self%field = from
      call fftw_execute_r2r(self%forward, self%field, self%spectrum)
      self%spectrum = self%spectrum*symbol
      call fftw_execute_r2r(self%backward, self%spectrum, self%field)
      to = self%field
      self%transform_pairs = self%transform_pairs + 1
   end subroutine apply

   !> The coefficients c(i, j) of sum_ij c(i, j) cos(i X) cos(j Y) that takes given values on the points.
   subroutine cosine_coefficients(values, c)
      real(dp), intent(in) :: values(:, :)               !! shape (m, n)
      real(dp), allocatable, intent(out) :: c(:, :)      !! shape (0:m-1, 0:n-1)

      real(c_double), allocatable :: field(:, :), spectrum(:, :)
      type(c_ptr) :: plan
      integer :: m, n

      m = size(values, 1)
      n = size(values, 2)
      allocate (field(m, n), spectrum(m, n), c(0:m - 1, 0:n - 1))
      plan = fftw_plan_r2r_2d(int(n, c_int), int(m, c_int), field, spectrum, FFTW_REDFT10, FFTW_REDFT10, FFTW_ESTIMATE)
      field = values
      call fftw_execute_r2r(plan, field, spectrum)
      call fftw_destroy_plan(plan)
      c = spectrum/(real(m, dp)*n)
      c(0, :) = 0.5_dp*c(0, :)
      c(:, 0) = 0.5_dp*c(:, 0)
   end subroutine cosine_coefficients

   subroutine finish(self)
      type(compliance_operator), intent(inout) :: self

      if (c_associated(self%forward)) call fftw_destroy_plan(self%forward)
      if (c_associated(self%backward)) call fftw_destroy_plan(self%backward)
      self%forward = c_null_ptr
      self%backward = c_null_ptr
   end subroutine finish

end module wavycon_compliance_operator
