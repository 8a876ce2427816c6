!> <case>.bounds.dat: guaranteed bounds of complementary energy, approach and mean gap of the surface, from pressures
!> and gaps of each solution, and whether the solution's own numbers lie within these bounds. Pressures and gaps are
!> taken at the points of a grid: of the grid that the solver used or, if there is none, of a grid on which the solution
!> is evaluated. The page of src/core/half_space derives the bounds, (E18) to (E26).
module wavycon_bounds_tables
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_energy_bounds, only: bounding_grid, energy_bounds
   use wavycon_fourier_series, only: fourier_series, weighted
   use wavycon_full_contact, only: mean_compliance
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, ieee_is_nan, not_a_number
   use wavycon_output_file, only: output_file
   use wavycon_quantities, only: approach, elastic_energy, mean_gap, or_nan
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: status_code, status_name
   use wavycon_surface, only: surface_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: bounds_tables

   !> A solution without a grid is evaluated on one. `usual_points` is the number of its points along each side of the
   !> cell for an accuracy of 1e-6, of profiles (1) and of surfaces in 2-D (2). The width of the bounds falls with the
   !> cube of the number of points, so that finer accuracies take 2^n times as many points, up to `most_points`, and
   !> coarser ones fewer, down to 64. On more points the rounding (E25) makes the bounds of profiles wider: those of the
   !> energy of the wave at 0.5 p* are 2e-11 apart on 8192 and on 16384 points, 8e-11 on 65536.
   integer, parameter :: usual_points(2) = [4096, 512], most_points(2) = [16384, 1024]

