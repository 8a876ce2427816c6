!> Pressure and gap on one grid, and the residual, which tells how far they are from a solution.
module wavycon_grid_state
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: grid_state

   type :: grid_state
      type(grid_slab) :: slab                   !! columns of the grid that this process has
      real(dp), allocatable :: pressure(:, :)   !! p/p*, 0 <= p <= H, shape (M, slab%columns())
      !> gap/Delta, negative where the surfaces overlap, shape of the pressure. Where 0 < p < H a solution has the gap
      !> 0, and this is the deviation from zero that is left.
      real(dp), allocatable :: gap(:, :)
      real(dp) :: hardness = huge(1.0_dp)       !! H/p*, huge if there is none
      real(dp) :: approach = 0.0_dp             !! delta [Delta], the multiplier of the mean pressure
      !> Mean of the gap over the map [Delta], in which overlaps count as negative; without a hardness this is G. On a
      !> periodic surface it is 1 - approach.
      real(dp) :: mean_gap = 1.0_dp
      real(dp) :: residual_indentation = 0.0_dp   !! mean over the cell of the overlap where p = H [Delta] (C22)
      !> (C9): root mean square of the violated conditions on the gap, over G. During a solution [Delta], not over G.
      real(dp) :: residual = huge(1.0_dp)
      logical :: starts_near = .false.          !! whether the start is the solution at a load near by
      integer :: iterations = 0                 !! number of iterations of all corrections
      logical :: converged = .false.            !! whether the residual is within the tolerance
      logical :: interrupted = .false.          !! whether `progress` stopped the solver; the gap is then not allocated
      logical :: is_open = .true.               !! whether a point has no pressure; with a hardness only
   contains
      procedure :: open_gap, size_of_gaps
   end type grid_state

contains

   !> The mean gap G [Delta], where overlaps count as zero; zero if no point is open.
   pure real(dp) function open_gap(self)
      class(grid_state), intent(in) :: self   !! state whose gap has been computed

      open_gap = self%mean_gap + self%residual_indentation
      if (self%hardness >= huge(self%hardness)) return
      if (.not. self%is_open) open_gap = 0.0_dp
   end function open_gap

   !> The mean of |gap| [Delta]: G without a hardness.
   pure real(dp) function size_of_gaps(self)
      class(grid_state), intent(in) :: self

      size_of_gaps = abs(self%open_gap() + self%residual_indentation)
   end function size_of_gaps

end module wavycon_grid_state
