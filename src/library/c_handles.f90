!> Handles, errors, texts and the lock, which all functions of the C interface need. wavycon.h documents each function.
!>
!> A function consists of three steps: `begins` of a c_call; its work, if the arguments are right; `code` or
!> `new_object`. All handles point to objects of one type, whose mark and kind are checked before use. So a null handle,
!> or one of another kind, gives the caller an error and does not crash. A pointer that is NULL in C is an absent
!> optional argument.
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

   public :: c_call, c_progress, handle_type, new_handle, progress_callback, put_text, text_at

   !> The number by which an object of this library is recognised in memory.
   integer, parameter :: our_mark = 1935764579

   abstract interface
      !> wavycon_progress of wavycon.h.
      integer(c_int) function progress_callback(user_data, iterations, residual) bind(c)
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: user_data
         integer(c_int), value :: iterations
         real(c_double), value :: residual
      end function progress_callback
   end interface

   !> A C function that solvers call to ask whether they shall stop.
   type, extends(solver_progress) :: c_progress
      procedure(progress_callback), pointer, nopass :: callback => null()
      type(c_ptr) :: data = c_null_ptr   !! its first argument
   contains
      procedure :: shall_stop
   end type c_progress

   !> The object to which a handle points. `kind` says which one of the components error, scene, solution and table is
   !> in use.
   type :: handle_type
      integer :: mark = our_mark
      character(8) :: kind = ''                       !! 'error', 'scene', 'solution' or 'table'
      type(error_type) :: error                       !! the outcome of the last call
      type(error_type), allocatable :: lost           !! why the last object could not be made, if no other call failed
      type(deck_session) :: scene
      type(solved_load) :: solution
      type(memory_table) :: table
      type(c_progress) :: progress                    !! the C function that the scene's solver calls
      integer :: users = 1                            !! number of users: the caller, and the solutions of a scene
      type(handle_type), pointer :: owner => null()   !! the scene of a solution
   end type handle_type

   !> A call from C.
   type :: c_call
      type(handle_type), pointer :: contents => null()   !! the object whose handle the caller gives
      type(handle_type), pointer :: made => null()       !! the object that the call makes; null if it makes none
      type(error_type), allocatable :: trouble           !! the error of the call; not allocated: success
      type(c_ptr), private :: error = c_null_ptr         !! handle of the caller's error object
      logical, private :: got_null = .false.             !! whether the handle that the caller gives is null
      logical, private :: makes_object = .false.         !! whether it is a call of a function that makes an object
   contains
      procedure :: begins, code, new_object, refuse
   end type c_call

   !> The object for a handle that is null or not one of this library: its kind is empty.
   type(handle_type), target :: nothing

   interface
      !> Waits until no other thread is in the library, and keeps others out: c_lock.c.
      subroutine lock() bind(c, name='wavycon_lock')
      end subroutine lock

      !> Lets other threads in.
      subroutine unlock() bind(c, name='wavycon_unlock')
      end subroutine unlock
   end interface

   !> Most bytes of a text from C, as many as a deck may have. Longer texts are cut.
   integer, parameter :: most_bytes = 67108864

