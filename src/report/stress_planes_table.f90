!> <case>.stress_planes.dat or .npy: stresses on planes below the whole cell, a block for each load, body and depth.
module wavycon_stress_planes_table
   use wavycon_cell_file, only: cell_file
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_results, only: results_type
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_rows, only: angle_of_depth, number_of_bodies, stress_columns, stress_depths, stress_numbers
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: stress_planes_table

   character(32), parameter :: columns(*) = [character(32) :: &
      'load[-]', 'body[-]', 'x[length]', 'y[length]', 'depth[length]', stress_columns]

   !> Numbers for each point of a plane: stresses, error, their spectra, and those of the solution.
   integer, parameter :: numbers_a_point = 20

contains

   type(table_type) function stress_planes_table() result(table)
      table%file = 'stress_planes'
      table%key = 'planes'
      table%meaning = 'Stresses on planes.'
      call table%set_columns(columns)
      table%group = 'stress'
      table%needs_fields = .true.
      table%write_all => write_stress_planes_table
   end function stress_planes_table

   !> Errors: exit_file_trouble.
   subroutine write_stress_planes_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(cell_file) :: planes
      class(stress_fields), allocatable :: fields
      real(dp), allocatable :: depths(:), errors(:, :), stress(:, :, :), values(:, :)
      real(dp) :: here(6)
      integer :: body, i, k, l, load

      associate (scene => results%scene, surface => results%solver%surface, bodies => number_of_bodies(results))
         call stress_depths(scene%stress, surface, .true., depths)
         call planes%open(results, 'stress_planes', columns, 2, [size(results%loads), bodies, size(depths)], &
                          numbers_a_point, 'planes of ')
         allocate (values(size(columns) - 4, planes%points(1)))
         do load = 1, size(results%loads)
            if (.not. planes%file%is_open()) exit
            call results%loads(load)%stresses(surface, fields)
            do body = 1, bodies
               do i = 1, size(depths)
                  if (planes%as_text) call results%begin_block(planes%file, load)
                  call fields%on_plane(planes%points, planes%offset, angle_of_depth(surface, depths(i)), &
                                       scene%stress_setting%body(body), stress, errors)
                  do l = 1, planes%points(2)
                     do k = 1, planes%points(1)
                        here = stress(k, l, :)
                        values(:, k) = [depths(i), stress_numbers(here, errors(k, l), scene%p_star)]
                     end do
                     call planes%put_row([load, body], l, values)
                  end do
               end do
            end do
         end do
      end associate
      call planes%file%finish(error)
   end subroutine write_stress_planes_table

end module wavycon_stress_planes_table
