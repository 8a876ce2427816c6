!> Contact on grids to an accuracy asked for.
!>
!> The 1-D wave is solved on half a wavelength. The 2-D wave (21) is solved on its primitive cell, a square of side
!> lambda/sqrt2 with one crest: X = phi + theta, Y = phi - theta, h/Delta = 1 - (cos X + cos Y)/2, of which a quarter is enough.
module wavycon_grid_contact
   use wavycon_contact_measures, only: contact_measures
   use wavycon_contact_solver, only: contact_solver, settle_without_solver
   use wavycon_contact_state, only: contact_state, converged, not_accurate
   use wavycon_cosine_series, only: cosine_series
   use wavycon_compliance_operator, only: cosine_coefficients
   use wavycon_edge_curves, only: edge_curve, strip_ends, trace_edges
   use wavycon_grid_cascade, only: cascade_answer, solve_by_cascade
   use wavycon_grid_edge, only: grid_strip_edges, start_grid_edge
   use wavycon_harmonic_surface, only: harmonic_surface, wave_sum
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_iteration_limit, qp_status_name
   implicit none (type, external)
   private

   public :: grid_contact

   type, extends(contact_solver) :: grid_contact
      private
      integer :: dimension = 2
      real(dp) :: accuracy = 1e-4_dp
      logical :: keep_fields = .true.
      type(harmonic_surface) :: surface
   contains
      procedure :: start
      procedure :: solve
      procedure :: pressure
      procedure :: displacement
      procedure :: edge_curves
      procedure :: describe
   end type grid_contact

contains

   subroutine start(self, dimension, accuracy, keep_fields)
      class(grid_contact), intent(out) :: self
      integer, intent(in) :: dimension      !! 1 or 2
      real(dp), intent(in) :: accuracy      !! > 0, of mean gap [Delta], contact area fraction and peak pressure [p*]
      logical, intent(in) :: keep_fields    !! whether `pressure` and `displacement` will be asked for

      self%dimension = dimension
      self%accuracy = accuracy
      self%keep_fields = keep_fields
      if (dimension == 1) then
         self%surface = wave_sum([1.0_dp, 1.0_dp], [1.0_dp], [1], [0])
      else
         self%surface = wave_sum([1.0_dp, 1.0_dp], [0.5_dp, 0.5_dp], [1, 0], [0, 1])
      end if
   end subroutine start

   subroutine solve(self, pbar_over_pstar, state)
      class(grid_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar     !! P
      type(contact_state), intent(out) :: state

      type(cascade_answer) :: answer
      logical :: settled

      call settle_without_solver(pbar_over_pstar, state, settled)
      if (settled) return
      call solve_by_cascade(self%surface, self%dimension, pbar_over_pstar, self%accuracy, answer)
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
      else if (answer%accurate) then
         state%status = converged
      else
         state%status = not_accurate
      end if
      if (self%keep_fields) then
         allocate (state%edge)
         call start_grid_edge(state%edge, answer%state%pressure, answer%state%gap)
      end if
   end subroutine solve

   function pressure(self, state) result(field)
      class(grid_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(cosine_series) :: field

      if (allocated(state%edge)) then
         call cosine_coefficients(state%edge%pressure, field%c)
         if (self%dimension == 2) call turn(field)
      else
         field = single_wave(self%dimension, state%pbar_over_pstar)
         field%c(0, 0) = state%pbar_over_pstar
      end if
   end function pressure

   function displacement(self, state) result(field)
      class(grid_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(cosine_series) :: field

      integer :: i, j

      if (allocated(state%edge)) then
         call cosine_coefficients(state%edge%pressure, field%c)
         do j = 0, ubound(field%c, 2)
            do i = 0, ubound(field%c, 1)
               if (i + j > 0) field%c(i, j) = field%c(i, j)/(self%surface%stiffness*self%surface%frequency(i, j))
            end do
         end do
         field%c(0, 0) = 0.0_dp
         if (self%dimension == 2) call turn(field)
      else
         field = single_wave(self%dimension, state%pbar_over_pstar)
      end if
   end function displacement

   subroutine edge_curves(self, state, curves)
      class(grid_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      real(dp), allocatable :: edges(:), turned(:)
      integer :: i

      if (.not. allocated(state%edge)) then
         allocate (curves(0))
      else if (self%dimension == 1) then
         call grid_strip_edges(state%edge, edges)
         call strip_ends(edges, state%edge%in_contact(1, 1), curves)
      else
         call trace_edges(state%edge, curves)
         do i = 1, size(curves)
            associate (x => curves(i)%phi, y => curves(i)%theta)
               turned = 0.5_dp*(x + y)
               y = 0.5_dp*(x - y)
               x = turned
            end associate
         end do
      end if
   end subroutine edge_curves

   !> cos phi (cos theta) in full contact, eq. (22), else nothing.
   pure type(cosine_series) function single_wave(dimension, pbar_over_pstar) result(field)
      integer, intent(in) :: dimension
      real(dp), intent(in) :: pbar_over_pstar

      allocate (field%c(0:1, 0:dimension - 1), source=0.0_dp)
      if (pbar_over_pstar >= 1.0_dp) field%c(1, dimension - 1) = 1.0_dp
   end function single_wave

   !> From a series in X = phi + theta, Y = phi - theta, alike in both, to one in phi and theta:
   !> cos mX cos nY + cos nX cos mY = cos(m+n)phi cos(m-n)theta + cos(m-n)phi cos(m+n)theta.
   pure subroutine turn(field)
      type(cosine_series), intent(inout) :: field

      real(dp), allocatable :: turned(:, :)
      integer :: m, n, last

      last = 2*ubound(field%c, 1)
      allocate (turned(0:last, 0:last), source=0.0_dp)
      do n = 0, ubound(field%c, 2)
         do m = 0, ubound(field%c, 1)
            turned(m + n, abs(m - n)) = turned(m + n, abs(m - n)) + 0.5_dp*field%c(m, n)
            turned(abs(m - n), m + n) = turned(abs(m - n), m + n) + 0.5_dp*field%c(m, n)
         end do
      end do
      call move_alloc(turned, field%c)
   end subroutine turn

   pure function describe(self) result(words)
      class(grid_contact), intent(in) :: self
      character(:), allocatable :: words

      character(16) :: number

      write (number, '(es8.1)') self%accuracy
      words = 'each grid twice as fine as the one before, to an accuracy of '//trim(adjustl(number))
   end function describe

end module wavycon_grid_contact
