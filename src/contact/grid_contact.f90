!> Contact on grids, to an accuracy asked for or on a grid of so many points.
!>
!> Surfaces that mirror themselves are solved on a quarter of their cell. The wave (21), and any like it, repeats
!> itself on a square of half the area turned by 45 degrees, of which a quarter is enough, unless the points are to
!> lie on the user's cell.
module wavycon_grid_contact
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: contact_measures, unmeasured
   use wavycon_contact_state, only: by_grid, contact_state, converged, no_memory, not_accurate
   use wavycon_edge_curves, only: edge_curve, strip_ends, trace_edges, turn_curves, whole_strips
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_cascade, only: cascade_answer, solve_by_cascade
   use wavycon_grid_edge, only: grid_strip_edges, start_grid_edge
   use wavycon_grid_progress, only: grid_progress
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_qp_problem, only: qp_iteration_limit, qp_status_name
   use wavycon_series_contact, only: series_contact
   use wavycon_surface, only: surface_type
   use wavycon_turned_series, only: to_half_angles
   implicit none (type, external)
   private

   public :: grid_contact

   type, extends(series_contact) :: grid_contact
      class(grid_progress), pointer :: progress => null()   !! that hears of each grid
      real(dp), private :: accuracy = 0.0_dp                 !! asked for
      integer, private :: points(2) = 0                      !! likewise
      integer, private :: level = 0
      logical, private :: keep_fields = .true., turned = .false.
      type(surface_type), private :: solved                  !! the surface on the cell that is solved
   contains
      procedure :: start
      procedure :: cheaper_levels
      procedure :: use_level
      procedure :: solve
      procedure :: solved_pressure
      procedure :: solved_edge_curves
      procedure :: describe
   end type grid_contact

contains

   subroutine start(self, surface, accuracy, keep_fields, points)
      class(grid_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: accuracy      !! of mean gap [Delta], contact area fraction and peak pressure [p*]
      logical, intent(in) :: keep_fields    !! whether `pressure`, `fields` and `edge_curves` will be asked for
      !> Of the whole cell; if present and above zero the grid to be solved, whatever the accuracy. Even numbers for
      !> a surface that mirrors itself; of a profile the first alone counts.
      integer, intent(in), optional :: points(2)

      self%surface = surface
      self%accuracy = accuracy
      self%keep_fields = keep_fields
      if (present(points)) self%points = points
      if (surface%dimension == 1) self%points(2) = min(self%points(2), 1)
      self%solved = surface
      self%turned = all(self%points == 0) .and. surface%has_smaller_cell()
      if (self%turned) self%solved = surface%smaller_cell()
   end subroutine start

   !> One ten times less accurate, or with half the points, each.
   integer function cheaper_levels(self) result(levels)
      class(grid_contact), intent(in) :: self

      !> What is less is no guide to the better answer.
      real(dp), parameter :: worst_accuracy = 1e-2_dp
      integer, parameter :: least_points = 64

      levels = 0
      if (all(self%points > 0)) then
         do while (all(mod(self%points, 2**(levels + 2)) == 0 .or. self%points == 1) .and. &
                   maxval(self%points)/2**(levels + 1) >= least_points)
            levels = levels + 1
         end do
      else
         do while (self%accuracy*10.0_dp**levels < worst_accuracy)
            levels = levels + 1
         end do
      end if
   end function cheaper_levels

   subroutine use_level(self, level)
      class(grid_contact), intent(inout) :: self
      integer, intent(in) :: level

      self%level = level
   end subroutine use_level

   subroutine solve(self, pbar_over_pstar, state)
      class(grid_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar     !! P
      type(contact_state), intent(out) :: state

      type(cascade_answer) :: answer
      logical :: settled

      call self%settle(pbar_over_pstar, state, settled)
      if (settled) return
      associate (accuracy => self%accuracy*10.0_dp**self%level, points => self%points/2**self%level)
         if (associated(self%progress)) then
            call solve_by_cascade(self%solved, pbar_over_pstar, accuracy, points, answer, self%progress)
         else
            call solve_by_cascade(self%solved, pbar_over_pstar, accuracy, points, answer)
         end if
      end associate
      state%status = no_memory
      state%solver = by_grid
      state%measures = unmeasured(self%surface%full_contact_peak)
      if (.not. allocated(answer%state%gap)) return
      state%measures = contact_measures(mean_gap_over_amplitude=answer%values(1), &
                                        approach_over_amplitude=1.0_dp - answer%values(1), &
                                        contact_area_fraction=answer%values(2), &
                                        peak_pressure_over_pstar=answer%values(3), &
                                        min_pressure_over_pstar=minval(answer%state%pressure), &
                                        mean_gap_error=answer%errors(1), contact_area_error=answer%errors(2), &
                                        peak_pressure_error=answer%errors(3))
      state%active_constraints = count(answer%state%pressure <= 0.0_dp)
      state%pivots = answer%iterations
      state%kkt_residual = answer%state%residual
      if (.not. answer%state%converged) then
         state%status = qp_status_name(qp_iteration_limit)
      else if (answer%accurate .or. (all(self%points > 0) .and. .not. answer%out_of_memory)) then
         state%status = converged
      else if (answer%out_of_memory) then
         state%status = no_memory
      else
         state%status = not_accurate
      end if
      if (self%keep_fields) then
         allocate (state%edge)
         call start_grid_edge(state%edge, answer%state%pressure, answer%state%gap, self%solved%shape%is_even())
      end if
   end subroutine solve

   function solved_pressure(self, state) result(field)
      class(grid_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(fourier_series) :: field

      type(grid_transform) :: transform
      real(dp), allocatable :: p(:, :)

      allocate (p, mold=state%edge%pressure_or_gap)
      p = max(state%edge%pressure_or_gap, 0.0_dp)
      call transform%start(shape(p), state%edge%even)
      call transform%series(p, field)
      if (self%turned) field = to_half_angles(field)
   end function solved_pressure

   subroutine solved_edge_curves(self, state, curves)
      class(grid_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      real(dp), allocatable :: edges(:)

      if (self%solved%dimension == 2) then
         call trace_edges(state%edge, curves)
         if (self%turned) call fill_whole_cell(curves)
         return
      end if
      call grid_strip_edges(state%edge, edges)
      if (state%edge%even) then
         call strip_ends(edges, state%edge%in_contact(1, 1), curves)
      else
         call whole_strips(edges, state%edge%in_contact(1, 1), curves)
      end if
   end subroutine solved_edge_curves

   !> From the smaller cell to the surface's own, of which it is half: the other half is like it, half a cell away.
   subroutine fill_whole_cell(curves)
      type(edge_curve), allocatable, intent(inout) :: curves(:)

      integer :: i

      call turn_curves(curves, factor=0.5_dp)
      curves = [curves, curves]
      do i = size(curves)/2 + 1, size(curves)
         curves(i)%phi = curves(i)%phi + pi
         curves(i)%theta = curves(i)%theta + pi
      end do
   end subroutine fill_whole_cell

   pure function describe(self) result(words)
      class(grid_contact), intent(in) :: self
      character(:), allocatable :: words

      if (all(self%points > 0)) then
         words = 'a grid of '//integer_text(self%points(1))
         if (self%solved%dimension == 2) words = words//' x '//integer_text(self%points(2))
         words = words//' points'
      else
         words = 'grids refined until mean gap, area and peak pressure are within '//short_number(self%accuracy)
      end if
      if (self%solved%shape%is_even()) words = words//', on a quarter of the cell'
      if (self%turned) words = words//' turned by 45 degrees'
   end function describe

end module wavycon_grid_contact
