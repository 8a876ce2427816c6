!> <case>.slip_map.dat: the tangential tractions over one cell, and where the contact sticks and slips, a block for each
!> load and tangential load. Or <case>.slip_map.npy: the same as an array of records for numpy.
module wavycon_slip_map_table
   use wavycon_cell_file, only: cell_file
   use wavycon_contact_fields, only: contact_fields
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: exact_number, integer_text
   use wavycon_results, only: not_a_number, results_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: slip_map_table

   !> Numbers for each point: three fields of two contacts.
   integer, parameter :: numbers_a_point = 6

   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'tangential[-]', 'x[length]', 'y[length]', 'traction[pressure]', 'pressure[pressure]', &
      'slip_state[-]']

contains

   type(table_type) function slip_map_table() result(table)
      table%file = 'slip_map'
      table%key = 'slip_map'
      table%group = 'interface'
      table%meaning = 'Tangential tractions over the cell; slip_state is 0 where it is open, 1 slip, 2 stick.'
      call table%set_columns(columns)
      table%needs_fields = .true.
      table%write_all => write_slip_map
   end function slip_map_table

   !> Errors: exit_file_trouble.
   subroutine write_slip_map(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(cell_file) :: map
      class(contact_fields), allocatable :: fields
      real(dp), allocatable :: gap(:, :), p(:, :), p_of_stick(:, :), u(:, :), values(:, :)
      integer :: i, l, load

      call map%open(results, 'slip_map', columns, 2, [size(results%loads), size(results%slip, 1)], numbers_a_point, '')
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
                  if (results%slip(i, load)%stick%is_good()) then
                     values = transpose(reshape([friction*p_star*max(p(:, l) - p_of_stick(:, l), 0.0_dp), &
                                                 p_star*p(:, l), state(p(:, l), p_of_stick(:, l))], &
                                                [map%points(1), 3]))
                  else
                     values = spread([not_a_number(), not_a_number(), not_a_number()], 2, map%points(1))
                  end if
                  call map%put_row([load, i], l, values)
               end do
            end do
         end do
      end associate
      call map%file%finish(error)
   end subroutine write_slip_map

   !> 0 open, 1 slip, 2 stick.
   elemental real(dp) function state(pressure, pressure_of_stick)
      real(dp), intent(in) :: pressure, pressure_of_stick

      state = merge(1.0_dp, 0.0_dp, pressure > 0.0_dp) + merge(1.0_dp, 0.0_dp, pressure_of_stick > 0.0_dp)
   end function state

end module wavycon_slip_map_table
