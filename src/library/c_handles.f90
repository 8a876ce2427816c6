!> What all functions of the C interface need: handles, errors, texts, the lock. wavycon.h documents each function.
!>
!> A function is `begins` of a c_call, its work if the arguments are right, and `code` or `new_object`. All handles
!> point to one type, whose mark and kind are checked before use: a null handle, or one of another kind, is an error of
!> the caller and not a crash. A pointer that is NULL in C is an absent optional argument.
module wavycon_c_handles
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_int, c_loc, c_null_char, &
      c_null_ptr, c_ptr, c_size_t
   use wavycon_deck_session, only: deck_session, solved_load
   use wavycon_error, only: error_type, exit_bad_input, exit_fine, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_memory_table, only: memory_table
   use wavycon_solver_progress, only: solver_progress
   use wavycon_threads, only: set_threads
   implicit none (type, external)
   private

   public :: c_call, c_progress, handle_type, new_handle, not_a_handle, progress_callback, put_text, text_at

   !> Marks the objects of this library in memory.
   integer, parameter :: our_mark = 1935764579

   !> How the message for a handle that is NULL or of another kind begins.
   character(*), parameter :: not_a_handle = 'the handle is NULL or not one of the kind '

   abstract interface
      integer(c_int) function progress_callback(data, iterations, residual) bind(c)
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: data
         integer(c_int), value :: iterations
         real(c_double), value :: residual
      end function progress_callback
   end interface

   !> A callback of C that solvers ask whether to stop.
   type, extends(solver_progress) :: c_progress
      procedure(progress_callback), pointer, nopass :: callback => null()
      type(c_ptr) :: data = c_null_ptr
   contains
      procedure :: shall_stop
   end type c_progress

   !> What a handle points to: one of error, scene, solution and table, as its kind says.
   type :: handle_type
      integer :: mark = our_mark
      character(8) :: kind = ''                       !! 'error', 'scene', 'solution' or 'table'
      type(error_type) :: error                       !! the outcome of the last call
      type(deck_session) :: scene
      type(solved_load) :: solution
      type(memory_table) :: table
      type(c_progress) :: progress                    !! of a scene
      integer :: users = 1                            !! the caller; of a scene also its solutions, for which it lives
      type(handle_type), pointer :: owner => null()   !! of a solution: its scene
   end type handle_type

   !> A call from C.
   type :: c_call
      type(handle_type), pointer :: contents => null()   !! of the handle of the object
      type(handle_type), pointer :: made => null()       !! contents of the object that the call makes, if it does
      type(error_type), allocatable :: trouble           !! not allocated: success
      type(c_ptr), private :: error = c_null_ptr         !! handle of the caller's error object
   contains
      procedure :: begins
      procedure :: code
      procedure :: new_object
   end type c_call

   !> The contents of a handle that is none.
   type(handle_type), target :: nothing

   interface
      !> Waits until no other thread is in a call.
      subroutine lock() bind(c, name='wavycon_lock')
      end subroutine lock

      subroutine unlock() bind(c, name='wavycon_unlock')
      end subroutine unlock
   end interface

   !> Most bytes of a text from C, the same as of a deck: longer ones are cut.
   integer, parameter :: most_bytes = 67108864

