!> Grids, each twice as fine as the one before, until the answer is as accurate as asked for.
!>
!> A coarse answer starts the next finer one and tells its error: of each number the error estimate is the larger of its
!> last change and half of the change before, so that a change that is small by chance does not pass for accuracy,
!> with a factor of safety that the irregular convergence of the area needs.
module wavycon_grid_cascade
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_constants, only: pi
   use wavycon_grid_edge, only: grid_contact_area, grid_crest_pressure, grid_edge, start_grid_edge
   use wavycon_grid_solver, only: grid_state, solve_on_grid
   use wavycon_harmonic_surface, only: harmonic_surface
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: cascade_answer, solve_by_cascade

   !> Points on the shorter side of the quarter cell, of the first grid and at most.
   integer, parameter :: first_points = 8, most_points(2) = [262144, 1024]
   !> A grid of step h is solved to a residual of this times h^(3/2) of the mean gap: the gap next to the edge of contact,
   !> which places it, is of the order of h^(3/2).
   real(dp), parameter :: tolerance_factor = 1e-4_dp
   integer, parameter :: iteration_limit = 500
   !> Of the estimates of mean gap, contact area and peak pressure. The area's change from grid to grid depends on how the
   !> edge happens to lie between the points.
   real(dp), parameter :: safety(3) = [1.25_dp, 2.0_dp, 1.25_dp]

   !> In place of a number that no grid has given yet; so large that no change from it passes for small.
   real(dp), parameter :: unknown = 1e30_dp

   type :: cascade_answer
      type(grid_state) :: state            !! on the finest grid
      real(dp) :: values(3) = 0.0_dp       !! mean gap [Delta], contact area fraction, peak pressure [p*]
      real(dp) :: errors(3) = huge(1.0_dp) !! estimated, in the same units
      logical :: accurate = .false.        !! whether all errors are as small as asked for
      integer :: grids = 0
      integer :: iterations = 0            !! on all grids
      real(dp) :: transform_pairs = 0.0_dp !! in units of one on the finest grid
   end type cascade_answer

