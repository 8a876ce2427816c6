!> <case>.histogram.dat: how pressures are distributed over the contact, and gaps over the open area.
!>
!> The table has a block for each load, with a row for each bin of pressure and of gap. Values are those at the points
!> of the grid that was solved; of other solutions those at equally spaced points, with which (A7) of README.md in
!> src/measure deals.
module wavycon_histogram_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
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

   type, extends(table_type) :: histogram_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: needs_fields
      procedure, nopass :: write => write_histogram_table
   end type histogram_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'histograms'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'How pressures are distributed over the contact, and gaps over the open area.'
   end function meaning

   pure logical function needs_fields(self)
      class(histogram_table), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .true.
   end function needs_fields

   !> Errors: exit_file_trouble.
   subroutine write_histogram_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: load
      logical :: any_block, written

      call results%open_table('histogram', columns, file, in_blocks=.true.)
      any_block = .false.
      do load = 1, size(results%loads)
         call put_histogram(results, load, file, written)
         any_block = any_block .or. written
      end do
      if (.not. any_block) call file%put_names()
      call file%finish(error)
   end subroutine write_histogram_table

   !> Writes the block of a load, if it has a solution.
   subroutine put_histogram(results, load, file, written)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file
      logical, intent(out) :: written

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
         written = .not. any(ieee_is_nan(pressure))
         if (.not. written) return
         bins = scene%output%integer('histogram_bins')
         ! The pressure of a series waves about zero outside the contact, whose edge is an isobar.
         least = 0.0_dp
         if (scene%method%has('edge_level')) least = scene%method%real('edge_level')
         call make_histogram(pressure, pressure > least, bins, pressures, linear)
         call make_histogram(gap, .not. pressure > least, bins, gaps, linear)
      end associate
      call results%begin_block(file, load)
      do bin = 1, bins
         call file%add(load)
         call file%add(bin)
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
