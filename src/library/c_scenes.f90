!> Scenes, their solutions and tables in the C interface. wavycon.h documents each procedure.
module wavycon_c_scenes
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_f_procpointer, c_funptr, c_int, &
      c_ptr, c_size_t
   use wavycon_c_handles, only: begin_call, check_pointers, close_call, close_new, close_text, find_object, handle_at, &
      handle_type, kind_of, not_a_handle, text_at
   use wavycon_deck_run, only: run_deck
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_key_json, only: key_json
   use wavycon_kinds, only: dp
   use wavycon_session_fields, only: map_grid, own_points
   use wavycon_solver_progress, only: solver_progress
   use wavycon_version, only: version
   implicit none (type, external)
   private

contains

   type(c_ptr) function new_scene(error, deck, path, keep_fields, points_x, points_y, heights) result(handle) &
      bind(c, name='wavycon_new_scene')
      type(c_ptr), value :: error, deck, path, heights
      integer(c_int), value :: keep_fields, points_x, points_y

      character(:), allocatable :: deck_text, name
      real(c_double), pointer :: height(:, :)
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made

      call begin_call()
      allocate (made)
      allocate (made%scene)
      call text_at(deck, deck_text, trouble)
      call text_at(path, name, trouble)
      ! Not associated: the argument is absent.
      nullify (height)
      if (c_associated(heights) .and. min(points_x, points_y) < 1) then
         if (.not. allocated(trouble)) call fatal_error(trouble, exit_bad_input, &
                                                       'points_x and points_y must be 1 or more')
      else if (c_associated(heights)) then
         call c_f_pointer(heights, height, [points_x, points_y])
      end if
      if (.not. allocated(trouble)) call made%scene%open(deck_text, name, keep_fields /= 0, trouble, height)
      handle = close_new(error, made, trouble)
   end function new_scene

   type(c_ptr) function read_scene(error, path, settings, keep_fields) result(handle) bind(c, name='wavycon_read_scene')
      type(c_ptr), value :: error, path, settings
      integer(c_int), value :: keep_fields

      character(:), allocatable :: lines, name
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made

      call begin_call()
      allocate (made)
      allocate (made%scene)
      call text_at(path, name, trouble)
      call text_at(settings, lines, trouble)
      if (.not. allocated(trouble)) call made%scene%open_file(name, lines, keep_fields /= 0, trouble)
      handle = close_new(error, made, trouble)
   end function read_scene

   integer(c_int) function set_progress(error, scene, callback, data) bind(c, name='wavycon_set_progress')
      type(c_ptr), value :: error, scene, data
      type(c_funptr), value :: callback

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      class(solver_progress), pointer :: progress

      call begin_call()
      call find_object(scene, 'scene', contents, trouble)
      if (.not. allocated(trouble)) then
         nullify (contents%progress%callback, progress)
         if (c_associated(callback)) then
            call c_f_procpointer(callback, contents%progress%callback)
            progress => contents%progress
         end if
         contents%progress%data = data
         call contents%scene%show_progress(progress)
      end if
      set_progress = close_call(error, trouble)
   end function set_progress

   type(c_ptr) function solve(error, scene, quantity, value) result(handle) bind(c, name='wavycon_solve')
      type(c_ptr), value :: error, scene, quantity
      real(c_double), value :: value

      character(:), allocatable :: key
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents, made

      call begin_call()
      call find_object(scene, 'scene', contents, trouble)
      call text_at(quantity, key, trouble)
      call start_solution(contents, made, trouble)
      if (.not. allocated(trouble)) call contents%scene%solve(key, value, made%solution, trouble)
      handle = close_new(error, made, trouble)
   end function solve

   type(c_ptr) function solve_load(error, scene, load) result(handle) bind(c, name='wavycon_solve_load')
      type(c_ptr), value :: error, scene
      integer(c_int), value :: load

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents, made

      call begin_call()
      call find_object(scene, 'scene', contents, trouble)
      call start_solution(contents, made, trouble)
      ! C counts loads from 0.
      if (.not. allocated(trouble)) &
         call contents%scene%solve_load(int(min(load, huge(load) - 1)) + 1, made%solution, trouble)
      handle = close_new(error, made, trouble)
   end function solve_load

   !> Makes an empty solution of a scene, which lives as long as it.
   subroutine start_solution(scene, made, error)
      type(handle_type), pointer, intent(in) :: scene
      type(handle_type), pointer, intent(out) :: made
      type(error_type), allocatable, intent(in) :: error   !! if it is allocated there is no scene

      allocate (made)
      allocate (made%solution)
      if (allocated(error)) return
      made%owner => scene
      scene%users = scene%users + 1
   end subroutine start_solution

   integer(c_int) function get(error, object, name, value) bind(c, name='wavycon_get')
      type(c_ptr), value :: error, object, name, value

      character(:), allocatable :: its_name
      integer :: points(2)
      real(c_double), pointer :: answer
      real(dp) :: offset(2)
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      contents => handle_at(object)
      call text_at(name, its_name, trouble)
      call check_pointers([c_associated(value)], trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(value, answer)
         select case (kind_of(contents))
         case ('scene')
            call contents%scene%number(its_name, answer, trouble)
         case ('solution')
            if (index(its_name, 'own_') == 1 .or. index(its_name, 'map_') == 1) then
               if (index(its_name, 'own_') == 1) then
                  call own_points(contents%owner%scene, contents%solution, points, offset, trouble)
               else
                  call map_grid(contents%owner%scene, contents%solution, points, offset, trouble)
               end if
               call pick([character(8) :: 'points_x', 'points_y', 'offset_x', 'offset_y'], [real(points, dp), offset], &
                         its_name(len('own_') + 1:), answer, trouble)
            else
               call contents%owner%scene%number(its_name, answer, trouble, contents%solution)
            end if
         case ('table')
            call pick([character(12) :: 'rows', 'columns'], &
                      real([contents%table%rows, size(contents%table%names)], dp), its_name, answer, trouble)
         case default
            call find_object(object, 'scene', contents, trouble)
         end select
      end if
      get = close_call(error, trouble)
   end function get

   !> The number of a name. Errors: exit_bad_input if there is none.
   subroutine pick(names, numbers, name, number, error)
      character(*), intent(in) :: names(:), name
      real(dp), intent(in) :: numbers(:)
      real(c_double), intent(inout) :: number
      type(error_type), allocatable, intent(inout) :: error   !! nothing is done if it is allocated

      integer :: i

      if (allocated(error)) return
      i = findloc(names == name, .true., dim=1)
      if (i > 0) then
         number = numbers(i)
      else
         call fatal_error(error, exit_bad_input, "there is no number '"//name//"'")
      end if
   end subroutine pick

   integer(c_size_t) function get_text(error, object, name, buffer, bytes) result(needed) &
      bind(c, name='wavycon_get_text')
      type(c_ptr), value :: error, object, name, buffer
      integer(c_size_t), value :: bytes

      character(:), allocatable :: its_name, words
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      contents => handle_at(object)
      call text_at(name, its_name, trouble)
      if (.not. allocated(trouble)) then
         select case (kind_of(contents))
         case ('scene')
            call contents%scene%text(its_name, words, trouble)
         case ('solution')
            call contents%owner%scene%text(its_name, words, trouble, contents%solution)
         case ('table')
            call contents%table%text(its_name, words)
         case default
            if (c_associated(object)) call find_object(object, 'scene', contents, trouble)
            if (its_name == 'version') words = version
            if (its_name == 'keys') words = key_json()
         end select
         if (.not. (allocated(words) .or. allocated(trouble))) &
            call fatal_error(trouble, exit_bad_input, not_a_handle//"scene, or there is no text '"//its_name//"'")
      end if
      needed = close_text(error, words, buffer, bytes, trouble)
   end function get_text

   type(c_ptr) function new_table(error, solution, name) result(handle) bind(c, name='wavycon_new_table')
      type(c_ptr), value :: error, solution, name

      character(:), allocatable :: its_name
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents, made

      call begin_call()
      allocate (made)
      allocate (made%table)
      call find_object(solution, 'solution', contents, trouble)
      call text_at(name, its_name, trouble)
      if (.not. allocated(trouble)) &
         call contents%owner%scene%make_table(its_name, contents%solution, made%table, trouble)
      handle = close_new(error, made, trouble)
   end function new_table

   integer(c_int) function get_column(error, table, name, rows, values) bind(c, name='wavycon_get_column')
      type(c_ptr), value :: error, table, name, values
      integer(c_int), value :: rows

      character(:), allocatable :: its_name
      integer :: column
      real(c_double), pointer :: answer(:)
      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_object(table, 'table', contents, trouble)
      call text_at(name, its_name, trouble)
      call check_pointers([c_associated(values)], trouble)
      if (.not. allocated(trouble)) then
         column = contents%table%find_column(its_name)
         if (column == 0) then
            call fatal_error(trouble, exit_bad_input, "the table has no column '"//its_name//"'")
         else if (rows /= contents%table%rows) then
            call fatal_error(trouble, exit_bad_input, 'rows is not the number of rows of the table')
         else
            call c_f_pointer(values, answer, [rows])
            answer = contents%table%values(column, :rows)
         end if
      end if
      get_column = close_call(error, trouble)
   end function get_column

   integer(c_int) function c_run_deck(error, path, directory, quiet, exit_status) bind(c, name='wavycon_run_deck')
      type(c_ptr), value :: error, path, directory, exit_status
      integer(c_int), value :: quiet

      character(:), allocatable :: deck, tables
      integer(c_int), pointer :: answer
      type(error_type), allocatable :: trouble

      call begin_call()
      call text_at(path, deck, trouble)
      call text_at(directory, tables, trouble)
      call check_pointers([c_associated(exit_status)], trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(exit_status, answer)
         call run_deck(deck, tables, quiet /= 0, answer, trouble)
      end if
      c_run_deck = close_call(error, trouble)
   end function c_run_deck

end module wavycon_c_scenes
