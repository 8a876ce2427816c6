!> The solution at one load: its measures, fields, edge of contact and details.
!>
!> Every solver extends `contact_solution`; callers use a solution without regard to its solver. Positions of fields and
!> edges are the angles X, Y of the surface's cell.
module wavycon_contact_solution
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: contact_measures, unmeasured
   use wavycon_contact_spots, only: contact_spots, find_spots, no_spots, one_region
   use wavycon_contact_status, only: full_contact, is_good_status
   use wavycon_edge_curves, only: edge_curve
   use wavycon_edgeless_fields, only: edgeless_fields, start_edgeless_fields
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_series_stress, only: series_stress, start_series_stress
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solution, contact_solution_item, solution_without_contact_edge, no_solution
   public :: pack_common, unpack_common

   !> Size of the array that pack_common makes.
   integer, parameter, public :: packed_values = 19

   !> Error of the stresses under a series that is known exactly, over the peak pressure.
   real(dp), parameter :: rounding = 1e-14_dp

   type, abstract :: contact_solution
      real(dp) :: pbar_over_pstar = 0.0_dp    !! P >= 0, the mean pressure over p*
      type(contact_measures) :: measures
      character(12) :: solver = 'none'        !! name of the solver; 'none' if no solver was needed
      integer(int64) :: active_constraints = 0   !! points at which the pressure is held at zero or at the hardness
      integer :: iterations = 0               !! for a quadratic programme, exchanges of variables since the last load
      real(dp) :: residual = 0.0_dp           !! relative, as each solver defines it
      character(16) :: status = ''            !! one of wavycon_contact_status, or of wavycon_qp_problem
   contains
      procedure :: is_good
      procedure :: largest_error
      procedure :: spots
      procedure(fields_of_solution), deferred :: fields
      procedure(edge_of_solution), deferred :: edge_curves
      procedure(stresses_of_solution), deferred :: stresses
      procedure :: coefficients
      procedure :: details
      procedure :: spread_points
      procedure :: collect_fields
      procedure :: is_kept
      procedure :: pack_kept => pack_common
      procedure :: unpack_kept => unpack_common
   end type contact_solution

   abstract interface
      !> Pressure, displacement and gap. Not allocated if the solver was started without keep_fields.
      subroutine fields_of_solution(self, surface, answer)
         import :: contact_fields, contact_solution, surface_type
         class(contact_solution), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! that was solved
         class(contact_fields), allocatable, intent(out) :: answer
      end subroutine fields_of_solution

      !> The edge of contact: closed curves in 2-D, the two ends of each strip in 1-D. There are no curves for full
      !> contact, for no load, and if the solver was started without keep_fields.
      subroutine edge_of_solution(self, surface, curves, loads)
         import :: contact_solution, dp, edge_curve, surface_type
         class(contact_solution), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! that was solved
         type(edge_curve), allocatable, intent(out) :: curves(:)
         !> What each spot carries of the load, by their numbers; of no size if that is not known.
         real(dp), allocatable, intent(out), optional :: loads(:)
      end subroutine edge_of_solution

      !> The stresses below the surface. Not allocated if the solver was started without keep_fields.
      subroutine stresses_of_solution(self, surface, answer)
         import :: contact_solution, stress_fields, surface_type
         class(contact_solution), intent(in) :: self
         type(surface_type), intent(in) :: surface             !! that was solved
         class(stress_fields), allocatable, intent(out) :: answer
      end subroutine stresses_of_solution
   end interface

   !> An element of an array of solutions.
   type :: contact_solution_item
      class(contact_solution), allocatable :: solution
   end type contact_solution_item

   !> Full contact, no load, or no solution at all.
   type, extends(contact_solution) :: solution_without_contact_edge
   contains
      procedure :: fields => fields_without_edge
      procedure :: edge_curves => no_curves
      procedure :: stresses => stresses_of_coefficients
      procedure :: coefficients => uniform_coefficients
   end type solution_without_contact_edge

