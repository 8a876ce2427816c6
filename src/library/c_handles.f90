!> What the C interface, wavycon.h, stands on: handles, errors, texts and arrays.
!>
!> All handles point to one type, whose mark and contents are checked before use: a null handle, or one of another kind,
!> is an error of the caller and not a crash.
module wavycon_c_handles
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_loc, c_null_char, c_null_ptr, &
      c_ptr, c_size_t
   use wavycon_error, only: error_type, exit_bad_input, exit_fine, fatal_error
   use wavycon_threads, only: set_threads
   use wavycon_version, only: version
   use wavycon_wavy_solution, only: wavy_edge, wavy_solution
   use wavycon_wavy_solver, only: wavy_solver
   use wavycon_wavy_surface, only: wavy_surface
   implicit none (type, external)
   private

   public :: not_a_handle, handle_type, begin_call, check_pointers, close_call, close_new, handle_at, put_text, text_at

   !> Marks the objects of this library in memory.
   integer, parameter :: our_mark = 1935764579

   !> How the message for a handle that is NULL or of another kind begins.
   character(*), parameter :: not_a_handle = 'the handle is NULL or not that of a '

   !> What a handle points to. One of the components is allocated.
   type :: handle_type
      integer :: mark = our_mark
      type(error_type), allocatable :: error          !! the outcome of the last call
      type(wavy_surface), allocatable :: surface
      type(wavy_solver), allocatable :: solver
      type(wavy_solution), allocatable :: solution
      type(wavy_edge), allocatable :: edges(:)        !! of the solution, found at their first use
   end type handle_type

   interface
      integer(c_size_t) function c_strnlen(text, most) bind(c, name='strnlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
         integer(c_size_t), value :: most
      end function c_strnlen

      !> Begins a call: waits until no other thread is in one. close_call and close_new end it.
      subroutine begin_call() bind(c, name='wavycon_lock')
      end subroutine begin_call

      subroutine end_call() bind(c, name='wavycon_unlock')
      end subroutine end_call
   end interface

   !> Most bytes of a text from C: longer ones are cut.
   integer(c_size_t), parameter :: most_bytes = 1000000_c_size_t

contains

   !> Ends a call that makes an object: its handle or, in case of an error, null.
   type(c_ptr) function close_new(error_handle, contents, error) result(handle)
      type(c_ptr), intent(in) :: error_handle                     !! as of close_call
      type(handle_type), pointer, intent(inout) :: contents       !! the object; deallocated in case of an error
      type(error_type), allocatable, intent(inout) :: error

      handle = c_null_ptr
      if (close_call(error_handle, error) == exit_fine) then
         handle = c_loc(contents)
      else
         deallocate (contents)
      end if
   end function close_new

   !> The contents of a handle; null if it is null or none of ours.
   function handle_at(handle) result(contents)
      type(c_ptr), intent(in) :: handle
      type(handle_type), pointer :: contents

      nullify (contents)
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, contents)
      if (contents%mark /= our_mark) nullify (contents)
   end function handle_at

   !> Ends a call: stores its outcome in the caller's error object and returns its code, 0 for success. The error of a
   !> call that failed to make a handle is kept by the calls that then get NULL.
   integer(c_int) function close_call(error_handle, error) result(code)
      type(c_ptr), intent(in) :: error_handle                     !! may be null: then the code alone tells
      type(error_type), allocatable, intent(inout) :: error       !! not allocated: success

      type(handle_type), pointer :: caller

      code = exit_fine
      if (allocated(error)) code = int(error%status, c_int)
      caller => handle_at(error_handle)
      if (is_error(caller)) then
         if (.not. is_consequence(error, caller%error)) then
            caller%error%status = code
            caller%error%message = ''
            if (allocated(error)) caller%error%message = error%message
         end if
      end if
      call end_call()
   end function close_call

   !> Whether an error is that of a handle that is none, after another error.
   logical function is_consequence(error, last)
      type(error_type), allocatable, intent(in) :: error
      type(error_type), intent(in) :: last   !! the outcome of the last call

      is_consequence = allocated(error) .and. last%status /= exit_fine
      if (is_consequence) is_consequence = index(error%message, not_a_handle) == 1
   end function is_consequence

   !> Whether a handle's contents are an error object.
   logical function is_error(contents)
      type(handle_type), pointer, intent(in) :: contents

      is_error = associated(contents)
      if (is_error) is_error = allocated(contents%error)
   end function is_error

   !> Errors: exit_bad_input if a pointer is null.
   subroutine check_pointers(are_there, error)
      logical, intent(in) :: are_there(:)                     !! for each pointer whether it is not null
      type(error_type), allocatable, intent(inout) :: error   !! nothing is checked if it is allocated

      if (allocated(error)) return
      if (.not. all(are_there)) call fatal_error(error, exit_bad_input, 'an argument is NULL')
   end subroutine check_pointers

   !> A text from C. Not allocated if the pointer is null.
   subroutine text_at(pointer, text)
      type(c_ptr), intent(in) :: pointer
      character(:), allocatable, intent(out) :: text

      character(kind=c_char), pointer :: bytes(:)
      integer :: i, length

      if (.not. c_associated(pointer)) return
      length = int(c_strnlen(pointer, most_bytes))
      call c_f_pointer(pointer, bytes, [length])
      allocate (character(length) :: text)
      do i = 1, length
         text(i:i) = bytes(i)
      end do
   end subroutine text_at

   !> Copies a text to a buffer of C, cut to its size, with a null character at its end.
   subroutine put_text(text, buffer, bytes)
      character(*), intent(in) :: text
      type(c_ptr), intent(in) :: buffer            !! may be null: nothing is copied
      integer(c_size_t), intent(in) :: bytes       !! size of the buffer

      character(kind=c_char), pointer :: to(:)
      integer :: i, length

      if (.not. c_associated(buffer) .or. bytes == 0_c_size_t) return
      length = len(text)
      ! A size_t above the largest integer appears here as a negative number.
      if (bytes > 0_c_size_t) length = int(min(int(length, c_size_t), bytes - 1_c_size_t))
      call c_f_pointer(buffer, to, [length + 1])
      do i = 1, length
         to(i) = text(i:i)
      end do
      to(length + 1) = c_null_char
   end subroutine put_text

   type(c_ptr) function new_error() result(handle) bind(c, name='wavycon_new_error')
      type(handle_type), pointer :: contents

      call begin_call()
      allocate (contents)
      allocate (contents%error)
      contents%error%message = ''
      handle = c_loc(contents)
      call end_call()
   end function new_error

   integer(c_int) function check_error(handle) bind(c, name='wavycon_check_error')
      type(c_ptr), value :: handle

      type(handle_type), pointer :: contents

      call begin_call()
      check_error = exit_bad_input
      contents => handle_at(handle)
      if (is_error(contents)) check_error = int(contents%error%status, c_int)
      call end_call()
   end function check_error

   integer(c_int) function get_error_message(handle, buffer, bytes) bind(c, name='wavycon_get_error_message')
      type(c_ptr), value :: handle, buffer
      integer(c_size_t), value :: bytes

      type(handle_type), pointer :: contents

      call begin_call()
      contents => handle_at(handle)
      if (is_error(contents)) then
         get_error_message = exit_fine
         call put_text(contents%error%message, buffer, bytes)
      else
         get_error_message = exit_bad_input
         call put_text('this is no error object', buffer, bytes)
      end if
      call end_call()
   end function get_error_message

   !> Deletes any handle and sets it to null; a null handle is ignored.
   subroutine delete_handle(handle) bind(c, name='wavycon_delete')
      type(c_ptr), value :: handle   !! address of the handle, a void *

      type(c_ptr), pointer :: its_handle
      type(handle_type), pointer :: contents

      if (.not. c_associated(handle)) return
      call begin_call()
      call c_f_pointer(handle, its_handle)
      contents => handle_at(its_handle)
      its_handle = c_null_ptr
      if (associated(contents)) then
         contents%mark = 0
         deallocate (contents)
      end if
      call end_call()
   end subroutine delete_handle

   integer(c_int) function get_version(buffer, bytes) bind(c, name='wavycon_get_version')
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: bytes

      get_version = merge(exit_fine, exit_bad_input, c_associated(buffer) .and. bytes /= 0_c_size_t)
      call put_text(version, buffer, bytes)
   end function get_version

   integer(c_int) function c_set_threads(error, number) bind(c, name='wavycon_set_threads')
      type(c_ptr), value :: error
      integer(c_int), value :: number

      integer, parameter :: most_threads = 1024
      type(error_type), allocatable :: trouble

      call begin_call()
      if (number < 1 .or. number > most_threads) then
         call fatal_error(trouble, exit_bad_input, 'the number of threads must be from 1 to 1024')
      else
         call set_threads(int(number))
      end if
      c_set_threads = close_call(error, trouble)
   end function c_set_threads

end module wavycon_c_handles
