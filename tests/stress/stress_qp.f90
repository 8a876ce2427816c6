!> Solves random quadratic programmes with known solutions by Beale's method and by the dual method, and checks the
!> results. Prints a line for each case, of the last method.
!>
!> usage: stress_qp SEED FIRST LAST LARGEST_N FOLDER   the cases FIRST to LAST; those that fail are saved in FOLDER
!>        stress_qp FILE                               a case that was saved
program stress_qp
   use, intrinsic :: iso_fortran_env, only: int64
   use command_words, only: number, word
   use stress_exact_programme, only: bad_start, kind_names, make_programme, nearly_parallel, &
                                     programme_type, random_recipe, recipe_type
   use stress_kkt_in_quad, only: check_in_quad, kkt_type
   use stress_problem_file, only: read_problem, write_problem
   use stress_random_numbers, only: random_stream
   use wavycon_contact_status, only: status_name, status_of_programme
   use wavycon_beale, only: beale_solver
   use wavycon_dual_solver, only: dual_solver
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution, qp_converged, qp_infeasible, qp_infeasible_start
   implicit none (type, external)

   !> The library's tolerance for the status converged (kkt_tolerance), here for each constraint on its own scale.
   real(dp), parameter :: promised_residual = 1e-12_dp

   integer :: case

   if (command_argument_count() == 1) then
      call run_file(word(1))
   else if (command_argument_count() == 5) then
      do case = number(2), number(3)
         call run_case(number(1), case, number(4))
      end do
   else
      error stop 'usage: stress_qp SEED FIRST LAST LARGEST_N FOLDER, or stress_qp FILE'
   end if

contains

   !> Makes, solves and checks a case.
   subroutine run_case(seed, case, largest_n)
      integer, intent(in) :: seed, case, largest_n

      integer, parameter :: by_beale = 1, by_dual = 2
      type(dual_solver) :: dual
      type(kkt_type) :: kkt
      type(programme_type) :: programme
      type(qp_solution) :: solution
      type(random_stream) :: stream
      type(recipe_type) :: recipe
      character(12) :: name, verdict
      integer :: method, wanted
      real(dp) :: error, seconds

      call stream%start(seed, case)
      recipe = random_recipe(stream, largest_n)
      do
         call make_programme(stream, recipe, programme)
         if (programme%exact) exit
         recipe%condition_bits = max(0, recipe%condition_bits - 1)
         if (recipe%kind == nearly_parallel) recipe%twist_bits = max(8, recipe%twist_bits - 1)
      end do

      wanted = qp_converged
      if (recipe%kind == bad_start) then
         wanted = qp_infeasible_start
      else if (.not. programme%feasible) then
         wanted = qp_infeasible
      end if
      verdict = 'passed'
      do method = by_beale, by_dual
         ! The dual method needs no allowed start.
         if (method == by_dual .and. recipe%kind == bad_start) exit
         if (method == by_beale) then
            call solve(programme%problem, start_bounds(recipe%kind, programme%problem), solution, seconds)
         else
            call dual%solve(programme%problem, solution)
         end if
         error = 0.0_dp
         if (solution%status == qp_converged) then
            kkt = check_in_quad(programme%problem, solution)
            if (kkt%well_formed .and. programme%feasible .and. recipe%kind /= bad_start) &
               error = maxval(abs(solution%x - programme%x))/max(1.0_dp, maxval(abs(programme%x)))
         else
            kkt%stationarity = 0.0_dp
            kkt%feasibility = 0.0_dp
            kkt%sign = 0.0_dp
            kkt%complementarity = 0.0_dp
         end if
         if (solution%status /= wanted) verdict = 'refused'
         if (solution%status == qp_converged .and. (wanted /= qp_converged .or. kkt%worst() > promised_residual)) &
            verdict = 'wrong'
         ! The status infeasible for a problem with a solution is wrong, not a refusal.
         if (solution%status == qp_infeasible .and. wanted == qp_converged) verdict = 'wrong'
         if (verdict /= 'passed') exit
      end do
      if (verdict /= 'passed') then
         write (name, '(i0)') case
         call write_problem(word(5)//'/case-'//trim(name)//'.qp', programme%problem, &
                            start_bounds(recipe%kind, programme%problem))
      end if
      write (*, '(i0, "|", a, 4("|", i0), 3("|", a), 7("|", es10.2e3), "|", i0, "|", f0.3)') case, &
         trim(kind_names(recipe%kind)), recipe%n, recipe%m, recipe%pushing, recipe%twist_bits, &
         trim(status_name(status_of_programme(wanted))), trim(status_name(status_of_programme(solution%status))), &
         trim(verdict), programme%condition, &
         kkt%stationarity, kkt%feasibility, kkt%sign, kkt%complementarity, error, solution%kkt_residual, &
         solution%pivots, seconds
      flush (6)
   end subroutine run_case

   !> The bounds of the first solution: those of the problem, or others that allow x = 0 if they do not.
   function start_bounds(kind, problem) result(bounds)
      integer, intent(in) :: kind
      type(qp_problem), intent(in) :: problem
      real(dp) :: bounds(size(problem%bounds))

      bounds = problem%bounds
      if (kind /= bad_start) bounds = min(bounds, 0.0_dp)
   end function start_bounds

   !> Solves with the first bounds and passes to those of the problem, if they differ.
   subroutine solve(problem, first_bounds, solution, seconds)
      type(qp_problem), intent(in) :: problem
      real(dp), intent(in) :: first_bounds(:)
      type(qp_solution), intent(out) :: solution
      real(dp), intent(out) :: seconds

      type(beale_solver) :: solver
      type(qp_problem) :: first
      integer :: pivots
      integer(int64) :: begun, ended, rate

      first = problem
      first%bounds = first_bounds
      call system_clock(begun, rate)
      call solver%solve(first, solution)
      if (any(abs(first_bounds - problem%bounds) > 0.0_dp) .and. allocated(solution%x)) then
         pivots = solution%pivots
         call solver%pass_to(problem%bounds, solution)
         solution%pivots = solution%pivots + pivots
      end if
      call system_clock(ended)
      seconds = real(ended - begun, dp)/real(rate, dp)
   end subroutine solve

   !> Runs a saved case.
   subroutine run_file(path)
      character(*), intent(in) :: path

      real(dp), allocatable :: first_bounds(:)
      real(dp) :: seconds
      type(kkt_type) :: kkt
      type(qp_problem) :: problem
      type(qp_solution) :: solution

      call read_problem(path, problem, first_bounds)
      call solve(problem, first_bounds, solution, seconds)
      write (*, '(a, i0, a, f0.3, a, es10.2e3)') trim(status_name(status_of_programme(solution%status)))//', ', &
         solution%pivots, ' pivots, ', &
         seconds, ' s, own residual ', solution%kkt_residual
      if (.not. allocated(solution%x)) return
      kkt = check_in_quad(problem, solution)
      write (*, '(4(a, es10.2e3))') 'in quadruple precision: stationarity ', kkt%stationarity, ', feasibility ', &
         kkt%feasibility, ', sign ', kkt%sign, ', complementarity ', kkt%complementarity
   end subroutine run_file

end program stress_qp
