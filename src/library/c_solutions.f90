!> The solutions of the C interface. wavycon.h documents each procedure.
module wavycon_c_solutions
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
   use wavycon_c_handles, only: begin_call, check_pointers, close_call, handle_at, handle_type, not_a_handle, &
      put_text
   use wavycon_contact_status, only: status_name
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_wavy_solution, only: wavy_measures
   implicit none (type, external)
   private

   public :: find_solution

contains

   integer(c_int) function get_measures(error, solution, measures) bind(c, name='wavycon_get_measures')
      type(c_ptr), value :: error, solution, measures

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      type(wavy_measures), pointer :: answer

      call begin_call()
      call find_solution(solution, contents, trouble)
      call check_pointers([c_associated(measures)], trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(measures, answer)
         answer = contents%solution%measures()
      end if
      get_measures = close_call(error, trouble)
   end function get_measures

   integer(c_int) function get_status(error, solution, buffer, bytes) bind(c, name='wavycon_get_status')
      type(c_ptr), value :: error, solution, buffer
      integer(c_size_t), value :: bytes

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_solution(solution, contents, trouble)
      call check_pointers([c_associated(buffer)], trouble)
      if (.not. allocated(trouble)) call put_text(trim(status_name(contents%solution%status())), buffer, bytes)
      get_status = close_call(error, trouble)
   end function get_status

   integer(c_int) function get_solver_name(error, solution, buffer, bytes) bind(c, name='wavycon_get_solver_name')
      type(c_ptr), value :: error, solution, buffer
      integer(c_size_t), value :: bytes

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_solution(solution, contents, trouble)
      call check_pointers([c_associated(buffer)], trouble)
      if (.not. allocated(trouble)) call put_text(contents%solution%solver(), buffer, bytes)
      get_solver_name = close_call(error, trouble)
   end function get_solver_name

   integer(c_int) function get_own_points(error, solution, points, offset) bind(c, name='wavycon_get_own_points')
      type(c_ptr), value :: error, solution, points, offset

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      integer(c_int), pointer :: to_points(:)
      integer :: own(2)
      real(c_double), pointer :: to_offset(:)
      real(dp) :: first(2)

      call begin_call()
      call find_solution(solution, contents, trouble)
      call check_pointers([c_associated(points), c_associated(offset)], trouble)
      if (.not. allocated(trouble)) call contents%solution%own_points(own, first, trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(points, to_points, [2])
         call c_f_pointer(offset, to_offset, [2])
         to_points = int(own, c_int)
         to_offset = first
      end if
      get_own_points = close_call(error, trouble)
   end function get_own_points

   integer(c_int) function get_map(error, solution, points_x, points_y, offset, pressure, gap, displacement) &
      bind(c, name='wavycon_get_map')
      type(c_ptr), value :: error, solution, offset, pressure, gap, displacement
      integer(c_int), value :: points_x, points_y

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      real(c_double), pointer :: from_offset(:)
      real(dp), allocatable :: p(:, :), g(:, :), u(:, :)
      real(dp) :: first(2)

      call begin_call()
      call find_solution(solution, contents, trouble)
      if (.not. allocated(trouble)) then
         first = 0.0_dp
         if (c_associated(offset)) then
            call c_f_pointer(offset, from_offset, [2])
            first = from_offset
         end if
         call contents%solution%map([int(points_x), int(points_y)], p, g, u, trouble, first)
      end if
      if (.not. allocated(trouble)) then
         call put_field(p, pressure)
         call put_field(g, gap)
         call put_field(u, displacement)
      end if
      get_map = close_call(error, trouble)
   end function get_map

   !> Copies a field to an array of C; a null pointer means that it is not wanted.
   subroutine put_field(field, to)
      real(dp), intent(in) :: field(:, :)
      type(c_ptr), intent(in) :: to

      real(c_double), pointer :: array(:, :)

      if (.not. c_associated(to)) return
      call c_f_pointer(to, array, shape(field))
      array = field
   end subroutine put_field

   integer(c_int) function get_fields_at(error, solution, x, y, pressure, gap, displacement) &
      bind(c, name='wavycon_get_fields_at')
      type(c_ptr), value :: error, solution, pressure, gap, displacement
      real(c_double), value :: x, y

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      real(dp) :: p, g, u

      call begin_call()
      call find_solution(solution, contents, trouble)
      if (.not. allocated(trouble)) call contents%solution%at(x, y, p, g, u, trouble)
      if (.not. allocated(trouble)) then
         call put_field(reshape([p], [1, 1]), pressure)
         call put_field(reshape([g], [1, 1]), gap)
         call put_field(reshape([u], [1, 1]), displacement)
      end if
      get_fields_at = close_call(error, trouble)
   end function get_fields_at

   integer(c_int) function get_number_of_edges(error, solution, edges) bind(c, name='wavycon_get_number_of_edges')
      type(c_ptr), value :: error, solution, edges

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      integer(c_int), pointer :: answer

      call begin_call()
      call find_edges(solution, contents, trouble)
      call check_pointers([c_associated(edges)], trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(edges, answer)
         answer = size(contents%edges, kind=c_int)
      end if
      get_number_of_edges = close_call(error, trouble)
   end function get_number_of_edges

   integer(c_int) function get_edge_points(error, solution, edge, points) bind(c, name='wavycon_get_edge_points')
      type(c_ptr), value :: error, solution, points
      integer(c_int), value :: edge

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      integer(c_int), pointer :: answer

      call begin_call()
      call find_edges(solution, contents, trouble)
      call check_pointers([c_associated(points)], trouble)
      call check_edge(contents, edge, trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(points, answer)
         answer = size(contents%edges(edge + 1)%x, kind=c_int)
      end if
      get_edge_points = close_call(error, trouble)
   end function get_edge_points

   integer(c_int) function get_edge(error, solution, edge, points, x, y) bind(c, name='wavycon_get_edge')
      type(c_ptr), value :: error, solution, x, y
      integer(c_int), value :: edge, points

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      real(c_double), pointer :: to_x(:), to_y(:)

      call begin_call()
      call find_edges(solution, contents, trouble)
      call check_pointers([c_associated(x), c_associated(y)], trouble)
      call check_edge(contents, edge, trouble)
      if (.not. allocated(trouble)) then
         if (points /= size(contents%edges(edge + 1)%x)) call fatal_error(trouble, exit_bad_input, &
            'points is not the number of points of this edge')
      end if
      if (.not. allocated(trouble)) then
         call c_f_pointer(x, to_x, [points])
         call c_f_pointer(y, to_y, [points])
         to_x = contents%edges(edge + 1)%x
         to_y = contents%edges(edge + 1)%y
      end if
      get_edge = close_call(error, trouble)
   end function get_edge

   !> The contents of a solution's handle. Errors: exit_bad_input if it is none.
   subroutine find_solution(solution, contents, error)
      type(c_ptr), intent(in) :: solution
      type(handle_type), pointer, intent(out) :: contents
      type(error_type), allocatable, intent(out) :: error

      logical :: found

      contents => handle_at(solution)
      found = associated(contents)
      if (found) found = allocated(contents%solution)
      if (.not. found) call fatal_error(error, exit_bad_input, not_a_handle//'solution')
   end subroutine find_solution

   !> Likewise, with the edges found. Errors also: as of wavy_solution%edges.
   subroutine find_edges(solution, contents, error)
      type(c_ptr), intent(in) :: solution
      type(handle_type), pointer, intent(out) :: contents
      type(error_type), allocatable, intent(out) :: error

      call find_solution(solution, contents, error)
      if (allocated(error)) return
      if (.not. allocated(contents%edges)) call contents%solution%edges(contents%edges, error)
   end subroutine find_edges

   !> Errors: exit_bad_input for an edge, counted from 0, that the solution does not have.
   subroutine check_edge(contents, edge, error)
      type(handle_type), pointer, intent(in) :: contents
      integer(c_int), intent(in) :: edge
      type(error_type), allocatable, intent(inout) :: error   !! nothing is checked if it is allocated

      if (allocated(error)) return
      if (edge < 0 .or. edge >= size(contents%edges)) &
         call fatal_error(error, exit_bad_input, 'the solution has no edge of this number')
   end subroutine check_edge

end module wavycon_c_solutions
