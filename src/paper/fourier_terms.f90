!> The terms of the pressure's Fourier series that symmetry does not make zero or equal.
!>
!> 1-D (Johnson, Greenwood & Higginson 1985, eq. 12):  (p - pbar)/p* = sum_i A_i cos(i phi),  i = 1..n.
!> 2-D (eq. 25):  (p - pbar)/p* = sum_ij A_ij cos(i phi) cos(j theta),  i, j = 0..n,  A_00 = 0. The symmetry
!>    'none'      keeps all terms,
!>    'diagonal'  keeps those with i + j even: phi, theta -> pi - phi, pi - theta leaves the surface as it is,
!>    'full'      also sets A_ij = A_ji: one unknown stands for both.
module wavycon_fourier_terms
   use wavycon_kinds, only: dp, sqrt2
   implicit none (type, external)
   private

   public :: fourier_terms, choose_terms

   !> The symmetry that is used.
   integer, parameter, public :: symmetry_none = 0, symmetry_diagonal = 1, symmetry_full = 2

   !> Terms k = 1..count. Term k is cos(i phi) cos(j theta), and the same with i and j exchanged where `paired`.
   type :: fourier_terms
      integer :: dimension = 2
      integer :: harmonics = 0              !! n
      integer :: count = 0                  !! number of unknowns
      integer :: fundamental = 0            !! the term that has the shape of the surface: cos phi, or cos phi cos theta
      integer, allocatable :: i(:), j(:)    !! wave numbers in phi and theta; j = 0 in 1-D
      logical, allocatable :: paired(:)     !! the term stands for A_ij and A_ji
      !> Displacement over pressure of a term [Delta/p*]: 1/i in 1-D (eq. 13), sqrt2/(i^2 + j^2)^1/2 in 2-D (A10).
      real(dp), allocatable :: compliance(:)
      !> Mean square of a term over the cell, over that of the surface's own wave (E5): doubled where i or j is zero
      !> (the star of eq. 26), doubled again where the term stands for two.
      real(dp), allocatable :: weight(:)
   contains
      procedure :: coefficients
   end type fourier_terms

contains

   !> The terms for a dimension, a highest harmonic and a symmetry.
   pure type(fourier_terms) function choose_terms(dimension, harmonics, symmetry) result(terms)
      integer, intent(in) :: dimension  !! 1 or 2
      integer, intent(in) :: harmonics  !! n >= 1
      integer, intent(in) :: symmetry   !! one of the names above; not used in 1-D

      integer, dimension((harmonics + 1)**dimension) :: all_i, all_j
      logical :: is_kept((harmonics + 1)**dimension)
      integer :: i, j, last

      last = merge(harmonics, 0, dimension == 2)
      all_i = [((i, j=0, last), i=0, harmonics)]
      all_j = [((j, j=0, last), i=0, harmonics)]
      is_kept = all_i + all_j > 0
      if (dimension == 2 .and. symmetry /= symmetry_none) is_kept = is_kept .and. mod(all_i + all_j, 2) == 0
      if (dimension == 2 .and. symmetry == symmetry_full) is_kept = is_kept .and. all_i <= all_j
      terms%dimension = dimension
      terms%harmonics = harmonics
      terms%count = count(is_kept)
      allocate (terms%i, source=pack(all_i, is_kept))
      allocate (terms%j, source=pack(all_j, is_kept))
      allocate (terms%paired, source=dimension == 2 .and. symmetry == symmetry_full .and. terms%i /= terms%j)
      terms%fundamental = findloc(terms%i == 1 .and. terms%j == dimension - 1, .true., dim=1)
      allocate (terms%compliance, source=merge(sqrt2, 1.0_dp, dimension == 2)/ &
                                         hypot(real(terms%i, dp), real(terms%j, dp)))
      allocate (terms%weight, source=real(merge(2, 1, dimension == 2 .and. (terms%i == 0 .or. terms%j == 0))* &
                                          merge(2, 1, terms%paired), dp))
   end function choose_terms

   !> A_ij of all i, j = 0..n (j = 0 alone in 1-D), from the values of the terms.
   pure subroutine coefficients(self, values, a)
      class(fourier_terms), intent(in) :: self
      real(dp), intent(in) :: values(:)                  !! shape (count)
      real(dp), allocatable, intent(out) :: a(:, :)      !! a(i, j), shape (0:n, 0:n) in 2-D, (0:n, 0:0) in 1-D

      integer :: k

      allocate (a(0:self%harmonics, 0:merge(self%harmonics, 0, self%dimension == 2)), source=0.0_dp)
      do k = 1, size(values)
         a(self%i(k), self%j(k)) = values(k)
         if (self%paired(k)) a(self%j(k), self%i(k)) = values(k)
      end do
   end subroutine coefficients

end module wavycon_fourier_terms
