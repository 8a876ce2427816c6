!> The &output group: which files are written, and where.
module wavycon_output_group
   implicit none (type, external)
   private

   public :: output_group_type

   !> What &output says.
   type :: output_group_type
      character(250) :: directory = ''         !! where results go; never empty once the deck is read
      logical :: lines = .false.               !! pressures and gaps along lines
      logical :: map = .false.                 !! pressures and gaps over the cell
      logical :: contours = .false.            !! the edge of contact as closed curves
      logical :: coefficients = .false.        !! the Fourier coefficients of the pressure
      logical :: theory = .false.              !! the closed forms beside the numbers
      integer :: points_per_wavelength = 128   !! of lines and maps
   end type output_group_type

end module wavycon_output_group
