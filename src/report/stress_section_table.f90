!> <case>.stress_section.dat: stresses on a vertical section through the crest, a block for each load and body with a
!> blank line between depths.
module wavycon_stress_section_table
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_scene, only: scene_type
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_rows, only: angle_of_depth, put_stresses, stress_columns, stress_depths
   use wavycon_surface_lines, only: start_surface_line, surface_line
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: stress_section_table

   character(32), parameter :: columns(*) = [character(32) :: &
      'load[-]', 'body[-]', 'distance[length]', 'x[length]', 'y[length]', 'depth[length]', stress_columns]

contains

   type(table_type) function stress_section_table() result(table)
      table%file = 'stress_section'
      table%key = 'section'
      table%meaning = 'Stresses on a vertical section through the crest.'
      call table%set_columns(columns)
      table%group = 'stress'
      table%needs_fields = .true.
      table%requested => asks_for_section
      table%put_load => put_section
   end function stress_section_table

   logical function asks_for_section(scene)
      type(scene_type), intent(in) :: scene

      asks_for_section = scene%stress%text('section') /= 'none'
   end function asks_for_section

   subroutine put_section(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      class(stress_fields), allocatable :: fields
      real(dp), allocatable :: depths(:), errors(:, :), parts(:, :, :, :), places(:, :, :), t(:)
      type(surface_line) :: line
      integer :: i, number

      ! A table in memory may be asked for although the deck has section = 'none': it is that along x.
      number = max(1, findloc(['x       ', 'diagonal', 'y       '] == results%scene%stress%text('section'), .true., &
                              dim=1))
      call start_surface_line(line, results, number)
      associate (surface => results%solver%surface)
         call stress_depths(results%scene%stress, surface, .false., depths)
         t = line%parameter()
         allocate (parts(6, 2, size(t), size(depths)), errors(size(t), size(depths)), places(4, size(t), size(depths)))
         call results%loads(load)%stresses(surface, fields)
         do i = 1, size(depths)
            call fields%on_line(line%angle(:, 0), line%direction, t, angle_of_depth(surface, depths(i)), &
                                parts(:, :, :, i), errors(:, i))
            places(1, :, i) = line%distance
            places(2:3, :, i) = line%place
            places(4, :, i) = depths(i)
         end do
      end associate
      call put_stresses(results, load, fields%pbar_over_pstar, places, parts, errors, file)
   end subroutine put_section

end module wavycon_stress_section_table
