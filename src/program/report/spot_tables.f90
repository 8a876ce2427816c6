!> Tables of the regions of contact. A spot is a connected region of contact, a pool a connected region of open gap.
!>
!> <case>.contour.dat: the edge of contact as closed curves; with solver = 'beale' the isobar p = edge_level p*. The
!> table has a block for each load that has an edge, with a blank line between curves. In 2-D the contact lies to the
!> left of a curve; curves are not cut at the border of the cell and may extend beyond it. In 1-D a curve consists of
!> the two ends of a strip.
!> <case>.spots.dat: number and sizes of spots and pools, and whether contact and gap percolate, a row for each load.
!> The row of a load without a solution has NaN.
!> <case>.spot_sizes.dat: each spot and each pool, the largest first, a block for each load with a blank line between
!> spots and pools. A load without a solution has no block.
!> <case>.histogram.dat: how pressures are distributed over the contact, and gaps over the open area, a block for each
!> load with a row for each bin of pressure and of gap. Values are those at the points of the solver's grid. A solution
!> without a grid is sampled at equally spaced points, and in 2-D taken as linear between them, by (A7) of README.md in
!> src/core/measure.
module wavycon_spot_tables
   use wavycon_contact_contours, only: contact_contour, keep_curves_of_quarter
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_spots, only: connected_region
   use wavycon_histogram, only: histogram, make_histogram
   use wavycon_kinds, only: dp, ieee_is_nan, not_a_number, pi
   use wavycon_measure_tuning, only: line_samples, plane_samples
   use wavycon_output_file, only: output_file
   use wavycon_quantities, only: contact_area
   use wavycon_plain_text, only: clauses, integer_text, short_number
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_solution_record, only: status_code, status_name
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: say_percolation, spot_tables

