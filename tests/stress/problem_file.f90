!> Quadratic programmes as text files, from which a failing case can be run again.
!>
!> Numbers separated by blanks or line ends: n, m, then D row by row, c, the normal of each constraint, b, and the
!> bounds of the second solution.
module stress_problem_file
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: write_problem, read_problem

   !> 17 digits, which restore every double precision number exactly.
   character(*), parameter :: layout = '(*(es25.16e3))'

contains

   subroutine write_problem(path, problem, start_bounds)
      character(*), intent(in) :: path
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: start_bounds(:)   !! b of the first solution, shape (m)

      integer :: i, unit

      open (newunit=unit, file=path, action='write', status='replace')
      write (unit, '(i0, 1x, i0)') size(problem%linear), size(problem%bounds)
      do i = 1, size(problem%linear)
         write (unit, layout) problem%hessian(i, :)
      end do
      write (unit, layout) problem%linear
      do i = 1, size(problem%bounds)
         write (unit, layout) problem%normals(:, i)
      end do
      write (unit, layout) start_bounds
      write (unit, layout) problem%bounds
      close (unit)
   end subroutine write_problem

   subroutine read_problem(path, problem, start_bounds)
      character(*), intent(in) :: path
      type(qp_problem), intent(out) :: problem
      real(dp), allocatable, intent(out) :: start_bounds(:)

      integer :: i, m, n, unit

      open (newunit=unit, file=path, action='read', status='old')
      read (unit, *) n, m
      allocate (problem%hessian(n, n), problem%linear(n), problem%normals(n, m), problem%bounds(m), start_bounds(m))
      read (unit, *) (problem%hessian(i, :), i=1, n), problem%linear, problem%normals, start_bounds, problem%bounds
      close (unit)
   end subroutine read_problem

end module stress_problem_file
