!> Tables of the surface that was solved.
!>
!> <case>.spectrum.dat: power spectra of the surface, a block for the isotropic spectrum and one each for lines along x
!> and along y.
!> <case>.height.npy: heights of the surface, for numpy and for kind = 'file'.
module wavycon_surface_tables
   use wavycon_cell_file, only: check_memory, map_points, npy_header
   use wavycon_error, only: error_type
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, not_a_number
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_roughness, only: line_spectrum, radial_spectrum, spectrum_bin
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: surface_tables

   !> How many numbers are in memory for each point: the height and its spectrum.
   integer, parameter :: numbers_a_point = 2

contains

   !> The tables of this file.
   function surface_tables() result(tables)
      type(table_type) :: tables(2)

      tables(1) = table_type('spectrum', 'spectrum', blocks=3, put_load=put_spectrum, &
         columns='direction[word] wave_number[rad/length] waves[#] spectrum_2d[length^4] spectrum_1d[length^3] '// &
         'rms_height_up_to[length] rms_slope_up_to[-] rms_curvature_up_to[1/length]', &
         meaning='The power spectrum of the surface.')
      ! Only the table in memory has these columns: the file of numpy has the heights alone.
      tables(2) = table_type('height', 'height', written_by_all=is_written_by_all, &
         write_all=write_height_table, &
         columns='x[length] y[length] height[length]', &
         meaning="The heights that are solved, as a file of numpy that kind = 'file' reads.")
   end function surface_tables

   !> Writes a block of the table of spectra: 1 is the isotropic spectrum, 2 and 3 are those of lines along x and y. A
   !> profile has block 2 alone.
   subroutine put_spectrum(results, block, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: block
      type(output_file), intent(inout) :: file

      character(6), parameter :: directions(3) = [character(6) :: 'radial', 'x', 'y']
      type(spectrum_bin), allocatable :: spectrum(:)
      real(dp) :: densities(2)
      integer :: k

      associate (surface => results%solver%surface)
         if (surface%dimension == 1 .and. block /= 2) return
         if (block == 1) then
            spectrum = radial_spectrum(surface%shape, surface%amplitude, surface%length, surface%points)
         else
            spectrum = line_spectrum(surface%shape, surface%amplitude, surface%length, surface%points, block - 1)
         end if
      end associate
      call file%begin_block('direction: '//trim(directions(block)))
      do k = 1, size(spectrum)
         densities = not_a_number()
         associate (bin => spectrum(k))
            densities(merge(1, 2, block == 1)) = bin%density
            call file%put_row([real(dp) :: bin%wave_number, bin%waves, densities, bin%height, bin%slope, &
                               bin%curvature], [directions(block)])
         end associate
      end do
   end subroutine put_spectrum

   !> All ranks write the table together if the height map is distributed over the ranks.
   logical function is_written_by_all(results)
      type(results_type), intent(in) :: results

      is_written_by_all = results%solver%surface%is_distributed()
   end function is_written_by_all

   !> Writes rows along x of the heights above their mean [length]: of a height map at its own points, of other surfaces
   !> at the points of maps (map_points). A table in memory has x and y of each point too. If the map is distributed
   !> over the ranks, the ranks send its columns one by one to the first rank, which writes them. Errors:
   !> exit_file_trouble.
   subroutine write_height_table(table, results, error)
      class(table_type), intent(in) :: table
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      type(grid_slab) :: slab
      type(grid_transform) :: transform
      real(dp), allocatable :: column(:, :), height(:, :)
      integer :: k, l, points(2)
      logical :: is_own
      real(dp) :: first   ! position of the first point along x and y, in steps

      associate (surface => results%solver%surface, is_here => results%sharing%is_first)
         points = surface%points/surface%maps_in_cell()
         if (all(points == 0)) points = map_points(results)
         if (associated(results%memory)) then
            call results%open_table(trim(table%file), table%columns, file)
         else if (is_here) then
            call file%open(results%scene%directory//'/'//results%scene%case//'.height.npy', npy_header(points([2, 1])))
         end if
         first = merge(0.5_dp, 0.0_dp, surface%mirrored)
         call slab%start(points, whole=.not. surface%is_distributed())
         if (slab%is_distributed) then
            allocate (height(points(1), slab%columns()))
            call transform%start(points, surface%shape%is_even())
            call transform%sample(surface%shape, height)
         else
            call check_memory(file, points, numbers_a_point, '')
            if (file%is_open()) call surface%sample_shape(points, [first, first], height)
         end if
         allocate (column(points(1), 1))
         do l = 1, points(2)
            if (.not. allocated(height)) exit
            is_own = l >= slab%first .and. l <= slab%last
            if (is_own) column(:, 1) = surface%amplitude*height(:, l - slab%first + 1)
            if (slab%is_distributed) call results%sharing%share_numbers(is_own, column)
            if (associated(results%memory)) then
               do k = 1, points(1)
                  call file%put_row([surface%sides()*([k, l] - 1 + first)/points, column(k, 1)])
               end do
            else if (is_here) then
               call file%put_numbers(column)
            end if
         end do
         if (is_here) call file%finish(error)
      end associate
   end subroutine write_height_table

end module wavycon_surface_tables
