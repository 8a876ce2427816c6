!> Prepares a measured map for a contact solver: removes spikes, subtracts the trend, fills holes and treats the
!> borders, in this order.
module wavycon_prepare_map
   use wavycon_detrend, only: detrend_map, level_lines
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_grid_slab, only: grid_slab
   use wavycon_fill_missing, only: fill_holes
   use wavycon_kinds, only: dp, int64
   use wavycon_map_filters, only: find_spikes, taper_borders
   use wavycon_map_tuning, only: usual_window_width
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped, integer_text, percent
   implicit none (type, external)
   private

   public :: map_changes, map_preparation, prepare_map

   !> If the prepared heights differ from each other by at most this part of the largest original one, the differences
   !> are rounding, and all heights are set to zero.
   real(dp), parameter, public :: rounding = 64*epsilon(1.0_dp)

   !> The preparation of a map that a deck asks for.
   type :: map_preparation
      character(9) :: detrend = 'none'         !! what is subtracted: 'none', 'mean', 'plane', 'quadratic', 'lines'
      character(8) :: fill_missing = 'none'    !! 'none': missing heights are an error; 'harmonic': (M3) fills them
      !> How the map continues beyond its borders. 'periodic': by itself, again and again. 'mirror': by its mirror
      !> images. 'window': as 'periodic', after a taper of the borders. 'free': the surface ends there.
      character(8) :: edges = 'periodic'
      real(dp) :: window_width = usual_window_width   !! width of the taper over the side, 0 < window_width <= 1/2
      logical :: crop_missing = .false.        !! whether rows and columns at the border without any height are cut off
      logical :: despike = .false.             !! whether spikes (M8) are replaced by the median of their neighbours
      real(dp) :: short_wavelength = 0.0_dp    !! short cut-off wavelength [length]; 0: none
      real(dp) :: long_wavelength = 0.0_dp     !! long cut-off wavelength [length]; 0: none
      character(8) :: filter = 'sharp'         !! how waves are cut off: 'sharp', 'gaussian' (M9)
      logical :: may_crop = .true.             !! whether crop_missing is allowed: not for one of two maps
   end type map_preparation

   !> The preparation, and what it changed.
   type, extends(map_preparation) :: map_changes
      real(dp) :: step = 0.0_dp             !! step between points along x [length]
      real(dp) :: uneven_steps(2) = 0.0_dp  !! component of the same name of measured_map
      real(dp) :: rise(2) = 0.0_dp          !! rise of the removed linear part between first and last points [length]
      integer :: points(2) = 0              !! numbers of points of the map along x and y
      integer :: head_lines = 0             !! component of the same name of measured_map
      integer :: cropped_from(2) = 0        !! numbers of points before the map was cropped; 0 if it was not
      integer :: spikes = 0                 !! number of heights that were replaced
      integer :: filled = 0                 !! number of missing heights that were filled
      real(dp) :: rms_of_short = 0.0_dp     !! root mean square of the short waves that were removed [length]
      real(dp) :: rms_of_long = 0.0_dp      !! the same of the long waves [length]
      real(dp) :: tapered = 0.0_dp          !! part of the points that the window changed
   end type map_changes

