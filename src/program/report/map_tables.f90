!> Tables over one cell: a text with a block for each load and a blank line between rows (gnuplot's grid format), or a
!> file of numpy, an array of records.
!>
!> <case>.map.dat or .npy: pressure, gap, displacement and undeformed gap.
!> <case>.slip_map.dat or .npy: tangential traction, pressure, and whether the point sticks or slips, for each load and
!> tangential load.
module wavycon_map_tables
   use wavycon_cell_file, only: cell_file, is_text, map_points
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, int64, not_a_number
   use wavycon_plain_text, only: exact_number, integer_text
   use wavycon_results, only: results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: map_tables

   !> How many numbers are in memory for each point. Map: three fields and the surface, the spectrum of one of these,
   !> and the solution's own fields. Slip map: three fields of two contacts.
   integer, parameter :: numbers_a_point = 7, numbers_a_slip_point = 6

   !> Columns of a map, without load, x and y.
   integer, parameter :: numbers_of_map = 4

contains

   !> The tables of this file.
   function map_tables() result(tables)
      type(table_type) :: tables(2)

      tables(1) = table_type('map', 'map', needs_fields=.true., written_by_all=is_written_by_all, &
         write_all=write_map_table, columns='load[#] x[length] y[length] pressure[pressure] gap[length] '// &
         'displacement[length] undeformed_gap[length]', &
         meaning='Pressures and gaps over the whole cell.')
      tables(2) = table_type('slip_map', 'slip_map', 'interface', needs_fields=.true., &
         write_all=write_slip_map, columns='load[#] tangential[#] x[length] y[length] traction[pressure] '// &
         'pressure[pressure] slip_state[-]')
   end function map_tables

   !> All ranks write the map together if it is in numpy's format and its points are those of the distributed grid that
   !> all loads are solved on. Before loads are solved, the grid that the deck gives decides.
   logical function is_written_by_all(results)
      type(results_type), intent(in) :: results

      class(contact_fields), allocatable :: fields
      integer :: load, points(2)
      integer(int64), allocatable :: own(:)

      points = map_points(results)
      is_written_by_all = .false.
      if (is_text(results%scene%output%map_format%text, points)) return
      if (.not. allocated(results%loads)) then
         is_written_by_all = all(points == results%traits%given_grid .or. points == 2*results%traits%given_grid)
      else
         own = [(results%loads(load)%distributed_points(), load=1, size(results%loads))]
         if (minval(own) <= 0 .or. maxval(own) > minval(own)) return
         call results%loads(1)%fields(results%solver%surface, fields)
         is_written_by_all = all(points == fields%own_points)
      end if
   end function is_written_by_all

   !> Writes the map of all loads. Errors: exit_file_trouble.
   subroutine write_map_table(table, results, error)
      class(table_type), intent(in) :: table
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(cell_file) :: map
      class(contact_fields), allocatable :: fields
      real(dp), allocatable :: gap(:, :), height(:, :), p(:, :), u(:, :)
      integer :: l, load
      logical :: by_all

      by_all = results%loads(1)%distributed_points() > 0
      call map%open(results, table, [size(results%loads)], merge(0, numbers_a_point, by_all), '')
      associate (surface => results%solver%surface)
         do load = 1, size(results%loads)
            if (.not. (map%file%is_open() .or. by_all)) exit
            if (map%as_text) call results%begin_block(map%file, load)
            call results%loads(load)%fields(surface, fields)
            if (by_all) then
               call put_distributed()
               cycle
            end if
            call fields%on_grid(map%points, map%offset, p, u, gap)
            call surface%sample_shape(map%points, map%offset, height)
            do l = 1, map%points(2)
               call map%put_row([load], l, row_of(p(:, l), gap(:, l), u(:, l), height(:, l)))
            end do
         end do
      end associate
      if (map%is_here) call map%file%finish(error)

   contains

      !> Writes the map of the load, whose columns are distributed over the ranks. All ranks call this procedure: they
      !> send the columns one by one to the first rank, which writes them.
      subroutine put_distributed()
         integer :: column, k, l, image(map%points(1))
         logical :: is_own
         real(dp), dimension(fields%own_slab%points(1)) :: gap, p, u
         real(dp), allocatable :: height(:, :)
         real(dp) :: values(numbers_of_map, map%points(1))
         type(grid_transform) :: transform

         associate (slab => fields%own_slab, series => results%solver%surface%shape)
            allocate (height(slab%points(1), slab%columns()))
            call transform%start(slab%points, series%is_even())
            call transform%sample(series, height)
            ! If the grid covers a quarter of the cell, its mirror images give the points of the others.
            image = image_of_point([(k, k=1, size(image))], slab%points(1), size(image) > slab%points(1))
            do l = 1, map%points(2)
               column = image_of_point(l, slab%points(2), map%points(2) > slab%points(2))
               is_own = column >= slab%first .and. column <= slab%last
               if (is_own) then
                  associate (own => height(:, column - slab%first + 1))
                     call fields%at_own_column(column, own, p, u, gap)
                     values = row_of(p(image), gap(image), u(image), own(image))
                  end associate
               end if
               call results%sharing%share_numbers(is_own, values)
               call map%put_row([load], l, values)
            end do
         end associate
      end subroutine put_distributed

      !> Pressure, gap, displacement and undeformed gap of a row of points, in the deck's units.
      pure function row_of(p, gap, u, height) result(values)
         real(dp), intent(in) :: p(:), gap(:), u(:)   !! p/p*, gap/Delta and u/Delta, shape (points)
         real(dp), intent(in) :: height(:)            !! 1 - h/Delta, h being the undeformed gap, shape (points)
         real(dp) :: values(numbers_of_map, size(p))

         values(1, :) = results%scene%p_star*p
         values(2, :) = results%solver%surface%amplitude*gap
         values(3, :) = results%solver%surface%amplitude*u
         values(4, :) = results%solver%surface%amplitude*(1.0_dp - height)
      end function row_of

   end subroutine write_map_table

   !> Writes the slip map of all loads and tangential loads. Errors: exit_file_trouble.
   subroutine write_slip_map(table, results, error)
      class(table_type), intent(in) :: table
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(cell_file) :: map
      class(contact_fields), allocatable :: fields
      real(dp), allocatable :: gap(:, :), p(:, :), p_of_stick(:, :), state(:), u(:, :), values(:, :)
      integer :: i, k, l, load

      call map%open(results, table, [size(results%loads), size(results%slip, 1)], numbers_a_slip_point, '')
      associate (surface => results%solver%surface, p_star => results%scene%p_star, &
                 friction => results%scene%interface_setting%friction)
         do load = 1, size(results%loads)
            do i = 1, size(results%slip, 1)
               if (.not. map%file%is_open()) exit
               associate (slip => results%slip(i, load))
                  if (map%as_text) call map%file%begin_block( &
                     'load '//integer_text(load)//', tangential load '//exact_number(p_star*slip%tangential))
                  call results%loads(load)%fields(surface, fields)
                  call fields%on_grid(map%points, map%offset, p, u, gap)
                  call slip%stick%fields(surface, fields)
                  call fields%on_grid(map%points, map%offset, p_of_stick, u, gap)
               end associate
               do l = 1, map%points(2)
                  ! The state is 0 where the gap is open, 1 where the contact slips and 2 where it sticks.
                  if (results%slip(i, load)%stick%has_numbers()) then
                     state = [(real(count([p(k, l), p_of_stick(k, l)] > 0.0_dp), dp), k=1, map%points(1))]
                     values = transpose(reshape([friction*p_star*max(p(:, l) - p_of_stick(:, l), 0.0_dp), &
                                                 p_star*p(:, l), state], [map%points(1), 3]))
                  else
                     values = reshape([real(dp) ::], [3, map%points(1)], pad=[not_a_number()])
                  end if
                  call map%put_row([load, i], l, values)
               end do
            end do
         end do
      end associate
      call map%file%finish(error)
   end subroutine write_slip_map

end module wavycon_map_tables
