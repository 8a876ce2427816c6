!> Interfaces of those procedures of BLAS and LAPACK that are used. Names and arguments are the libraries' own; their
!> documentation describes them. Their double precision is the kind dp, and their real is the kind sp.
module wavycon_lapack
   implicit none (type, external)
   private

   public :: ddot, dgemm, dgemv, drot, dtrsv, sdot                   ! BLAS
   public :: dgels, dgglse, dpotrf, dsyev                     ! LAPACK

   interface
      pure subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
         character, intent(in) :: trans
         integer, intent(in) :: m, n, lda, incx, incy
         double precision, intent(in) :: alpha, beta, a(lda, *), x(*)
         double precision, intent(inout) :: y(*)
      end subroutine dgemv

      pure subroutine dtrsv(uplo, trans, diag, n, a, lda, x, incx)
         character, intent(in) :: uplo, trans, diag
         integer, intent(in) :: n, lda, incx
         double precision, intent(in) :: a(lda, *)
         double precision, intent(inout) :: x(*)
      end subroutine dtrsv

      pure subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
         character, intent(in) :: transa, transb
         integer, intent(in) :: m, n, k, lda, ldb, ldc
         double precision, intent(in) :: alpha, beta, a(lda, *), b(ldb, *)
         double precision, intent(inout) :: c(ldc, *)
      end subroutine dgemm

      pure subroutine dpotrf(uplo, n, a, lda, info)
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         double precision, intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf

      pure function ddot(n, x, incx, y, incy)
         integer, intent(in) :: n, incx, incy
         double precision, intent(in) :: x(*), y(*)
         double precision :: ddot
      end function ddot

      pure function sdot(n, x, incx, y, incy)
         integer, intent(in) :: n, incx, incy
         real, intent(in) :: x(*), y(*)
         real :: sdot
      end function sdot

      pure subroutine drot(n, x, incx, y, incy, c, s)
         integer, intent(in) :: n, incx, incy
         double precision, intent(inout) :: x(*), y(*)
         double precision, intent(in) :: c, s
      end subroutine drot

      pure subroutine dgels(trans, m, n, nrhs, a, lda, b, ldb, work, lwork, info)
         character, intent(in) :: trans
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
         double precision, intent(inout) :: a(lda, *), b(ldb, *)
         double precision, intent(out) :: work(*)
         integer, intent(out) :: info
      end subroutine dgels

      pure subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
         character, intent(in) :: jobz, uplo
         integer, intent(in) :: n, lda, lwork
         double precision, intent(inout) :: a(lda, *)
         double precision, intent(out) :: w(*), work(*)
         integer, intent(out) :: info
      end subroutine dsyev

      pure subroutine dgglse(m, n, p, a, lda, b, ldb, c, d, x, work, lwork, info)
         integer, intent(in) :: m, n, p, lda, ldb, lwork
         double precision, intent(inout) :: a(lda, *), b(ldb, *), c(*), d(*)
         double precision, intent(out) :: x(*), work(*)
         integer, intent(out) :: info
      end subroutine dgglse
   end interface

end module wavycon_lapack