contains

   !> Prepares a map, except for the removal of waves. With the edges 'mirror' and 'free' the heights at the
   !> borders do not change: the surface adds the mirror images. A distributed map must have no holes and spikes to be
   !> treated. Errors: exit_bad_input if there are holes that are not to be filled, and if the heights do not determine
   !> the trend; exit_file_trouble if there is not enough memory.
   subroutine prepare_map(source, preparation, length, map, changes, error)
      character(*), intent(in) :: source                !! name of the map, for messages
      type(map_preparation), intent(in) :: preparation
      real(dp), intent(in) :: length(2)                 !! sides of the map along x and y, in one unit, > 0
      type(measured_map), intent(inout) :: map          !! on exit prepared, and without holes
      type(map_changes), intent(out) :: changes         !! `rise` is in the unit of the heights
      type(error_type), allocatable, intent(out) :: error

      character(*), parameter :: trends(*) = [character(9) :: 'mean', 'plane', 'quadratic']
      logical :: is_determined
      integer :: degree
      type(grid_slab) :: slab
      real(dp) :: extremes(2), largest, step(2)

      changes%map_preparation = preparation
      slab = map%columns()
      largest = maxval(slab%extremes(map%height))
      step = length/slab%points
      if (preparation%crop_missing) call crop(map, changes%cropped_from)
      slab = map%columns()
      changes%points = slab%points
      changes%head_lines = map%head_lines
      changes%step = map%step(1)
      changes%uneven_steps = map%uneven_steps
      if (allocated(map%missing)) changes%filled = count(map%missing)
      call check_holes()
      if (allocated(error)) return
      if (preparation%despike) call find_spikes(map%height, map%missing, changes%spikes, replace=.true.)
      degree = findloc(trends, preparation%detrend, dim=1) - 1
      if (preparation%detrend == 'lines') call level_lines(map%height, map%missing)
      if (degree >= 0) then
         call detrend_map(map, degree, changes%rise, is_determined)
         if (.not. is_determined) then
            call fatal_error(error, exit_bad_input, escaped(source)//': the '// &
                             integer_text(product(slab%points) - changes%filled)//' heights that are there do not '// &
                             "determine detrend = '"//trim(preparation%detrend)//"': give detrend = 'mean'")
            return
         end if
         where (abs(changes%rise) <= rounding*largest) changes%rise = 0.0_dp
      end if
      if (changes%filled > 0) then
         call fill_holes(source, step, preparation%edges == 'periodic', map, error)
         if (allocated(error)) return
      end if
      if (preparation%edges == 'window') call taper_borders(preparation%window_width, slab, map%height, changes%tapered)
      if (preparation%detrend == 'none' .and. changes%filled == 0 .and. preparation%edges /= 'window') return
      extremes = slab%extremes(map%height)
      if (sum(extremes) <= rounding*largest) map%height = 0.0_dp

   contains

      !> Checks the missing heights. Errors: exit_bad_input if some are missing and are not to be filled, and if all
      !> are. `missing` may become allocated.
      subroutine check_holes()
         integer(int64) :: holes, points
         integer :: first(2)
         character(:), allocatable :: remedy, what
         real(dp) :: unused

         points = product(int(slab%points, int64))
         holes = 0
         if (allocated(map%missing)) holes = count(map%missing, kind=int64)
         holes = slab%total_count(holes)
         if (holes == 0) return
         if (holes == points) then
            call fatal_error(error, exit_bad_input, escaped(source)//': all heights are missing: some must be numbers')
         else if (preparation%fill_missing == 'none') then
            if (.not. allocated(map%missing)) allocate (map%missing(slab%points(1), slab%columns()), source=.false.)
            call slab%find_largest(merge(1.0_dp, 0.0_dp, map%missing), unused, first)
            remedy = "fill_missing = 'harmonic' fills them"
            if (all(first == 1) .and. preparation%may_crop) remedy = remedy// &
               ', crop_missing = .true. cuts off rows and columns at the border that have no heights'
            what = ' heights are missing ('
            if (map%uneven_steps(2) > 0.0_dp) what = ' heights, resampled to equal steps, are missing ('
            call fatal_error(error, exit_bad_input, escaped(source)//': '//integer_text(holes)//' of '// &
                             integer_text(points)//what// &
                             percent(real(holes, dp)/points)//'), the first is number '// &
                             integer_text(first(1))//' along x and '//integer_text(first(2))//' along y: '//remedy)
         end if
      end subroutine check_holes

   end subroutine prepare_map

   !> Cuts off the rows and columns at the border of a map in which all heights are missing.
   subroutine crop(map, points)
      type(measured_map), intent(inout) :: map
      integer, intent(out) :: points(2)   !! numbers of points before; zeros if nothing is cut off

      integer :: first(2), last(2)

      points = 0
      if (.not. allocated(map%missing)) return
      associate (is_there => .not. map%missing)
         first = [findloc(any(is_there, dim=2), .true.), findloc(any(is_there, dim=1), .true.)]
         last = [findloc(any(is_there, dim=2), .true., back=.true.), &
                 findloc(any(is_there, dim=1), .true., back=.true.)]
      end associate
      if (any(first == 0) .or. all(last - first + 1 == shape(map%height))) return
      points = shape(map%height)
      map%height = map%height(first(1):last(1), first(2):last(2))
      map%missing = map%missing(first(1):last(1), first(2):last(2))
      if (.not. any(map%missing)) deallocate (map%missing)
   end subroutine crop

end module wavycon_prepare_map