contains

   !> Begins a call, and tells whether its arguments are right. Errors: exit_bad_input if the handle is none, or that of
   !> another kind, or if another pointer is null.
   logical function begins(self, error, object, kind, are_there)
      class(c_call), intent(inout) :: self
      type(c_ptr), intent(in) :: error                 !! may be null: then the code alone tells
      type(c_ptr), intent(in), optional :: object
      character(*), intent(in), optional :: kind       !! of the object; absent: any, or none
      logical, intent(in), optional :: are_there(:)    !! for each other pointer whether it is not null

      call lock()
      self%error = error
      if (present(object)) self%contents => object_at(object)
      if (present(kind)) then
         if (self%contents%kind /= kind) call fatal_error(self%trouble, exit_bad_input, not_a_handle//kind)
      end if
      if (present(are_there) .and. .not. allocated(self%trouble)) then
         if (.not. all(are_there)) call fatal_error(self%trouble, exit_bad_input, 'an argument is NULL')
      end if
      begins = .not. allocated(self%trouble)
   end function begins

   !> Ends a call: stores its outcome in the caller's error object and returns its code, 0 for success. The error of a
   !> call that failed to make a handle is kept by the calls that then get NULL.
   integer(c_int) function code(self)
      class(c_call), intent(in) :: self

      logical :: is_consequence
      type(handle_type), pointer :: caller

      code = exit_fine
      if (allocated(self%trouble)) code = int(self%trouble%status, c_int)
      caller => object_at(self%error)
      if (caller%kind == 'error') then
         is_consequence = code /= exit_fine .and. caller%error%status /= exit_fine
         if (is_consequence) is_consequence = index(self%trouble%message, not_a_handle) == 1
         if (.not. is_consequence) then
            caller%error = error_type(code, '')
            if (allocated(self%trouble)) caller%error = self%trouble
         end if
      end if
      call unlock()
   end function code

   !> Ends a call that makes an object: its handle or, in case of an error, null.
   type(c_ptr) function new_object(self) result(handle)
      class(c_call), intent(inout) :: self   !! the object is deallocated in case of an error

      integer(c_int) :: ignored

      handle = c_null_ptr
      if (.not. allocated(self%trouble)) then
         handle = c_loc(self%made)
      else if (associated(self%made)) then
         call release(self%made)
      end if
      ignored = self%code()
   end function new_object

   !> A new object of a kind. Its owner, if it has one, lives as long as it.
   function new_handle(kind, owner) result(made)
      character(*), intent(in) :: kind
      type(handle_type), pointer, intent(in), optional :: owner
      type(handle_type), pointer :: made

      allocate (made)
      made%kind = kind
      made%error%message = ''
      if (.not. present(owner)) return
      made%owner => owner
      owner%users = owner%users + 1
   end function new_handle

   !> The contents of a handle; those of `nothing`, without a kind, if it is null or none of ours.
   function object_at(handle) result(contents)
      type(c_ptr), intent(in) :: handle
      type(handle_type), pointer :: contents

      contents => nothing
      if (c_associated(handle)) call c_f_pointer(handle, contents)
      if (contents%mark /= our_mark) contents => nothing
   end function object_at

   !> A text from C; empty if the pointer is null.
   pure function text_at(bytes) result(text)
      character(kind=c_char), intent(in), optional :: bytes(*)
      character(:), allocatable :: text

      integer :: length

      length = 0
      if (present(bytes)) then
         do length = 0, most_bytes - 1
            if (bytes(length + 1) == c_null_char) exit
         end do
      end if
      allocate (character(length) :: text)
      if (length > 0) text = transfer(bytes(:length), text)
   end function text_at

   !> Copies a text to a buffer of C, cut to its size, with a null character at its end. Returns the bytes of the whole.
   integer(c_size_t) function put_text(text, buffer, bytes) result(needed)
      character(*), intent(in) :: text
      character(kind=c_char), intent(inout), optional :: buffer(*)   !! absent: nothing is copied
      integer(c_size_t), intent(in) :: bytes                         !! size of the buffer

      integer :: length

      length = len(text)
      needed = length + 1_c_size_t
      if (.not. present(buffer) .or. bytes == 0_c_size_t) return
      ! A size_t above the largest integer appears here as a negative number.
      if (bytes > 0_c_size_t) length = int(min(int(length, c_size_t), bytes - 1_c_size_t))
      buffer(:length) = transfer(text, buffer(1), length)
      buffer(length + 1) = c_null_char
   end function put_text

   logical function shall_stop(self, iterations, residual)
      class(c_progress), intent(in) :: self
      integer, intent(in) :: iterations
      real(dp), intent(in) :: residual

      shall_stop = .false.
      if (associated(self%callback)) shall_stop = self%callback(self%data, int(iterations, c_int), residual) /= 0
   end function shall_stop

   type(c_ptr) function new_error() result(handle) bind(c, name='wavycon_new_error')
      call lock()
      handle = c_loc(new_handle('error'))
      call unlock()
   end function new_error

   integer(c_int) function get_code(handle) bind(c, name='wavycon_get_code')
      type(c_ptr), value :: handle

      type(c_call) :: this

      get_code = exit_bad_input
      if (this%begins(c_null_ptr, handle, 'error')) get_code = int(this%contents%error%status, c_int)
      call unlock()
   end function get_code

   integer(c_size_t) function get_message(handle, buffer, bytes) bind(c, name='wavycon_get_message')
      type(c_ptr), value :: handle
      character(kind=c_char), intent(inout), optional :: buffer(*)
      integer(c_size_t), value :: bytes

      type(c_call) :: this

      if (this%begins(c_null_ptr, handle, 'error')) this%trouble = this%contents%error
      get_message = put_text(this%trouble%message, buffer, bytes)
      call unlock()
   end function get_message

   !> Deletes any handle and sets it to null; a null handle is ignored.
   subroutine delete_handle(handle) bind(c, name='wavycon_delete')
      type(c_ptr), intent(inout), optional :: handle

      type(handle_type), pointer :: contents

      if (.not. present(handle)) return
      call lock()
      contents => object_at(handle)
      handle = c_null_ptr
      if (contents%kind /= '') call release(contents)
      call unlock()
   end subroutine delete_handle

   !> Takes off a user, and deallocates an object that has lost its last one: then its owner has one less.
   recursive subroutine release(contents)
      type(handle_type), pointer, intent(inout) :: contents   !! null afterwards

      type(handle_type), pointer :: owner

      nullify (owner)
      contents%users = contents%users - 1
      if (contents%users == 0) then
         owner => contents%owner
         contents%mark = 0
         deallocate (contents)
      end if
      nullify (contents)
      if (associated(owner)) call release(owner)
   end subroutine release

   integer(c_int) function c_set_threads(error, number) bind(c, name='wavycon_set_threads')
      type(c_ptr), value :: error
      integer(c_int), value :: number

      integer, parameter :: most_threads = 1024
      type(c_call) :: this

      if (this%begins(error)) then
         if (number < 1 .or. number > most_threads) then
            call fatal_error(this%trouble, exit_bad_input, 'the number of threads must be from 1 to 1024')
         else
            call set_threads(int(number))
         end if
      end if
      c_set_threads = this%code()
   end function c_set_threads

end module wavycon_c_handles
