!> Contact by boundary-fitted expansions, whose digits are limited by rounding and not by a grid. On request grids
!> take over where spots are about to merge, or have merged to bands, and the expansions are not as accurate as asked for.
module wavycon_fitted_contact
   use wavycon_constants, only: pi
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: contact_measures, unmeasured
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_state, only: by_fitted, contact_state, converged, not_accurate, not_found
   use wavycon_edge_curves, only: edge_curve
   use wavycon_fitted_fields, only: fitted_fields, start_fitted_fields
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_fitted_solver, only: fitted_answer, fitted_less_exact, fitted_solved, solve_fitted
   use wavycon_grid_contact, only: grid_contact
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: fitted_contact

   type, extends(contact_solver) :: fitted_contact
      type(grid_contact), allocatable :: grids     !! that take over; not allocated if none are to
      type(fitted_frame), private :: frame
      real(dp), private :: accuracy = 1e-3_dp
      logical, private :: keep_fields = .true.
      type(fitted_answer), private :: last         !! of the load before
   contains
      procedure :: start
      procedure :: solve
      procedure :: solved_fields
      procedure :: solved_edge_curves
      procedure :: describe
   end type fitted_contact

   type, extends(contact_fields) :: fields_of_answer
      type(surface_type) :: surface
      type(fitted_frame) :: frame
      type(fitted_fields) :: fitted
   contains
      procedure :: at
      procedure :: on_cell
   end type fields_of_answer

   !> Points of an edge for a table.
   integer, parameter :: edge_points = 256

