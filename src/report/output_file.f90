!> Result files that appear whole or not at all: written under another name, then renamed.
!>
!> gnuplot reads them unaided: header lines start with '#', the last of them names the columns as name[unit].
module wavycon_output_file
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_system, only: process_id, remove_file, rename_file
   implicit none (type, external)
   private

   public :: output_file, real_width

   !> Width of a real number, 16 digits and a three-digit exponent, and of the blank before it.
   integer, parameter :: real_width = 25
   character(*), parameter :: real_format = '(*(1x, es24.15e3))'

   type :: output_file
      private
      integer, public :: unit = -1                !! for writers of their own; `put` is to be preferred
      character(:), allocatable :: name           !! final name
      character(:), allocatable :: working_name
      character(:), allocatable :: trouble        !! the first thing that went wrong
   contains
      procedure :: open => open_file
      procedure :: is_open
      procedure :: put
      procedure :: put_values
      procedure :: put_columns
      procedure :: finish
   end type output_file

contains

   !> Opens a file for writing. Trouble shows in `finish`.
   subroutine open_file(self, directory, name)
      class(output_file), intent(out) :: self
      character(*), intent(in) :: directory   !! that exists
      character(*), intent(in) :: name        !! of the file in it

      character(12) :: process
      character(200) :: message
      integer :: status

      write (process, '(i0)') process_id()
      self%name = directory//'/'//name
      self%working_name = directory//'/.'//name//'.'//trim(process)//'.part'
      open (newunit=self%unit, file=self%working_name, status='replace', action='write', iostat=status, iomsg=message)
      if (status /= 0) self%trouble = trim(message)
   end subroutine open_file

   !> Whether it can be written to.
   pure logical function is_open(self)
      class(output_file), intent(in) :: self

      is_open = .not. allocated(self%trouble)
   end function is_open

   !> Writes a line.
   subroutine put(self, line)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: line

      character(200) :: message
      integer :: status

      if (allocated(self%trouble)) return
      write (self%unit, '(a)', iostat=status, iomsg=message) line
      if (status /= 0) self%trouble = trim(message)
   end subroutine put

   !> Writes a line of numbers, and words behind them.
   subroutine put_values(self, values, words)
      class(output_file), intent(inout) :: self
      real(dp), intent(in) :: values(:)
      character(*), intent(in), optional :: words

      character(real_width*size(values)) :: line

      write (line, real_format) values
      if (present(words)) then
         call self%put(line//' '//words)
      else
         call self%put(line)
      end if
   end subroutine put_values

   !> Writes the header line that names the columns, aligned with the numbers.
   subroutine put_columns(self, names)
      class(output_file), intent(inout) :: self
      character(*), intent(in) :: names(:)   !! name[unit]

      character(:), allocatable :: line
      integer :: i, blanks

      line = '#'
      do i = 1, size(names)
         blanks = max(1, i*real_width - len(line) - len_trim(names(i)))
         line = line//repeat(' ', blanks)//trim(names(i))
      end do
      call self%put(line)
   end subroutine put_columns

   !> Closes the file and gives it its name; if anything went wrong nothing of it stays. Errors: exit_file_trouble.
   subroutine finish(self, error)
      class(output_file), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      character(200) :: message
      character(:), allocatable :: failure
      integer :: status

      if (.not. allocated(self%trouble)) then
         flush (self%unit, iostat=status, iomsg=message)
         if (status /= 0) self%trouble = trim(message)
         close (self%unit, iostat=status, iomsg=message)
         if (status /= 0) self%trouble = trim(message)
      else
         close (self%unit, iostat=status)
      end if
      if (.not. allocated(self%trouble)) then
         call rename_file(self%working_name, self%name, failure)
         if (allocated(failure)) self%trouble = failure
      end if
      if (allocated(self%trouble)) then
         call remove_file(self%working_name)
         call fatal_error(error, exit_file_trouble, self%name//': cannot be written: '//self%trouble)
      end if
   end subroutine finish

end module wavycon_output_file
