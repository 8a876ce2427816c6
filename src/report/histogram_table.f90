!> <case>.histogram.dat: how pressures are distributed over the contact, and gaps over the open area.
!>
!> The table has a block for each load, with a row for each bin of pressure and of gap. Values are those at the points
!> of the grid that was solved; of other solutions those at equally spaced points, with which (A7) of README.md in
!> src/measure deals.
module wavycon_histogram_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_fields, only: contact_fields
   use wavycon_histogram, only: histogram, make_histogram
   use wavycon_kinds, only: dp
   use wavycon_measure_tuning, only: line_samples, plane_samples
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: histogram_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'bin[-]', 'pressure[pressure]', 'pressure_mean[pressure]', 'pressure_fraction[-]', &
      'pressure_density[1/pressure]', 'gap[length]', 'gap_mean[length]', 'gap_fraction[-]', 'gap_density[1/length]']

contains

   type(table_type) function histogram_table() result(table)
      table%file = 'histogram'
      table%key = 'histograms'
      table%meaning = 'How pressures are distributed over the contact, and gaps over the open area.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%put_load => put_histogram
   end function histogram_table

   !> Writes the block of a load, if it has a solution.
   subroutine put_histogram(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      class(contact_fields), allocatable :: fields
      type(histogram) :: gaps, pressures
      real(dp), allocatable :: displacement(:, :), gap(:, :), pressure(:, :)
      real(dp) :: least, offset(2)
      integer :: bin, bins, points(2)
      logical :: linear

      associate (scene => results%scene, surface => results%solver%surface, solution => results%loads(load))
         call solution%fields(surface, fields)
         points = fields%own_points
         offset = fields%own_offset
         linear = any(points == 0) .and. surface%dimension == 2
         if (any(points == 0)) then
            points = merge(plane_samples, [line_samples, 1], surface%dimension == 2)
            offset = merge(0.5_dp, 0.0_dp, points > 1)
         end if
         call fields%on_grid(points, offset, pressure, displacement, gap)
         if (any(ieee_is_nan(pressure))) return
         bins = scene%output%integer('histogram_bins')
         ! The pressure of a series waves about zero outside the contact, whose edge is an isobar.
         least = 0.0_dp
         if (scene%method%has('edge_level')) least = scene%method%real('edge_level')
         call make_histogram(pressure, pressure > least, bins, pressures, linear)
         call make_histogram(gap, .not. pressure > least, bins, gaps, linear)
      end associate
      call results%begin_block(file, load)
      do bin = 1, bins
         call file%add([load, bin])
         call put_bin(pressures, results%scene%p_star)
         call put_bin(gaps, results%solver%surface%amplitude)
         call file%end_row()
      end do

   contains

      subroutine put_bin(of, unit)
         type(histogram), intent(in) :: of
         real(dp), intent(in) :: unit   !! of its values [pressure] or [length]

         call file%add([unit*of%middle(bin), unit*of%mean(bin), of%fraction(bin), of%density(bin)/unit])
      end subroutine put_bin

   end subroutine put_histogram

end module wavycon_histogram_table
