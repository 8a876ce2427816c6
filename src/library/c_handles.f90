!> The handles of the C interface: what they point to, errors, texts, deletion. wavycon.h documents each procedure.
!>
!> All handles point to one type, whose mark and contents are checked before use: a null handle, or one of another kind,
!> is an error of the caller and not a crash.
module wavycon_c_handles
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_loc, c_null_char, c_null_ptr, &
      c_ptr, c_size_t
   use wavycon_c_progress, only: c_progress
   use wavycon_deck_session, only: deck_session, solved_load
   use wavycon_error, only: error_type, exit_bad_input, exit_fine, fatal_error
   use wavycon_memory_table, only: memory_table
   use wavycon_threads, only: set_threads
   implicit none (type, external)
   private

   public :: handle_type, begin_call, check_pointers, close_call, close_new, close_text, find_object, handle_at, &
      kind_of, not_a_handle, text_at

   !> Marks the objects of this library in memory.
   integer, parameter :: our_mark = 1935764579

   !> How the message for a handle that is NULL or of another kind begins.
   character(*), parameter :: not_a_handle = 'the handle is NULL or not that of a '

   !> What a handle points to. One of the allocatable components is allocated.
   type :: handle_type
      integer :: mark = our_mark
      type(error_type), allocatable :: error          !! the outcome of the last call
      type(deck_session), allocatable :: scene
      type(solved_load), allocatable :: solution
      type(memory_table), allocatable :: table
      type(c_progress) :: progress                    !! of a scene
      integer :: users = 0                            !! of a scene: its solutions, and those being found
      logical :: is_deleted = .false.                 !! of a scene, which lives as long as it has users
      type(handle_type), pointer :: owner => null()   !! of a solution: its scene
   end type handle_type

   interface
      integer(c_size_t) function c_strnlen(text, most) bind(c, name='strnlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
         integer(c_size_t), value :: most
      end function c_strnlen

      !> Begins a call: waits until no other thread is in one. close_call, close_new and close_text end it.
      subroutine begin_call() bind(c, name='wavycon_lock')
      end subroutine begin_call

      subroutine end_call() bind(c, name='wavycon_unlock')
      end subroutine end_call
   end interface

   !> Most bytes of a text from C, the same as of a deck: longer ones are cut.
   integer(c_size_t), parameter :: most_bytes = 67108864_c_size_t

contains

   !> Ends a call: stores its outcome in the caller's error object and returns its code, 0 for success. The error of a
   !> call that failed to make a handle is kept by the calls that then get NULL.
   integer(c_int) function close_call(error_handle, error) result(code)
      type(c_ptr), intent(in) :: error_handle                     !! may be null: then the code alone tells
      type(error_type), allocatable, intent(inout) :: error       !! not allocated: success

      type(handle_type), pointer :: caller

      code = exit_fine
      if (allocated(error)) code = int(error%status, c_int)
      caller => handle_at(error_handle)
      if (kind_of(caller) == 'error') then
         if (.not. is_consequence(error, caller%error)) then
            caller%error%status = code
            caller%error%message = ''
            if (allocated(error)) caller%error%message = error%message
         end if
      end if
      call end_call()
   end function close_call

   !> Ends a call that makes an object: its handle or, in case of an error, null.
   type(c_ptr) function close_new(error_handle, contents, error) result(handle)
      type(c_ptr), intent(in) :: error_handle                     !! as of close_call
      type(handle_type), pointer, intent(inout) :: contents       !! the object; deallocated in case of an error
      type(error_type), allocatable, intent(inout) :: error

      handle = c_null_ptr
      if (allocated(error)) call remove(contents)
      if (associated(contents)) handle = c_loc(contents)
      if (close_call(error_handle, error) /= exit_fine) handle = c_null_ptr
   end function close_new

   !> Ends a call that copies a text: the bytes that it needs, with its null character, or 0 in case of an error.
   integer(c_size_t) function close_text(error_handle, words, buffer, bytes, error) result(needed)
      type(c_ptr), intent(in) :: error_handle                     !! as of close_call
      character(:), allocatable, intent(in) :: words              !! allocated unless there is an error
      type(c_ptr), intent(in) :: buffer
      integer(c_size_t), intent(in) :: bytes
      type(error_type), allocatable, intent(inout) :: error

      needed = 0
      if (.not. allocated(error)) needed = put_text(words, buffer, bytes)
      if (close_call(error_handle, error) /= exit_fine) needed = 0
   end function close_text

   !> The contents of a handle; null if it is null or none of ours.
   function handle_at(handle) result(contents)
      type(c_ptr), intent(in) :: handle
      type(handle_type), pointer :: contents

      nullify (contents)
      if (.not. c_associated(handle)) return
      call c_f_pointer(handle, contents)
      if (contents%mark /= our_mark) nullify (contents)
   end function handle_at

   !> The kind of an object; blank for none.
   character(8) function kind_of(contents) result(kind)
      type(handle_type), pointer, intent(in) :: contents

      kind = ''
      if (.not. associated(contents)) return
      if (allocated(contents%error)) kind = 'error'
      if (allocated(contents%scene)) kind = 'scene'
      if (allocated(contents%solution)) kind = 'solution'
      if (allocated(contents%table)) kind = 'table'
   end function kind_of

   !> The object of a handle. Errors: exit_bad_input if it is none or of another kind.
   subroutine find_object(handle, kind, contents, error)
      type(c_ptr), intent(in) :: handle
      character(*), intent(in) :: kind
      type(handle_type), pointer, intent(out) :: contents
      type(error_type), allocatable, intent(out) :: error

      contents => handle_at(handle)
      if (kind_of(contents) /= kind) call fatal_error(error, exit_bad_input, not_a_handle//kind)
   end subroutine find_object

   !> Whether an error is that of a handle that is none, after another error.
   logical function is_consequence(error, last)
      type(error_type), allocatable, intent(in) :: error
      type(error_type), intent(in) :: last   !! the outcome of the last call

      is_consequence = allocated(error) .and. last%status /= exit_fine
      if (is_consequence) is_consequence = index(error%message, not_a_handle) == 1
   end function is_consequence

   !> Errors: exit_bad_input if a pointer is null.
   subroutine check_pointers(are_there, error)
      logical, intent(in) :: are_there(:)                     !! for each pointer whether it is not null
      type(error_type), allocatable, intent(inout) :: error   !! nothing is checked if it is allocated

      if (allocated(error)) return
      if (.not. all(are_there)) call fatal_error(error, exit_bad_input, 'an argument is NULL')
   end subroutine check_pointers

   !> A text from C. Errors: exit_bad_input if the pointer is null.
   subroutine text_at(pointer, text, error)
      type(c_ptr), intent(in) :: pointer
      character(:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(inout) :: error   !! there is no text if it is allocated

      character(kind=c_char), pointer :: bytes(:)
      integer :: i, length

      call check_pointers([c_associated(pointer)], error)
      if (allocated(error)) return
      length = int(c_strnlen(pointer, most_bytes))
      call c_f_pointer(pointer, bytes, [length])
      allocate (character(length) :: text)
      do i = 1, length
         text(i:i) = bytes(i)
      end do
   end subroutine text_at

   !> Copies a text to a buffer of C, cut to its size, with a null character at its end. Returns the bytes of the whole.
   integer(c_size_t) function put_text(text, buffer, bytes) result(needed)
      character(*), intent(in) :: text
      type(c_ptr), intent(in) :: buffer            !! may be null: nothing is copied
      integer(c_size_t), intent(in) :: bytes       !! size of the buffer

      character(kind=c_char), pointer :: to(:)
      integer :: i, length

      length = len(text)
      needed = length + 1_c_size_t
      if (.not. c_associated(buffer) .or. bytes == 0_c_size_t) return
      ! A size_t above the largest integer appears here as a negative number.
      if (bytes > 0_c_size_t) length = int(min(int(length, c_size_t), bytes - 1_c_size_t))
      call c_f_pointer(buffer, to, [length + 1])
      do i = 1, length
         to(i) = text(i:i)
      end do
      to(length + 1) = c_null_char
   end function put_text

   type(c_ptr) function new_error() result(handle) bind(c, name='wavycon_new_error')
      type(handle_type), pointer :: contents

      call begin_call()
      allocate (contents)
      allocate (contents%error)
      contents%error%message = ''
      handle = c_loc(contents)
      call end_call()
   end function new_error

   integer(c_int) function get_code(handle) bind(c, name='wavycon_get_code')
      type(c_ptr), value :: handle

      type(handle_type), pointer :: contents

      call begin_call()
      get_code = exit_bad_input
      contents => handle_at(handle)
      if (kind_of(contents) == 'error') get_code = int(contents%error%status, c_int)
      call end_call()
   end function get_code

   integer(c_size_t) function get_message(handle, buffer, bytes) bind(c, name='wavycon_get_message')
      type(c_ptr), value :: handle, buffer
      integer(c_size_t), value :: bytes

      type(handle_type), pointer :: contents

      call begin_call()
      contents => handle_at(handle)
      if (kind_of(contents) == 'error') then
         get_message = put_text(contents%error%message, buffer, bytes)
      else
         get_message = put_text('this is no error object', buffer, bytes)
      end if
      call end_call()
   end function get_message

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
      if (associated(contents)) call remove(contents)
      call end_call()
   end subroutine delete_handle

   !> Deallocates an object, a scene only if it has no users, and a scene that has lost its last one.
   recursive subroutine remove(contents)
      type(handle_type), pointer, intent(inout) :: contents

      type(handle_type), pointer :: owner

      owner => contents%owner
      contents%is_deleted = .true.
      if (contents%users == 0) then
         contents%mark = 0
         deallocate (contents)
      end if
      nullify (contents)
      if (.not. associated(owner)) return
      owner%users = owner%users - 1
      if (owner%is_deleted) call remove(owner)
   end subroutine remove

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
