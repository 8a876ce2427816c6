!> What the keys of solvers on grids mean: checks, and the grid.
module wavycon_grid_keys
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_grid_keys, grid_in_words, points_of_grid

contains

   !> The grid in effect on the whole cell, along x and y: that of the deck, which refers to surface%parts(), or,
   !> without an accuracy, that which the surface was given on. Zeros if the accuracy decides.
   pure function points_of_grid(values, surface) result(points)
      type(group_values), intent(in) :: values     !! of &method
      type(surface_type), intent(in) :: surface
      integer :: points(2)

      points = surface%parts()*nint(values%pair('grid_points'))
      if (all(points == 0) .and. .not. values%real('accuracy') > 0.0_dp) points = surface%points
   end function points_of_grid

   !> Removes the default of `accuracy` if the deck gives grid_points or the surface is a height map: these are then
   !> solved on one given grid. Writes grid_points in full to the resolved deck. Reports a residual without a given
   !> grid, and odd numbers of points.
   subroutine check_grid_keys(values, surface, problems)
      type(group_values), intent(inout) :: values  !! of &method
      type(surface_type), intent(in) :: surface
      type(problem_list_type), intent(inout) :: problems

      real(dp) :: points(2)

      if (values%has('grid_points') .and. .not. values%is_bad('grid_points')) then
         points = values%pair('grid_points')
         call values%set('grid_points', points(:surface%dimension))
      end if
      if (.not. values%has('accuracy') .and. (values%has('grid_points') .or. all(surface%points > 0))) then
         call values%set_default('accuracy', [0.0_dp])
         call values%leave_out('accuracy')
      end if
      if (values%has('residual') .and. .not. values%has('accuracy') .and. all(points_of_grid(values, surface) == 0)) &
         call values%complain(problems, 'residual', 'residual needs grid_points, or a height map on '// &
                              'its own points: other grids have the residual that their accuracy takes')
      if (.not. surface%mirrored .and. any(mod(nint(values%reals('grid_points')), 2) /= 0)) &
         call values%complain(problems, 'grid_points', &
         'grid_points must be even: of surfaces with mirror symmetry half of them are solved each way')
   end subroutine check_grid_keys

   !> The grid in words.
   pure function grid_in_words(values, surface) result(words)
      type(group_values), intent(in) :: values     !! of &method
      type(surface_type), intent(in) :: surface
      character(:), allocatable :: words

      integer :: points(2)

      points = points_of_grid(values, surface)/surface%parts()
      if (all(points > 0)) then
         words = 'a grid of '//integer_text(points(1))
         if (surface%dimension == 2) words = words//' x '//integer_text(points(2))
         words = words//' points'
         if (values%real('residual') > 0.0_dp) words = words//' to a residual of '// &
                                                    short_number(values%real('residual'))
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
   end function grid_in_words

end module wavycon_grid_keys
