!> The solution at one load: a record of numbers, and a source from which fields, edge of contact and stresses are
!> computed when they are asked for.
!>
!> Callers use a solution without regard to the solver that made it. Positions of fields and edges are the angles X, Y
!> of the surface's cell. Ranks are the processes of the parallel program.
module wavycon_contact_solution
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_spots, only: contact_spots, find_spots, one_region
   use wavycon_contact_contours, only: contact_contour
   use wavycon_field_source, only: field_source
   use wavycon_fourier_series, only: fourier_series
   use wavycon_full_contact, only: full_contact_series
   use wavycon_grid_source, only: grid_source
   use wavycon_kinds, only: dp, int64
   use wavycon_quantities, only: area_slope, contact_area, gap_slope, quantities
   use wavycon_series_fields, only: series_fields, start_edgeless_fields
   use wavycon_series_stress_fields, only: series_stress_fields, start_series_stress_fields
   use wavycon_solution_record, only: by_grid, full_contact, interrupted, is_good_status, no_load, no_memory, &
      record_words, solution_record
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solution

   !> Error of the stresses below a pressure whose Fourier series is known exactly, relative to the peak pressure.
   real(dp), parameter :: rounding = 1e-14_dp

   type, extends(solution_record) :: contact_solution
      !> The source of a partial contact. It is not allocated if the solver was started without keep_fields, if another
      !> rank has solved the load or has the collected fields, if there is no solution, in full contact and without
      !> load. The last two need no source.
      class(field_source), allocatable :: source
   contains
      procedure :: move_to, is_good, has_numbers, fields, contact_contours, stresses, spots
      procedure :: coefficients, details, derivatives, distributed_points, collect_fields, is_kept
      procedure :: pack => pack_solution
      procedure :: unpack => unpack_solution
   end type contact_solution

