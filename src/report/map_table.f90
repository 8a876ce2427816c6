!> <case>.map.dat: the fields over one cell, a block a load, a blank line between rows (gnuplot's grid
!> format).
module wavycon_map_table
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   implicit none (type, external)
   private

   public :: write_map_table

contains

   !> Errors: exit_file_trouble.
   subroutine write_map_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: load

      call results%open_table('map', file)
      call file%put_columns([character(40) :: 'pbar_over_pstar[-]', 'x[length]', 'y[length]', &
                             'undeformed_gap[Delta]', 'pressure_over_pstar[-]', 'displacement[Delta]', &
                             'gap[Delta]'])
      do load = 1, size(results%states)
         call results%put_load_heading(file, load, first=load == 1)
         call put_map(results, file, load)
      end do
      call file%finish(error)
   end subroutine write_map_table

   !> The cell has as many intervals a side as points are asked for.
   subroutine put_map(results, file, load)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load

      class(contact_fields), allocatable :: fields
      real(dp), allocatable :: p(:, :), shape(:, :), u(:, :)
      real(dp) :: approach
      integer :: k, l, n

      n = results%deck%output%integer('points_per_wavelength')
      associate (surface => results%scene%surface)
         approach = results%states(load)%measures%approach_over_amplitude
         call results%contact%fields(results%states(load), fields)
         call fields%on_cell(n, surface%dimension, p, u)
         call surface%shape%evaluate_on_cell(n, shape)
         do l = 0, merge(n, 0, surface%dimension == 2)
            if (l > 0) call file%put('')
            do k = 0, n
               call file%put_values([results%states(load)%pbar_over_pstar, surface%length(1)*k/n, &
                                     surface%length(2)*l/n, 1.0_dp - shape(k, l), p(k, l), u(k, l), &
                                     1.0_dp - shape(k, l) + u(k, l) - approach])
            end do
         end do
      end associate
   end subroutine put_map

end module wavycon_map_table
