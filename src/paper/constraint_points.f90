!> The points at which the pressure must not be negative, and the pressure there as a function of the amplitudes of the
!> terms.
!>
!> N points, equally spaced on [0, pi] with both ends, in each direction: a grid that symmetry reduces.
!> N = 27 gives the counts of Johnson, Greenwood & Higginson (1985): 729 points, 378 in the triangle
!> phi + theta <= pi, 196 in the triangle phi <= theta <= pi - phi between the crest, the trough and the saddle.
module wavycon_constraint_points
   use wavycon_cosine_table, only: cosine_table
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

      logical, allocatable :: is_kept(:)
      integer :: last(2), p, q

      last = [points_per_side - 1, merge(points_per_side - 1, 0, dimension == 2)]
      k = [((p, p=0, last(1)), q=0, last(2))]
      l = [((q, p=0, last(1)), q=0, last(2))]
      is_kept = dimension == 1 .or. symmetry == symmetry_none .or. &
                (k + l <= last(1) .and. (symmetry /= symmetry_full .or. k <= l))
      k = pack(k, is_kept)
      l = pack(l, is_kept)
   end subroutine choose_points

   !> The terms' values at the points: the constraint matrix of eqs. (18), (27), transposed.
   pure function term_values(terms, points_per_side, k, l) result(values)
      type(fourier_terms), intent(in) :: terms
      integer, intent(in) :: points_per_side          !! N
      integer, intent(in) :: k(:), l(:)               !! points, shape (m)
      real(dp), allocatable :: values(:, :)           !! shape (terms%count, m)

      real(dp) :: cosine(0:points_per_side - 1, 0:terms%harmonics)
      integer :: i, j, p, t

      cosine = cosine_table(points_per_side - 1, terms%harmonics)
      allocate (values(terms%count, size(k)))
      do p = 1, size(k)
         do t = 1, terms%count
            i = terms%i(t)
            j = terms%j(t)
            values(t, p) = cosine(k(p), i)*cosine(l(p), j)
            if (terms%paired(t)) values(t, p) = values(t, p) + cosine(k(p), j)*cosine(l(p), i)
         end do
      end do
   end function term_values

end module wavycon_constraint_points
