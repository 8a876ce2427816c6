!> Solves random quadratic programmes with known solutions by Beale's method and by the dual method, and checks the
!> results. Prints a line for each case, of the last method.
!>
!> usage: stress_qp SEED FIRST LAST LARGEST_N   the cases FIRST to LAST
program stress_qp
   use, intrinsic :: iso_fortran_env, only: int64
   use command_words, only: number
   use stress_exact_programme, only: kind_names, make_programme, nearly_parallel, programme_type, &
                                     random_recipe, recipe_type
   use stress_kkt_in_quad, only: check_in_quad, kkt_type
   use stress_random_numbers, only: random_stream
   use wavycon_beale, only: solve_by_beale
   use wavycon_contact_status, only: status_name, status_of_programme
   use wavycon_dual_solver, only: dual_solver
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged
   implicit none (type, external)

   !> The library's tolerance for the status converged (kkt_tolerance), here for each constraint on its own scale.
   real(dp), parameter :: promised_residual = 1e-12_dp

   integer :: case

   if (command_argument_count() /= 4) error stop 'usage: stress_qp SEED FIRST LAST LARGEST_N'
   do case = number(2), number(3)
      call run_case(number(1), case, number(4))
   end do

contains

   !> Makes, solves and checks a case.
   subroutine run_case(seed, case, largest_n)
      integer, intent(in) :: seed, case, largest_n

      integer, parameter :: by_beale = 1, by_dual = 2
      type(kkt_type) :: kkt
      type(programme_type) :: programme
      type(qp_solution) :: solution
      type(random_stream) :: stream
      type(recipe_type) :: recipe
      character(7) :: verdict
      integer :: method
      real(dp) :: error, seconds

      call stream%start(seed, case)
      recipe = random_recipe(stream, largest_n)
      do
         call make_programme(stream, recipe, programme)
         if (programme%exact) exit
         recipe%condition_bits = max(0, recipe%condition_bits - 1)
         if (recipe%kind == nearly_parallel) recipe%twist_bits = max(8, recipe%twist_bits - 1)
      end do

      verdict = 'passed'
      do method = by_beale, by_dual
         call solve(programme%problem, method == by_beale, solution, seconds)
         kkt = check_in_quad(programme%problem, solution)
         error = 0.0_dp
         if (kkt%well_formed) error = maxval(abs(solution%x - programme%x))/max(1.0_dp, maxval(abs(programme%x)))
         if (solution%status /= qp_converged) then
            verdict = 'refused'
         else if (kkt%worst() > promised_residual) then
            verdict = 'wrong'
         end if
         if (verdict /= 'passed') exit
      end do
      write (*, '(i0, "|", a, 4("|", i0), 2("|", a), 7("|", es10.2e3), "|", i0, "|", f0.3)') case, &
         trim(kind_names(recipe%kind)), recipe%n, recipe%m, recipe%pushing, recipe%twist_bits, &
         trim(status_name(status_of_programme(solution%status))), trim(verdict), programme%condition, &
         kkt%stationarity, kkt%feasibility, kkt%sign, kkt%complementarity, error, solution%kkt_residual, &
         solution%pivots, seconds
      flush (6)
   end subroutine run_case

   !> Solves, from bounds that allow x = 0.
   subroutine solve(problem, by_beale, solution, seconds)
      type(qp_problem), intent(in) :: problem
      logical, intent(in) :: by_beale
      type(qp_solution), intent(out) :: solution
      real(dp), intent(out) :: seconds

      type(dual_solver) :: solver
      type(qp_problem) :: first
      integer :: pivots
      integer(int64) :: begun, ended, rate

      first = problem
      if (by_beale) first%bounds = min(problem%bounds, 0.0_dp)
      call system_clock(begun, rate)
      if (by_beale) then
         call solve_by_beale(first, solution)
      else
         call solver%solve(first, solution)
      end if
      if (any(abs(first%bounds - problem%bounds) > 0.0_dp)) then
         pivots = solution%pivots
         call solver%pass_to(problem%bounds, solution)
         solution%pivots = solution%pivots + pivots
      end if
      call system_clock(ended)
      seconds = real(ended - begun, dp)/real(rate, dp)
   end subroutine solve

end program stress_qp
