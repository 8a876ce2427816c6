!> The preconditioners of a correction (C4), and which of them an iteration takes. README.md in this directory derives
!> them; numbers (C..) are its equations.
module wavycon_correction_preconditioner
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_multilevel_preconditioner, only: multilevel_preconditioner
   use wavycon_contact_region, only: longest_chunk
   use wavycon_contact_tuning, only: largest_growth, settled_part, stencil_fraction
   use wavycon_correction_state, only: correction_state
   use wavycon_kinds, only: dp, sp
   use wavycon_local_stiffness, only: local_stiffness
   implicit none (type, external)
   private

   public :: correction_preconditioner

   !> S^-1 of the gap continued to all points, S^-1 restricted to the contact, none.
   integer, parameter :: extended = 1, restricted = 2, none = 3

   type :: correction_preconditioner
      type(local_stiffness) :: stencil
      integer :: local_iterations = 0           !! those by the stencil
      integer :: plain_iterations = 0           !! those without the multilevel preconditioner or the stencil
      integer, private :: kind = extended
      logical, private :: has_resumed = .false. !! whether the kind was `restricted` and is `extended` again
      real(sp), allocatable, private :: contact_field(:, :)   !! K on the grid, for the multilevel preconditioner
      type(multilevel_preconditioner), private :: extension
   contains
      procedure :: select
      procedure :: apply
   end type correction_preconditioner

contains

   !> Selects a weaker preconditioner when the residual grows: on grids that hardly resolve the surface the multilevel
   !> preconditioner couples such distant points that those which leave the contact undo the step. It is used again,
   !> once in a correction, when the contact has settled. The search restarts when the preconditioner changes.
   subroutine select(self, state, last_residual, restarts)
      class(correction_preconditioner), intent(inout) :: self
      type(correction_state), intent(in) :: state
      real(dp), intent(in) :: last_residual
      logical, intent(out) :: restarts

      restarts = .true.
      if (self%kind /= none .and. state%residual/largest_growth > last_residual) then
         self%kind = merge(restricted, none, self%kind == extended .and. .not. self%has_resumed)
      else if (self%kind /= extended .and. .not. self%has_resumed .and. &
               state%changed_points <= settled_part*state%contact_points) then
         self%kind = extended
         self%has_resumed = .true.
      else
         restarts = .false.
      end if
   end subroutine select

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
         self%local_iterations = self%local_iterations + 1
      else if (self%kind == extended) then
         call set_contact(self, state)
         field = 0.0_sp
         call state%put_residual(field)
         call self%extension%extend(self%contact_field, field)
         call half_space%pressure(field)
         call self%extension%collect(self%contact_field, field)
      else
         self%plain_iterations = self%plain_iterations + 1
         call state%put_residual(field)
         if (self%kind == none) return
         call state%region%clear_outside(field)
         call half_space%pressure(field, state%region%columns, state%region%columns)
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
