!> Takes the heads of ESRI's ASCII grids, https://desktop.arcgis.com/en/arcmap/latest/manage-data/raster-and-images/
!> esri-ascii-raster-format.htm: lines of a key and its number before the rows of heights.
module wavycon_esri_grid
   use wavycon_decimal_number, only: read_decimal
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_gwyddion_map, only: entry_of, positive_number
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped, integer_text, lower_case
   implicit none (type, external)
   private

   public :: esri_points, take_esri_head

contains

   !> Points along x and y as the head of such a grid gives them; 0 if this is none.
   function esri_points(head) result(points)
      character(*), intent(in) :: head   !! the first lines of the file, behind an empty one
      integer :: points(2)

      points = int(min([number_of(head, 'ncols'), number_of(head, 'nrows')], real(huge(0), dp)))
   end function esri_points

   !> Takes points, steps and the number of missing heights from the head. Its first row is that of the largest y; y of
   !> the map rises. Errors: exit_bad_input for another number of heights than the head gives.
   subroutine take_esri_head(path, head, map, error)
      character(*), intent(in) :: path   !! of the file, for the message
      character(*), intent(in) :: head   !! as of esri_points, which are above 0
      type(measured_map), intent(inout) :: map   !! with the heights of the file in their order, in any rows
      type(error_type), allocatable, intent(out) :: error

      !> Where the head does not give it.
      real(dp), parameter :: usual_no_data = -9999.0_dp
      integer :: points(2)
      logical :: is_number

      points = esri_points(head)
      if (product(real(points, dp)) > size(map%height) .or. product(points) /= size(map%height)) then
         call fatal_error(error, exit_bad_input, escaped(path)//': its head announces '//integer_text(points(1))// &
                          ' x '//integer_text(points(2))//' heights, but it has '//integer_text(size(map%height)))
         return
      end if
      map%height = reshape(map%height, points)
      map%height = map%height(:, points(2):1:-1)
      map%step = number_of(head, 'cellsize')
      if (.not. map%step(1) > 0.0_dp) map%step = [number_of(head, 'dx'), number_of(head, 'dy')]
      allocate (map%no_data)
      call read_decimal(entry_of(lower_case(head), 'nodata_value', ' '), map%no_data, is_number)
      if (.not. is_number) map%no_data = usual_no_data
      map%head_lines = 0
   end subroutine take_esri_head

   !> The positive number of a key; 0 if there is none.
   real(dp) function number_of(head, key)
      character(*), intent(in) :: head, key

      number_of = positive_number(entry_of(lower_case(head), key, ' '))
   end function number_of

end module wavycon_esri_grid
