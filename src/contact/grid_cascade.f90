!> Grids, each twice as fine as the one before, until the answer is as accurate as asked for.
!>
!> A coarse answer starts the next finer one and tells its error: of each number the error estimate is the larger of
!> its last change and half of the change before, so that a change that is small by chance does not pass for
!> accuracy, with a factor of safety that the irregular convergence of the area needs.
module wavycon_grid_cascade
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: largest_errors
   use wavycon_grid_edge, only: grid_contact_area, grid_edge, start_grid_edge
   use wavycon_grid_peak, only: grid_peak_pressure
   use wavycon_solver_progress, only: solver_progress
   use wavycon_grid_solver, only: grid_state, solve_on_grid
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: cascade_answer, solve_by_cascade

   !> Points of the first grid to half of the shortest wave each way; of the last grid, of a profile and of a
   !> surface, on an even one's part of the cell. Any other may have as many on each such part.
   integer, parameter :: first_points = 8, most_points(2) = [262144, 1024*1024]
   !> A grid of step h is solved to a residual of this times h^(3/2) P^(1/3) of the mean gap: the gap next to the
   !> edge of contact, which places it, is of the order of h^(3/2), and the peak of a light load is that of a small
   !> part of the surface.
   real(dp), parameter :: tolerance_factor = 1e-3_dp
   !> A grid that is asked for is solved to this, for those who compare it with their own.
   real(dp), parameter :: last_tolerance = 1e-11_dp
   integer, parameter :: iteration_limit = 500
   !> Of the estimates of mean gap, contact area and peak pressure. The area's change from grid to grid depends on
   !> how the edge happens to lie between the points.
   real(dp), parameter :: safety(3) = [1.25_dp, 2.0_dp, 1.25_dp]

   !> In place of a number that no grid has given yet; so large that no change from it passes for small. It takes
   !> three grids until none is left in an estimate.
   real(dp), parameter :: unknown = 1e30_dp

   type :: cascade_answer
      type(grid_state) :: state            !! on the finest grid
      real(dp) :: values(3) = 0.0_dp       !! mean gap [Delta], contact area fraction, peak pressure [p*]
      real(dp) :: errors(3) = huge(1.0_dp) !! estimated, in the same units; `largest_errors` if that cannot be
      logical :: accurate = .false.        !! whether all errors are as small as asked for
      logical :: out_of_memory = .false.   !! whether a finer grid would have been needed, but not its memory
      integer :: grids = 0
      integer :: iterations = 0            !! on all grids
      real(dp) :: transform_pairs = 0.0_dp !! in units of one on the finest grid
   end type cascade_answer

