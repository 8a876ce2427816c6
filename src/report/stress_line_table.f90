!> <case>.stress_line.dat: stresses on the line below the crest, a block for each load and body.
module wavycon_stress_line_table
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_rows, only: angle_of_depth, number_of_bodies, stress_columns, stress_depths, stress_numbers
   use wavycon_stress_table, only: stress_table_type
   implicit none (type, external)
   private

   public :: stress_line_table

   character(32), parameter :: columns(*) = [character(32) :: &
      'load[-]', 'body[-]', 'depth[length]', 'depth_over_cell_x[-]', stress_columns]

   type, extends(stress_table_type) :: stress_line_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure, nopass :: write => write_stress_line_table
   end type stress_line_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'line'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'Stresses on the line below the crest.'
   end function meaning

   !> Errors: exit_file_trouble.
   subroutine write_stress_line_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      class(stress_fields), allocatable :: fields
      real(dp), allocatable :: depths(:), errors(:), parts(:, :, :), rows(:, :)
      real(dp) :: side(2)
      integer :: body, i, load

      associate (scene => results%scene, surface => results%solver%surface)
         side = surface%sides()
         call stress_depths(scene%stress, surface, .false., depths)
         allocate (parts(6, 2, size(depths)), errors(size(depths)), rows(size(columns) - 2, size(depths)))
         call results%open_table('stress_line', columns, file, in_blocks=.true.)
         do load = 1, size(results%loads)
            call results%loads(load)%stresses(surface, fields)
            do i = 1, size(depths)
               call fields%at(surface%crest(1), surface%crest(2), angle_of_depth(surface, depths(i)), &
                              parts(:, :, i), errors(i))
            end do
            do body = 1, number_of_bodies(results)
               call results%begin_block(file, load)
               do i = 1, size(depths)
                  rows(:, i) = [depths(i), depths(i)/side(1), &
                                stress_numbers(scene%stress_setting%body(body)%stress(parts(:, :, i), &
                                                                                      fields%pbar_over_pstar), &
                                               errors(i), scene%p_star)]
               end do
               call file%put_rows([load, body], rows)
            end do
         end do
      end associate
      call file%finish(error)
   end subroutine write_stress_line_table

end module wavycon_stress_line_table
