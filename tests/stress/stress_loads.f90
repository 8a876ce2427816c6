!> Solves the paper's quadratic programmes from full contact down to nearly no load, as the solvers 'beale' and 'series'
!> do, and checks every solution in quadruple precision. Prints a line for each load: the load, the verdict, the status,
!> the largest residual.
!>
!> usage: stress_loads SOLVER DIMENSION HARMONICS POINTS SYMMETRY
program stress_loads
   use command_words, only: number, word
   use stress_kkt_in_quad, only: check_in_quad, kkt_type
   use wavycon_beale, only: solve_by_beale
   use wavycon_complementary_energy, only: energy_problem
   use wavycon_dual_solver, only: dual_solver
   use wavycon_fourier_terms, only: choose_terms, fourier_terms, symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged
   use wavycon_solution_record, only: status_name, status_of_programme
   implicit none (type, external)

   !> The library's tolerance for the status converged (kkt_tolerance).
   real(dp), parameter :: promised_residual = 1e-12_dp
   !> Nearly full contact, partial contact, and nearly none.
   real(dp), parameter :: loads(*) = [ &
      1 - 1e-12_dp, 1 - 1e-9_dp, 1 - 1e-6_dp, 1 - 1e-3_dp, 0.99_dp, 0.9_dp, 0.7_dp, 0.5_dp, 0.3_dp, 0.2_dp, 0.1_dp, &
      1e-2_dp, 1e-3_dp, 1e-4_dp, 1e-6_dp, 1e-8_dp, 1e-10_dp, 1e-12_dp]

   type(dual_solver) :: solver
   type(fourier_terms) :: terms
   type(kkt_type) :: kkt
   type(qp_problem) :: problem
   type(qp_solution) :: solution
   character(7) :: verdict
   character(:), allocatable :: solver_name
   integer :: dimension, harmonics, i, points, symmetry
   logical :: by_beale

   if (command_argument_count() /= 5) error stop 'usage: stress_loads SOLVER DIMENSION HARMONICS POINTS SYMMETRY'
   solver_name = word(1)
   by_beale = solver_name == 'beale'
   if (.not. by_beale .and. solver_name /= 'series') error stop 'stress_loads: SOLVER is beale or series'
   dimension = number(2)
   harmonics = number(3)
   points = number(4)
   select case (word(5))
   case ('full')
      symmetry = symmetry_full
   case ('diagonal')
      symmetry = symmetry_diagonal
   case ('none')
      symmetry = symmetry_none
   case default
      error stop 'stress_loads: SYMMETRY is full, diagonal or none'
   end select

   terms = choose_terms(dimension, harmonics, symmetry)
   problem = energy_problem(terms, points, symmetry, has_hardness=.false.)
   do i = 1, size(loads)
      problem%bounds = -loads(i)
      if (by_beale) then
         call solve_by_beale(problem, solution)
      else if (i == 1) then
         call solver%solve(problem, solution)
      else
         call solver%pass_to(problem%bounds, solution)
      end if
      kkt = check_in_quad(problem, solution)
      verdict = 'passed'
      if (solution%status /= qp_converged) then
         verdict = 'refused'
      else if (kkt%worst() > promised_residual) then
         verdict = 'wrong'
      end if
      write (*, '(es24.16, 2("|", a), "|", es10.2e3)') loads(i), trim(verdict), &
         trim(status_name(status_of_programme(solution%status))), max(kkt%worst(), solution%kkt_residual)
   end do

end program stress_loads