contains

   !> The tables of this file.
   function spot_tables() result(tables)
      type(table_type) :: tables(4)

      tables(1) = table_type('contour', 'contours', needs_fields=.true., put_load=put_curves, &
         columns='load[#] curve[#] x[length] y[length]', &
         meaning='The edge of contact as closed curves.')
      tables(2) = table_type('spots', 'spots', needs_fields=.true., needs_spots=.true., put_load=put_spots, &
         columns='load[#] pbar_over_pstar[-] contact_area_fraction[-] spots[#] '// &
         'spots_area_fraction[-] largest_spot_area_fraction[-] closed_pools[#] closed_pools_area_fraction[-] '// &
         'largest_pool_area_fraction[-] perimeter[length] contact_percolates_x[#] contact_percolates_y[#] '// &
         'gap_percolates_x[#] gap_percolates_y[#] status_code[#] status[word]', &
         meaning='Number and sizes of contact spots and of pools of gap; percolation of both.')
      tables(3) = table_type('spot_sizes', asked_by=[character(16) :: 'spots', ''], needs_fields=.true., &
         needs_spots=.true., put_load=put_spot_sizes, &
         columns='load[#] rank[#] area[area] area_fraction[-] equivalent_radius[length] '// &
         'perimeter[length] load_fraction[-] mean_pressure[pressure] x[length] y[length] holes[#] percolates_x[#] '// &
         'percolates_y[#] region[word]')
      tables(4) = table_type('histogram', 'histograms', needs_fields=.true., put_load=put_histogram, &
         columns='load[#] bin[#] pressure[pressure] pressure_mean[pressure] pressure_fraction[-] '// &
         'pressure_density[1/pressure] gap[length] gap_mean[length] gap_fraction[-] gap_density[1/length]', &
         meaning='How pressures are distributed over the contact, and gaps over the open area.')
   end function spot_tables

   !> Writes the block of a load: the curves of its edge of contact.
   subroutine put_curves(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(contact_contour), allocatable :: curves(:)   ! their points are in the angles X and Y
      integer :: i, k

      associate (surface => results%solver%surface)
         call results%loads(load)%contact_contours(surface, curves)
         if (surface%mirrored) call keep_curves_of_quarter(curves)
         if (size(curves) > 0) call results%begin_block(file, load)
         do i = 1, size(curves)
            if (i > 1) call file%put('')
            do k = 1, size(curves(i)%phi)
               call file%put_row([real(dp) :: load, i, surface%length*[curves(i)%phi(k), curves(i)%theta(k)]/(2*pi)])
            end do
         end do
      end associate
   end subroutine put_curves

   !> Writes the row of a load: numbers, areas and percolation of its spots and pools.
   subroutine put_spots(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      real(dp) :: numbers(11)
      real(dp), allocatable :: pools(:), spots(:)   ! area fractions of closed pools and of spots
      integer :: i

      associate (solution => results%loads(load), regions => results%spots(load))
         numbers = not_a_number()
         if (allocated(regions%spots)) then
            spots = regions%spots%area_fraction
            pools = pack(regions%pools%area_fraction, regions%pools%is_closed())
            numbers = [real(dp) :: size(spots), sum(spots), max(0.0_dp, maxval(spots)), &
                       size(pools), sum(pools), max(0.0_dp, maxval(pools)), regions%perimeter(), &
                       (merge(1, 0, any(regions%spots%percolates(i))), i=1, 2), &
                       (merge(1, 0, any(regions%pools%percolates(i))), i=1, 2)]
         end if
         call file%put_row([real(dp) :: load, results%in_p_star(solution%pbar_over_pstar), &
                            solution%value(contact_area), numbers, status_code(solution%status)], &
                           [status_name(solution%status)])
      end associate
   end subroutine put_spots

   !> Writes to the log at how many loads contact and gap percolate, and in which direction. In 1-D both always do along
   !> y, and with free edges there is no next cell: nothing is written.
   subroutine say_percolation(results, logger)
      type(results_type), intent(inout) :: results   !! with a solution for each load; gets `spots`
      type(run_log), intent(inout) :: logger

      character(*), parameter :: names(2) = ['contact', 'gap    '], limits(2) = [', from ', ', up to']
      character(:), allocatable :: words
      integer :: i, known, region_kind, load
      logical :: percolates(size(results%loads), 2, 2)   ! at each load, along x and y, contact and gap
      real(dp) :: limit

      if (results%solver%surface%has_free_edges .or. results%solver%surface%dimension == 1 .or. logger%quiet) return
      percolates = .false.
      known = 0   ! loads with a solution
      call results%find_spots()
      do load = 1, size(results%loads)
         associate (regions => results%spots(load))
            if (.not. allocated(regions%spots)) cycle
            known = known + 1
            percolates(load, :, 1) = [(any(regions%spots%percolates(i)), i=1, 2)]
            percolates(load, :, 2) = [(any(regions%pools%percolates(i)), i=1, 2)]
         end associate
      end do
      if (known == 0) return
      do region_kind = 1, 2
         words = ''
         do i = 1, 2
            if (.not. any(percolates(:, i, region_kind))) cycle
            limit = minval(results%loads%pbar_over_pstar, mask=percolates(:, i, region_kind))
            if (region_kind == 2) limit = maxval(results%loads%pbar_over_pstar, mask=percolates(:, i, region_kind))
            words = clauses(words, 'along '//'xy'(i:i)//' at '// &
                            integer_text(count(percolates(:, i, region_kind)))//' of '// &
                            integer_text(known)//' loads'//trim(limits(region_kind))//' pbar/p* = '// &
                            short_number(limit))
         end do
         if (words == '') words = 'at no load'
         call logger%say(trim(names(region_kind))//' percolates '//words)
      end do
   end subroutine say_percolation

   !> Writes the block of a load: a row for each spot, then one for each pool.
   subroutine put_spot_sizes(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      associate (found => results%spots(load))
         if (.not. allocated(found%spots)) return
         call results%begin_block(file, load)
         call put_regions(found%spots, 'spot')
         if (size(found%spots) > 0 .and. size(found%pools) > 0) call file%put('')
         call put_regions(found%pools, 'pool')
      end associate

   contains

      !> Writes a row for each region of one kind.
      subroutine put_regions(regions, word)
         type(connected_region), intent(in) :: regions(:)   !! the largest first
         character(*), intent(in) :: word                   !! 'spot' or 'pool'

         real(dp) :: area, mean_pressure, radius
         integer :: i

         associate (surface => results%solver%surface)
            do i = 1, size(regions)
               associate (region => regions(i))
                  area = region%area_fraction*surface%nominal_area()
                  ! The equivalent radius is that of the disc with this area; in 1-D it is half the width of the strip.
                  radius = sqrt(area/pi)
                  if (surface%dimension == 1) radius = 0.5_dp*area
                  mean_pressure = not_a_number()
                  if (region%area_fraction > 0.0_dp) &
                     mean_pressure = results%mean_pressure(load)*region%load_fraction/region%area_fraction
                  call file%put_row([real(dp) :: load, i, area, region%area_fraction, radius, region%perimeter, &
                                     region%load_fraction, mean_pressure, surface%length*region%centre/(2*pi), &
                                     region%holes, merge(1, 0, region%percolates)], [word])
               end associate
            end do
         end associate
      end subroutine put_regions

   end subroutine put_spot_sizes

   !> Writes the block of a load: its histograms of pressure and gap. A load without a solution has no block.
   subroutine put_histogram(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      class(contact_fields), allocatable :: fields
      type(histogram) :: gaps, pressures
      real(dp), allocatable :: displacement(:, :), gap(:, :), pressure(:, :)
      real(dp) :: least, offset(2)
      integer :: bin, bins, points(2)
      logical :: is_continuous   ! whether the fields are taken as linear between the points, (A7)

      associate (scene => results%scene, surface => results%solver%surface, solution => results%loads(load))
         call solution%fields(surface, fields)
         points = fields%own_points
         offset = fields%own_offset
         is_continuous = any(points == 0) .and. surface%dimension == 2
         if (any(points == 0)) then
            points = plane_samples
            if (surface%dimension == 1) points = [line_samples, 1]
            offset = merge(0.5_dp, 0.0_dp, points > 1)
         end if
         call fields%on_grid(points, offset, pressure, displacement, gap)
         if (any(ieee_is_nan(pressure))) return
         bins = nint(scene%output%histogram_bins%number)
         ! The pressure of a truncated series oscillates about zero outside the contact. The edge of its contact is
         ! therefore the isobar p = edge_level p*.
         least = 0.0_dp
         if (scene%method%edge_level%in_effect) least = scene%method%edge_level%number
         call make_histogram(pressure, pressure > least, bins, is_continuous, pressures)
         call make_histogram(gap, .not. pressure > least, bins, is_continuous, gaps)
      end associate
      call results%begin_block(file, load)
      do bin = 1, bins
         call file%put_row([real(dp) :: load, bin, in_unit(pressures, results%scene%p_star), &
                            in_unit(gaps, results%solver%surface%amplitude)])
      end do

   contains

      !> The numbers of the current bin in the deck's units: middle, mean of the values, area fraction and density.
      pure function in_unit(values, unit) result(numbers)
         type(histogram), intent(in) :: values   !! histogram of p/p* or of gap/Delta
         real(dp), intent(in) :: unit            !! p* [pressure] or Delta [length]
         real(dp) :: numbers(4)

         numbers = [unit*values%middle(bin), unit*values%mean(bin), values%fraction(bin), values%density(bin)/unit]
      end function in_unit

   end subroutine put_histogram

end module wavycon_spot_tables
