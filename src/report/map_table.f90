!> <case>.map.dat: the fields over one cell in the user's axes, a block a load, a blank line between rows (gnuplot's grid
!> format).
module wavycon_map_table
   use wavycon_constants, only: pi
   use wavycon_cosine_series, only: cosine_series, folded
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
                             'undeformed_gap[Delta]', 'pressure_over_pstar[-]', 'displacement[Delta]', 'gap[Delta]'])
      do load = 1, size(results%states)
         call results%put_load_heading(file, load, first=load == 1)
         call put_map(results, file, load)
      end do
      call file%finish(error)
   end subroutine write_map_table

   !> The cell has as many intervals N a side as points are asked for a wavelength. The nodes of a cell in turned axes are
   !> nodes k = a + b, l = a - b of the grid phi = pi k/N, theta = pi l/N; those of a straight one k = 2a, l = 2b.
   subroutine put_map(results, file, load)
      type(results_type), intent(in) :: results
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load

      type(cosine_series) :: pressure, displacement
      real(dp), allocatable :: p(:, :), u(:, :)
      real(dp) :: approach, side, h
      integer :: a, b, k, l, n

      call results%series(load, pressure, displacement, approach)
      n = results%deck%output%points_per_wavelength
      call pressure%evaluate_on_grid(n, p)
      call displacement%evaluate_on_grid(n, u)
      associate (surface => results%scene%surface)
         side = surface%cell_side()
         do b = 0, merge(n, 0, surface%dimension == 2)
            if (b > 0) call file%put('')
            do a = 0, n
               k = merge(a + b, 2*a, surface%turned)
               l = merge(a - b, 2*b, surface%turned)
               h = surface%undeformed_gap_over_amplitude(pi*k/n, pi*l/n)
               k = folded(k, n)
               l = folded(l, n)
               call file%put_values([results%states(load)%pbar_over_pstar, side*a/n, side*b/n, h, &
                                     p(k, l), u(k, l), h + u(k, l) - approach])
            end do
         end do
      end associate
   end subroutine put_map

end module wavycon_map_table
