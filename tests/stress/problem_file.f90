!> Quadratic programmes as text files, from which a failing case can be run again.
!>
!> Numbers separated by blanks or line ends: n, m, then the diagonal of D, c, the normal of each constraint, and b.
module stress_problem_file
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: write_problem, read_problem

   !> 17 digits, which restore every double precision number exactly.
   character(*), parameter :: layout = '(*(es25.16e3))'

contains

   subroutine write_problem(path, problem)
      character(*), intent(in) :: path
      type(qp_problem), intent(in) :: problem

      integer :: i, unit

      open (newunit=unit, file=path, action='write', status='replace')
      write (unit, '(i0, 1x, i0)') size(problem%linear), size(problem%bounds)
      write (unit, layout) problem%hessian
      write (unit, layout) problem%linear
      do i = 1, size(problem%bounds)
         write (unit, layout) problem%normals(:, i)
      end do
      write (unit, layout) problem%bounds
      close (unit)
   end subroutine write_problem

   subroutine read_problem(path, problem)
      character(*), intent(in) :: path
      type(qp_problem), intent(out) :: problem

      integer :: m, n, unit

      open (newunit=unit, file=path, action='read', status='old')
      read (unit, *) n, m
      allocate (problem%hessian(n), problem%linear(n), problem%normals(n, m), problem%bounds(m))
      read (unit, *) problem%hessian, problem%linear, problem%normals, problem%bounds
      close (unit)
   end subroutine read_problem

end module stress_problem_file
