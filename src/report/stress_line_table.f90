!> <case>.stress_line.dat: stresses on the line below the crest, a block for each load and body.
module wavycon_stress_line_table
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_rows, only: angle_of_depth, put_stresses, stress_columns, stress_depths
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: stress_line_table

   character(32), parameter :: columns(*) = [character(32) :: &
      'load[-]', 'body[-]', 'depth[length]', 'depth_over_cell_x[-]', stress_columns]

contains

   type(table_type) function stress_line_table() result(table)
      table%file = 'stress_line'
      table%key = 'line'
      table%meaning = 'Stresses on the line below the crest.'
      call table%set_columns(columns)
      table%group = 'stress'
      table%needs_fields = .true.
      table%put_load => put_line
   end function stress_line_table

   subroutine put_line(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      class(stress_fields), allocatable :: fields
      real(dp), allocatable :: depths(:), errors(:, :), parts(:, :, :, :), places(:, :, :)
      real(dp) :: side(2)
      integer :: i

      associate (surface => results%solver%surface)
         side = surface%sides()
         call stress_depths(results%scene%stress, surface, .false., depths)
         allocate (parts(6, 2, size(depths), 1), errors(size(depths), 1), places(2, size(depths), 1))
         call results%loads(load)%stresses(surface, fields)
         do i = 1, size(depths)
            call fields%at(surface%crest(1), surface%crest(2), angle_of_depth(surface, depths(i)), parts(:, :, i, 1), &
                           errors(i, 1))
            places(:, i, 1) = [depths(i), depths(i)/side(1)]
         end do
      end associate
      call put_stresses(results, load, fields%pbar_over_pstar, places, parts, errors, file)
   end subroutine put_line

end module wavycon_stress_line_table
