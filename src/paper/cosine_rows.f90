!> The pressures at the constraint points by sums over one direction after the other. For n harmonics and N points a
!> side these take of the order of n N^2 operations, the product with the matrix of the constraints n^2 N^2. And the
!> matrix of weighted sums of squares of the constraints, by such sums too.
module wavycon_cosine_rows
   use wavycon_cosine_table, only: cosine_table
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: fourier_terms
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: cosine_rows

   type :: cosine_rows
      type(fourier_terms) :: terms
      integer :: points_per_side = 0          !! N
      integer, allocatable :: k(:), l(:)      !! the points as chosen by `choose_points`, shape (m)
   contains
      procedure :: of, squares
   end type cosine_rows

contains

   !> sum_k x_k t_k at the points; the same with the opposite sign follows if `values` is twice as long.
   subroutine of(self, x, values)
      class(cosine_rows), intent(in) :: self
      real(dp), intent(in) :: x(:)         !! amplitudes of the terms
      real(dp), intent(out) :: values(:)   !! shape (m) or (2 m)

      type(fourier_series) :: series
      real(dp), allocatable :: grid(:, :)
      integer :: p

      call self%terms%coefficients(x, series%c)
      call series%evaluate_on_grid(self%points_per_side - 1, grid)
      do p = 1, size(self%k)
         values(p) = grid(self%k(p), self%l(p))
      end do
      if (size(values) > size(self%k)) values(size(self%k) + 1:) = -values(:size(self%k))
   end subroutine of

   !> The lower triangle of C'WC with a diagonal W: by cos a cos b = (cos(a + b) + cos(a - b))/2 its elements follow
   !> from the sums of W times cosines of up to 2n, (Q14).
   subroutine squares(self, weights, matrix)
      class(cosine_rows), intent(in) :: self
      real(dp), intent(in) :: weights(:)           !! the diagonal of W, shape (m) or (2 m)
      real(dp), intent(out) :: matrix(:, :)        !! shape (n, n)

      real(dp) :: cosines(0:self%points_per_side - 1, 0:2*self%terms%harmonics), factor(self%terms%count)
      real(dp) :: grid(0:self%points_per_side - 1, 0:self%points_per_side - 1)
      real(dp), dimension(0:2*self%terms%harmonics, 0:2*self%terms%harmonics) :: t   ! the sums of W cos cos, over 4
      logical :: has_pairs
      integer :: a, b, p

      grid = 0.0_dp
      do p = 1, size(self%k)
         grid(self%k(p), self%l(p)) = 0.25_dp*sum(weights(p::size(self%k)))
      end do
      cosines = cosine_table(self%points_per_side - 1, 2*self%terms%harmonics)
      t = matmul(transpose(cosines), matmul(grid, cosines))
      has_pairs = any(self%terms%paired)
      if (has_pairs) t = t + transpose(t)
      ! The sums over both orders of i and j count a term twice that has only one.
      factor = merge(0.5_dp, 1.0_dp, has_pairs .and. .not. self%terms%paired)
      associate (i => self%terms%i, j => self%terms%j)
         do b = 1, size(factor)
            do a = b, size(factor)
               matrix(a, b) = four_sums(i(a), j(a), i(b), j(b))
               if (has_pairs) matrix(a, b) = factor(a)*factor(b)*(matrix(a, b) + four_sums(i(a), j(a), j(b), i(b)))
            end do
         end do
      end associate

   contains

      pure real(dp) function four_sums(i, j, k, l)
         integer, intent(in) :: i, j, k, l   !! wave numbers

         four_sums = t(i + k, j + l) + t(abs(i - k), j + l) + t(i + k, abs(j - l)) + t(abs(i - k), abs(j - l))
      end function four_sums

   end subroutine squares

end module wavycon_cosine_rows
