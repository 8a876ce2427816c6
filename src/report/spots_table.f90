!> <case>.spots.dat: how many spots of contact and pools of gap there are, and whether contact and gap percolate.
!>
!> The table has a row for each load. A load without a solution has NaN.
module wavycon_spots_table
   use wavycon_contact_spots, only: contact_spots
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: spots_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'pbar_over_pstar[-]', 'contact_area_fraction[-]', 'spots[-]', 'spots_area_fraction[-]', &
      'largest_spot_area_fraction[-]', 'closed_pools[-]', 'closed_pools_area_fraction[-]', &
      'largest_pool_area_fraction[-]', 'perimeter[length]', 'contact_percolates_x[-]', 'contact_percolates_y[-]', &
      'gap_percolates_x[-]', 'gap_percolates_y[-]', 'status_code[-]', 'status[-]']

contains

   type(table_type) function spots_table() result(table)
      table%file = 'spots'
      table%key = 'spots'
      table%meaning = 'Number and sizes of contact spots and of pools of gap; percolation of both.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%put_load => put_spots
   end function spots_table

   subroutine put_spots(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(contact_spots) :: regions

      associate (solution => results%loads(load))
         call solution%spots(results%solver%surface, regions)
         call file%add(load)
         call file%add([results%in_p_star(solution%pbar_over_pstar), solution%measures%contact_area_fraction])
      end associate
      call put_regions(file, regions)
      call results%end_row(file, load)
   end subroutine put_spots

   !> Fills the columns from the number of spots to percolation.
   subroutine put_regions(file, regions)
      type(output_file), intent(inout) :: file
      type(contact_spots), intent(in) :: regions

      integer, parameter :: numbers = 11
      real(dp), allocatable :: pools(:), spots(:)   ! areas
      integer :: i

      if (.not. regions%known) then
         call file%add([(not_a_number(), i=1, numbers)])
         return
      end if
      spots = regions%spots%area_fraction
      pools = regions%pools%area_fraction
      pools = pack(pools, regions%pools%is_closed())
      call file%add(size(spots))
      call file%add([sum(spots), largest(spots)])
      call file%add(size(pools))
      call file%add([sum(pools), largest(pools), regions%perimeter()])
      call file%add([(merge(1, 0, any(regions%spots%percolates(i))), i=1, 2), &
                     (merge(1, 0, any(regions%pools%percolates(i))), i=1, 2)])
   end subroutine put_regions

   !> The largest area; 0 if there is none.
   pure real(dp) function largest(areas)
      real(dp), intent(in) :: areas(:)   !! >= 0

      largest = max(0.0_dp, maxval(areas))
   end function largest

end module wavycon_spots_table
