!> <case>.contour.dat: the edge of contact, the isobar p = edge_level p*, as closed curves in the user's axes.
!>
!> A block a load that has an edge, a blank line between curves. In 2-D a curve has the contact on its left in (phi, theta);
!> it is of one piece and may reach beyond the cell. In 1-D a curve is the two ends of a strip.
module wavycon_contour_table
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: measuring_intervals
   use wavycon_contact_state, only: full_contact, no_load
   use wavycon_cosine_series, only: cosine_series
   use wavycon_error, only: error_type
   use wavycon_isobar_cell, only: isobar_grid, start_isobar_grid
   use wavycon_isobar_curves, only: isobar_curve, trace_isobars
   use wavycon_kinds, only: dp
   use wavycon_line_zeros, only: line_zeros
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
      type(isobar_curve), allocatable :: curves(:)
      integer :: load, i, blocks

      call results%open_table('contour', file)
      call file%put_columns([character(40) :: 'pbar_over_pstar[-]', 'x[length]', 'y[length]'])
      blocks = 0
      do load = 1, size(results%states)
         if (results%states(load)%status == full_contact .or. results%states(load)%status == no_load) cycle
         call find_edges(results, load, curves)
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

   subroutine find_edges(results, load, curves)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(isobar_curve), allocatable, intent(out) :: curves(:)

      type(cosine_series) :: pressure, displacement
      type(isobar_grid) :: grid
      real(dp), allocatable :: zeros(:)
      real(dp) :: line(0:results%deck%method%harmonics), approach
      integer :: i, intervals

      call results%series(load, pressure, displacement, approach)
      intervals = measuring_intervals(results%deck%method%harmonics)
      if (results%scene%surface%dimension == 2) then
         call start_isobar_grid(grid, pressure, results%deck%method%edge_level, intervals)
         call trace_isobars(grid, curves)
         return
      end if

      line = pressure%c(:, 0)
      line(0) = line(0) - results%deck%method%edge_level
      call line_zeros(line, intervals, zeros)
      ! The strip about the crest ends at the first zero and its mirror image; then come strips between two zeros.
      if (mod(size(zeros), 2) == 1) zeros = [-zeros(1), zeros]
      allocate (curves(size(zeros)/2))
      do i = 1, size(curves)
         curves(i)%phi = zeros(2*i - 1:2*i)
         curves(i)%theta = [0.0_dp, 0.0_dp]
      end do
   end subroutine find_edges

   subroutine put_curve(results, file, load, curve)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load
      type(isobar_curve), intent(in) :: curve

      real(dp) :: x, y
      integer :: i

      do i = 1, size(curve%phi)
         call results%scene%surface%point_at(curve%phi(i), curve%theta(i), x, y)
         call file%put_values([results%states(load)%pbar_over_pstar, x, y])
      end do
   end subroutine put_curve

end module wavycon_contour_table
