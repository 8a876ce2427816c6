!> solver = 'grid': grids, refined to an accuracy or with a given number of points; also its keys, which other solvers
!> read.
module wavycon_grid_method
   use wavycon_contact_solver, only: contact_solver, default_accuracy
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: integer_key, key_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, short_number
   use wavycon_problems, only: problem_list_type
   use wavycon_solver_method, only: solver_method
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: accuracy_key, check_grid_keys, grid_in_words, grid_keys, grid_method, points_of_grid, start_on_grids

contains

   type(solver_method) function grid_method() result(method)
      type(grid_contact) :: solver

      method%name = 'grid'
      method%meaning = 'ever finer grids until mean gap, area and peak pressure are accurate'
      allocate (method%keys, source=grid_keys())
      method%traits = solver%traits()
      method%check => check_grid_keys
      method%make => make
   end function grid_method

   subroutine make(values, surface, keep_fields, solver, description)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      logical, intent(in) :: keep_fields
      class(contact_solver), allocatable, intent(out) :: solver
      character(:), allocatable, intent(out) :: description

      type(grid_contact), allocatable :: own

      allocate (own)
      call start_on_grids(values, surface, keep_fields, own)
      call move_alloc(own, solver)
      description = grid_in_words(values, surface)
   end subroutine make

   !> The key of solvers that refine.
   pure type(key_type) function accuracy_key() result(key)
      key = real_key('accuracy', short_number(default_accuracy), '-', &
         'largest error allowed of mean gap [amplitude], contact area fraction and peak pressure [p*]; of '// &
         '''fitted'' with lines, map, contours, spots, histograms or details also of the gap at a trough. A load '// &
         'that misses it has the status not_accurate.', least=1.0e-12_dp, most=0.1_dp, way=10)
   end function accuracy_key

   !> The keys of solvers on grids.
   pure function grid_keys() result(keys)
      type(key_type) :: keys(3)

      keys(1) = accuracy_key()
      keys(2) = integer_key('grid_points', '', &
         'in place of accuracy: points of the cell along x and y of the one grid to solve; one number for both. '// &
         'Even numbers. For height maps, read or made, the default is their own grid. Errors are estimated '// &
         'from 64 points a side on; those of coarser grids are unknown.', 8, 1048576, most_values=2, way=11)
      keys(3) = real_key('residual', '', '-', &
         'with grid_points or a height map on its own points: largest root mean square over the grid of gaps in '// &
         'contact and of overlaps, over the mean gap, for comparisons with other programs. The default keeps the '// &
         'iteration error below a tenth of the error estimates.', &
         least=1.0e-13_dp, most=0.1_dp, way=11)
   end function grid_keys

   !> The grid in effect on the whole cell, along x and y: that of the deck, which refers to surface%parts(), or,
   !> without an accuracy, that which the surface was given on. Zeros if the accuracy decides.
   pure function points_of_grid(values, surface) result(points)
      type(group_values), intent(in) :: values     !! of &method
      type(surface_type), intent(in) :: surface
      integer :: points(2)

      points = surface%parts()*nint(values%pair('grid_points'))
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
      if (.not. surface%mirrored .and. any(mod(values%integers('grid_points'), 2) /= 0)) &
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

end module wavycon_grid_method
