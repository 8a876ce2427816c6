!> Interfaces of those procedures of BLAS and LAPACK that are used. Names and arguments are the libraries' own; their
!> documentation describes them.
module wavycon_lapack
   use wavycon_kinds, only: dp, sp
   implicit none (type, external)
   private

   public :: ddot, dgemm, dgemv, drot, dtrsv, sdot                   ! BLAS
   public :: dgels, dgglse, dpotrf, dsyev                     ! LAPACK

   interface
      pure subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: dp
         character, intent(in) :: trans
         integer, intent(in) :: m, n, lda, incx, incy
         real(dp), intent(in) :: alpha, beta, a(lda, *), x(*)
         real(dp), intent(inout) :: y(*)
      end subroutine dgemv

      pure subroutine dtrsv(uplo, trans, diag, n, a, lda, x, incx)
         import :: dp
         character, intent(in) :: uplo, trans, diag
         integer, intent(in) :: n, lda, incx
         real(dp), intent(in) :: a(lda, *)
         real(dp), intent(inout) :: x(*)
      end subroutine dtrsv

      pure subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
         import :: dp
         character, intent(in) :: transa, transb
         integer, intent(in) :: m, n, k, lda, ldb, ldc
         real(dp), intent(in) :: alpha, beta, a(lda, *), b(ldb, *)
         real(dp), intent(inout) :: c(ldc, *)
      end subroutine dgemm

      pure subroutine dpotrf(uplo, n, a, lda, info)
         import :: dp
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(dp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf

      pure function ddot(n, x, incx, y, incy)
         import :: dp
         integer, intent(in) :: n, incx, incy
         real(dp), intent(in) :: x(*), y(*)
         real(dp) :: ddot
      end function ddot

      pure function sdot(n, x, incx, y, incy)
         import :: sp
         integer, intent(in) :: n, incx, incy
         real(sp), intent(in) :: x(*), y(*)
         real(sp) :: sdot
      end function sdot

      pure subroutine drot(n, x, incx, y, incy, c, s)
         import :: dp
         integer, intent(in) :: n, incx, incy
         real(dp), intent(inout) :: x(*), y(*)
         real(dp), intent(in) :: c, s
      end subroutine drot

      pure subroutine dgels(trans, m, n, nrhs, a, lda, b, ldb, work, lwork, info)
         import :: dp
         character, intent(in) :: trans
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
         real(dp), intent(inout) :: a(lda, *), b(ldb, *)
         real(dp), intent(out) :: work(*)
         integer, intent(out) :: info
      end subroutine dgels

      pure subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
         import :: dp
         character, intent(in) :: jobz, uplo
         integer, intent(in) :: n, lda, lwork
         real(dp), intent(inout) :: a(lda, *)
         real(dp), intent(out) :: w(*), work(*)
         integer, intent(out) :: info
      end subroutine dsyev

      pure subroutine dgglse(m, n, p, a, lda, b, ldb, c, d, x, work, lwork, info)
         import :: dp
         integer, intent(in) :: m, n, p, lda, ldb, lwork
         real(dp), intent(inout) :: a(lda, *), b(ldb, *), c(*), d(*)
         real(dp), intent(out) :: x(*), work(*)
         integer, intent(out) :: info
      end subroutine dgglse
   end interface

end module wavycon_lapack
