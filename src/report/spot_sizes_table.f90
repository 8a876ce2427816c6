!> <case>.spot_sizes.dat: each spot of contact and each pool of gap, the largest first.
!>
!> The table has a block for each load, with a blank line between spots and pools. A load without a solution has none.
module wavycon_spot_sizes_table
   use wavycon_constants, only: pi
   use wavycon_contact_spots, only: contact_region, contact_spots
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_scene, only: scene_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: spot_sizes_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'rank[-]', 'area[area]', 'area_fraction[-]', 'equivalent_radius[length]', 'perimeter[length]', &
      'load_fraction[-]', 'mean_pressure[pressure]', 'x[length]', 'y[length]', 'holes[-]', 'percolates_x[-]', &
      'percolates_y[-]', 'region[-]']

contains

   type(table_type) function spot_sizes_table() result(table)
      table%file = 'spot_sizes'
      table%meaning = 'Sizes and places of contact spots and of pools of gap.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%requested => asks_for_spots
      table%put_load => put_spot_sizes
   end function spot_sizes_table

   logical function asks_for_spots(scene)
      type(scene_type), intent(in) :: scene

      asks_for_spots = scene%output%logical('spots')
   end function asks_for_spots

   subroutine put_spot_sizes(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(contact_spots) :: regions

      call results%loads(load)%spots(results%solver%surface, regions)
      if (.not. regions%known) return
      call results%begin_block(file, load)
      call put_regions(results, file, load, regions%spots, 'spot')
      if (size(regions%spots) > 0 .and. size(regions%pools) > 0) call file%put('')
      call put_regions(results, file, load, regions%pools, 'pool')
   end subroutine put_spot_sizes

   !> Writes the regions of one kind, a row for each.
   subroutine put_regions(results, file, load, regions, kind)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load
      type(contact_region), intent(in) :: regions(:)   !! the largest first
      character(*), intent(in) :: kind                 !! 'spot' or 'pool'

      real(dp) :: area, mean_pressure
      integer :: i

      associate (surface => results%solver%surface)
         do i = 1, size(regions)
            associate (region => regions(i))
               area = region%area_fraction*surface%nominal_area()
               mean_pressure = not_a_number()
               if (region%area_fraction > 0.0_dp) &
                  mean_pressure = results%mean_pressure(load)*region%load_fraction/region%area_fraction
               call file%add([load, i])
               call file%add([area, region%area_fraction, equivalent_radius(area, surface%dimension), &
                              region%perimeter, region%load_fraction, mean_pressure, &
                              surface%length*region%centre/(2*pi)])
               call file%add([region%holes, merge(1, 0, region%percolates)])
               call file%add(kind)
               call file%end_row()
            end associate
         end do
      end associate
   end subroutine put_regions

   !> The radius of the disc of an area; of a strip half its width [length].
   pure real(dp) function equivalent_radius(area, dimension) result(radius)
      real(dp), intent(in) :: area         !! [length^2], in 1-D [length]
      integer, intent(in) :: dimension

      radius = sqrt(area/pi)
      if (dimension == 1) radius = 0.5_dp*area
   end function equivalent_radius

end module wavycon_spot_sizes_table
