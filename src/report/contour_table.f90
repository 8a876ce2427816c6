!> <case>.contour.dat: the edge of contact as closed curves; with solver = 'beale' the isobar p = edge_level p*.
!>
!> The table has a block for each load that has an edge, with a blank line between curves. In 2-D the contact lies to
!> the left of a curve; curves are not cut at the border of the cell and may extend beyond it. In 1-D a curve consists
!> of the two ends of a strip.
module wavycon_contour_table
   use wavycon_constants, only: pi
   use wavycon_contact_contours, only: contact_contour, keep_curves_of_quarter
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: contour_table

   character(40), parameter :: columns(*) = [character(40) :: 'load[-]', 'curve[-]', 'x[length]', 'y[length]']

contains

   type(table_type) function contour_table() result(table)
      table%file = 'contour'
      table%key = 'contours'
      table%meaning = 'The edge of contact as closed curves.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%put_load => put_curves
   end function contour_table

   subroutine put_curves(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(contact_contour), allocatable :: curves(:)   ! in X and Y
      integer :: i, k
      real(dp), allocatable :: places(:, :)

      associate (surface => results%solver%surface)
         call results%loads(load)%contact_contours(surface, curves)
         if (surface%mirrored) call keep_curves_of_quarter(curves)
         if (size(curves) > 0) call results%begin_block(file, load)
         do i = 1, size(curves)
            if (i > 1) call file%put('')
            associate (phi => curves(i)%phi, theta => curves(i)%theta)
               places = reshape([(surface%length*[phi(k), theta(k)]/(2*pi), k=1, size(phi))], [2, size(phi)])
            end associate
            call file%put_rows([load, i], places)
         end do
      end associate
   end subroutine put_curves

end module wavycon_contour_table
