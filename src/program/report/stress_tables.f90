!> Tables of stresses in the bodies.
!>
!> <case>.stress_largest.dat: the largest von Mises stress and the largest shear stress of each load and body.
!> <case>.stress_line.dat: stresses on the vertical line below the crest, a block for each load and body.
!> <case>.stress_section.dat: stresses on a vertical section through the crest, a block for each load and body with a
!> blank line between depths.
!> <case>.stress_planes.dat or .npy: stresses on horizontal planes below the whole cell, a block for each load, body and
!> depth.
module wavycon_stress_tables
   use wavycon_cell_file, only: cell_file
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp, not_a_number, pi
   use wavycon_line_tables, only: start_surface_line, surface_line
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_scene_groups, only: stress_group
   use wavycon_solution_record, only: status_code, status_name
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_tensor, only: principal_stresses, stress_pressure, von_mises
   use wavycon_surface, only: surface_type
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: stress_tables, stress_depths, stress_numbers

   !> Columns of the stress at a point. Tension is positive, and principal stress 1 is the largest. The error is an
   !> estimate of the largest error of the six components.
   character(*), parameter :: stress_columns = &
      'stress_xx[pressure] stress_yy[pressure] stress_zz[pressure] stress_xy[pressure] stress_xz[pressure] '// &
      'stress_yz[pressure] principal_1[pressure] principal_2[pressure] principal_3[pressure] von_mises[pressure] '// &
      'largest_shear[pressure] stress_pressure[pressure] stress_error[pressure]'
   integer, parameter :: numbers_of_stress = 13

   !> How many numbers are in memory for each point of a plane: stresses, error, their spectra, and the solution's own
   !> fields.
   integer, parameter :: numbers_a_point = 20

