!> The C interface to scenes, solutions and tables, and to fields and stresses in arrays of the caller. wavycon.h
!> documents each procedure and its arguments; a pointer that is NULL in C is here an absent argument.
module wavycon_c_functions
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_procpointer, c_funptr, c_int, c_ptr, &
      c_size_t
   use wavycon_c_handles, only: c_call, handle_type, new_handle, put_text, text_at
   use wavycon_deck_session, only: await_solve, no_name, pick_number
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_key_reference, only: key_json
   use wavycon_kinds, only: dp
   use wavycon_nearest_name, only: did_you_mean, near_names
   use wavycon_plain_text, only: lines_of, lower_case, newline
   use wavycon_run_scene, only: run_deck
   use wavycon_session_fields, only: bounds_from_fields, check_number, fields_at, fields_on_grid, map_grid, &
      own_points, stresses_at, stresses_on_plane
   use wavycon_stress_tensor, only: largest_shear, principal_stresses, von_mises
   use wavycon_version, only: version
   implicit none (type, external)
   private

   !> The kinds of objects that have numbers and texts.
   character(*), parameter :: kinds = 'kinds scene, solution and table'

contains

   type(c_ptr) function new_scene(error, deck, path, keep_fields, points_x, points_y, heights) result(handle) &
      bind(c, name='wavycon_new_scene')
      type(c_ptr), value :: error
      character(kind=c_char), intent(in), optional :: deck(*), path(*)
      integer(c_int), value :: keep_fields, points_x, points_y
      real(c_double), intent(in), optional :: heights(points_x, points_y)

      type(c_call) :: this

      if (this%begins(error, needs='wavycon_new_scene deck path', are_there=[present(deck), present(path)])) then
         this%made => new_handle('scene')
         if (present(heights) .and. min(points_x, points_y) < 1) then
            call fatal_error(this%trouble, exit_bad_input, 'points_x and points_y must be 1 or more')
         else if (.not. present(heights) .and. max(points_x, points_y) > 0) then
            call fatal_error(this%trouble, exit_bad_input, &
                             'heights is NULL: without heights points_x and points_y must be 0')
         else
            call this%made%scene%open(text_at(deck), text_at(path), keep_fields /= 0, this%trouble, heights)
         end if
      end if
      handle = this%new_object()
   end function new_scene

   type(c_ptr) function read_scene(error, path, settings, keep_fields) result(handle) bind(c, name='wavycon_read_scene')
      type(c_ptr), value :: error
      character(kind=c_char), intent(in), optional :: path(*), settings(*)
      integer(c_int), value :: keep_fields

      type(c_call) :: this

      if (this%begins(error, needs='wavycon_read_scene path settings', &
                      are_there=[present(path), present(settings)])) then
         this%made => new_handle('scene')
         call this%made%scene%open_file(text_at(path), text_at(settings), keep_fields /= 0, this%trouble)
      end if
      handle = this%new_object()
   end function read_scene

   integer(c_int) function set_progress(error, scene, callback, user_data) bind(c, name='wavycon_set_progress')
      type(c_ptr), value :: error, scene, user_data
      type(c_funptr), value :: callback

      integer(c_int) :: ignored
      type(c_call) :: this

      if (this%begins(error, scene, 'scene')) then
         ignored = await_solve(this%contents%scene%is_solving)   ! another thread's solve may be calling it
         associate (progress => this%contents%progress, solver => this%contents%scene%results%solver)
            nullify (progress%callback, solver%progress)
            progress%data = user_data
            if (c_associated(callback)) then
               call c_f_procpointer(callback, progress%callback)
               solver%progress => this%contents%progress
            end if
         end associate
      end if
      set_progress = this%code()
   end function set_progress

   type(c_ptr) function solve(error, scene, quantity, value) result(handle) bind(c, name='wavycon_solve')
      type(c_ptr), value :: error, scene
      character(kind=c_char), intent(in), optional :: quantity(*)
      real(c_double), value :: value

      character(:), allocatable :: key
      type(c_call) :: this

      if (this%begins(error, scene, 'scene', 'wavycon_solve quantity', [present(quantity)])) then
         key = text_at(quantity)   ! copied before the solver runs, as other threads call the library meanwhile
         this%made => new_handle('solution', this%contents)
         call this%contents%scene%solve(key, value, this%made%solution, this%trouble)
      end if
      handle = this%new_object()
   end function solve

   type(c_ptr) function solve_load(error, scene, load) result(handle) bind(c, name='wavycon_solve_load')
      type(c_ptr), value :: error, scene
      integer(c_int), value :: load

      type(c_call) :: this

      if (this%begins(error, scene, 'scene')) then
         this%made => new_handle('solution', this%contents)
         ! C counts loads from 0.
         call this%contents%scene%solve_load(int(min(load, huge(load) - 1)) + 1, this%made%solution, this%trouble)
      end if
      handle = this%new_object()
   end function solve_load

   integer(c_int) function get(error, object, name, value) bind(c, name='wavycon_get')
      type(c_ptr), value :: error, object
      character(kind=c_char), intent(in), optional :: name(*)
      real(c_double), intent(inout), optional :: value

      type(c_call) :: this

      if (this%begins(error, object, needs='wavycon_get name value', are_there=[present(name), present(value)])) then
         select case (this%contents%kind)
         case ('scene')
            call this%contents%scene%number(text_at(name), value, this%trouble)
         case ('solution')
            call get_of_solution(this%contents, text_at(name), value, this%trouble)
         case ('table')
            call pick_number([character(7) :: 'rows', 'columns'], &
                             real([this%contents%table%rows, size(this%contents%table%columns)], dp), &
                             text_at(name), value, this%trouble)
         case default
            call this%refuse(kinds)
         end select
      end if
      get = this%code()
   end function get

   !> A number of a solution: that of a column of the summary, or points and offset of the grid on which it was solved
   !> (names with own_) or of the map (names with map_).
   subroutine get_of_solution(contents, name, number, error)
      type(handle_type), intent(inout) :: contents   !! contents of the handle of the solution
      character(*), intent(in) :: name
      real(c_double), intent(inout) :: number        !! unchanged in case of an error
      type(error_type), allocatable, intent(out) :: error

      integer :: points(2)
      real(dp) :: offset(2)

      associate (session => contents%owner%scene)
         if (index(name, 'own_') == 1) then
            call own_points(session, contents%solution, points, offset, error)
         else if (index(name, 'map_') == 1) then
            call map_grid(session, contents%solution, points, offset, error)
         else
            call session%number(name, number, error, contents%solution)
            return
         end if
      end associate
      if (.not. allocated(error)) &
         call pick_number([character(8) :: 'points_x', 'points_y', 'offset_x', 'offset_y'], &
                          [real(points, dp), offset], name(len('own_') + 1:), number, error)
   end subroutine get_of_solution

   integer(c_size_t) function get_text(error, object, name, buffer, bytes) result(needed) &
      bind(c, name='wavycon_get_text')
      type(c_ptr), value :: error, object
      character(kind=c_char), intent(in), optional :: name(*)
      character(kind=c_char), intent(inout), optional :: buffer(*)
      integer(c_size_t), value :: bytes

      character(:), allocatable :: text_name, words
      integer(c_int) :: ignored
      type(c_call) :: this

      if (this%begins(error, object, needs='wavycon_get_text name', are_there=[present(name)])) then
         text_name = text_at(name)
         select case (this%contents%kind)
         case ('scene')
            call this%contents%scene%text(text_name, words, this%trouble)
         case ('solution')
            call this%contents%owner%scene%text(text_name, words, this%trouble, this%contents%solution)
         case ('table')
            call this%contents%table%text(text_name, words)
            if (.not. allocated(words)) &
               call no_name("text '"//text_name//"'", text_name, ['columns', 'words  '], this%trouble)
         case default
            if (c_associated(object)) then
               call this%refuse(kinds)
            else if (text_name == 'version') then
               words = version
            else if (text_name == 'keys') then
               words = key_json()
            else
               call no_name("text '"//text_name//"' of NULL", text_name, ['version', 'keys   '], this%trouble)
            end if
         end select
      end if
      needed = 0
      if (.not. allocated(this%trouble)) needed = put_text(words, buffer, bytes)
      ignored = this%code()
   end function get_text

   integer(c_size_t) function get_near_names(error, name, names, meanings, buffer, bytes) result(needed) &
      bind(c, name='wavycon_get_near_names')
      type(c_ptr), value :: error
      character(kind=c_char), intent(in), optional :: name(*), names(*), meanings(*)
      character(kind=c_char), intent(inout), optional :: buffer(*)
      integer(c_size_t), value :: bytes

      character(:), allocatable :: words
      integer(c_int) :: ignored
      type(c_call) :: this

      if (.not. this%begins(error, needs='wavycon_get_near_names name names', &
                            are_there=[present(name), present(names)])) then
         words = ''
      else if (present(meanings)) then
         call list_near_names(text_at(name), lines_of(text_at(names)), words, this%trouble, lines_of(text_at(meanings)))
      else
         call list_near_names(text_at(name), lines_of(text_at(names)), words, this%trouble)
      end if
      needed = 0
      if (.not. allocated(this%trouble)) needed = put_text(words, buffer, bytes)
      ignored = this%code()
   end function get_near_names

   !> Lists the known names that may be meant, a line each. Errors: exit_bad_input for another number of meanings.
   subroutine list_near_names(name, known, words, trouble, meanings)
      character(*), intent(in) :: name, known(:)         !! the unknown name; the known ones, padded with blanks
      character(:), allocatable, intent(out) :: words    !! the names, each with a newline behind it
      type(error_type), allocatable, intent(inout) :: trouble
      character(*), intent(in), optional :: meanings(:)   !! of the known names

      character(len(known)) :: lower(size(known))
      logical :: is_given(size(known))
      integer :: i
      integer, allocatable :: near(:)

      words = ''
      if (present(meanings)) then
         if (size(meanings) /= size(known)) call fatal_error(trouble, exit_bad_input, &
                                                             'names and meanings must have as many lines each')
      end if
      if (allocated(trouble)) return
      is_given = .false.
      do i = 1, size(known)
         lower(i) = lower_case(known(i))
      end do
      if (present(meanings)) then
         allocate (near, source=near_names(lower_case(name), lower, is_given, meanings))
      else
         allocate (near, source=near_names(lower_case(name), lower, is_given))
      end if
      do i = 1, size(near)
         words = words//trim(known(near(i)))//newline
      end do
   end subroutine list_near_names

   type(c_ptr) function new_table(error, solution, name) result(handle) bind(c, name='wavycon_new_table')
      type(c_ptr), value :: error, solution
      character(kind=c_char), intent(in), optional :: name(*)

      type(c_call) :: this

      if (this%begins(error, solution, 'solution', 'wavycon_new_table name', [present(name)])) then
         this%made => new_handle('table')
         call this%contents%owner%scene%make_table(text_at(name), this%contents%solution, this%made%table, this%trouble)
      end if
      handle = this%new_object()
   end function new_table

   integer(c_int) function get_column(error, table, name, rows, values) bind(c, name='wavycon_get_column')
      type(c_ptr), value :: error, table
      character(kind=c_char), intent(in), optional :: name(*)
      integer(c_int), value :: rows
      real(c_double), intent(inout), optional :: values(*)

      integer :: column
      type(c_call) :: this

      if (this%begins(error, table, 'table', 'wavycon_get_column name values', [present(name), present(values)])) then
         column = this%contents%table%find_column(text_at(name))
         if (column == 0) then
            call fatal_error(this%trouble, exit_bad_input, "the table has no column '"//text_at(name)//"'"// &
                             did_you_mean(text_at(name), this%contents%table%columns%name, "'", "'"))
         else if (rows /= this%contents%table%rows) then
            call fatal_error(this%trouble, exit_bad_input, 'rows is not the number of rows of the table')
         else
            values(:rows) = this%contents%table%values(column, :rows)
         end if
      end if
      get_column = this%code()
   end function get_column

   integer(c_int) function get_fields(error, solution, points, x, y, pressure, gap, displacement) &
      bind(c, name='wavycon_get_fields')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points
      real(c_double), intent(in), optional :: x(*), y(*)
      real(c_double), intent(inout), optional :: pressure(*), gap(*), displacement(*)

      type(c_call) :: this

      if (this%begins(error, solution, 'solution', 'wavycon_get_fields x y', [present(x), present(y)])) &
         call fields_at(this%contents%owner%scene, this%contents%solution, int(points), x, y, this%trouble, pressure, &
                        gap, displacement)
      get_fields = this%code()
   end function get_fields

   integer(c_int) function get_grid(error, solution, points_x, points_y, offset, pressure, gap, displacement) &
      bind(c, name='wavycon_get_grid')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points_x, points_y
      real(c_double), intent(in), optional :: offset(2)
      real(c_double), intent(inout), optional :: pressure(*), gap(*), displacement(*)

      type(c_call) :: this

      if (this%begins(error, solution, 'solution')) &
         call fields_on_grid(this%contents%owner%scene, this%contents%solution, [points_x, points_y], offset, &
                             this%trouble, pressure, gap, displacement)
      get_grid = this%code()
   end function get_grid

   integer(c_int) function get_bounds(error, scene, mean_pressure, points_x, points_y, offset, pressure, gap, bounds) &
      bind(c, name='wavycon_get_bounds')
      type(c_ptr), value :: error, scene
      real(c_double), value :: mean_pressure
      integer(c_int), value :: points_x, points_y
      real(c_double), intent(in), optional :: offset(2), pressure(*), gap(*)
      real(c_double), intent(inout), optional :: bounds(6)

      type(c_call) :: this

      if (this%begins(error, scene, 'scene', 'wavycon_get_bounds pressure gap bounds', &
                      [present(pressure), present(gap), present(bounds)])) &
         call bounds_from_fields(this%contents%scene, mean_pressure, [points_x, points_y], offset, pressure, &
                                 gap, this%trouble, bounds)
      get_bounds = this%code()
   end function get_bounds

   integer(c_int) function get_stresses(error, solution, points, x, y, depth, nu, lateral, stress, stress_error) &
      bind(c, name='wavycon_get_stresses')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points
      real(c_double), intent(in), optional :: x(*), y(*), depth(*)
      real(c_double), value :: nu
      character(kind=c_char), intent(in), optional :: lateral(*)
      real(c_double), intent(inout), optional :: stress(6, *), stress_error(*)

      type(c_call) :: this

      if (this%begins(error, solution, 'solution', 'wavycon_get_stresses x y depth lateral stress', &
                      [present(x), present(y), present(depth), present(lateral), present(stress)])) &
         call stresses_at(this%contents%owner%scene, this%contents%solution, int(points), x, y, depth, nu, &
                          text_at(lateral), stress, this%trouble, stress_error)
      get_stresses = this%code()
   end function get_stresses

   integer(c_int) function get_stress_plane(error, solution, points_x, points_y, offset, depth, nu, lateral, stress, &
      stress_error) bind(c, name='wavycon_get_stress_plane')
      type(c_ptr), value :: error, solution
      integer(c_int), value :: points_x, points_y
      real(c_double), intent(in), optional :: offset(2)
      real(c_double), value :: depth, nu
      character(kind=c_char), intent(in), optional :: lateral(*)
      real(c_double), intent(inout), optional :: stress(*), stress_error(*)

      type(c_call) :: this

      if (this%begins(error, solution, 'solution', 'wavycon_get_stress_plane lateral stress', &
                      [present(lateral), present(stress)])) &
         call stresses_on_plane(this%contents%owner%scene, this%contents%solution, [points_x, points_y], offset, &
                                depth, nu, text_at(lateral), stress, this%trouble, stress_error)
      get_stress_plane = this%code()
   end function get_stress_plane

   integer(c_int) function get_invariants(error, points, stress, to_von_mises, to_shear, to_principal) &
      bind(c, name='wavycon_get_invariants')
      type(c_ptr), value :: error
      integer(c_int), value :: points
      real(c_double), intent(in), optional :: stress(6, *)
      real(c_double), intent(inout), optional :: to_von_mises(*), to_shear(*), to_principal(3, *)

      type(c_call) :: this
      integer :: i

      if (this%begins(error, needs='wavycon_get_invariants stress', are_there=[present(stress)])) &
         call check_number(int(points), this%trouble)
      if (.not. allocated(this%trouble)) then
         do i = 1, points
            if (present(to_von_mises)) to_von_mises(i) = von_mises(stress(:, i))
            if (present(to_shear)) to_shear(i) = largest_shear(stress(:, i))
            if (present(to_principal)) to_principal(:, i) = principal_stresses(stress(:, i))
         end do
      end if
      get_invariants = this%code()
   end function get_invariants

   integer(c_int) function c_run_deck(error, path, directory, quiet, exit_status) bind(c, name='wavycon_run_deck')
      type(c_ptr), value :: error
      character(kind=c_char), intent(in), optional :: path(*), directory(*)
      integer(c_int), value :: quiet
      integer(c_int), intent(inout), optional :: exit_status

      type(c_call) :: this

      if (this%begins(error, needs='wavycon_run_deck path directory exit_status', &
                      are_there=[present(path), present(directory), present(exit_status)])) &
         call run_deck(text_at(path), text_at(directory), quiet /= 0, exit_status, this%trouble)
      c_run_deck = this%code()
   end function c_run_deck

end module wavycon_c_functions
