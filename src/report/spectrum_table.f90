!> <case>.spectrum.dat: the power spectra of the surface, a block for the isotropic one and one for lines along x and y.
module wavycon_spectrum_table
   use wavycon_contact_solver, only: solver_traits
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_plain_text, only: short_number
   use wavycon_roughness, only: line_spectrum, power_spectrum, radial_spectrum
   use wavycon_results, only: not_a_number, results_type
   use wavycon_surface, only: surface_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: spectrum_table

   character(40), parameter :: columns(*) = [character(40) :: &
      'direction[-]', 'wave_number[rad/length]', 'waves[-]', 'spectrum_2d[length^4]', 'spectrum_1d[length^3]', &
      'rms_height_up_to[length]', 'rms_slope_up_to[-]', 'rms_curvature_up_to[1/length]']

contains

   type(table_type) function spectrum_table() result(table)
      table%file = 'spectrum'
      table%key = 'spectrum'
      table%meaning = 'The power spectrum of the surface.'
      call table%set_columns(columns)
      table%refuse => refuse
      table%write_all => write_spectrum_table
   end function spectrum_table

   !> The fourth power of a length must be a number.
   subroutine refuse(traits, surface, words)
      type(solver_traits), intent(in) :: traits
      type(surface_type), intent(in) :: surface
      character(:), allocatable, intent(out) :: words

      real(dp), parameter :: largest = 1.0e75_dp

      associate (unused => traits); end associate
      words = ''
      if (max(surface%amplitude, maxval(surface%length)) > largest) words = 'it has the fourth power of lengths, '// &
         'which may be up to '//short_number(largest)//'; choose another unit of length'
   end subroutine refuse

   !> Errors: exit_file_trouble.
   subroutine write_spectrum_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file

      call results%open_table('spectrum', columns, file)
      associate (surface => results%solver%surface)
         associate (shape => surface%shape, unit => surface%amplitude, length => surface%length, &
                    points => surface%points)
            if (surface%dimension == 2) &
               call put_spectrum(file, 'radial', radial_spectrum(shape, unit, length, points), is_radial=.true.)
            call put_spectrum(file, 'x', line_spectrum(shape, unit, length, points, 1), is_radial=.false.)
            if (surface%dimension == 2) &
               call put_spectrum(file, 'y', line_spectrum(shape, unit, length, points, 2), is_radial=.false.)
         end associate
      end associate
      call file%finish(error)
   end subroutine write_spectrum_table

   !> Writes the block of a spectrum.
   subroutine put_spectrum(file, direction, spectrum, is_radial)
      type(output_file), intent(inout) :: file
      character(*), intent(in) :: direction
      type(power_spectrum), intent(in) :: spectrum
      logical, intent(in) :: is_radial

      real(dp) :: densities(2)
      integer :: i

      call file%begin_block('direction: '//direction)
      do i = 1, size(spectrum%waves)
         densities = not_a_number()
         densities(merge(1, 2, is_radial)) = spectrum%density(i)
         call file%add(direction)
         call file%add(spectrum%wave_number(i))
         call file%add(spectrum%waves(i))
         call file%add(densities)
         call file%add([spectrum%height(i), spectrum%slope(i), spectrum%curvature(i)])
         call file%end_row()
      end do
   end subroutine put_spectrum

end module wavycon_spectrum_table
