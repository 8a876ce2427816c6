!> Computes the pressure at the constraint points from the amplitudes of the terms, by sums over one direction after the
!> other. For n harmonics and N points a side they take of the order of n N^2 operations; the product with the matrix of
!> terms and points takes n^2 N^2.
module wavycon_cosine_rows
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: fourier_terms
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: row_products
   implicit none (type, external)
   private

   public :: cosine_rows

   type, extends(row_products) :: cosine_rows
      type(fourier_terms) :: terms
      integer :: points_per_side = 0          !! N
      integer, allocatable :: k(:), l(:)      !! the points as chosen by `choose_points`, shape (m)
   contains
      procedure :: of
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

end module wavycon_cosine_rows
