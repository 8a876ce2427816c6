!> Random quadratic programmes whose solution is known exactly, to the last bit.
!>
!> All numbers are small integers times powers of two, so that D, c, C and b are computed without rounding: the x from
!> which a programme is made solves it exactly, whatever its condition number.
!>
!>     D = diag(2^k): the condition number is 2^(greatest k - least k)
!>     c = D x - C'y,   b = C x - slack,   y > 0 where the slack is 0
module stress_exact_programme
   use, intrinsic :: iso_fortran_env, only: real128
   use stress_random_numbers, only: random_stream
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_problem
   implicit none (type, external)
   private

   public :: recipe_type, programme_type, random_recipe, make_programme, kind_names

   !> Kinds of constraints.
   integer, parameter, public :: plain = 1, degenerate = 2, repeated = 3, nearly_parallel = 4, moved_origin = 5
   character(*), parameter :: kind_names(*) = [character(16) :: 'plain', 'degenerate', 'repeated', 'nearly parallel', &
      'moved origin']

   !> Properties of the programme to make.
   type :: recipe_type
      integer :: kind = plain
      integer :: n = 1, m = 1         !! unknowns, constraints
      integer :: pushing = 0          !! constraints with a multiplier, <= m
      integer :: touching = 0         !! constraints that hold with equality without a multiplier
      integer :: condition_bits = 0   !! log2 of the condition number of D
      integer :: twist_bits = 0       !! nearly parallel constraints differ by 2^-twist_bits
   end type recipe_type

   !> A programme and its known properties.
   type :: programme_type
      type(qp_problem) :: problem
      logical :: exact = .true.           !! no sum was rounded
      real(dp) :: condition = 1.0_dp      !! of D
      real(dp), allocatable :: x(:)       !! the answer
   end type programme_type