contains

   !> Moves a solution to another variable without copying its fields.
   subroutine move_to(self, to)
      class(contact_solution), intent(inout) :: self   !! has no source afterwards
      type(contact_solution), intent(inout) :: to

      to%solution_record = self%solution_record
      call move_alloc(self%source, to%source)
   end subroutine move_to

   !> Whether the status says that the solution is what was requested (`is_good_status`).
   pure logical function is_good(self)
      class(contact_solution), intent(in) :: self

      is_good = is_good_status(self%status)
   end function is_good

   !> Whether the record has numbers of a solution, be they as accurate as requested or not. A solution that is not good
   !> has them if it has a source.
   pure logical function has_numbers(self)
      class(contact_solution), intent(in) :: self

      has_numbers = self%is_good() .or. allocated(self%source)
   end function has_numbers

   !> Pressure, displacement and gap. They are NaN for a partial contact without a source.
   subroutine fields(self, surface, answer)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface             !! the surface that was solved
      class(contact_fields), allocatable, intent(out) :: answer

      type(series_fields), allocatable :: own

      if (allocated(self%source)) then
         call self%source%fields(surface, answer)
      else
         allocate (own)
         call start_edgeless_fields(own, surface, self%pbar_over_pstar, self%status)
         call move_alloc(own, answer)
      end if
   end subroutine fields

   !> The edge of contact: closed curves in 2-D, the two ends of each strip in 1-D. There are no curves in full contact,
   !> without load, and without a source.
   subroutine contact_contours(self, surface, curves)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface             !! the surface that was solved
      type(contact_contour), allocatable, intent(out) :: curves(:)

      if (allocated(self%source)) then
         call self%source%contact_contours(surface, curves)
      else
         allocate (curves(0))
      end if
   end subroutine contact_contours

   !> The stresses below the surface. They are exact but for rounding in full contact, and zero without load. They do
   !> not exist for a partial contact without a source.
   subroutine stresses(self, surface, answer)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface             !! the surface that was solved
      class(stress_fields), allocatable, intent(out) :: answer

      real(dp) :: largest, mean   ! largest and mean pressure [p*]: none of a tension that nothing holds
      type(fourier_series) :: pressure
      type(series_stress_fields), allocatable :: own

      if (allocated(self%source)) then
         call self%source%stresses(surface, answer)
      else if (self%status /= full_contact .and. self%status /= no_load) then
         allocate (answer, source=stress_fields(exist=.false.))
      else
         mean = merge(self%pbar_over_pstar, 0.0_dp, self%status == full_contact)
         largest = merge(abs(mean) + surface%full_contact_peak, 0.0_dp, self%status == full_contact)
         call self%coefficients(surface, pressure)
         allocate (own)
         call start_series_stress_fields(own, surface, pressure, mean, pressure_error=rounding*largest, &
                                         is_sampled=.false.)
         call move_alloc(own, answer)
      end if
   end subroutine stresses

   !> The spots, which are regions of contact, and the pools, which are regions of open gap; of a mirrored height map
   !> those of the map. The arrays of `answer` are not allocated for a partial contact without a source.
   subroutine spots(self, surface, answer)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface      !! the surface that was solved
      type(contact_spots), intent(out) :: answer

      type(contact_contour), allocatable :: curves(:)
      logical :: is_full

      call self%contact_contours(surface, curves)
      is_full = self%value(contact_area) > 0.5_dp
      if (size(curves) > 0) then
         call find_spots(curves, self%value(contact_area), surface%dimension, surface%length, surface%mirrored, answer)
      else if (self%is_good() .or. is_full) then
         call one_region(is_full, surface%dimension, answer)
      end if
   end subroutine spots

   !> The Fourier series of p/p* in X and Y, if the solver computes one; otherwise series%c is not allocated. Full
   !> contact has its own series, and without a source all coefficients are zero.
   subroutine coefficients(self, surface, series)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface      !! the surface that was solved
      type(fourier_series), intent(out) :: series

      if (allocated(self%source)) then
         call self%source%coefficients(series)
      else if (self%status == full_contact) then
         series = full_contact_series(surface, self%pbar_over_pstar)
      else
         allocate (series%c(0:surface%shape%last(1), 0:surface%shape%last(2)), source=0.0_dp)
      end if
   end subroutine coefficients

   !> The quantities of the record and those that are only computed when they are asked for.
   subroutine details(self, answer)
      class(contact_solution), intent(in) :: self
      type(quantities), intent(out) :: answer

      answer = self%quantities
      if (allocated(self%source)) call self%source%details(answer)
   end subroutine details

   !> Derivatives of mean gap and area with respect to the load. In full contact both slopes are zero, because the gap
   !> stays closed. Without load, and for a partial contact without a source, all derivatives are unknown.
   subroutine derivatives(self, surface, answer)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface      !! the surface that was solved
      type(quantities), intent(out) :: answer

      if (allocated(self%source)) then
         call self%source%derivatives(surface, answer)
      else if (self%status == full_contact) then
         answer%value([gap_slope, area_slope]) = 0.0_dp
         answer%error([gap_slope, area_slope]) = 0.0_dp
      end if
   end subroutine derivatives

   !> The number of points of the grid if its columns are distributed over the ranks, otherwise 0.
   pure integer(int64) function distributed_points(self)
      class(contact_solution), intent(in) :: self

      distributed_points = 0
      if (allocated(self%source)) distributed_points = self%source%distributed_points
   end function distributed_points

   !> Gathers fields that are distributed over the ranks on rank 0; the other ranks have no source afterwards. All ranks
   !> call this procedure.
   subroutine collect_fields(self)
      class(contact_solution), intent(inout) :: self

      logical :: is_here

      if (.not. allocated(self%source)) return
      call self%source%collect(is_here)
      if (.not. is_here) deallocate (self%source)
   end subroutine collect_fields

   !> Whether a solution is written to checkpoints. Solutions on grids are, because they may take minutes; those of
   !> other solvers take seconds and are computed again. A load that lacked memory or was interrupted is solved again
   !> too.
   pure logical function is_kept(self)
      class(contact_solution), intent(in) :: self

      is_kept = self%solver == by_grid .and. .not. any(self%status == [interrupted, no_memory])
   end function is_kept

   !> Packs a solution into 8-byte words for a checkpoint, so that a resumed run need not compute the solution again:
   !> the record, and the numbers of the source if there is one.
   subroutine pack_solution(self, words)
      class(contact_solution), intent(in) :: self            !! a solution with is_kept() = .true.
      integer(int64), allocatable, intent(out) :: words(:)   !! not allocated if there is not enough memory

      real(dp), allocatable :: values(:)

      allocate (values(0))
      if (allocated(self%source)) then
         select type (source => self%source)
         type is (grid_source)
            call source%pack(values)
         end select
      end if
      if (allocated(values)) words = [transfer(self%solution_record, [0_int64]), transfer(values, [0_int64])]
   end subroutine pack_solution

   !> Restores a solution from the words of pack_solution. The words of a distributed grid come from several ranks, each
   !> with some of the columns. So the procedure is called for the words of one rank after the other, in any order,
   !> until `complete` is true.
   subroutine unpack_solution(self, words, whole, complete)
      class(contact_solution), intent(inout) :: self     !! before the first call it has no source
      integer(int64), intent(in) :: words(:)             !! packed by the same version of the program, same surface
      logical, intent(in) :: whole                       !! whether this rank needs all columns of a distributed grid
      logical, intent(out) :: complete                   !! whether all columns that this rank needs have been found

      self%solution_record = transfer(words(:record_words), self%solution_record)
      complete = size(words) == record_words
      if (complete) return
      if (.not. allocated(self%source)) allocate (grid_source :: self%source)
      self%source%record = self%solution_record
      select type (source => self%source)
      type is (grid_source)
         call source%unpack(transfer(words(record_words + 1:), [0.0_dp]), whole, complete)
      end select
   end subroutine unpack_solution

end module wavycon_contact_solution