contains

   !> Whether the numbers are as accurate as requested.
   pure logical function is_good(self)
      class(contact_solution), intent(in) :: self

      is_good = is_good_status(self%status)
   end function is_good

   !> The largest error estimate of mean gap [Delta], contact area fraction and peak pressure [p*].
   pure real(dp) function largest_error(self)
      class(contact_solution), intent(in) :: self

      largest_error = maxval(self%measures%errors())
   end function largest_error

   !> The spots of contact and the pools of gap; of a mirrored height map those of the map. Not known if the solver was
   !> started without keep_fields.
   subroutine spots(self, surface, answer)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface      !! that was solved
      type(contact_spots), intent(out) :: answer

      type(edge_curve), allocatable :: curves(:)
      real(dp), allocatable :: loads(:)
      logical :: is_full

      call self%edge_curves(surface, curves, loads)
      is_full = self%measures%contact_area_fraction > 0.5_dp
      if (size(curves) > 0) then
         call find_spots(curves, self%measures%contact_area_fraction, surface%dimension, surface%length, loads, answer, &
                         surface%mirrored)
      else if (self%is_good() .or. is_full) then
         call one_region(is_full, surface%dimension, answer)
      else
         call no_spots(answer)
      end if
   end subroutine spots

   !> p/p* as the Fourier series in X and Y that the solver computed; series%c is not allocated if it computed none.
   subroutine coefficients(self, surface, series)
      class(contact_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface      !! that was solved
      type(fourier_series), intent(out) :: series

      associate (unused => self, unused_too => surface, none => series); end associate
   end subroutine coefficients

   !> Further numbers of the solution, such as the strain energy. Here there are none.
   subroutine details(self, answer, found)
      class(contact_solution), intent(in) :: self
      type(contact_details), intent(out) :: answer   !! to be used only if found
      logical, intent(out) :: found                  !! whether this solution has them

      associate (unused => self, none => answer); end associate
      found = .false.
   end subroutine details

   !> The points of the grid if its columns are spread over the ranks, otherwise 0.
   pure integer(int64) function spread_points(self)
      class(contact_solution), intent(in) :: self

      associate (unused => self); end associate
      spread_points = 0
   end function spread_points

   !> Brings fields whose columns are spread over the ranks to the first rank: afterwards it has them whole, the others
   !> have none. All ranks call it. Here nothing is spread.
   subroutine collect_fields(self)
      class(contact_solution), intent(inout) :: self

      associate (unused => self); end associate
   end subroutine collect_fields

   !> Whether the solution is written to the checkpoint, so that a resumed run need not compute it again. Here it is
   !> not.
   pure logical function is_kept(self)
      class(contact_solution), intent(in) :: self

      associate (unused => self); end associate
      is_kept = .false.
   end function is_kept

   !> `pack_kept`: the numbers of the solution in one array, from which `unpack_kept` restores it. An extension of the
   !> type appends its own numbers to those of pack_common.
   pure subroutine pack_common(self, values)
      class(contact_solution), intent(in) :: self
      real(dp), allocatable, intent(out) :: values(:)   !! not allocated if there is not enough memory

      associate (measures => self%measures)
         values = [self%pbar_over_pstar, measures%mean_gap_over_amplitude, measures%approach_over_amplitude, &
                   measures%contact_area_fraction, measures%peak_pressure_over_pstar, &
                   measures%min_pressure_over_pstar, measures%mean_gap_error, measures%contact_area_error, &
                   measures%peak_pressure_error, measures%area_at_hardness_fraction, &
                   measures%load_at_hardness_fraction, measures%area_at_hardness_error, &
                   measures%load_at_hardness_error, measures%contact_area_counted_fraction, &
                   measures%contact_area_corrected_fraction, measures%load_concentration, &
                   real(self%active_constraints, dp), real(self%iterations, dp), self%residual]
      end associate
   end subroutine pack_common

   !> `unpack_kept`: restores the solution from the array of `pack_kept`, except the names of solver and status.
   pure subroutine unpack_common(self, values, understood)
      class(contact_solution), intent(inout) :: self
      real(dp), intent(in) :: values(:)                 !! size >= packed_values
      logical, intent(out) :: understood                !! .false. if these are not the numbers of such a solution

      understood = size(values) >= packed_values
      if (.not. understood) return
      self%pbar_over_pstar = values(1)
      self%measures = contact_measures(values(2), values(3), values(4), values(5), values(6), values(7), values(8), &
                                       values(9), values(10), values(11), values(12), values(13), values(14), values(15), &
                                       values(16))
      self%active_constraints = nint(values(17), int64)
      self%iterations = nint(values(18))
      self%residual = values(19)
   end subroutine unpack_common

   !> Makes the solution that stands for a failure: fields of NaN, no edge, and unknown errors.
   subroutine no_solution(pbar_over_pstar, solver, status, solution)
      real(dp), intent(in) :: pbar_over_pstar        !! P
      character(*), intent(in) :: solver             !! name of the solver that failed
      character(*), intent(in) :: status             !! why: a name of wavycon_contact_status
      class(contact_solution), allocatable, intent(out) :: solution

      allocate (solution_without_contact_edge :: solution)
      solution%pbar_over_pstar = pbar_over_pstar
      solution%measures = unmeasured()
      solution%solver = solver
      solution%status = status
   end subroutine no_solution

   subroutine fields_without_edge(self, surface, answer)
      class(solution_without_contact_edge), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      type(edgeless_fields), allocatable :: own

      allocate (own)
      call start_edgeless_fields(own, surface, self%pbar_over_pstar, self%status)
      call move_alloc(own, answer)
   end subroutine fields_without_edge

   !> Of full contact to rounding, zero without load, NaN without a solution.
   subroutine stresses_of_coefficients(self, surface, answer)
      class(solution_without_contact_edge), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      type(fourier_series) :: pressure
      type(series_stress), allocatable :: own

      call self%coefficients(surface, pressure)
      allocate (own)
      call start_series_stress(own, surface, pressure, self%pbar_over_pstar, &
                               pressure_error=rounding*self%measures%peak_pressure_over_pstar, is_sampled=.false.)
      own%exist = self%is_good()
      call move_alloc(own, answer)
   end subroutine stresses_of_coefficients

   subroutine uniform_coefficients(self, surface, series)
      class(solution_without_contact_edge), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(fourier_series), intent(out) :: series

      if (self%status == full_contact) then
         series = surface%full_contact_series(self%pbar_over_pstar)
      else
         allocate (series%c, mold=surface%shape%c)
         series%c = 0.0_dp
      end if
   end subroutine uniform_coefficients

   subroutine no_curves(self, surface, curves, loads)
      class(solution_without_contact_edge), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(edge_curve), allocatable, intent(out) :: curves(:)
      real(dp), allocatable, intent(out), optional :: loads(:)

      associate (unused => self, unused_too => surface); end associate
      allocate (curves(0))
      if (present(loads)) allocate (loads(0))
   end subroutine no_curves

end module wavycon_contact_solution
