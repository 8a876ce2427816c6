!> Keys of &method that several solvers read.
module wavycon_grid_keys
   use wavycon_contact_solver, only: default_accuracy, solver_traits
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_key, key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: accuracy_key, check_grid_points, describe_grid, grid_points_key, is_another_way, points_of_grid, &
      residual_key, set_grid_defaults, start_on_grids

contains

   pure type(key_type) function accuracy_key() result(key)
      key = real_key('accuracy', short_number(default_accuracy), '-', &
         'largest error allowed of mean gap [amplitude], contact area fraction and peak pressure [p*]; of '// &
         'expansions with lines, map, contours, spots, histograms or details also of the gap at a trough. A load '// &
         'that misses it has the status not_accurate.', least=1.0e-12_dp, most=0.1_dp)
   end function accuracy_key

   pure type(key_type) function grid_points_key() result(key)
      key = integer_key('grid_points', '', &
         'in place of accuracy: points of the cell along x and y of the one grid to solve; one number for both. '// &
         'Even numbers. For height maps, read or made, the default is their own grid. Errors are estimated for '// &
         'multiples of 4 from 64 points a side; those of others are unknown.', 8, 1048576, most_values=2)
   end function grid_points_key

   pure type(key_type) function residual_key() result(key)
      key = real_key('residual', '', '-', &
         'with grid_points or a height map on its own points: largest root mean square over the grid of gaps in '// &
         'contact and of overlaps, over the mean gap, for comparisons with other programs. By default it is so '// &
         'large that it changes the results by less than a tenth of their error estimates.', &
         least=1.0e-13_dp, most=0.1_dp)
   end function residual_key

   !> The grid in effect on the whole cell, along x and y: that of the deck, which refers to surface%parts(), or,
   !> without an accuracy, that which the surface was given on. Zeros if the accuracy decides.
   pure function points_of_grid(values, surface) result(points)
      type(group_values), intent(in) :: values     !! of &method
      type(surface_type), intent(in) :: surface
      integer :: points(2)

      points = 0
      associate (given => values%integers('grid_points'))
         if (size(given) > 0) points = given(1)
         if (size(given) > 1) points(2) = given(2)
         points = surface%parts()*points
      end associate
      if (all(points == 0) .and. .not. values%real('accuracy') > 0.0_dp) points = surface%points
   end function points_of_grid

   !> Starts a solver on grids, or one that extends it, with the values of &method.
   subroutine start_on_grids(values, surface, keep_fields, solver)
      type(group_values), intent(in) :: values     !! of &method
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(grid_contact), intent(inout) :: solver

      call solver%start(surface, grid_options(values%real('accuracy'), points_of_grid(values, surface), &
                                              values%real('residual')), keep_fields)
   end subroutine start_on_grids

   !> Removes the default of `accuracy` if the deck gives grid_points or the surface is a height map: these are then
   !> solved on one given grid. Writes grid_points in full to the resolved deck.
   subroutine set_grid_defaults(values, surface)
      type(group_values), intent(inout) :: values  !! of &method
      type(surface_type), intent(in) :: surface

      integer :: points(2)

      if (values%has('grid_points') .and. .not. values%is_bad('grid_points')) then
         points = points_of_grid(values, surface)/surface%parts()
         call values%set('grid_points', points(:surface%dimension))
      end if
      if (values%has('accuracy') .or. .not. (values%has('grid_points') .or. all(surface%points > 0))) return
      call values%set_default('accuracy', 0.0_dp)
      call values%leave_out('accuracy')
   end subroutine set_grid_defaults

   !> Reports grid_points or residual beside accuracy, a residual without a given grid, and odd numbers of points.
   subroutine check_grid_points(values, surface, problems)
      type(group_values), intent(in) :: values     !! of &method
      type(surface_type), intent(in) :: surface
      type(problem_list_type), intent(inout) :: problems

      call values%forbid(problems, 'accuracy', 'grid_points', 'give the one or the other')
      call values%forbid(problems, 'accuracy', 'residual', 'grids solved to an accuracy have the residual that it takes')
      if (values%has('residual') .and. .not. values%has('accuracy') .and. all(points_of_grid(values, surface) == 0)) &
         call values%complain(problems, 'residual', 'residual needs grid_points, or a height map on its own points: '// &
                              'other grids have the residual that their accuracy takes')
      if (.not. surface%mirrored .and. any(mod(values%integers('grid_points'), 2) /= 0)) &
         call values%complain(problems, 'grid_points', &
         'grid_points must be even: of surfaces with mirror symmetry half of them are solved each way')
   end subroutine check_grid_points

   !> The grid in words: `describe` of 'grid'.
   subroutine describe_grid(values, surface, traits, words)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      type(solver_traits), intent(in) :: traits
      character(:), allocatable, intent(out) :: words

      integer :: points(2)

      associate (unused => traits); end associate
      points = points_of_grid(values, surface)/surface%parts()
      if (all(points > 0)) then
         words = 'a grid of '//integer_text(points(1))
         if (surface%dimension == 2) words = words//' x '//integer_text(points(2))
         words = words//' points'
         if (values%real('residual') > 0.0_dp) words = words//' to a residual of '//short_number(values%real('residual'))
      else
         words = 'grids refined until mean gap, area and peak pressure are within '// &
                 short_number(values%real('accuracy'))
      end if
      if (surface%mirrored) then
         words = words//', on the map without its mirror images'
      else if (surface%shape%is_even()) then
         words = words//', on a quarter of the cell'
      end if
      if (all(points == 0) .and. surface%has_smaller_cell()) words = words//' turned by 45 degrees'
   end subroutine describe_grid

   !> Whether two keys of &method choose the grid in different ways: accuracy, or grid_points.
   pure logical function is_another_way(key, other)
      character(*), intent(in) :: key, other

      is_another_way = (key == 'accuracy' .and. other == 'grid_points') .or. &
                       (key == 'grid_points' .and. other == 'accuracy')
   end function is_another_way

end module wavycon_grid_keys
