!> The Karush-Kuhn-Tucker conditions of a solution, in quadruple precision and from the problem's data alone.
!>
!> N.B. The check is independent of the library's own. The violation of each constraint is relative to its own normal
!> and bound and the size of x, so that a large constraint does not hide the violation of a small one. For x = 0 and
!> b = 0 there is no such scale.
module stress_kkt_in_quad
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_fortran_env, only: real128
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem, qp_solution
   implicit none (type, external)
   private

   public :: kkt_type, check_in_quad

   integer, parameter :: qp = real128

   !> Largest violations, relative to the largest terms that should cancel [-].
   type :: kkt_type
      logical :: well_formed = .false.     !! shapes fit, active constraints exist and are named once, all is finite
      real(dp) :: stationarity = huge(1.0_dp)
      real(dp) :: feasibility = huge(1.0_dp)
      real(dp) :: sign = huge(1.0_dp)
      real(dp) :: complementarity = huge(1.0_dp)
   contains
      procedure :: worst
   end type kkt_type

contains

   !> Checks a solution.
   function check_in_quad(problem, solution) result(kkt)
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(in) :: solution
      type(kkt_type) :: kkt

      real(qp) :: gradient(size(problem%linear)), terms(size(problem%linear)), x(size(problem%linear))
      real(qp) :: slack(size(problem%bounds)), slack_scale(size(problem%bounds)), force, gradient_scale
      integer :: i, j

      kkt%well_formed = is_well_formed(problem, solution)
      if (.not. kkt%well_formed) return

      x = solution%x
      gradient = problem%hessian*x - problem%linear
      terms = abs(problem%hessian*x) + abs(problem%linear)
      do i = 1, size(solution%active)
         associate (push => real(solution%multipliers(i), qp)*problem%normals(:, solution%active(i)))
            gradient = gradient - push
            terms = terms + abs(push)
         end associate
      end do
      gradient_scale = maxval(terms)
      kkt%stationarity = ratio(maxval(abs(gradient)), gradient_scale)

      do i = 1, size(slack)
         slack(i) = dot_product(x, real(problem%normals(:, i), qp)) - problem%bounds(i)
         slack_scale(i) = maxval(abs(x))*maxval(abs(problem%normals(:, i))) + abs(problem%bounds(i))
      end do
      kkt%feasibility = 0.0_dp
      do i = 1, size(slack)
         kkt%feasibility = max(kkt%feasibility, ratio(max(0.0_qp, -slack(i)), slack_scale(i)))
      end do

      kkt%sign = 0.0_dp
      kkt%complementarity = 0.0_dp
      do i = 1, size(solution%active)
         j = solution%active(i)
         force = solution%multipliers(i)*maxval(abs(real(problem%normals(:, j), qp)))
         kkt%sign = max(kkt%sign, ratio(max(0.0_qp, -force), gradient_scale))
         kkt%complementarity = max(kkt%complementarity, ratio(abs(force*slack(j)), gradient_scale*slack_scale(j)))
      end do
   end function check_in_quad

   pure logical function is_well_formed(problem, solution) result(good)
      type(qp_problem), intent(in) :: problem
      type(qp_solution), intent(in) :: solution

      logical :: named(size(problem%bounds))
      integer :: i

      good = allocated(solution%x) .and. allocated(solution%active) .and. allocated(solution%multipliers)
      if (.not. good) return
      good = size(solution%x) == size(problem%linear) .and. size(solution%active) == size(solution%multipliers)
      if (.not. good) return
      good = all(ieee_is_finite(solution%x)) .and. all(ieee_is_finite(solution%multipliers)) .and. &
         all(solution%active >= 1) .and. all(solution%active <= size(problem%bounds))
      if (.not. good) return
      named = .false.
      do i = 1, size(solution%active)
         good = good .and. .not. named(solution%active(i))
         named(solution%active(i)) = .true.
      end do
   end function is_well_formed

   !> a/b, 0 for 0/0.
   pure real(dp) function ratio(a, b)
      real(qp), intent(in) :: a, b   !! >= 0

      ratio = 0.0_dp
      if (a > 0.0_qp) ratio = real(a/max(b, tiny(b)), dp)
   end function ratio

   pure real(dp) function worst(self)
      class(kkt_type), intent(in) :: self

      worst = max(self%stationarity, self%feasibility, self%sign, self%complementarity)
   end function worst

end module stress_kkt_in_quad
