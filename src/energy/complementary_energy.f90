!> Kalker's principle for a wavy surface, as a quadratic programme.
!>
!> The pressure p >= 0 of the given mean minimises the complementary energy (Johnson, Greenwood & Higginson 1985,
!> eqs. 1, 2). But for a constant and a factor it is, in the amplitudes x_k of the Fourier terms (E6), (E7),
!>
!>     f' = 1/2 sum_k w_k c_k x_k^2 - x_1    (eqs. 17, 26)   with   sum_k x_k t_k >= -P at the points (18, 27),
!>
!> w_k the weight, c_k the compliance of term t_k, x_1 the amplitude of the term of the surface's shape.
!> The unconstrained minimum x_1 = 1 is full contact. Numbers (E..) are the equations of README.md in this directory.
module wavycon_complementary_energy
   use wavycon_constraint_points, only: choose_points, term_values
   use wavycon_cosine_rows, only: cosine_rows
   use wavycon_fourier_terms, only: fourier_terms
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: energy_problem

   !> With more elements the products with the matrix of the constraints take longer than those by `cosine_rows`.
   integer, parameter :: largest_matrix = 500000

contains

   !> The quadratic programme of some terms at zero load. Its bounds are b = 0, at the load P they are b = -P.
   type(qp_problem) function energy_problem(terms, points_per_side, symmetry) result(problem)
      type(fourier_terms), intent(in) :: terms
      integer, intent(in) :: points_per_side   !! N >= 2 constraint points on [0, pi]
      integer, intent(in) :: symmetry          !! that of the terms

      integer, allocatable :: k(:), l(:)
      integer :: t, n

      n = terms%count()
      allocate (problem%hessian(n, n), problem%linear(n), source=0.0_dp)
      do t = 1, n
         problem%hessian(t, t) = terms%weight(t)*terms%compliance(t)
      end do
      problem%linear = 0.0_dp
      problem%linear(terms%fundamental()) = 1.0_dp
      call choose_points(terms%dimension, points_per_side, symmetry, k, l)
      problem%normals = term_values(terms, points_per_side, k, l)
      allocate (problem%bounds(size(k)), source=0.0_dp)
      if (terms%dimension == 2 .and. size(problem%normals) > largest_matrix) &
         allocate (problem%rows, source=cosine_rows(terms, points_per_side, k, l))
   end function energy_problem

end module wavycon_complementary_energy
