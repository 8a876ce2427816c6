!> The solver on grids that are distributed over the ranks beside the same on whole grids: equal to the last bit,
!> iterations and residuals included.
!>
!> `mpirun -n N test_grid_solver` prints a line for each case, and ends with status 1 if one of them fails.
program test_grid_solver
   use, intrinsic :: iso_fortran_env, only: int64, output_unit
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_constants, only: pi
   use wavycon_grid_solver, only: grid_state, solve_on_grid
   use wavycon_kinds, only: dp
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_ranks, only: any_rank, end_ranks, is_first_rank, work_alone
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_wave_surfaces, only: wave_2d
   implicit none (type, external)

   !> The last is distributed over a few ranks only.
   integer, parameter :: grids(2, 3) = reshape([256, 288, 300, 325, 2048, 72], [2, 3])
   !> From few points in contact, where the stencil is the preconditioner, to nearly all.
   real(dp), parameter :: loads(4) = [3e-3_dp, 0.05_dp, 0.4_dp, 0.95_dp]
   !> Most points at the hardness, some, none.
   real(dp), parameter :: hardnesses(3) = [0.105_dp, 0.25_dp, 1e4_dp]
   real(dp), parameter :: tolerance = 1e-9_dp
   integer, parameter :: limit = 200

   logical :: failed = .false.
   integer :: i, k

   call start_mpi()
   do k = 1, size(grids, 2)
      do i = 1, size(loads)
         call compare(mod(i + k, 2) == 0, grids(:, k), loads(i), huge(1.0_dp), tolerance)
      end do
      ! With the residual that the edge needs.
      call compare(.true., grids(:, k), 0.05_dp, 0.5_dp, 0.0_dp)
      call compare(.false., grids(:, k), 0.1_dp, hardnesses(k), tolerance)
   end do
   call end_ranks(0)
   if (failed) error stop 1

contains

   subroutine compare(even, points, load, hardness, residual)
      logical, intent(in) :: even
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: load, hardness, residual

      type(grid_state) :: spread, whole
      logical :: good

      call solve(even, points, load, hardness, residual, spread)
      call work_alone(.true.)
      call solve(even, points, load, hardness, residual, whole)
      call work_alone(.false.)
      associate (first => spread%slab%first, last => spread%slab%last)
         good = all(transfer(spread%pressure, [0_int64]) == transfer(whole%pressure(:, first:last), [0_int64])) .and. &
                all(transfer(spread%gap, [0_int64]) == transfer(whole%gap(:, first:last), [0_int64]))
      end associate
      good = good .and. all(transfer(numbers(spread), [0_int64]) == transfer(numbers(whole), [0_int64]))
      good = good .and. whole%converged .and. spread%converged
      good = .not. any_rank(.not. good)
      failed = failed .or. .not. good
      if (is_first_rank()) write (output_unit, '(a, 2i5, l2, 3es10.2, 2i5)') merge('same     ', 'different', good), &
         points, even, load, hardness, whole%residual, whole%corrections, whole%iterations
   end subroutine compare

   !> What of a state is not a field.
   pure function numbers(state)
      type(grid_state), intent(in) :: state
      real(dp) :: numbers(6)

      numbers = [state%mean_gap, state%residual_indentation, state%residual, state%open_gap(), &
                 real(state%corrections, dp), real(state%iterations, dp)]
   end function numbers

   subroutine solve(even, points, load, hardness, residual, state)
      logical, intent(in) :: even
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: load, hardness, residual
      type(grid_state), intent(out) :: state

      type(compliance_operator) :: half_space
      type(local_stiffness) :: stencil
      type(surface_type) :: surface
      real(dp), allocatable :: gap(:, :), height(:, :)
      integer :: i, j

      ! Its sides and whether it is even are of use, its heights are not.
      height = reshape([(sin(1.7_dp*i**2), i=1, 9)], [3, 3])
      surface = surface_of_points([1.0_dp, 1.0_dp*points(2)/points(1)], height)
      if (even) surface = wave_2d(1.0_dp, 1.0_dp, 1.0_dp*points(2)/points(1))
      call state%slab%start(points)
      state%hardness = hardness
      call half_space%start(surface, points)
      call stencil%start(surface, points)
      allocate (state%pressure(points(1), state%slab%columns()), source=load)
      allocate (gap(points(1), state%slab%columns()))
      do j = 1, size(gap, 2)
         do i = 1, points(1)
            gap(i, j) = 1.0_dp - roughness(2*pi*i/points(1), 2*pi*(state%slab%first - 1 + j)/points(2))
         end do
      end do
      call solve_on_grid(half_space, stencil, gap, residual, limit, state)
   end subroutine solve

   !> Waves of many directions, and across the rim.
   pure real(dp) function roughness(x, y)
      real(dp), intent(in) :: x, y

      integer :: k, l

      roughness = 0.0_dp
      do l = -3, 3
         do k = 1, 3
            roughness = roughness + cos(2*k*x + 2*l*y + 7.0_dp*sin(1.7_dp*k**2 + 0.9_dp*l**2)) &
                        /(1.0_dp*k**2 + 1.0_dp*l**2)**1.4_dp
         end do
      end do
      roughness = 0.4_dp*roughness
   end function roughness

end program test_grid_solver
