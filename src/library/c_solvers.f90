!> The solvers of the C interface. wavycon.h documents each procedure.
module wavycon_c_solvers
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
   use wavycon_c_handles, only: begin_call, check_pointers, close_call, close_new, handle_at, handle_type, &
      not_a_handle, put_text, text_at
   use wavycon_deck_run, only: run_deck
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_wavy_solver, only: make_solver, make_solver_of_deck, make_solver_of_material, wavy_scales
   implicit none (type, external)
   private

contains

   type(c_ptr) function new_solver(error, surface, e_star, method, keep_fields) result(handle) &
      bind(c, name='wavycon_new_solver')
      type(c_ptr), value :: error, surface, method
      real(c_double), value :: e_star
      integer(c_int), value :: keep_fields

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: from
      type(handle_type), pointer :: made
      character(:), allocatable :: text

      call begin_call()
      call text_at(method, text)
      from => handle_at(surface)
      allocate (made)
      allocate (made%solver)
      if (.not. allocated(text)) then
         call fatal_error(trouble, exit_bad_input, 'method is NULL')
      else if (.not. has_surface(from)) then
         call fatal_error(trouble, exit_bad_input, not_a_handle//'surface')
      else
         call make_solver(from%surface, e_star, text, keep_fields /= 0, made%solver, trouble)
      end if
      handle = close_new(error, made, trouble)
   end function new_solver

   type(c_ptr) function new_solver_of_material(error, surface, material, method, keep_fields) result(handle) &
      bind(c, name='wavycon_new_solver_of_material')
      type(c_ptr), value :: error, surface, material, method
      integer(c_int), value :: keep_fields

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: from
      type(handle_type), pointer :: made
      character(:), allocatable :: keys, text

      call begin_call()
      call text_at(material, keys)
      call text_at(method, text)
      from => handle_at(surface)
      allocate (made)
      allocate (made%solver)
      if (.not. allocated(keys)) then
         call fatal_error(trouble, exit_bad_input, 'material is NULL')
      else if (.not. allocated(text)) then
         call fatal_error(trouble, exit_bad_input, 'method is NULL')
      else if (.not. has_surface(from)) then
         call fatal_error(trouble, exit_bad_input, not_a_handle//'surface')
      else
         call make_solver_of_material(from%surface, keys, text, keep_fields /= 0, made%solver, trouble)
      end if
      handle = close_new(error, made, trouble)
   end function new_solver_of_material

   type(c_ptr) function new_solver_of_deck(error, path, keep_fields) result(handle) &
      bind(c, name='wavycon_new_solver_of_deck')
      type(c_ptr), value :: error, path
      integer(c_int), value :: keep_fields

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made
      character(:), allocatable :: text

      call begin_call()
      call text_at(path, text)
      allocate (made)
      allocate (made%solver)
      if (allocated(text)) then
         call make_solver_of_deck(text, keep_fields /= 0, made%solver, trouble)
      else
         call fatal_error(trouble, exit_bad_input, 'path is NULL')
      end if
      handle = close_new(error, made, trouble)
   end function new_solver_of_deck

   integer(c_int) function c_run_deck(error, path, directory, quiet, exit_status) bind(c, name='wavycon_run_deck')
      type(c_ptr), value :: error, path, directory, exit_status
      integer(c_int), value :: quiet

      type(error_type), allocatable :: trouble
      character(:), allocatable :: deck, tables
      integer(c_int), pointer :: answer

      call begin_call()
      call check_pointers([c_associated(path), c_associated(directory), c_associated(exit_status)], trouble)
      if (.not. allocated(trouble)) then
         call text_at(path, deck)
         call text_at(directory, tables)
         call c_f_pointer(exit_status, answer)
         call run_deck(deck, tables, quiet /= 0, answer, trouble)
      end if
      c_run_deck = close_call(error, trouble)
   end function c_run_deck

   integer(c_int) function describe_solver(error, solver, buffer, bytes) bind(c, name='wavycon_describe_solver')
      type(c_ptr), value :: error, solver, buffer
      integer(c_size_t), value :: bytes

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents

      call begin_call()
      call find_solver(solver, contents, trouble)
      call check_pointers([c_associated(buffer)], trouble)
      if (.not. allocated(trouble)) call put_text(contents%solver%name()//', '//contents%solver%describe(), &
                                                  buffer, bytes)
      describe_solver = close_call(error, trouble)
   end function describe_solver

   integer(c_int) function get_scales(error, solver, scales) bind(c, name='wavycon_get_scales')
      type(c_ptr), value :: error, solver, scales

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      type(wavy_scales), pointer :: answer

      call begin_call()
      call find_solver(solver, contents, trouble)
      call check_pointers([c_associated(scales)], trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(scales, answer)
         answer = contents%solver%scales()
      end if
      get_scales = close_call(error, trouble)
   end function get_scales

   integer(c_int) function get_number_of_loads(error, solver, loads) bind(c, name='wavycon_get_number_of_loads')
      type(c_ptr), value :: error, solver, loads

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      integer(c_int), pointer :: answer

      call begin_call()
      call find_solver(solver, contents, trouble)
      call check_pointers([c_associated(loads)], trouble)
      if (.not. allocated(trouble)) then
         call c_f_pointer(loads, answer)
         answer = int(contents%solver%number_of_loads(), c_int)
      end if
      get_number_of_loads = close_call(error, trouble)
   end function get_number_of_loads

   integer(c_int) function set_stress(error, solver, keys) bind(c, name='wavycon_set_stress')
      type(c_ptr), value :: error, solver, keys

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      character(:), allocatable :: text

      call begin_call()
      call find_solver(solver, contents, trouble)
      call check_pointers([c_associated(keys)], trouble)
      if (.not. allocated(trouble)) then
         call text_at(keys, text)
         call contents%solver%set_stress(text, trouble)
      end if
      set_stress = close_call(error, trouble)
   end function set_stress

   type(c_ptr) function solve(error, solver, quantity, value) result(handle) bind(c, name='wavycon_solve')
      type(c_ptr), value :: error, solver, quantity
      real(c_double), value :: value

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      type(handle_type), pointer :: made
      character(:), allocatable :: text

      call begin_call()
      call find_solver(solver, contents, trouble)
      call text_at(quantity, text)
      call check_pointers([c_associated(quantity)], trouble)
      allocate (made)
      allocate (made%solution)
      if (.not. allocated(trouble)) call contents%solver%solve(text, value, made%solution, trouble)
      handle = close_new(error, made, trouble)
   end function solve

   type(c_ptr) function solve_load(error, solver, load) result(handle) bind(c, name='wavycon_solve_load')
      type(c_ptr), value :: error, solver
      integer(c_int), value :: load

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: contents
      type(handle_type), pointer :: made

      call begin_call()
      call find_solver(solver, contents, trouble)
      allocate (made)
      allocate (made%solution)
      ! C counts loads from 0.
      if (.not. allocated(trouble)) then
         if (load < 0 .or. load >= contents%solver%number_of_loads()) then
            call fatal_error(trouble, exit_bad_input, 'there is no load of this number')
         else
            call contents%solver%solve_load(load + 1, made%solution, trouble)
         end if
      end if
      handle = close_new(error, made, trouble)
   end function solve_load

   !> The contents of a solver's handle. Errors: exit_bad_input if it is none.
   subroutine find_solver(solver, contents, error)
      type(c_ptr), intent(in) :: solver
      type(handle_type), pointer, intent(out) :: contents
      type(error_type), allocatable, intent(out) :: error

      logical :: found

      contents => handle_at(solver)
      found = associated(contents)
      if (found) found = allocated(contents%solver)
      if (.not. found) call fatal_error(error, exit_bad_input, not_a_handle//'solver')
   end subroutine find_solver

   logical function has_surface(contents)
      type(handle_type), pointer, intent(in) :: contents

      has_surface = associated(contents)
      if (has_surface) has_surface = allocated(contents%surface)
   end function has_surface

end module wavycon_c_solvers
