!> Solves random quadratic programmes with known solutions by Beale's method, by the dual method, and by passing from
!> the programme of Beale's method to the random one, and checks the results. Prints a line for each case: the verdict
!> on Beale's method, and verdict and numbers of the last way.
!>
!> N.B. Beale's method starts at x = 0, so that it needs b <= 0. It gets min(b, 0): another programme, whose solution is
!> not known but checked all the same.
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
   use wavycon_dual_solver, only: dual_solver
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged
   use wavycon_solution_record, only: status_name, status_of_programme
   implicit none (type, external)

   !> The library's tolerance for the status converged (kkt_tolerance), here for each constraint on its own scale.
   real(dp), parameter :: promised_residual = 1e-12_dp
   !> The ways to solve.
   integer, parameter :: by_beale = 1, by_dual = 2, by_passing = 3

   integer :: case

   if (command_argument_count() /= 4) error stop 'usage: stress_qp SEED FIRST LAST LARGEST_N'
   do case = number(2), number(3)
      call run_case(number(1), case, number(4))
   end do

contains

   !> Makes, solves and checks a case.
   subroutine run_case(seed, case, largest_n)
      integer, intent(in) :: seed, case, largest_n

      type(kkt_type) :: kkt
      type(programme_type) :: programme
      type(qp_problem) :: problem
      type(qp_solution) :: solution
      type(random_stream) :: stream
      type(recipe_type) :: recipe
      character(7) :: verdict, verdict_of_beale
      integer :: way
      logical :: is_known
      real(dp) :: error, seconds

      call stream%start(seed, case)
      recipe = random_recipe(stream, largest_n)
      do
         call make_programme(stream, recipe, programme)
         if (programme%exact) exit
         recipe%condition_bits = max(0, recipe%condition_bits - 1)
         if (recipe%kind == nearly_parallel) recipe%twist_bits = max(8, recipe%twist_bits - 1)
      end do

      do way = by_beale, by_passing
         verdict = 'passed'
         problem = programme%problem
         if (way == by_beale) problem%bounds = min(problem%bounds, 0.0_dp)
         call solve(problem, way, solution, seconds)
         kkt = check_in_quad(problem, solution)
         error = 0.0_dp
         is_known = way /= by_beale .or. all(programme%problem%bounds <= 0.0_dp)
         if (kkt%well_formed .and. is_known) &
            error = maxval(abs(solution%x - programme%x))/max(1.0_dp, maxval(abs(programme%x)))
         if (solution%status /= qp_converged) then
            verdict = 'refused'
         else if (kkt%worst() > promised_residual) then
            verdict = 'wrong'
         end if
         if (way == by_beale) verdict_of_beale = verdict
         if (way /= by_beale .and. verdict /= 'passed') exit
      end do
      write (*, '(i0, "|", a, 4("|", i0), 3("|", a), 7("|", es10.2e3), "|", i0, "|", f0.3)') case, &
         trim(kind_names(recipe%kind)), recipe%n, recipe%m, recipe%pushing, recipe%twist_bits, trim(verdict_of_beale), &
         trim(status_name(status_of_programme(solution%status))), trim(verdict), programme%condition, &
         kkt%stationarity, kkt%feasibility, kkt%sign, kkt%complementarity, error, solution%kkt_residual, &
         solution%pivots, seconds
      flush (6)
   end subroutine run_case

   !> Solves in one of the ways.
   subroutine solve(problem, way, solution, seconds)
      type(qp_problem), intent(in) :: problem
      integer, intent(in) :: way
      type(qp_solution), intent(out) :: solution
      real(dp), intent(out) :: seconds

      type(dual_solver) :: solver
      type(qp_problem) :: first
      integer :: pivots
      integer(int64) :: begun, ended, rate

      call system_clock(begun, rate)
      select case (way)
      case (by_beale)
         call solve_by_beale(problem, solution)
      case (by_dual)
         call solver%solve(problem, solution)
      case (by_passing)
         first = problem
         first%bounds = min(problem%bounds, 0.0_dp)
         call solver%solve(first, solution)
         pivots = solution%pivots
         call solver%pass_to(problem%bounds, solution)
         solution%pivots = solution%pivots + pivots
      end select
      call system_clock(ended)
      seconds = real(ended - begun, dp)/real(rate, dp)
   end subroutine solve

end program stress_qp