contains

   subroutine solve_by_cascade(surface, mean_pressure, accuracy, points, answer, progress)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure           !! P in (0, 1)
      real(dp), intent(in) :: accuracy                !! of all three values, absolute; 0 for that of `points` alone
      integer, intent(in) :: points(2)                !! of the last grid's whole cell; zeros: the accuracy decides
      type(cascade_answer), intent(out) :: answer
      class(solver_progress), intent(in), optional :: progress   !! that hears of each grid

      real(dp) :: values(3), change(3), last_change(3), tolerance
      real(dp), allocatable :: finer(:, :)
      type(grid_edge) :: edge
      logical :: last, resolved
      integer :: grid(2), last_grid(2), trusted_grid(2)

      last_change = unknown
      values = unknown
      call plan_grids(surface, points, grid, trusted_grid, last_grid)
      answer%out_of_memory = .not. fits_memory(grid)
      if (answer%out_of_memory) return
      allocate (answer%state%pressure(grid(1), grid(2)), source=mean_pressure)
      do
         last = all(grid == last_grid)
         tolerance = tolerance_factor*mean_pressure**(1.0_dp/3)/maxval(grid)**1.5_dp
         if (last .and. all(points > 0)) tolerance = last_tolerance
         call solve_level(surface, mean_pressure, tolerance, answer)
         answer%grids = answer%grids + 1
         call start_grid_edge(edge, answer%state%pressure, answer%state%gap, surface%shape%is_even())
         answer%values(:2) = [answer%state%mean_gap, grid_contact_area(edge)]
         call grid_peak_pressure(edge, answer%values(3), resolved)
         change = abs(answer%values - values)
         answer%errors = max(safety*change, 0.5_dp*safety*last_change, unresolved(surface, edge, resolved))
         answer%errors = max(answer%errors, hidden_by_chance(surface%dimension, answer%values, answer%errors(2)))
         answer%accurate = answer%state%converged .and. all(answer%errors <= accuracy) .and. &
            all(grid >= trusted_grid)
         if (present(progress)) &
            call progress%grid_solved(grid*merge(2, 1, surface%shape%is_even() .and. grid > 1), &
                                      answer%state%iterations, answer%state%residual)
         ! A grid that cannot be solved starts no finer one.
         if (answer%accurate .or. last .or. .not. answer%state%converged) exit
         values = answer%values
         last_change = change
         grid = merge(2*grid, 1, grid > 1)
         if (.not. fits_memory(grid)) then
            answer%out_of_memory = .true.
            exit
         end if
         call refine(answer%state%pressure, surface%shape%is_even(), finer)
         call move_alloc(finer, answer%state%pressure)
         deallocate (answer%state%gap)
      end do
      answer%errors = min(answer%errors, largest_errors(surface%full_contact_peak))
   end subroutine solve_by_cascade

   !> Whether there is memory for the solution on a grid: it is asked for all at once, and given back.
   logical function fits_memory(grid)
      integer, intent(in) :: grid(2)

      !> Numbers a point: pressure, gap, undeformed gap, four of the search, spectrum, the refined start, the edge.
      integer, parameter :: numbers = 10
      real(dp), allocatable :: probe(:, :, :)
      integer :: status

      allocate (probe(grid(1), grid(2), numbers), stat=status)
      fits_memory = status == 0
   end function fits_memory

   !> The first grid, the first whose changes tell of all waves of the surface, and the last.
   pure subroutine plan_grids(surface, points, first, trusted, last)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)
      integer, intent(out) :: first(2), trusted(2), last(2)   !! of a quarter cell, if the surface is even

      integer :: parts(2), least(2)

      parts = merge(2, 1, surface%shape%is_even())
      if (surface%dimension == 1) parts(2) = 1
      least = 2*first_points/parts
      if (surface%dimension == 1) least(2) = 1
      if (all(points > 0)) then
         last = points/parts
         trusted = last
         first = coarsest(last)
      else if (all(surface%points > 0)) then
         last = finest(surface%points/parts)
         trusted = min(2*surface%points/parts, last)
         first = coarsest(surface%points/parts)
      else
         first = least*easy(max(1, ubound(surface%shape%c)))
         if (surface%dimension == 1) first(2) = 1
         trusted = first
         last = finest(first)
      end if

   contains

      !> A grid halved as long as it can be and something is left of it.
      pure function coarsest(grid)
         integer, intent(in) :: grid(2)
         integer :: coarsest(2)

         coarsest = grid
         do while (all((mod(coarsest, 2) == 0 .and. coarsest/2 >= least) .or. coarsest == 1))
            if (all(coarsest == 1)) exit
            coarsest = max(coarsest/2, 1)
         end do
      end function coarsest

      !> A grid doubled as long as it is not too fine.
      pure function finest(grid)
         integer, intent(in) :: grid(2)
         integer :: finest(2)

         integer :: most

         most = most_points(surface%dimension)*product(2/parts)
         finest = grid
         do while (product(finest) <= most/2**surface%dimension)
            finest = 2*finest
            if (surface%dimension == 1) finest(2) = 1
         end do
      end function finest

   end subroutine plan_grids

   !> The next number whose transforms are fast: 1, 3 or 5 times a power of two.
   elemental integer function easy(number)
      integer, intent(in) :: number   !! >= 1

      integer :: power

      power = 1
      do while (5*power < number)
         power = 2*power
      end do
      easy = 5*power
      if (3*power >= number) easy = 3*power
      if (2*power >= number) easy = 2*power
      if (power >= number) easy = power
   end function easy

   subroutine solve_level(surface, mean_pressure, tolerance, answer)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: mean_pressure, tolerance
      type(cascade_answer), intent(inout) :: answer

      type(compliance_operator) :: half_space
      real(dp), allocatable :: h(:, :)
      integer :: points(2)

      points = shape(answer%state%pressure)
      allocate (h(points(1), points(2)))
      call half_space%start(surface, points)
      call half_space%transform%sample(surface%shape, h)
      h = 1.0_dp - h
      answer%state%pressure = answer%state%pressure*(mean_pressure*size(h)/sum(answer%state%pressure))
      call solve_on_grid(half_space, h, mean_pressure, tolerance, iteration_limit, answer%state)
      answer%iterations = answer%iterations + answer%state%iterations
      answer%transform_pairs = answer%transform_pairs/2**surface%dimension + half_space%transform_pairs
   end subroutine solve_level

   !> Errors that no change tells of: the edge's place between the points, where two grids may err alike; while the
   !> grid is too coarse for it, the last open gap, between points that are all in contact; a peak made of fewer
   !> points than its polynomial.
   pure function unresolved(surface, edge, peak_resolved) result(errors)
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge
      logical, intent(in) :: peak_resolved
      real(dp) :: errors(3)                    !! of mean gap, contact area and peak pressure

      !> At each point the edge is placed to this part of a step, and on the average over many of them to this; where no
      !> symmetry ties the points to the edge, three grids may err alike by more.
      real(dp), parameter :: edge_scatter = 0.1_dp, edge_uncertainty(2) = [0.005_dp, 0.02_dp]
      !> Hertz's peak pressure of a contact of half width or radius a: this times a over the radius of curvature.
      real(dp), parameter :: hertz_peak(2) = [2*pi, 8.0_dp]

      real(dp) :: open_part, step(2)
      integer :: edges, m, n

      associate (field => edge%pressure_or_gap)
         m = size(field, 1)
         n = size(field, 2)
         edges = count((field(:m - 1, :) > 0.0_dp) .neqv. (field(2:, :) > 0.0_dp)) &
                 + count((field(:, :n - 1) > 0.0_dp) .neqv. (field(:, 2:) > 0.0_dp))
         associate (uncertainty => edge_uncertainty(merge(1, 2, edge%even)))
            errors = [0.0_dp, max(edge_scatter*sqrt(real(edges, dp)), uncertainty*edges)/size(field), 0.0_dp]
         end associate
         if (all(field > 0.0_dp)) then
            ! With this part of the surface the mean gap falls as the power 5/2 or faster, and with it the change of
            ! the peak.
            open_part = max(1, hidden_openings(edge))/real(size(field), dp)
            errors = [open_part**2, open_part, open_part**2]
         else if (.not. peak_resolved) then
            ! The contact may have its edge between the first and the second point from the crest.
            step = surface%length/(merge(2, 1, edge%even)*[m, n])
            if (n == 1) step(2) = 0.0_dp
            errors(3) = hertz_peak(surface%dimension)*1.5_dp*maxval(step)*surface%stiffness*surface%crest_curvature
         end if
      end associate
   end function unresolved

   !> Errors of mean gap and peak pressure that their changes on three grids may not show, from that of the area.
   pure function hidden_by_chance(dimension, values, area_error) result(errors)
      integer, intent(in) :: dimension
      real(dp), intent(in) :: values(3), area_error
      real(dp) :: errors(3)                  !! of mean gap, contact area and peak pressure; of the area none

      !> Both converge faster than the area, but not by much more than this.
      real(dp), parameter :: least_of_area = 0.01_dp
      !> With these powers of the open part the mean gap falls towards full contact.
      real(dp), parameter :: closing_power(2) = [4.0_dp, 2.5_dp]
      real(dp) :: open_part

      errors = 0.0_dp
      open_part = 1.0_dp - values(2)
      associate (gap => values(1), area => values(2), peak => values(3))
         if (.not. min(gap, area, open_part) > 0.0_dp) return
         errors = least_of_area*area_error*[min(gap, 1.0_dp - gap)/min(area, open_part), 0.0_dp, peak/area]
         ! A last gap that a few points make may well be much larger.
         if (area_error >= open_part) errors(1) = max(errors(1), min(area_error**2, &
            gap*((1.0_dp + area_error/open_part)**closing_power(dimension) - 1.0_dp)))
      end associate
   end function hidden_by_chance

   !> Points in contact whose pressure is so far below a neighbour's that there may be a gap beside them.
   pure integer function hidden_openings(edge)
      type(grid_edge), intent(in) :: edge

      real(dp) :: around
      integer :: i, j

      hidden_openings = 0
      associate (field => edge%pressure_or_gap)
         do j = 1, size(field, 2)
            do i = 1, size(field, 1)
               around = max(field(edge%place(i - 1, 1), j), field(edge%place(i + 1, 1), j), &
                            field(i, edge%place(j - 1, 2)), field(i, edge%place(j + 1, 2)))
               if (around > 2*field(i, j)) hidden_openings = hidden_openings + 1
            end do
         end do
      end associate
   end function hidden_openings

   !> The pressure on a grid twice as fine, linear between points. In 1-D the second direction stays.
   pure subroutine refine(coarse, even, fine)
      real(dp), intent(in) :: coarse(:, :)
      logical, intent(in) :: even
      real(dp), allocatable, intent(out) :: fine(:, :)

      real(dp), allocatable :: half_way(:, :)
      integer :: m, n, i

      m = size(coarse, 1)
      n = size(coarse, 2)
      allocate (half_way(2*m, n))
      if (even) then
         half_way(1::2, :) = 0.75_dp*coarse + 0.25_dp*coarse([(max(i - 1, 1), i=1, m)], :)
         half_way(2::2, :) = 0.75_dp*coarse + 0.25_dp*coarse([(min(i + 1, m), i=1, m)], :)
      else
         half_way(1::2, :) = coarse
         half_way(2::2, :) = 0.5_dp*(coarse + coarse([(mod(i, m) + 1, i=1, m)], :))
      end if
      if (n == 1) then
         call move_alloc(half_way, fine)
         return
      end if
      allocate (fine(2*m, 2*n))
      if (even) then
         fine(:, 1::2) = 0.75_dp*half_way + 0.25_dp*half_way(:, [(max(i - 1, 1), i=1, n)])
         fine(:, 2::2) = 0.75_dp*half_way + 0.25_dp*half_way(:, [(min(i + 1, n), i=1, n)])
      else
         fine(:, 1::2) = half_way
         fine(:, 2::2) = 0.5_dp*(half_way + half_way(:, [(mod(i, n) + 1, i=1, n)]))
      end if
   end subroutine refine

end module wavycon_grid_cascade
