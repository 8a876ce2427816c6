!> A height map as a file or an array gives it: perhaps with holes, tilted, and not periodic.
module wavycon_measured_map
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: measured_map

   type :: measured_map
      !> As in the file, 0 where it is missing, shape (M, N): along x, along y; N = 1 for a profile.
      real(dp), allocatable :: height(:, :)
      logical, allocatable :: missing(:, :)        !! shape of `height`; not allocated if no height is missing
      logical :: has_missing_value = .false.       !! whether a height has the value of the key missing_value
      real(dp) :: step(2) = 0.0_dp                 !! between points along x and y; 0 where the file does not give it
      character(7) :: format = ''                  !! a value of the key file_format but 'auto'
      character(:), allocatable :: length_unit     !! of the steps; not allocated if the file does not name units
      character(:), allocatable :: height_unit     !! of the heights; allocated if length_unit is
   end type measured_map

end module wavycon_measured_map
