!> <case>.spots.dat: how many spots of contact and pools of gap there are, and whether contact and gap percolate.
!>
!> The table has a row for each load. A load without a solution has NaN.
module wavycon_spots_table
   use wavycon_contact_spots, only: contact_spots
   use wavycon_contact_status, only: status_code, status_name
   use wavycon_error, only: error_type
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

   type, extends(table_type) :: spots_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: needs_fields
      procedure, nopass :: write => write_spots_table
   end type spots_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'spots'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'Number and sizes of contact spots and of pools of gap; percolation of both.'
   end function meaning

   pure logical function needs_fields(self)
      class(spots_table), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .true.
   end function needs_fields

   !> Errors: exit_file_trouble.
   subroutine write_spots_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      type(contact_spots) :: regions
      integer :: load

      call results%open_table('spots', columns, file, in_blocks=.false.)
      do load = 1, size(results%loads)
         associate (solution => results%loads(load))
            call solution%spots(results%solver%surface, regions)
            call file%add(load)
            call file%add([solution%pbar_over_pstar, solution%measures%contact_area_fraction])
            call put_regions(file, regions)
            call file%add(status_code(solution%status))
            call file%add(trim(status_name(solution%status)))
            call file%end_row()
         end associate
      end do
      call file%finish(error)
   end subroutine write_spots_table

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
      do i = 1, 2
         call file%add(merge(1, 0, any(regions%spots%percolates(i))))
      end do
      do i = 1, 2
         call file%add(merge(1, 0, any(regions%pools%percolates(i))))
      end do
   end subroutine put_regions

   !> The largest area; 0 if there is none.
   pure real(dp) function largest(areas)
      real(dp), intent(in) :: areas(:)   !! >= 0

      largest = max(0.0_dp, maxval(areas))
   end function largest

end module wavycon_spots_table