contains

   subroutine solve_by_cascade(surface, dimension, mean_pressure, accuracy, answer)
      type(harmonic_surface), intent(in) :: surface   !! that mirrors itself at the middle lines of its cell
      integer, intent(in) :: dimension                !! 1 or 2
      real(dp), intent(in) :: mean_pressure           !! P in (0, 1)
      real(dp), intent(in) :: accuracy                !! of all three values, absolute
      type(cascade_answer), intent(out) :: answer

      real(dp) :: values(3), change(3), last_change(3)
      real(dp), allocatable :: finer(:, :)
      type(grid_edge) :: edge
      integer :: m, n

      last_change = unknown
      values = unknown
      m = first_points*max(1, nint(surface%length(1)/surface%length(2)))
      n = first_points*max(1, nint(surface%length(2)/surface%length(1)))
      if (dimension == 1) n = 1
      do
         if (allocated(answer%state%pressure)) then
            call refine(answer%state%pressure, finer)
            call move_alloc(finer, answer%state%pressure)
            if (allocated(answer%state%gap)) deallocate (answer%state%gap)
            m = size(answer%state%pressure, 1)
            n = size(answer%state%pressure, 2)
         else
            allocate (answer%state%pressure(m, n), source=mean_pressure)
         end if
         call solve_level(surface, mean_pressure, answer)
         answer%grids = answer%grids + 1
         call start_grid_edge(edge, answer%state%pressure, answer%state%gap)
         answer%values = [answer%state%mean_gap, grid_contact_area(edge), &
                          grid_crest_pressure(answer%state%pressure)]
         change = abs(answer%values - values)
         answer%errors = max(safety*change, 0.5_dp*safety*last_change, unresolved(answer%state%pressure))
         answer%accurate = answer%state%converged .and. all(answer%errors <= accuracy)
         if (answer%accurate .or. 2*min(m, merge(m, n, n == 1)) > most_points(dimension)) exit
         values = answer%values
         last_change = change
      end do
   end subroutine solve_by_cascade

   subroutine solve_level(surface, mean_pressure, answer)
      type(harmonic_surface), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure
      type(cascade_answer), intent(inout) :: answer

      type(compliance_operator) :: half_space
      real(dp), allocatable :: h(:, :)
      integer :: i, j, m, n

      m = size(answer%state%pressure, 1)
      n = size(answer%state%pressure, 2)
      allocate (h(m, n))
      do j = 1, n
         do i = 1, m
            h(i, j) = surface%gap_at(pi*(i - 0.5_dp)/m, merge(0.0_dp, pi*(j - 0.5_dp)/n, n == 1))
         end do
      end do
      call half_space%start(surface, m, n)
      answer%state%pressure = answer%state%pressure*(mean_pressure*m*n/sum(answer%state%pressure))
      call solve_on_grid(half_space, h, mean_pressure, tolerance_factor/max(m, n)**1.5_dp, iteration_limit, answer%state)
      answer%iterations = answer%iterations + answer%state%iterations
      answer%transform_pairs = answer%transform_pairs/merge(2, 4, n == 1) + half_space%transform_pairs
   end subroutine solve_level

   !> Errors that no change tells of: the edge's place between the points, where two grids may err alike; while the grid is too
   !> coarse for it, the last open gap, about a corner of the quarter; a peak made of fewer points than its polynomial.
   pure function unresolved(pressure) result(errors)
      real(dp), intent(in) :: pressure(:, :)   !! shape (m, n)
      real(dp) :: errors(3)                    !! of mean gap, contact area and peak pressure

      !> On the average over the edge it is placed to this part of a step.
      real(dp), parameter :: edge_uncertainty = 0.005_dp
      !> A contact that has its edge between the first and the second point: Hertz's peak of the widest such one, in 1-D
      !> pi times the part in contact, which is 3/(2m), in 2-D less.
      real(dp), parameter :: peak_of_one_cell = 1.5_dp*pi

      logical :: contact(size(pressure, 1), size(pressure, 2))
      real(dp) :: open_part
      integer :: m, n, edges

      m = size(pressure, 1)
      n = size(pressure, 2)
      contact = pressure > 0.0_dp
      edges = count(contact(:m - 1, :) .neqv. contact(2:, :)) + count(contact(:, :n - 1) .neqv. contact(:, 2:))
      errors = [0.0_dp, edge_uncertainty*edges/size(pressure), 0.0_dp]
      if (all(contact)) then
         ! The gap may be open one step from the corner. With this part of the surface the mean gap falls as the power
         ! 5/2 or faster, and with it the change of the peak.
         open_part = 1.0_dp/m
         if (n > 1) open_part = 0.25_dp*pi*open_part/n
         errors = [open_part**2, open_part, open_part**2]
      else if (.not. contact(3, 1)) then
         errors(3) = peak_of_one_cell/max(m, n)
      end if
   end function unresolved

   !> The pressure on a grid twice as fine, linear between points. In 1-D the second direction stays.
   pure subroutine refine(coarse, fine)
      real(dp), intent(in) :: coarse(:, :)
      real(dp), allocatable, intent(out) :: fine(:, :)

      real(dp) :: half_way(2*size(coarse, 1), size(coarse, 2))
      integer :: m, n, i

      m = size(coarse, 1)
      n = size(coarse, 2)
      half_way(1::2, :) = 0.75_dp*coarse + 0.25_dp*coarse([(max(i - 1, 1), i=1, m)], :)
      half_way(2::2, :) = 0.75_dp*coarse + 0.25_dp*coarse([(min(i + 1, m), i=1, m)], :)
      if (n == 1) then
         allocate (fine, source=half_way)
      else
         allocate (fine(2*m, 2*n))
         fine(:, 1::2) = 0.75_dp*half_way + 0.25_dp*half_way(:, [(max(i - 1, 1), i=1, n)])
         fine(:, 2::2) = 0.75_dp*half_way + 0.25_dp*half_way(:, [(min(i + 1, n), i=1, n)])
      end if
   end subroutine refine

end module wavycon_grid_cascade
