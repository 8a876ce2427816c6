!> The points at which the pressure must not be negative.
!>
!> N points, equally spaced on [0, pi] with both ends, in each direction: a grid that symmetry cuts down.
!> N = 27 gives the counts of Johnson, Greenwood & Higginson (1985): 729 points, 378 in the triangle
!> phi + theta <= pi, 196 in the triangle phi <= theta <= pi - phi between the crest, the trough and the saddle.
module wavycon_constraint_points
   use wavycon_constants, only: pi
   use wavycon_fourier_terms, only: fourier_terms, symmetry_diagonal, symmetry_full
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: choose_points, term_values

contains

   !> Grid numbers of the constraint points: phi = pi k/(N-1), theta = pi l/(N-1).
   pure subroutine choose_points(dimension, points_per_side, symmetry, k, l)
      integer, intent(in) :: dimension                !! 1 or 2
      integer, intent(in) :: points_per_side          !! N >= 2
      integer, intent(in) :: symmetry                 !! as the terms'; no matter in 1-D
      integer, allocatable, intent(out) :: k(:), l(:) !! in 0 .. N-1; l = 0 in 1-D

      integer :: p, q, last, passes, count

      last = points_per_side - 1
      do passes = 1, 2
         count = 0
         do q = 0, merge(last, 0, dimension == 2)
            do p = 0, last
               if (dimension == 2) then
                  if (symmetry /= symmetry_diagonal .and. symmetry /= symmetry_full) then
                     continue
                  else if (p + q > last) then
                     cycle
                  else if (symmetry == symmetry_full .and. p > q) then
                     cycle
                  end if
               end if
               count = count + 1
               if (passes == 2) then
                  k(count) = p
                  l(count) = q
               end if
            end do
         end do
         if (passes == 1) allocate (k(count), l(count))
      end do
   end subroutine choose_points

   !> The terms' values at the points: the constraint matrix of eqs. (18), (27), transposed.
   pure function term_values(terms, points_per_side, k, l) result(values)
      type(fourier_terms), intent(in) :: terms
      integer, intent(in) :: points_per_side          !! N
      integer, intent(in) :: k(:), l(:)               !! points, shape (m)
      real(dp), allocatable :: values(:, :)           !! shape (terms%count(), m)

      real(dp) :: cosine(0:terms%harmonics, 0:points_per_side - 1)
      integer :: i, j, p, t

      do p = 0, points_per_side - 1
         do i = 0, terms%harmonics
            ! The angle is reduced in whole numbers: cos is then as exact at i = 60 as at 1, and symmetric.
            cosine(i, p) = cosine_of_part(mod(i*p, 2*(points_per_side - 1)), points_per_side - 1)
         end do
      end do
      allocate (values(terms%count(), size(k)))
      do p = 1, size(k)
         do t = 1, terms%count()
            i = terms%i(t)
            j = terms%j(t)
            values(t, p) = cosine(i, k(p))*cosine(j, l(p))
            if (terms%paired(t)) values(t, p) = values(t, p) + cosine(j, k(p))*cosine(i, l(p))
         end do
      end do
   end function term_values

   !> cos(pi a/b), 0 <= a < 2b, with the symmetries of the cosine kept to the last bit.
   pure real(dp) function cosine_of_part(a, b) result(c)
      integer, intent(in) :: a, b

      integer :: q

      q = min(a, 2*b - a)
      if (2*q == b) then
         c = 0.0_dp
      else if (2*q < b) then
         c = cos(pi*q/b)
      else
         c = -cos(pi*(b - q)/b)
      end if
   end function cosine_of_part

end module wavycon_constraint_points
