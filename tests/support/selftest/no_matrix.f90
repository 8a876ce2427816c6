!> pFUnit's assertTrue and assertFalse take no array of rank 2: this must not compile.
subroutine no_matrix(matrix)
   use funit
   implicit none (type, external)
   logical, intent(in) :: matrix(2, 2)

   call ASSERTION(matrix, location=SourceLocation('no_matrix.f90', 1))
end subroutine no_matrix
