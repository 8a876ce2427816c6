!> The measures of a solution that another rank has computed, without its fields.
module wavycon_measured_solution
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution, pack_common, packed_values, unpack_common
   use wavycon_edge_curves, only: edge_curve
   use wavycon_kinds, only: dp
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: measured_solution, solution_from_words, words_of_solution

   !> 8-byte words for the names of solver and status.
   integer, parameter :: name_words = 4

   !> Words that words_of_solution makes.
   integer, parameter, public :: solution_words = packed_values + name_words

   !> As a solution of a solver that was started without keep_fields.
   type, extends(contact_solution) :: measured_solution
   contains
      procedure :: fields
      procedure :: edge_curves
      procedure :: stresses
   end type measured_solution

contains

   !> All that tables without fields are made from, as words that are sent between ranks.
   pure function words_of_solution(solution) result(words)
      class(contact_solution), intent(in) :: solution
      integer(int64) :: words(solution_words)

      character(8*name_words) :: names
      real(dp), allocatable :: values(:)

      call pack_common(solution, values)
      names = solution%solver//solution%status
      words = [transfer(values, words, packed_values), transfer(names, words, name_words)]
   end function words_of_solution

   !> The inverse of words_of_solution.
   subroutine solution_from_words(words, solution)
      integer(int64), intent(in) :: words(:)   !! shape (solution_words)
      class(contact_solution), allocatable, intent(out) :: solution

      character(8*name_words) :: names
      logical :: understood

      allocate (measured_solution :: solution)
      call unpack_common(solution, transfer(words(:packed_values), [0.0_dp], packed_values), understood)
      names = transfer(words(packed_values + 1:), names)
      solution%solver = names(:len(solution%solver))
      solution%status = names(len(solution%solver) + 1:)
   end subroutine solution_from_words

   subroutine fields(self, surface, answer)
      class(measured_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(contact_fields), allocatable, intent(out) :: answer

      associate (unused => self, unused_too => surface); end associate
      if (allocated(answer)) return
   end subroutine fields

   subroutine edge_curves(self, surface, curves, loads)
      class(measured_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      type(edge_curve), allocatable, intent(out) :: curves(:)
      real(dp), allocatable, intent(out), optional :: loads(:)

      associate (unused => self, unused_too => surface); end associate
      allocate (curves(0))
      if (present(loads)) allocate (loads(0))
   end subroutine edge_curves

   subroutine stresses(self, surface, answer)
      class(measured_solution), intent(in) :: self
      type(surface_type), intent(in) :: surface
      class(stress_fields), allocatable, intent(out) :: answer

      associate (unused => self, unused_too => surface); end associate
      if (allocated(answer)) return
   end subroutine stresses

end module wavycon_measured_solution
