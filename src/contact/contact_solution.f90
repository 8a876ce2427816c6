!> The solution at one load: its measures, fields, edge of contact and details.
!>
!> Every solver extends `contact_solution`; callers use a solution without regard to its solver. Positions of fields and
!> edges are the angles X, Y of the surface's cell.
module wavycon_contact_solution
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_details, only: contact_details
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_measures, only: unmeasured
   use wavycon_contact_spots, only: contact_spots, find_spots, no_spots, one_region
   use wavycon_contact_status, only: full_contact, is_good_status
   use wavycon_edge_curves, only: edge_curve
   use wavycon_edgeless_fields, only: edgeless_fields, start_edgeless_fields
   use wavycon_fourier_series, only: fourier_series
   use wavycon_kinds, only: dp
   use wavycon_series_stress, only: series_stress, start_series_stress
   use wavycon_solution_record, only: solution_record
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: contact_solution, contact_solution_item, solution_without_contact_edge, no_solution

   !> Error of the stresses under a series that is known exactly, over the peak pressure.
   real(dp), parameter :: rounding = 1e-14_dp

   type, abstract, extends(solution_record) :: contact_solution
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
      procedure :: pack_kept
      procedure :: unpack_kept
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

   !> `pack_kept`: what the checkpoint keeps of a solution besides its record, for `unpack_kept`. Here it is nothing.
   pure subroutine pack_kept(self, values)
      class(contact_solution), intent(in) :: self
      real(dp), allocatable, intent(out) :: values(:)   !! not allocated if there is not enough memory

      associate (unused => self); end associate
      allocate (values(0))
   end subroutine pack_kept

   !> `unpack_kept`: restores what pack_kept made; the record is there.
   pure subroutine unpack_kept(self, values, understood)
      class(contact_solution), intent(inout) :: self
      real(dp), intent(in) :: values(:)
      logical, intent(out) :: understood                !! .false. if these are not the numbers of such a solution

      associate (unused => self); end associate
      understood = size(values) == 0
   end subroutine unpack_kept

   !> Makes the solution that stands for a failure: fields of NaN, no edge, and unknown errors.
   subroutine no_solution(pbar_over_pstar, solver, status, solution)
      real(dp), intent(in) :: pbar_over_pstar        !! P
      integer, intent(in) :: solver                  !! that failed, a name of wavycon_solution_record
      integer, intent(in) :: status                  !! why: a name of wavycon_contact_status
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