contains

   !> Random properties of a case. Nine of ten are small, one of 200 may have the largest size.
   function random_recipe(stream, largest_n) result(recipe)
      type(random_stream), intent(inout) :: stream
      integer, intent(in) :: largest_n   !! >= 1; there are ten times as many constraints at most
      type(recipe_type) :: recipe

      real(dp) :: size_of_case

      size_of_case = stream%uniform()
      if (size_of_case < 0.005_dp) then
         recipe%n = stream%whole(max(1, largest_n/2), largest_n)
      else if (size_of_case < 0.05_dp) then
         recipe%n = stream%whole(1, max(1, largest_n/3))
      else if (size_of_case < 0.3_dp) then
         recipe%n = stream%whole(1, max(1, largest_n/8))
      else
         recipe%n = stream%whole(1, min(12, largest_n))
      end if
      recipe%kind = stream%whole(1, size(kind_names))
      recipe%m = max(2, stream%whole(0, 10*recipe%n))
      recipe%pushing = stream%whole(0, min(recipe%n, recipe%m))
      if (stream%chance(0.2_dp)) recipe%pushing = min(recipe%n, recipe%m)
      recipe%condition_bits = stream%whole(0, 40)
      if (recipe%kind == degenerate) then
         ! More constraints than unknowns are active, sometimes more than n of them with multipliers.
         recipe%m = recipe%m + 3*recipe%n
         if (stream%chance(0.3_dp)) recipe%pushing = recipe%n + stream%whole(1, recipe%n)
         recipe%touching = stream%whole(1, recipe%m - recipe%pushing)
      end if
      if (recipe%kind == nearly_parallel) recipe%twist_bits = stream%whole(8, 46)
   end function random_recipe

   !> Makes a programme. If a sum was rounded, `exact` is false and the caller must make another.
   subroutine make_programme(stream, recipe, programme)
      type(random_stream), intent(inout) :: stream
      type(recipe_type), intent(in) :: recipe
      type(programme_type), intent(out) :: programme

      real(dp) :: multipliers(recipe%m), slack(recipe%m)
      integer :: i, j

      associate (n => recipe%n, m => recipe%m, problem => programme%problem)
         allocate (programme%x(n))
         programme%x = [(real(stream%whole(-3, 3), dp), j=1, n)]
         if (.not. any(abs(programme%x) > 0.0_dp)) programme%x(stream%whole(1, n)) = 1.0_dp
         problem%hessian = [(scale(1.0_dp, stream%whole(0, recipe%condition_bits)), j=1, n)]
         problem%hessian(stream%whole(1, n)) = scale(1.0_dp, recipe%condition_bits)
         programme%condition = maxval(problem%hessian)/minval(problem%hessian)
         allocate (problem%normals(n, m))
         do i = 1, m
            problem%normals(:, i) = random_normal(stream, n)
         end do
         call relate_constraints(stream, recipe, problem%normals)

         ! The normals point away from x, so that the origin satisfies every constraint.
         do i = 1, m
            if (recipe%kind == moved_origin) exit
            if (dot_product(problem%normals(:, i), programme%x) > 0.0_dp) problem%normals(:, i) = -problem%normals(:, i)
         end do
         multipliers = 0.0_dp
         do i = 1, recipe%pushing
            multipliers(i) = scale(real(stream%whole(1, 4), dp), -stream%whole(0, 6))
         end do
         slack = 0.0_dp
         do i = recipe%pushing + recipe%touching + 1, m
            slack(i) = scale(real(stream%whole(1, 8), dp), -stream%whole(0, 6))
         end do
         if (recipe%kind == repeated .or. recipe%kind == nearly_parallel) slack(m/2 + 1:) = 0.0_dp

         call set_linear(programme, multipliers)
         call set_bounds(programme, slack)
      end associate
   end subroutine make_programme

   !> Small integers, at least one of them not zero; sometimes few of them.
   function random_normal(stream, n) result(normal)
      type(random_stream), intent(inout) :: stream
      integer, intent(in) :: n
      real(dp) :: normal(n)

      integer :: i
      logical :: sparse

      sparse = stream%chance(0.3_dp)
      do i = 1, n
         normal(i) = real(stream%whole(-4, 4), dp)
         if (.not. sparse) cycle
         if (stream%chance(0.7_dp)) normal(i) = 0.0_dp
      end do
      if (.not. any(abs(normal) > 0.0_dp)) normal(stream%whole(1, n)) = 1.0_dp
   end function random_normal

   !> Makes the second half of the constraints copies of the first, or nearly so.
   subroutine relate_constraints(stream, recipe, normals)
      type(random_stream), intent(inout) :: stream
      type(recipe_type), intent(in) :: recipe
      real(dp), intent(inout) :: normals(:, :)

      integer :: half, i, j

      half = recipe%m/2
      do i = half + 1, recipe%m
         j = i - half
         if (j > half) exit
         select case (recipe%kind)
         case (repeated)
            normals(:, i) = scale(normals(:, j), stream%whole(-3, 3))
         case (nearly_parallel)
            normals(:, i) = normals(:, j) + scale(random_normal(stream, recipe%n), -recipe%twist_bits)
         end select
      end do
   end subroutine relate_constraints

   !> c = D x - C'y.
   subroutine set_linear(programme, multipliers)
      type(programme_type), intent(inout) :: programme
      real(dp), intent(in) :: multipliers(:)   !! shape (m)

      real(real128) :: total(size(programme%x))
      integer :: i

      total = real(programme%problem%hessian, real128)*programme%x
      do i = 1, size(multipliers)
         if (multipliers(i) > 0.0_dp) total = total - real(programme%problem%normals(:, i), real128)*multipliers(i)
      end do
      programme%problem%linear = real(total, dp)
      programme%exact = programme%exact .and. .not. any(abs(programme%problem%linear - total) > 0.0_real128)
   end subroutine set_linear

   !> b = C x - slack.
   subroutine set_bounds(programme, slack)
      type(programme_type), intent(inout) :: programme
      real(dp), intent(in) :: slack(:)   !! shape (m)

      real(real128) :: total
      integer :: i

      allocate (programme%problem%bounds(size(slack)))
      do i = 1, size(slack)
         total = sum(real(programme%problem%normals(:, i), real128)*programme%x) - slack(i)
         programme%problem%bounds(i) = real(total, dp)
         programme%exact = programme%exact .and. .not. abs(programme%problem%bounds(i) - total) > 0.0_real128
      end do
   end subroutine set_bounds

end module stress_exact_programme
