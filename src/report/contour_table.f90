!> <case>.contour.dat: the edge of contact, the isobar p = edge_level p*, as closed curves.
!>
!> A block a load that has an edge, a blank line between curves. In 2-D a curve has the contact on its left;
!> it is of one piece and may reach beyond the cell. In 1-D a curve is the two ends of a strip.
module wavycon_contour_table
   use wavycon_constants, only: pi
   use wavycon_error, only: error_type
   use wavycon_edge_curves, only: edge_curve
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   implicit none (type, external)
   private

   public :: write_contour_table

contains

   !> Errors: exit_file_trouble.
   subroutine write_contour_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      type(edge_curve), allocatable :: curves(:)
      integer :: load, i, blocks

      call results%open_table('contour', file)
      call file%put_columns([character(40) :: 'pbar_over_pstar[-]', 'x[length]', 'y[length]'])
      blocks = 0
      do load = 1, size(results%states)
         call results%contact%edge_curves(results%states(load), curves)
         if (size(curves) == 0) cycle
         blocks = blocks + 1
         call results%put_load_heading(file, load, first=blocks == 1)
         do i = 1, size(curves)
            if (i > 1) call file%put('')
            call put_curve(results, file, load, curves(i))
         end do
      end do
      call file%finish(error)
   end subroutine write_contour_table

   subroutine put_curve(results, file, load, curve)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load
      type(edge_curve), intent(in) :: curve   !! in X and Y

      integer :: i

      do i = 1, size(curve%phi)
         call file%put_values([results%states(load)%pbar_over_pstar, &
                               results%scene%surface%length*[curve%phi(i), curve%theta(i)]/(2*pi)])
      end do
   end subroutine put_curve

end module wavycon_contour_table
