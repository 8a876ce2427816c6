!> A binary file of which each rank writes some columns. As output_file it appears whole or not at all.
module wavycon_shared_file
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_output_file, only: output_file
   use wavycon_ranks, only: add_over_ranks, any_rank, is_first_rank, share_error, share_text
   implicit none (type, external)
   private

   public :: shared_file

   integer, parameter :: bytes_of_number = storage_size(1.0_dp)/8
   integer, parameter :: message_length = 512   !! of the compiler's messages

   type :: shared_file
      private
      type(output_file) :: file                      !! of the first rank, which writes the head and renames the file
      character(:), allocatable :: path              !! temporary name
      integer(int64) :: head = 0                     !! bytes before the columns
      integer(int64) :: bytes = 0                    !! of all columns written so far
      logical :: is_open = .false.                   !! whether no error has occurred on any rank
   contains
      procedure :: open => open_file
      procedure :: put_columns
      procedure :: finish
   end type shared_file

contains

   !> Opens the file and writes its head. All ranks call this and the other procedures; `finish` reports errors.
   subroutine open_file(self, directory, name, head)
      class(shared_file), intent(out) :: self
      character(*), intent(in) :: directory      !! existing
      character(*), intent(in) :: name           !! of the file in the directory
      character(*), intent(in) :: head           !! the bytes before the columns

      logical :: is_open

      is_open = .true.
      self%head = len(head)
      self%path = ''
      if (is_first_rank()) then
         call self%file%open(directory, name, head)
         call self%file%share(self%path)
         is_open = self%file%is_open()
      end if
      self%is_open = .not. any_rank(.not. is_open)
      call share_text(0, self%path)
   end subroutine open_file

   !> Writes adjacent columns of each rank to their places, all ranks at a time.
   subroutine put_columns(self, before, rows, first, columns, values)
      class(shared_file), intent(inout) :: self
      integer(int64), intent(in) :: before       !! numbers between the head and column 1
      integer, intent(in) :: rows                !! numbers of a column
      integer, intent(in) :: first, columns      !! of this rank; columns may be 0
      real(dp), intent(in) :: values(*)       !! size >= rows*columns

      character(message_length) :: words
      type(error_type), allocatable :: error
      integer :: status, unit

      if (.not. self%is_open) return
      if (columns > 0) then
         associate (number => int(rows, int64)*columns, place => before + int(first - 1, int64)*rows)
            open (newunit=unit, file=self%path, status='old', access='stream', action='write', iostat=status, &
                  iomsg=words)
            if (status == 0) then
               write (unit, pos=self%head + place*bytes_of_number + 1, iostat=status, iomsg=words) values(:number)
               if (status == 0) then
                  close (unit, iostat=status, iomsg=words)
               else
                  close (unit)
               end if
            end if
         end associate
         if (status /= 0) call fatal_error(error, exit_file_trouble, trim(words))
      end if
      call share_error(error)
      self%is_open = .not. allocated(error)
      if (allocated(error)) call self%file%note_trouble(error%message)
      self%bytes = self%bytes + int(rows, int64)*columns*bytes_of_number
   end subroutine put_columns

   !> Gives the file its final name; after an error it is removed. Errors: exit_file_trouble.
   subroutine finish(self, error)
      class(shared_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: bytes(1)

      bytes = self%bytes
      call add_over_ranks(bytes)
      if (is_first_rank()) call self%file%finish(error, bytes(1))
      call share_error(error)
   end subroutine finish

end module wavycon_shared_file
