!> The points at which the pressure must not be negative.
!>
!> N points, equally spaced on [0, pi] with both ends, in each direction: a grid that symmetry reduces.
!> N = 27 gives the counts of Johnson, Greenwood & Higginson (1985): 729 points, 378 in the triangle
!> phi + theta <= pi, 196 in the triangle phi <= theta <= pi - phi between the crest, the trough and the saddle.
module wavycon_constraint_points
   use wavycon_fourier_series, only: cosine_table
   use wavycon_fourier_terms, only: fourier_terms, symmetry_full, symmetry_none
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: choose_points, term_values

contains

   !> Grid numbers of the constraint points: phi = pi k/(N-1), theta = pi l/(N-1).
   pure subroutine choose_points(dimension, points_per_side, symmetry, k, l)
      integer, intent(in) :: dimension                !! 1 or 2
      integer, intent(in) :: points_per_side          !! N >= 2
      integer, intent(in) :: symmetry                 !! that of the terms; not used in 1-D
      integer, allocatable, intent(out) :: k(:), l(:) !! in 0 .. N-1; l = 0 in 1-D

      integer :: all_k(points_per_side**dimension), all_l(points_per_side**dimension)
      integer :: p, q, last, count

      last = points_per_side - 1
      count = 0
      do q = 0, merge(last, 0, dimension == 2)
         do p = 0, last
            if (dimension == 2 .and. symmetry /= symmetry_none .and. p + q > last) cycle
            if (dimension == 2 .and. symmetry == symmetry_full .and. p > q) cycle
            count = count + 1
            all_k(count) = p
            all_l(count) = q
         end do
      end do
      allocate (k, source=all_k(:count))
      allocate (l, source=all_l(:count))
   end subroutine choose_points

   !> The terms' values at the points: the constraint matrix of eqs. (18), (27), transposed.
   pure function term_values(terms, points_per_side, k, l) result(values)
      type(fourier_terms), intent(in) :: terms
      integer, intent(in) :: points_per_side          !! N
      integer, intent(in) :: k(:), l(:)               !! points, shape (m)
      real(dp), allocatable :: values(:, :)           !! shape (terms%count(), m)

      real(dp) :: cosine(0:points_per_side - 1, 0:terms%harmonics)
      integer :: i, j, p, t

      cosine = cosine_table(points_per_side - 1, terms%harmonics)
      allocate (values(terms%count(), size(k)))
      do p = 1, size(k)
         do t = 1, terms%count()
            i = terms%i(t)
            j = terms%j(t)
            values(t, p) = cosine(k(p), i)*cosine(l(p), j)
            if (terms%paired(t)) values(t, p) = values(t, p) + cosine(k(p), j)*cosine(l(p), i)
         end do
      end do
   end function term_values

end module wavycon_constraint_points
