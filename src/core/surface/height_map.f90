!> Makes the surface of a measured height map: prepares the map, computes its statistics, and interpolates its heights.
module wavycon_height_map
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, int64, largest_number, smallest_number
   use wavycon_map_filters, only: find_spikes, leave_out_waves
   use wavycon_map_statistics, only: map_statistics, statistics_of
   use wavycon_map_tuning, only: least_placeholder, placeholders, spiky_kurtosis
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped, short_number
   use wavycon_prepare_map, only: map_changes, map_preparation, prepare_map, rounding
   use wavycon_surface, only: surface_type
   use wavycon_surface_of_points, only: surface_of_points
   implicit none (type, external)
   private

   public :: surface_of_map

contains

   !> Prepares a map and makes its surface. Errors: exit_bad_input for heights out of range, for missing heights that
   !> are not to be filled, for too few heights to determine the trend, and for filters that leave nothing of the
   !> heights; exit_file_trouble if there is not enough memory.
   subroutine surface_of_map(source, preparation, unit, sides, map, surface, statistics, error, radii)
      character(*), intent(in) :: source            !! name of the map, for messages
      type(map_preparation), intent(in) :: preparation
      real(dp), intent(in) :: unit                  !! length of one unit of the heights, > 0
      real(dp), intent(in) :: sides(2)              !! sides of the map along x and y [length], > 0
      !> On entry heights that rise towards the other body. On exit the heights of the surface less their mean [length],
      !> without holes.
      type(measured_map), intent(inout) :: map
      type(surface_type), intent(inout), optional :: surface   !! absent: the map is only prepared
      type(map_statistics), allocatable, intent(out) :: statistics   !! all components but the path are set
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(in), optional :: radii(2)    !! radii of the ball that the map lies on, as of surface_of_points

      type(grid_slab) :: slab
      type(map_changes) :: changes
      integer(int64) :: of_extreme   ! number of heights that stand for missing ones, as it seems
      logical :: repeats
      real(dp) :: extreme, extremes(2), largest, length(2), mean(1), unfiltered(2)

      slab = map%columns()
      length = sides/slab%points
      extremes = slab%extremes(map%height)
      largest = maxval(extremes)
      extreme = merge(extremes(1), -extremes(2), is_placeholder(extremes(1)))
      of_extreme = 0
      if (is_placeholder(extreme)) &
         of_extreme = slab%total_count(count(.not. abs(map%height - extreme) > 0.0_dp, kind=int64))
      if (largest > largest_number) &
         call fatal_error(error, exit_bad_input, escaped(source)//': heights are up to '//short_number(largest)// &
                          ' in size: they may be up to '//short_number(largest_number))
      if (.not. allocated(error)) call prepare_map(source, preparation, sides, map, changes, error)
      call slab%share_error(error)
      if (allocated(error)) return
      call map%keep_own_columns()
      slab = map%columns()
      ! Cropping changes the number of points, and the sides with it, but not the steps, which `length` has here.
      length = length*slab%points
      ! A map with free edges is stored as a mirrored one. Opposite borders are neighbours of each other in neither.
      repeats = all(preparation%edges /= ['mirror', 'free  '])
      unfiltered = slab%extremes(map%height)
      if (preparation%short_wavelength > 0.0_dp) &
         call leave_out_waves(slab%points, length, .not. repeats, 'shorter', preparation%filter, &
                              preparation%short_wavelength, map%height, changes%rms_of_short)
      if (preparation%long_wavelength > 0.0_dp) &
         call leave_out_waves(slab%points, length, .not. repeats, 'longer', preparation%filter, &
                              preparation%long_wavelength, map%height, changes%rms_of_long)
      extremes = slab%extremes(map%height)
      if (max(preparation%short_wavelength, preparation%long_wavelength) > 0.0_dp .and. &
          sum(unfiltered) > 0.0_dp .and. sum(extremes) <= rounding*largest) then
         call fatal_error(error, exit_bad_input, escaped(source)//': nothing is left of the heights but rounding: '// &
                          'short_wavelength and long_wavelength leave out all waves of the map, which is '// &
                          short_number(length(1))//' long. Do the units agree?')
         return
      else if (sum(extremes) <= 0.0_dp) then
         ! All heights are equal. They are set to zero, because heights less their rounded mean would not be zero
         ! exactly.
         map%height = 0.0_dp
         largest = 0.0_dp
      else
         mean = slab%column_totals(reshape(sum(map%height, dim=1), [1, slab%columns()]))/product(real(slab%points, dp))
         map%height = unit*(map%height - mean(1))
         largest = unit*maxval(extremes + [-mean, mean])
      end if
      if (largest > largest_number .or. (largest < smallest_number .and. largest > 0.0_dp)) then
         call fatal_error(error, exit_bad_input, escaped(source)//': the heights over their mean, times '// &
                          'height_scale, are up to '//short_number(largest)//' [length]: lengths may be '// &
                          'from '//short_number(smallest_number)//' to '//short_number(largest_number))
         return
      end if
      changes%rise = unit*changes%rise
      changes%rms_of_short = unit*changes%rms_of_short
      changes%rms_of_long = unit*changes%rms_of_long
      statistics = statistics_of(map%height, map%format, slab%points, length/slab%points, repeats)
      if (present(surface)) surface = surface_of_points(length, map%height, changes%edges == 'mirror', slab%points, &
                                                        changes%edges == 'free', radii)
      statistics%changes = changes
      if (of_extreme > 1) statistics%placeholder = extreme
      if (of_extreme > 1) statistics%placeholders = int(of_extreme)
      if (statistics%kurtosis > spiky_kurtosis .and. .not. slab%is_distributed .and. .not. preparation%despike) &
         call find_spikes(map%height, map%missing, statistics%spikes, replace=.false.)
   end subroutine surface_of_map

   !> Whether programs often write a height for a missing one.
   pure logical function is_placeholder(height)
      real(dp), intent(in) :: height

      is_placeholder = abs(height) >= least_placeholder .or. any(.not. abs(placeholders - height) > 0.0_dp)
   end function is_placeholder

end module wavycon_height_map
