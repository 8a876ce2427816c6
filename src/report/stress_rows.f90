!> What all tables of stresses at points share: their columns, the numbers of a point, the depths, and their blocks.
module wavycon_stress_rows
   use wavycon_constants, only: pi
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_results, only: results_type
   use wavycon_stress_tensor, only: principal_stresses, stress_pressure, von_mises
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: angle_of_depth, number_of_bodies, put_stresses, stress_depths, stress_numbers

   !> Tension is positive, and principal stress 1 is the largest. The error is an estimate for the six components.
   character(32), parameter, public :: stress_columns(*) = [character(32) :: &
      'stress_xx[pressure]', 'stress_yy[pressure]', 'stress_zz[pressure]', 'stress_xy[pressure]', &
      'stress_xz[pressure]', 'stress_yz[pressure]', 'principal_1[pressure]', 'principal_2[pressure]', &
      'principal_3[pressure]', 'von_mises[pressure]', 'largest_shear[pressure]', 'stress_pressure[pressure]', &
      'stress_error[pressure]']

contains

   !> The numbers of these columns at a point.
   pure function stress_numbers(stress, error, p_star) result(numbers)
      real(dp), intent(in) :: stress(6)   !! xx, yy, zz, xy, xz, yz [p*]
      real(dp), intent(in) :: error       !! [p*]
      real(dp), intent(in) :: p_star      !! [pressure]
      real(dp) :: numbers(size(stress_columns))

      real(dp) :: principal(3)

      principal = principal_stresses(stress)
      numbers = p_star*[stress, principal, von_mises(stress), 0.5_dp*(principal(1) - principal(3)), &
                        stress_pressure(stress), error]
   end function stress_numbers

   !> Writes the stresses at points: a block for each body, with a blank line between the rows of points.
   subroutine put_stresses(results, load, pbar_over_pstar, places, parts, errors, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      real(dp), intent(in) :: pbar_over_pstar         !! of the stresses
      real(dp), intent(in) :: places(:, :, :)   !! of the columns before the stresses, shape (columns, points, rows)
      real(dp), intent(in) :: parts(:, :, :, :)       !! as of `stress_fields`, shape (6, 2, points, rows)
      real(dp), intent(in) :: errors(:, :)            !! of the stresses [p*], shape (points, rows)
      type(output_file), intent(inout) :: file   !! with the columns 'load', 'body', those of the places, and stresses

      real(dp), allocatable :: rows(:, :)
      integer :: body, i, k

      do body = 1, number_of_bodies(results)
         call results%begin_block(file, load)
         do i = 1, size(places, 3)
            if (i > 1) call file%put('')
            rows = reshape([(places(:, k, i), &
                             stress_numbers(results%scene%stress_setting%body(body)%stress(parts(:, :, k, i), &
                                                                                           pbar_over_pstar), &
                                            errors(k, i), results%scene%p_star), k=1, size(places, 2))], &
                           [size(places, 1) + size(stress_columns), size(places, 2)])
            call file%put_rows([load, body], rows)
         end do
      end do
   end subroutine put_stresses

   !> The depths of a table: those of planes are the list of depths, if there is one, and those of line and section the
   !> range, if there is one.
   subroutine stress_depths(stress, surface, of_planes, depths)
      type(group_values), intent(in) :: stress    !! the group &stress
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: of_planes
      real(dp), allocatable, intent(out) :: depths(:)   !! [length]

      integer :: i, intervals, steps
      logical :: by_list, has_range
      real(dp) :: side(2)

      side = surface%sides()
      has_range = stress%has('depth_from') .or. stress%has('depth_to') .or. stress%has('depth_steps')
      by_list = of_planes .or. .not. has_range
      if (by_list .and. stress%has('depths')) then
         depths = stress%reals('depths')
      else if (by_list .and. stress%has('depths_over_cell_x')) then
         depths = side(1)*stress%reals('depths_over_cell_x')
      else
         steps = stress%integer('depth_steps')
         intervals = max(1, steps - 1)
         depths = [(side(1)*(stress%real('depth_from')*(intervals - i) + stress%real('depth_to')*i)/intervals, &
                    i=0, steps - 1)]
      end if
   end subroutine stress_depths

   !> Z of a depth [rad].
   elemental real(dp) function angle_of_depth(surface, depth)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: depth   !! [length]

      angle_of_depth = 2*pi*depth/surface%length(1)
   end function angle_of_depth

   !> The number of bodies whose stresses differ.
   pure integer function number_of_bodies(results)
      type(results_type), intent(in) :: results

      number_of_bodies = 0
      if (allocated(results%scene%stress_setting)) number_of_bodies = size(results%scene%stress_setting%body)
   end function number_of_bodies

end module wavycon_stress_rows