contains

   subroutine start(self, surface, accuracy, with_grids, keep_fields)
      class(fitted_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface   !! one that find_frame covers
      real(dp), intent(in) :: accuracy            !! of mean gap [Delta], contact area fraction, peak pressure [p*]
      logical, intent(in) :: with_grids           !! whether grids take over where the expansions are less exact
      logical, intent(in) :: keep_fields          !! whether the fields will be asked for

      self%surface = surface
      self%accuracy = accuracy
      self%keep_fields = keep_fields
      call find_frame(surface, self%frame)
      if (with_grids) then
         allocate (self%grids)
         call self%grids%start(surface, accuracy, keep_fields)
      end if
   end subroutine start

   subroutine solve(self, pbar_over_pstar, state)
      class(fitted_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar     !! P
      type(contact_state), intent(out) :: state

      type(contact_state) :: on_grids
      type(fitted_answer) :: answer
      logical :: settled
      real(dp) :: peak

      call self%settle(pbar_over_pstar, state, settled)
      if (settled) return
      ! The solver's accuracy is relative; the largest of the three values is the peak, in full contact.
      peak = 1.0_dp + self%surface%full_contact_peak
      call solve_fitted(self%frame%lattice, pbar_over_pstar/self%frame%pressure_unit, self%accuracy/peak, answer, &
                        self%last, self%keep_fields)
      state%solver = by_fitted
      state%status = not_found
      state%measures = unmeasured(self%surface%full_contact_peak)
      if (answer%status == fitted_solved .or. answer%status == fitted_less_exact) then
         self%last = answer
         call take_measures(self%frame, answer, state)
         allocate (state%fitted, source=answer)
         state%status = not_accurate
         if (largest_error(state) <= self%accuracy) state%status = converged
      end if
      if (state%status == converged .or. .not. allocated(self%grids)) return

      call self%grids%solve(pbar_over_pstar, on_grids)
      if (on_grids%status == converged .or. .not. allocated(state%fitted)) then
         state = on_grids
      else if (largest_error(on_grids) < largest_error(state)) then
         state = on_grids
      end if
   end subroutine solve

   subroutine take_measures(frame, answer, state)
      type(fitted_frame), intent(in) :: frame
      type(fitted_answer), intent(in) :: answer
      type(contact_state), intent(inout) :: state

      state%measures = contact_measures(mean_gap_over_amplitude=answer%mean_gap, &
                                        approach_over_amplitude=1.0_dp - answer%mean_gap, &
                                        contact_area_fraction=answer%area_fraction, &
                                        peak_pressure_over_pstar=answer%peak_pressure*frame%pressure_unit, &
                                        min_pressure_over_pstar=0.0_dp, &
                                        mean_gap_error=answer%mean_gap_error, &
                                        contact_area_error=answer%area_error, &
                                        peak_pressure_error=answer%peak_error*frame%pressure_unit)
      state%pivots = answer%iterations
      state%kkt_residual = answer%residual
   end subroutine take_measures

   pure real(dp) function largest_error(state)
      type(contact_state), intent(in) :: state

      associate (measures => state%measures)
         largest_error = max(measures%mean_gap_error, measures%contact_area_error, measures%peak_pressure_error)
      end associate
   end function largest_error

   subroutine solved_fields(self, state, fields)
      class(fitted_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      class(contact_fields), allocatable, intent(out) :: fields

      type(fields_of_answer), allocatable :: own

      if (allocated(state%edge)) then
         call self%grids%solved_fields(state, fields)
         return
      end if
      allocate (own)
      own%surface = self%surface
      own%frame = self%frame
      call start_fitted_fields(own%fitted, self%frame%lattice, state%fitted)
      call move_alloc(own, fields)
   end subroutine solved_fields

   subroutine at(self, x, y, pressure, displacement)
      class(fields_of_answer), intent(inout) :: self
      real(dp), intent(in) :: x, y
      real(dp), intent(out) :: pressure, displacement

      complex(dp) :: place
      real(dp) :: gap

      associate (length => self%surface%length)
         place = self%frame%place(length(1)*x/(2*pi), length(2)*y/(2*pi))
      end associate
      call self%fitted%at(place, pressure, displacement, gap)
      pressure = pressure*self%frame%pressure_unit
   end subroutine at

   !> A point with those that mirror it, and with those that are like it on a square cell and about a second crest,
   !> is evaluated once.
   subroutine on_cell(self, intervals, dimension, pressure, displacement)
      class(fields_of_answer), intent(inout) :: self
      integer, intent(in) :: intervals, dimension
      real(dp), allocatable, intent(out) :: pressure(:, :), displacement(:, :)

      integer :: k, l, image(2)

      associate (always_two => dimension); end associate
      allocate (pressure(0:intervals, 0:intervals), displacement(0:intervals, 0:intervals))
      do l = 0, intervals
         do k = 0, intervals
            image = first_image(k, l)
            if (all(image == [k, l])) then
               call self%at(2*pi*k/intervals, 2*pi*l/intervals, pressure(k, l), displacement(k, l))
            else
               pressure(k, l) = pressure(image(1), image(2))
               displacement(k, l) = displacement(image(1), image(2))
            end if
         end do
      end do

   contains

      !> Of the points like this one, that which comes first.
      pure function first_image(i, j) result(first)
         integer, intent(in) :: i, j
         integer :: first(2)

         integer :: other(2)

         first = ordered([min(i, intervals - i), min(j, intervals - j)])
         if (self%frame%crests == 2 .and. mod(intervals, 2) == 0) then
            other = ordered(intervals/2 - first)
            if (other(2) < first(2) .or. (other(2) == first(2) .and. other(1) < first(1))) first = other
         end if
      end function first_image

      pure function ordered(point)
         integer, intent(in) :: point(2)
         integer :: ordered(2)

         ordered = point
         if (self%frame%lattice%square .and. point(2) > point(1)) ordered = point([2, 1])
      end function ordered

   end subroutine on_cell

   !> A curve about each crest, or about each trough.
   subroutine solved_edge_curves(self, state, curves)
      class(fitted_contact), intent(in) :: self
      type(contact_state), intent(in) :: state
      type(edge_curve), allocatable, intent(out) :: curves(:)

      complex(dp) :: centre, edge(edge_points), to_surface
      type(fitted_fields) :: fields
      integer :: i, k, turned

      if (allocated(state%edge)) then
         call self%grids%solved_edge_curves(state, curves)
         return
      end if
      call start_fitted_fields(fields, self%frame%lattice, state%fitted)
      to_surface = self%frame%side/self%frame%turn
      edge = (fields%edge(edge_points) - fields%centre)*to_surface
      ! With the contact on the left.
      if (state%fitted%island) edge = edge(edge_points:1:-1)
      ! The second of two islands is the first one turned by half a turn, the second half of a cell the first one moved.
      allocate (curves(self%frame%crests*fields%places))
      do k = 1, size(curves)
         turned = merge(-1, 1, k > self%frame%crests)
         centre = turned*fields%centre*to_surface
         associate (length => self%surface%length, places => [(mod(i, edge_points) + 1, i=0, edge_points)], &
                    half_cells => modulo(k - 1, self%frame%crests))
            curves(k)%phi = in_cell(2*pi*centre%re/length(1) + pi*half_cells) + 2*pi*turned*edge(places)%re/length(1)
            curves(k)%theta = in_cell(2*pi*centre%im/length(2) + pi*half_cells) + 2*pi*turned*edge(places)%im/length(2)
         end associate
      end do

   contains

      !> The same angle between 0 and 2 pi.
      pure real(dp) function in_cell(angle)
         real(dp), intent(in) :: angle

         !> An angle of 0 or pi, less rounding, is not to jump.
         real(dp), parameter :: rounding = 1e-9_dp

         in_cell = angle - 2*pi*floor(angle/(2*pi) + rounding)
      end function in_cell

   end subroutine solved_edge_curves

   pure function describe(self) result(words)
      class(fitted_contact), intent(in) :: self
      character(:), allocatable :: words

      words = 'boundary-fitted expansions to within '//short_number(self%accuracy)
      if (allocated(self%grids)) words = words//', grids where these cannot'
   end function describe

end module wavycon_fitted_contact
