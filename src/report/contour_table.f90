!> <case>.contour.dat: the edge of contact as closed curves; with solver = 'beale' the isobar p = edge_level p*.
!>
!> The table has a block for each load that has an edge, with a blank line between curves. In 2-D the contact lies to
!> the left of a curve; curves are not cut at the border of the cell and may extend beyond it. In 1-D a curve consists
!> of the two ends of a strip.
module wavycon_contour_table
   use wavycon_constants, only: pi
   use wavycon_edge_curves, only: edge_curve, keep_curves_of_quarter
   use wavycon_error, only: error_type
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: contour_table

   character(40), parameter :: columns(*) = [character(40) :: 'load[-]', 'curve[-]', 'x[length]', 'y[length]']

   type, extends(table_type) :: contour_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: needs_fields
      procedure, nopass :: write => write_contour_table
   end type contour_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'contours'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'The edge of contact as closed curves.'
   end function meaning

   pure logical function needs_fields(self)
      class(contour_table), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .true.
   end function needs_fields

   !> Errors: exit_file_trouble.
   subroutine write_contour_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      type(edge_curve), allocatable :: curves(:)
      integer :: load, i
      logical :: any_curve

      call results%open_table('contour', columns, file, in_blocks=.true.)
      any_curve = .false.
      do load = 1, size(results%loads)
         call results%loads(load)%edge_curves(results%solver%surface, curves)
         if (results%solver%surface%mirrored) call keep_curves_of_quarter(curves)
         if (size(curves) == 0) cycle
         any_curve = .true.
         call results%begin_block(file, load)
         do i = 1, size(curves)
            if (i > 1) call file%put('')
            call put_curve(results, file, load, i, curves(i))
         end do
      end do
      if (.not. any_curve) call file%put_names()
      call file%finish(error)
   end subroutine write_contour_table

   subroutine put_curve(results, file, load, number, curve)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load, number     !! of the load in the deck, of the curve in the load
      type(edge_curve), intent(in) :: curve   !! in X and Y

      integer :: i

      do i = 1, size(curve%phi)
         call file%add(load)
         call file%add(number)
         call file%add(results%solver%surface%length*[curve%phi(i), curve%theta(i)]/(2*pi))
         call file%end_row()
      end do
   end subroutine put_curve

end module wavycon_contour_table
