!> <case>.stress_section.dat: stresses on a vertical section through the crest, a block for each load and body with a
!> blank line between depths.
module wavycon_stress_section_table
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_scene, only: scene_type
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_rows, only: angle_of_depth, number_of_bodies, stress_columns, stress_depths, stress_numbers
   use wavycon_stress_table, only: stress_table_type
   use wavycon_surface_lines, only: start_surface_line, surface_line
   implicit none (type, external)
   private

   public :: stress_section_table

   character(32), parameter :: columns(*) = [character(32) :: &
      'load[-]', 'body[-]', 'distance[length]', 'x[length]', 'y[length]', 'depth[length]', stress_columns]

   type, extends(stress_table_type) :: stress_section_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: is_requested
      procedure, nopass :: write => write_stress_section_table
   end type stress_section_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'section'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'Stresses on a vertical section through the crest.'
   end function meaning

   logical function is_requested(self, scene)
      class(stress_section_table), intent(in) :: self
      type(scene_type), intent(in) :: scene

      associate (unused => self); end associate
      is_requested = allocated(scene%stress_setting)
      if (is_requested) is_requested = scene%stress%text('section') /= 'none'
   end function is_requested

   !> Errors: exit_file_trouble.
   subroutine write_stress_section_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: body, load, number
      class(stress_fields), allocatable :: fields
      real(dp), allocatable :: depths(:), errors(:, :), parts(:, :, :, :), t(:)
      type(surface_line) :: line
      integer :: i, k

      ! A table in memory may be asked for although the deck has section = 'none': it is that along x.
      number = max(1, findloc(['x       ', 'diagonal', 'y       '] == results%scene%stress%text('section'), .true., &
                              dim=1))
      call start_surface_line(line, results, number)
      call stress_depths(results%scene%stress, results%solver%surface, .false., depths)
      allocate (t, source=[(maxval(line%angle(:, k) - line%angle(:, 0)), k=0, ubound(line%angle, 2))])
      allocate (parts(6, 2, size(t), size(depths)), errors(size(t), size(depths)))
      call results%open_table('stress_section', columns, file, in_blocks=.true.)
      do load = 1, size(results%loads)
         call results%loads(load)%stresses(results%solver%surface, fields)
         do i = 1, size(depths)
            call fields%on_line(line%angle(:, 0), line%direction, t, &
                                angle_of_depth(results%solver%surface, depths(i)), parts(:, :, :, i), errors(:, i))
         end do
         do body = 1, number_of_bodies(results)
            call results%begin_block(file, load)
            do i = 1, size(depths)
               if (i > 1) call file%put('')
               call put_depth()
            end do
         end do
      end do
      call file%finish(error)

   contains

      !> Writes the points of one depth.
      subroutine put_depth()
         real(dp) :: rows(size(columns) - 2, size(t))

         associate (scene => results%scene)
            do k = 1, size(t)
               rows(:, k) = [line%distance(k - 1), line%place(:, k - 1), depths(i), &
                             stress_numbers(scene%stress_setting%body(body)%stress(parts(:, :, k, i), &
                                                                                   fields%pbar_over_pstar), &
                                            errors(k, i), scene%p_star)]
            end do
         end associate
         call file%put_rows([load, body], rows)
      end subroutine put_depth

   end subroutine write_stress_section_table

end module wavycon_stress_section_table
