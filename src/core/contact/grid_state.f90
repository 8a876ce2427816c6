!> Pressure and gap on one grid, and how far they are from a solution.
module wavycon_grid_state
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: grid_state

   type :: grid_state
      type(grid_slab) :: slab                   !! of the grid
      real(dp), allocatable :: pressure(:, :)   !! p/p*, 0 <= p <= H, shape (M, slab%columns())
      !> gap/Delta, negative where the surfaces overlap: at free points its deviation from zero; own columns
      real(dp), allocatable :: gap(:, :)
      real(dp) :: hardness = huge(1.0_dp)       !! H/p*, huge if there is none
      real(dp) :: approach = 0.0_dp             !! the multiplier of the mean pressure [Delta]
      !> Mean over the map, overlaps negative [Delta]: without a hardness G. On a periodic surface 1 - approach.
      real(dp) :: mean_gap = 1.0_dp
      real(dp) :: residual_indentation = 0.0_dp   !! mean over the cell of the overlap where p = H [Delta] (C22)
      real(dp) :: residual = huge(1.0_dp)       !! root mean square of the violated conditions on the gap, over G (C9)
      logical :: starts_near = .false.          !! whether the start is the solution of a load near by
      integer :: corrections = 0                !! steps
      integer :: iterations = 0                 !! of all corrections
      logical :: converged = .false.
      logical :: interrupted = .false.          !! by `progress`: the gap is not allocated
      logical :: is_open = .true.               !! whether any point has no pressure; only with a hardness
   contains
      procedure :: open_gap
      procedure :: size_of_gaps
   end type grid_state

contains

   !> The mean gap G [Delta], where overlaps count as zero; zero if no point is open.
   pure real(dp) function open_gap(self)
      class(grid_state), intent(in) :: self   !! solved

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