contains

   !> Begins a call: waits for the lock and checks the arguments. The result is whether they are right. Errors:
   !> exit_bad_input if `object` is no handle or one of another kind, or if another pointer is null.
   logical function begins(self, error, object, object_kind, needs, are_there)
      class(c_call), intent(inout) :: self
      type(c_ptr), intent(in) :: error                     !! handle of the caller's error object; null: there is none
      type(c_ptr), intent(in), optional :: object          !! handle of the object that the call works on
      character(*), intent(in), optional :: object_kind    !! kind that it must have; absent: any, also no object
      !> The C function and those of its other arguments that must not be null, separated by blanks.
      character(*), intent(in), optional :: needs
      logical, intent(in), optional :: are_there(:)        !! whether each of these is not null

      integer :: first, i, missing

      call lock()
      self%error = error
      if (present(object)) then
         self%contents => object_at(object)
         self%got_null = .not. c_associated(object)
      end if
      if (present(object_kind)) then
         if (self%contents%kind /= object_kind) call self%refuse('kind '//object_kind)
      end if
      if (present(are_there) .and. .not. allocated(self%trouble)) then
         missing = findloc(are_there, .false., dim=1)
         first = 1
         do i = 1, missing
            first = first + index(needs(first:), ' ')
         end do
         if (missing > 0) call fatal_error(self%trouble, exit_bad_input, needs(:index(needs, ' ') - 1)//': '// &
                                           needs(first:first + index(needs(first:)//' ', ' ') - 2)//' is NULL')
      end if
      begins = .not. allocated(self%trouble)
   end function begins

   !> Reports that the handle is NULL or of another kind.
   subroutine refuse(self, kinds)
      class(c_call), intent(inout) :: self
      character(*), intent(in) :: kinds   !! 'kind' and the kind that the function takes, or 'kinds' and their list

      character(:), allocatable :: words

      words = 'the handle is not one of the '//kinds
      if (self%got_null) words = 'the handle is NULL'
      call fatal_error(self%trouble, exit_bad_input, words)
   end subroutine refuse

   !> Ends a call: stores its outcome in the caller's error object, and returns its code, 0 for success. If a call
   !> failed to make an object, the error of later calls that get NULL in its place is that of the first call.
   integer(c_int) function code(self)
      class(c_call), intent(in) :: self

      type(handle_type), pointer :: caller

      code = exit_fine
      if (allocated(self%trouble)) code = int(self%trouble%status, c_int)
      caller => object_at(self%error)
      if (caller%kind == 'error') then
         caller%error = error_type(code, '')
         if (allocated(self%trouble)) caller%error = self%trouble
         if (code /= exit_fine .and. self%got_null .and. allocated(caller%lost)) then
            caller%error = caller%lost
         else if (self%makes_object .or. code /= exit_fine) then
            if (allocated(caller%lost)) deallocate (caller%lost)
            if (self%makes_object .and. code /= exit_fine) allocate (caller%lost, source=caller%error)
         end if
      end if
      call unlock()
   end function code

   !> Ends a call that makes an object. The result is the handle of the object or, in case of an error, null.
   type(c_ptr) function new_object(self) result(handle)
      class(c_call), intent(inout) :: self   !! in case of an error the object is deallocated

      integer(c_int) :: ignored

      handle = c_null_ptr
      if (.not. allocated(self%trouble)) then
         handle = c_loc(self%made)
      else if (associated(self%made)) then
         call release(self%made)
      end if
      self%makes_object = .true.
      ignored = self%code()
   end function new_object

   !> Makes a new object of a kind.
   function new_handle(object_kind, owner) result(made)
      character(*), intent(in) :: object_kind
      !> The scene of a solution, which must not be deallocated before the solution: it gets one more user.
      type(handle_type), pointer, intent(in), optional :: owner
      type(handle_type), pointer :: made

      allocate (made)
      made%kind = object_kind
      made%error%message = ''
      if (.not. present(owner)) return
      made%owner => owner
      owner%users = owner%users + 1
   end function new_handle

   !> The object of a handle; `nothing`, which has no kind, if the handle is null or not one of this library.
   function object_at(handle) result(contents)
      type(c_ptr), intent(in) :: handle
      type(handle_type), pointer :: contents

      contents => nothing
      if (c_associated(handle)) call c_f_pointer(handle, contents)
      if (contents%mark /= our_mark) contents => nothing
   end function object_at

   !> A text from C, whose pointer is not null.
   pure function text_at(bytes) result(text)
      character(kind=c_char), intent(in) :: bytes(*)
      character(:), allocatable :: text

      integer :: length

      do length = 0, most_bytes - 1
         if (bytes(length + 1) == c_null_char) exit
      end do
      allocate (character(length) :: text)
      if (length > 0) text = transfer(bytes(:length), text)
   end function text_at

   !> Copies a text to a buffer of C, cut to the size of the buffer, with a null character at its end. Returns the
   !> number of bytes that the whole text needs, with the null character.
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

   !> Whether the C function says that the solver shall stop.
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

   !> Takes one user from an object. An object without users is deallocated, and its owner then has one user less.
   recursive subroutine release(contents)
      type(handle_type), pointer, intent(inout) :: contents   !! the object; null afterwards

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