contains

   !> The table <case>.bounds.dat.
   function bounds_tables() result(tables)
      type(table_type) :: tables(1)

      tables(1) = table_type('bounds', 'bounds', needs_fields=.true., write_all=write_bounds, &
         columns='load[#] pbar_over_pstar[-] energy_lower_over_pstar_amplitude[-] '// &
         'energy_upper_over_pstar_amplitude[-] approach_lower_over_amplitude[-] approach_upper_over_amplitude[-] '// &
         'mean_gap_lower_over_amplitude[-] mean_gap_upper_over_amplitude[-] energy_lower[force*length] '// &
         'energy_upper[force*length] approach_lower[length] approach_upper[length] mean_gap_lower[length] '// &
         'mean_gap_upper[length] energy_is_inside[#] approach_is_inside[#] points_x[#] points_y[#] status_code[#] '// &
         'status[word]', &
         meaning='Guaranteed bounds of complementary energy, approach and mean gap.')
   end function bounds_tables

   !> Writes the table: a row for each load. Bounds are NaN for a load without a solution, and on a grid that does not
   !> have all waves of the surface. Errors: exit_file_trouble.
   subroutine write_bounds(table, results, error)
      class(table_type), intent(in) :: table
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(bounding_grid) :: grid   ! as the last load needed it; loads on the same grid use it again
      type(energy_bounds) :: bounds
      type(output_file) :: file
      integer :: cell(2), load
      real(dp) :: inside(2), numbers(6), own(3), overlap, unit(6)
      real(dp), allocatable :: gap(:, :), p(:, :)

      call results%open_table(trim(table%file), table%columns, file)
      associate (surface => results%solver%surface)
         unit = surface%amplitude
         unit(:2) = results%scene%p_star*surface%amplitude*surface%nominal_area()
         do load = 1, size(results%loads)
            inside = not_a_number()
            numbers = not_a_number()
            cell = 0
            associate (solution => results%loads(load))
               call fields_of(results, load, p, gap)
               if (allocated(p)) then
                  if (any(grid%points /= shape(p))) call grid%start(surface, shape(p), surface%shape%is_even())
                  call grid%bound(surface, p, gap, solution%pbar_over_pstar, bounds)
                  if (grid%is_fine_enough) cell = grid%cell/surface%maps_in_cell()
                  own = or_nan(solution%value([approach, elastic_energy, mean_gap]))
                  ! H <max(-g, 0)> of (E24). The mean of h + u is 1, so that the negative part of the gap h + u -
                  ! delta_0 has the mean delta_0 - 1 + mean gap, where delta_0 lacks the compression of a layer (E31).
                  overlap = 0.0_dp
                  if (surface%has_hardness()) overlap = surface%hardness*( &
                     own(1) - mean_compliance(surface)*solution%pbar_over_pstar - 1.0_dp + own(3))
                  numbers = [bounds%energy, bounds%approach, bounds%mean_gap]
                  ! The solution's own energy F by (E24), and its approach.
                  inside = [inside_of(solution%pbar_over_pstar*own(1) - own(2) - overlap, bounds%energy), &
                            inside_of(own(1), bounds%approach)]
               end if
               call file%put_row([real(dp) :: load, results%in_p_star(solution%pbar_over_pstar), numbers, &
                                  unit*numbers, inside, cell, status_code(solution%status)], &
                                 [status_name(solution%status)])
            end associate
         end do
      end associate
      call file%finish(error)

   contains

      !> 1 if the number lies between the bounds, 0 if it does not, NaN if the number or a bound is unknown.
      real(dp) function inside_of(number, bounds)
         real(dp), intent(in) :: number, bounds(2)

         inside_of = not_a_number()
         if (any(ieee_is_nan([number, bounds]))) return
         inside_of = 0.0_dp
         if (number >= bounds(1) .and. number <= bounds(2)) inside_of = 1.0_dp
      end function inside_of

   end subroutine write_bounds

   !> The pressures and the gaps of a solution at the points of a grid: of the whole cell or, if the surface is even in
   !> X and Y, of a quarter of it.
   subroutine fields_of(results, load, p, gap)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      real(dp), allocatable, intent(out) :: p(:, :)      !! p/p*, shape (M, N); not allocated without a solution
      !> gap/Delta, shape (M, N). With a hardness it is h + u - delta <= 0 where the pressure is the hardness.
      real(dp), allocatable, intent(out) :: gap(:, :)

      class(contact_fields), allocatable :: fields
      integer :: i, j, points(2)
      logical :: is_halved(2)
      real(dp) :: doublings, offset(2)
      real(dp), allocatable :: u(:, :)

      associate (surface => results%solver%surface, solution => results%loads(load))
         if (.not. solution%has_numbers()) return
         call solution%fields(surface, fields)
         if (.not. allocated(fields)) return
         if (fields%own_points(1) > 0) then
            points = fields%own_slab%points
            allocate (p(points(1), points(2)), gap(points(1), points(2)), u(points(1), 1))
            do j = 1, points(2)
               ! The shape serves for the displacement alone, which is not used here: zeros do.
               call fields%at_own_column(j, [(0.0_dp, i=1, points(1))], p(:, j), u(:, 1), gap(:, j))
            end do
         else
            points = 1
            doublings = ceiling(log(1.0e-6_dp/max(results%scene%method%accuracy%number, tiny(offset)))/(3*log(2.0_dp)))
            points(:surface%dimension) = nint(min(max(usual_points(surface%dimension)*2.0_dp**doublings, 64.0_dp), &
                                                  real(most_points(surface%dimension), dp)))
            points = points/surface%maps_in_cell()
            ! Of an even surface the bounds take a quarter of the cell, with points in the middle of their steps.
            is_halved = points > 1 .and. surface%shape%is_even()
            offset = 0.0_dp
            where (is_halved) offset = 0.5_dp
            call fields%on_grid(points, offset, p, u, gap)
            where (is_halved) points = points*surface%maps_in_cell()/2
            p = p(:points(1), :points(2))
            gap = gap(:points(1), :points(2))
         end if
         if (surface%has_hardness()) call add_overlap( &
            surface, solution%value(approach) - mean_compliance(surface)*solution%pbar_over_pstar, p, gap)
      end associate
   end subroutine fields_of

   !> Sets the gap to h + u - delta, if that is negative, where the pressure is the hardness, as (E24) needs it. The
   !> displacement u of the pressure is computed by Fourier transforms.
   subroutine add_overlap(surface, approach_over_amplitude, p, gap)
      type(surface_type), intent(in) :: surface   !! with a hardness
      real(dp), intent(in) :: approach_over_amplitude   !! delta/Delta less the mean compression of a layer
      real(dp), intent(in) :: p(:, :)             !! p/p* at the points of the grid, shape (M, N)
      real(dp), intent(inout) :: gap(:, :)        !! gap/Delta there

      real(dp), allocatable :: height(:, :), u(:, :)
      type(fourier_series) :: series
      type(grid_transform) :: transform

      allocate (height, u, mold=gap)
      call transform%start(shape(p), surface%shape%is_even(), whole=.true.)
      call transform%series(p, series)
      call transform%sample(weighted(series, surface%length, surface%kernel, divides=.true.), u)
      call transform%sample(surface%shape, height)
      where (p >= surface%hardness) &
         gap = min(0.0_dp, 1.0_dp - height + u/surface%stiffness - approach_over_amplitude)
   end subroutine add_overlap

end module wavycon_bounds_tables
