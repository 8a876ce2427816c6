!> Kalker's principle for a wavy surface, as a quadratic programme.
!>
!> The pressure p >= 0 of the given mean minimises the complementary energy (Johnson, Greenwood & Higginson 1985, eqs.
!> 1, 2). Up to a constant and a factor this energy is, in the amplitudes x_k of the Fourier terms (E6), (E7),
!>
!>     F' = 1/2 sum_k w_k gamma_k x_k^2 - x_1    (eqs. 17, 26)   with   sum_k x_k t_k >= -P at the points (18, 27),
!>
!> w_k the weight, gamma_k the compliance of term t_k, x_1 the amplitude of the term of the surface's shape.
!> The unconstrained minimum x_1 = 1 is full contact.
!>
!> N.B. The paper has no hardness. A hardness H, the largest pressure, adds  -sum_k x_k t_k >= P - H.
!>
!> Numbers (E..) are the equations of README.md in this directory.
module wavycon_complementary_energy
   use wavycon_constraint_points, only: choose_points, term_values
   use wavycon_cosine_rows, only: cosine_rows
   use wavycon_fourier_terms, only: fourier_terms
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: bounds_at, energy_problem

   !> With more elements the products with the matrix of the constraints take longer than sums by `cosine_rows`.
   integer, parameter :: largest_matrix = 500000

contains

   !> The quadratic programme of some terms at zero load. Its bounds are b = 0, at the load P they are b = -P. With a
   !> hardness as many more constraints follow, with b = P - H: `bounds_at` has all bounds.
   type(qp_problem) function energy_problem(terms, points_per_side, symmetry, has_hardness) result(problem)
      type(fourier_terms), intent(in) :: terms
      integer, intent(in) :: points_per_side   !! N >= 2 constraint points on [0, pi]
      integer, intent(in) :: symmetry          !! that of the terms
      logical, intent(in) :: has_hardness

      integer, allocatable :: k(:), l(:)

      allocate (problem%hessian, source=terms%weight*terms%compliance)
      allocate (problem%linear(terms%count), source=0.0_dp)
      problem%linear(terms%fundamental) = 1.0_dp
      call choose_points(terms%dimension, points_per_side, symmetry, k, l)
      problem%normals = term_values(terms, points_per_side, k, l)
      if (terms%dimension == 2 .and. size(problem%normals) > largest_matrix) &
         problem%rows = cosine_rows(terms, points_per_side, k, l)
      if (has_hardness) problem%normals = reshape([problem%normals, -problem%normals], [terms%count, 2*size(k)])
      allocate (problem%bounds(size(problem%normals, 2)), source=0.0_dp)
   end function energy_problem

   !> The bounds b of a problem at a load.
   pure function bounds_at(problem, pbar_over_pstar, hardness) result(bounds)
      type(qp_problem), intent(in) :: problem      !! of energy_problem
      real(dp), intent(in) :: pbar_over_pstar      !! P
      real(dp), intent(in) :: hardness             !! H/p*, huge if the problem has none
      real(dp) :: bounds(size(problem%bounds))

      bounds = -pbar_over_pstar
      if (hardness < huge(hardness)) bounds(size(bounds)/2 + 1:) = pbar_over_pstar - hardness
   end function bounds_at

end module wavycon_complementary_energy
