!> The convex quadratic programme  minimise 1/2 x'Dx - c'x  subject to  Cx >= b,  D diagonal, and its
!> solution.
module wavycon_qp_problem
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dgemv
   implicit none (type, external)
   private

   public :: qp_problem, qp_solution, row_products

   !> How a solver ended.
   integer, parameter, public :: qp_converged = 0
   integer, parameter, public :: qp_iteration_limit = 1
   integer, parameter, public :: qp_inaccurate = 2   !! the KKT residual exceeds its tolerance

   !> A faster way to Cx than by the elements of C.
   type, abstract :: row_products
   contains
      procedure(products), deferred :: of
   end type row_products

   abstract interface
      !> Cx.
      subroutine products(self, x, values)
         import :: dp, row_products
         class(row_products), intent(in) :: self
         real(dp), intent(in) :: x(:)         !! shape (n)
         real(dp), intent(out) :: values(:)   !! shape (m)
      end subroutine products
   end interface

   !> A problem of n unknowns and m constraints.
   type :: qp_problem
      real(dp), allocatable :: hessian(:)     !! the diagonal of D, all > 0, shape (n)
      real(dp), allocatable :: linear(:)      !! c, shape (n)
      real(dp), allocatable :: normals(:, :)  !! C': column i is the gradient of constraint i, shape (n, m)
      real(dp), allocatable :: bounds(:)      !! b, shape (m)
      class(row_products), allocatable :: rows   !! C as an operator, if that is faster
   contains
      procedure :: slacks
   end type qp_problem

   !> Its solution.
   type :: qp_solution
      integer :: status = qp_iteration_limit   !! one of the names above
      integer :: pivots = 0                    !! number of exchanges of variables
      real(dp) :: kkt_residual = huge(1.0_dp)  !! largest relative violation of the KKT conditions
      real(dp), allocatable :: x(:)            !! shape (n)
      integer, allocatable :: active(:)        !! the active constraints, which hold with equality, shape (k)
      real(dp), allocatable :: multipliers(:)  !! of the active constraints, in the same order, shape (k)
   end type qp_solution

contains

   !> Cx - b, by the fastest way there is.
   subroutine slacks(self, x, values)
      class(qp_problem), intent(in) :: self
      real(dp), intent(in), contiguous :: x(:)          !! shape (n)
      real(dp), intent(out), contiguous :: values(:)    !! shape (m)

      if (allocated(self%rows)) then
         call self%rows%of(x, values)
         values = values - self%bounds
      else
         values = -self%bounds
         call dgemv('T', size(x), size(values), 1.0_dp, self%normals, size(x), x, 1, 1.0_dp, values, 1)
      end if
   end subroutine slacks

end module wavycon_qp_problem