contains

   !> The tables of this file.
   function stress_tables() result(tables)
      type(table_type) :: tables(4)

      ! stress_over_yield_stress is the equivalent stress of the yield criterion in use over the yield stress.
      tables(1) = table_type('stress_largest', 'largest', 'stress', put_load=put_largest_stresses, &
         columns='load[#] body[#] nu[-] pbar_over_pstar[-] '// &
         'largest_von_mises_over_pstar[-] largest_von_mises_over_pstar_error[-] largest_shear_over_pstar[-] '// &
         'largest_shear_over_pstar_error[-] stress_over_yield_stress[-] stress_over_yield_stress_error[-] '// &
         'mean_pressure[pressure] largest_von_mises[pressure] largest_von_mises_error[pressure] '// &
         'von_mises_x[length] '// &
         'von_mises_y[length] von_mises_depth[length] largest_shear[pressure] largest_shear_error[pressure] '// &
         'shear_x[length] shear_y[length] shear_depth[length] status_code[#] status[word]')
      tables(2) = table_type('stress_line', 'line', 'stress', needs_fields=.true., put_load=put_line, &
         columns='load[#] body[#] depth[length] depth_over_cell_x[-] '//stress_columns)
      tables(3) = table_type('stress_section', 'section', 'stress', needs_fields=.true., &
         put_load=put_section, &
         columns='load[#] body[#] distance[length] x[length] y[length] depth[length] '// &
         stress_columns)
      tables(4) = table_type('stress_planes', 'planes', 'stress', needs_fields=.true., &
         write_all=write_stress_planes_table, &
         columns='load[#] body[#] x[length] y[length] depth[length] '//stress_columns)
   end function stress_tables

   !> Writes the rows of a load, one for each body. The largest stresses were found before: they are in the results.
   subroutine put_largest_stresses(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      integer :: body
      integer :: images(2)     ! how often a mirrored map fits into the cell along x and y
      real(dp) :: ratio(2)     ! equivalent stress over the yield stress, and its error
      real(dp) :: to_unit(5)   ! units of value, error, x, y and depth in the deck's units

      associate (surface => results%solver%surface)
         images = surface%maps_in_cell()
         to_unit = [results%scene%p_star, results%scene%p_star, surface%length, surface%length(1)]
      end associate
      do body = 1, size(results%scene%stress_setting%body)
         associate (setting => results%scene%stress_setting, yielding => results%largest_stresses(1, body, load), &
                    shear => results%largest_stresses(2, body, load), status => results%stress_status(load, body))
            ratio = not_a_number()
            if (allocated(setting%yield_stress)) &
               ratio = setting%over_yield_stress(body, [yielding%value, yielding%error], [shear%value, shear%error])
            call file%put_row([real(dp) :: load, body, setting%body(body)%nu, &
                               results%in_p_star([results%loads(load)%pbar_over_pstar, yielding%value, &
                                                  yielding%error, shear%value, shear%error]), ratio, &
                               results%mean_pressure(load), &
                               to_unit*[yielding%value, yielding%error, yielding%position_in_cell(images)], &
                               to_unit*[shear%value, shear%error, shear%position_in_cell(images)], &
                               status_code(status)], [status_name(status)])
         end associate
      end do
   end subroutine put_largest_stresses

   !> Writes the blocks of a load: the stresses below the crest.
   subroutine put_line(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      call put_below(results, load, file)
   end subroutine put_line

   !> Writes the blocks of a load: the stresses on the vertical section below a line of the surface.
   subroutine put_section(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(surface_line) :: line

      ! A program may ask for this table in memory although the deck has section = 'none'. The section is then that
      ! along x.
      call start_surface_line(line, results, max(1, findloc(['x       ', 'diagonal', 'y       '] == &
                              results%scene%stress%section%text, .true., dim=1)))
      call put_below(results, load, file, line)
   end subroutine put_section

   !> Writes the stresses below the crest or below a line of the surface: a block for each body. Below a line a blank
   !> line separates the depths.
   subroutine put_below(results, load, file, line)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      !> The file. Its columns are 'load' and 'body'; then, below the crest, depth and depth over cell or, below a line,
      !> distance, x, y and depth; then those of the stress.
      type(output_file), intent(inout) :: file
      type(surface_line), intent(in), optional :: line   !! absent: the vertical line below the crest

      class(stress_fields), allocatable :: fields
      !> Position columns, and the stress of the waves as terms(:, 1) + nu*terms(:, 2), shape (6, 2, points, depths).
      real(dp), allocatable :: depths(:), errors(:, :), position(:), terms(:, :, :, :)
      real(dp) :: side(2)
      integer :: body, i, k, points

      points = 1
      if (present(line)) points = size(line%t)
      associate (surface => results%solver%surface, bodies => results%scene%stress_setting%body)
         side = surface%sides()
         call stress_depths(results%scene%stress, surface, .false., depths)
         allocate (terms(6, 2, points, size(depths)), errors(points, size(depths)))
         call results%loads(load)%stresses(surface, fields)
         do i = 1, size(depths)
            associate (depth => 2*pi*depths(i)/surface%length(1))
               if (present(line)) then
                  call fields%on_line(line%angle(:, 0), line%direction, line%t, depth, terms(:, :, :, i), errors(:, i))
               else
                  call fields%at(surface%crest(1), surface%crest(2), depth, terms(:, :, 1, i), errors(1, i))
               end if
            end associate
         end do
         do body = 1, size(bodies)
            call results%begin_block(file, load)
            do i = 1, size(depths)
               if (i > 1 .and. present(line)) call file%put('')
               do k = 1, points
                  position = [depths(i), depths(i)/side(1)]
                  if (present(line)) &
                     position = [line%distance(k - 1), surface%length*line%angle(:, k - 1)/(2*pi), depths(i)]
                  call file%put_row([real(dp) :: load, body, position, stress_numbers( &
                                     bodies(body)%stress(terms(:, :, k, i), fields%pbar_over_pstar), errors(k, i), &
                                     results%scene%p_star)])
               end do
            end do
         end do
      end associate
   end subroutine put_below

   !> Writes the stresses of all loads on planes. Errors: exit_file_trouble.
   subroutine write_stress_planes_table(table, results, error)
      class(table_type), intent(in) :: table
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(cell_file) :: planes
      class(stress_fields), allocatable :: fields
      real(dp), allocatable :: depths(:), errors(:, :), stress(:, :, :), values(:, :)
      integer :: body, i, k, l, load

      associate (scene => results%scene, surface => results%solver%surface, &
                 bodies => size(results%scene%stress_setting%body))
         call stress_depths(scene%stress, surface, .true., depths)
         call planes%open(results, table, [size(results%loads), bodies, size(depths)], numbers_a_point, 'planes of ')
         allocate (values(1 + numbers_of_stress, planes%points(1)))
         do load = 1, size(results%loads)
            if (.not. planes%file%is_open()) exit
            call results%loads(load)%stresses(surface, fields)
            do body = 1, bodies
               do i = 1, size(depths)
                  if (planes%as_text) call results%begin_block(planes%file, load)
                  call fields%on_plane(planes%points, planes%offset, 2*pi*depths(i)/surface%length(1), &
                                       scene%stress_setting%body(body), stress, errors)
                  do l = 1, planes%points(2)
                     do k = 1, planes%points(1)
                        values(:, k) = [depths(i), stress_numbers(stress(k, l, :), errors(k, l), scene%p_star)]
                     end do
                     call planes%put_row([load, body], l, values)
                  end do
               end do
            end do
         end do
      end associate
      call planes%file%finish(error)
   end subroutine write_stress_planes_table

   !> The numbers of `stress_columns` at a point [pressure].
   pure function stress_numbers(stress, error, p_star) result(numbers)
      real(dp), intent(in) :: stress(6)   !! components xx, yy, zz, xy, xz, yz [p*]
      real(dp), intent(in) :: error       !! estimate of the largest error of a component [p*]
      real(dp), intent(in) :: p_star      !! p* [pressure]
      real(dp) :: numbers(numbers_of_stress)

      real(dp) :: principal(3)

      principal = principal_stresses(stress)
      numbers = p_star*[stress, principal, von_mises(stress), 0.5_dp*(principal(1) - principal(3)), &
                        stress_pressure(stress), error]
   end function stress_numbers

   !> The depths of a table. A deck may give a list of depths, a range of equally spaced depths, or both. Planes take
   !> the list if the deck gives it; line and section take the range if it is in effect. Otherwise they take the other.
   subroutine stress_depths(stress, surface, of_planes, depths)
      type(stress_group), intent(in) :: stress          !! the values of the group &stress
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: of_planes                  !! whether the table is that of planes
      real(dp), allocatable, intent(out) :: depths(:)   !! depths below the surface [length]

      integer :: i, intervals, steps
      logical :: by_list
      real(dp) :: side(2)

      side = surface%sides()
      by_list = of_planes .or. .not. stress%depth_from%in_effect
      if (by_list .and. stress%depths%is_given) then
         depths = stress%depths%numbers
      else if (by_list .and. stress%depths_over_cell_x%is_given) then
         depths = side(1)*stress%depths_over_cell_x%numbers
      else
         steps = nint(stress%depth_steps%number)
         intervals = max(1, steps - 1)
         depths = [(side(1)*(stress%depth_from%number*(intervals - i) + stress%depth_to%number*i)/intervals, &
                    i=0, steps - 1)]
      end if
   end subroutine stress_depths

end module wavycon_stress_tables
