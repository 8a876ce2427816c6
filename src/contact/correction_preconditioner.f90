!> The preconditioner of a correction (C4): the multilevel one, or at light loads a stencil. README.md in this directory
!> derives both; numbers (C..) are its equations.
module wavycon_correction_preconditioner
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_multilevel_preconditioner, only: multilevel_preconditioner
   use wavycon_contact_region, only: longest_chunk
   use wavycon_contact_tuning, only: stencil_fraction
   use wavycon_correction_state, only: correction_state
   use wavycon_kinds, only: dp, sp
   use wavycon_local_stiffness, only: local_stiffness
   implicit none (type, external)
   private

   public :: correction_preconditioner

   type :: correction_preconditioner
      type(local_stiffness) :: stencil
      real(sp), allocatable, private :: contact_field(:, :)   !! K on the grid, for the multilevel preconditioner
      type(multilevel_preconditioner), private :: extension
   contains
      procedure :: apply
   end type correction_preconditioner

contains

   !> Computes z of (C4) from the residual r, without subtracting its mean.
   subroutine apply(self, half_space, state, field)
      class(correction_preconditioner), intent(inout) :: self
      type(compliance_operator), intent(inout) :: half_space
      type(correction_state), intent(in) :: state
      real(sp), intent(inout), contiguous :: field(:, :)   !! becomes z, shape (M, slab%columns())

      real(sp), allocatable :: vector(:)

      if (state%contact_points <= 0.0_dp) then
         call state%put_residual(field)
      else if (self%stencil%exists .and. &
               state%contact_points < stencil_fraction*product(real(state%slab%points, dp))) then
         call state%put_residual(field)
         allocate (vector(state%region%points))
         call state%region%gather(field, vector)
         call self%stencil%apply(state%region, state%slab%points, vector)
         call state%region%scatter(vector, field)
      else
         call set_contact(self, state)
         field = 0.0_sp
         call state%put_residual(field)
         call self%extension%extend(self%contact_field, field)
         call half_space%pressure(field)
         call self%extension%collect(self%contact_field, field)
      end if
   end subroutine apply

   !> Starts the multilevel preconditioner when it is first needed, and sets its points in contact.
   subroutine set_contact(self, state)
      type(correction_preconditioner), intent(inout) :: self
      type(correction_state), intent(in) :: state

      real(sp) :: contact(longest_chunk)
      integer :: c

      if (.not. allocated(self%contact_field)) then
         allocate (self%contact_field(state%slab%points(1), state%slab%columns()), source=0.0_sp)
         call self%extension%start(state%slab%points, self%stencil%even)
      end if
      !$omp parallel do num_threads(state%region%threads) private(contact)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            contact(:b - a + 1) = state%contact(a:b)
         end associate
         call state%region%put_chunk(c, contact, self%contact_field)
      end do
      call self%extension%set_contact(self%contact_field)
   end subroutine set_contact

end module wavycon_correction_preconditioner
