!> <case>.checkpoint: the loads of a sweep that are finished, from its beginning until its tables are written.
!>
!> First a mark, then frames: the number of words, its complement, the words and their checksum. The first
!> frame tells the run apart from all others, the second says what is being solved, each further one is a
!> load. What an interruption left of a last frame is not looked at; anything else that does not fit is
!> damage.
!>
!> Runs side by side do not mix: each has a file of its own, which got its name when it was whole and loses
!> it, to the next run that begins, without being written into by it.
module wavycon_checkpoint
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_checkpoint_words, only: checksum, state_of_words, surface_checksum, text_of_words, words_of_state, &
                                       words_of_text
   use wavycon_contact_state, only: contact_state
   use wavycon_deck, only: deck_type
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_plain_text, only: escaped, excerpt, integer_text, newline, system_words
   use wavycon_resolved_deck, only: write_resolved_deck
   use wavycon_results, only: results_type
   use wavycon_system, only: file_size, path_absent, path_kind, process_id, remove_file, remove_when_interrupted, &
      rename_file
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: checkpoint_file, checkpoint_name, read_checkpoint

   character(*), parameter :: mark = 'wavycon checkpoint 1'//newline
   integer, parameter :: bytes_of_word = 8
   character(*), parameter :: way_out = '. Without --resume all loads are solved, and the checkpoint is replaced.'

   type :: checkpoint_file
      private
      integer :: unit = -1
      logical :: opened = .false.
      integer(int64) :: run(3) = 0             !! that it is of
      character(:), allocatable :: name        !! final name
      character(:), allocatable :: name_now
   contains
      procedure :: begin
      procedure :: is_kept
      procedure :: add
      procedure :: remove
   end type checkpoint_file

contains

   !> <directory>/<case>.checkpoint
   pure function checkpoint_name(results) result(name)
      type(results_type), intent(in) :: results
      character(:), allocatable :: name

      name = results%directory//'/'//results%deck%scene%text('case')//'.checkpoint'
   end function checkpoint_name

   !> The name of a file that this process alone uses, until it is renamed or removed.
   function working_name(results, kind) result(name)
      type(results_type), intent(in) :: results
      character(*), intent(in) :: kind
      character(:), allocatable :: name

      name = results%directory//'/.'//results%deck%scene%text('case')//'.'//kind//'.'//integer_text(process_id())// &
         '.part'
   end function working_name

   !> Begins a checkpoint with the loads that are known already; one that is there is replaced. A checkpoint
   !> that cannot be written is no reason not to solve: `is_kept` tells.
   subroutine begin(self, results, known)
      class(checkpoint_file), intent(out) :: self
      type(results_type), intent(in) :: results   !! in a directory that is there
      logical, intent(in) :: known(:)             !! loads whose states are known, in the deck's order

      character(:), allocatable :: description, failure, working
      integer :: clock(8), load, status

      working = working_name(results, 'checkpoint')
      self%name = checkpoint_name(results)
      call describe(results, description)
      if (description == '') return
      call date_and_time(values=clock)
      call system_clock(self%run(3))
      self%run(:2) = [int(process_id(), int64), checksum(int(clock, int64))]
      self%name_now = working
      call remove_when_interrupted(working)
      open (newunit=self%unit, file=working, access='stream', form='unformatted', status='replace', &
            action='write', iostat=status)
      self%opened = status == 0
      if (self%opened) write (self%unit, iostat=status) mark
      call put(self, self%run)
      call put(self, words_of_text(description))
      do load = 1, size(known)
         if (known(load)) call self%add(load, results%states(load))
      end do
      if (self%opened) call rename_file(working, self%name, failure)
      self%name_now = self%name
      if (self%opened .and. .not. allocated(failure)) return
      call give_up(self)
      call remove_file(working)
   end subroutine begin

   !> Whether loads are still being written down.
   pure logical function is_kept(self)
      class(checkpoint_file), intent(in) :: self

      is_kept = self%opened
   end function is_kept

   !> Writes down a finished load.
   subroutine add(self, load, state)
      class(checkpoint_file), intent(inout) :: self
      integer, intent(in) :: load             !! its place in the deck
      type(contact_state), intent(in) :: state

      integer(int64), allocatable :: words(:)

      if (.not. self%opened) return
      call words_of_state(load, state, words)
      if (allocated(words)) then
         call put(self, words)
      else
         call give_up(self)
      end if
   end subroutine add

   !> Ends the checkpoint: the tables hold all. That of another run is left to it.
   subroutine remove(self)
      class(checkpoint_file), intent(inout) :: self

      integer(int64), allocatable :: run(:)
      integer :: status, unit
      logical :: whole

      call give_up(self)
      open (newunit=unit, file=self%name, access='stream', form='unformatted', status='old', action='read', &
            iostat=status)
      if (status /= 0) return
      call get(unit, len(mark) + 1_int64, run, whole)
      close (unit)
      if (.not. whole .or. size(run) /= size(self%run)) return
      if (all(run == self%run)) call remove_file(self%name)
   end subroutine remove

   subroutine give_up(self)
      type(checkpoint_file), intent(inout) :: self

      integer :: ignored

      if (self%opened) close (self%unit, iostat=ignored)
      self%opened = .false.
   end subroutine give_up

   !> Writes a frame, and sees that it is there: on a full disk gfortran 12 reports nothing. Nor is more
   !> written when another run's checkpoint has taken the place.
   subroutine put(self, words)
      type(checkpoint_file), intent(inout) :: self
      integer(int64), intent(in) :: words(:)

      integer(int64) :: count_of, next_byte
      integer :: status

      if (.not. self%opened) return
      count_of = size(words, kind=int64)
      write (self%unit, iostat=status) count_of, not(count_of), words, checksum(words)
      if (status == 0) flush (self%unit, iostat=status)
      if (status == 0) then
         inquire (unit=self%unit, pos=next_byte)
         if (file_size(self%name_now) /= next_byte - 1) status = 1
      end if
      if (status /= 0) call give_up(self)
   end subroutine put

   !> Reads the frame at a place. What is cut short is not whole, what does not fit has no words.
   subroutine get(unit, place, words, whole)
      integer, intent(in) :: unit
      integer(int64), intent(in) :: place                   !! of its first byte
      integer(int64), allocatable, intent(out) :: words(:)
      logical, intent(out) :: whole

      integer(int64) :: bytes, head(2), there
      integer :: status

      allocate (words(0))
      inquire (unit=unit, size=bytes)
      bytes = bytes - place + 1
      whole = .false.
      if (bytes < 2*bytes_of_word) return
      read (unit, pos=place, iostat=status) head
      whole = status /= 0 .or. head(2) /= not(head(1)) .or. head(1) < 1
      if (whole) return
      if (head(1) > bytes/bytes_of_word - 3) return
      whole = .true.
      deallocate (words)
      allocate (words(head(1)))
      read (unit, iostat=status) words, there
      if (status == 0 .and. there == checksum(words)) return
      deallocate (words)
      allocate (words(0))
   end subroutine get

   !> Takes the finished loads of an interrupted run. Errors: exit_bad_input for a checkpoint of something
   !> else, or damaged; exit_file_trouble.
   subroutine read_checkpoint(results, known, found, error)
      type(results_type), intent(inout) :: results   !! `states` are those of the loads that are known
      logical, intent(out) :: known(:)                !! the loads found, in the deck's order
      logical, intent(out) :: found                   !! whether there is a checkpoint
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: description, name
      character(len(mark)) :: start
      character(200) :: message
      integer(int64) :: place
      integer(int64), allocatable :: words(:)
      type(contact_state) :: state
      integer :: load, status, unit
      logical :: understood, whole

      known = .false.
      name = checkpoint_name(results)
      found = path_kind(name) /= path_absent
      if (.not. found) return
      open (newunit=unit, file=name, access='stream', form='unformatted', status='old', action='read', &
            iostat=status, iomsg=message)
      if (status /= 0) then
         call fatal_error(error, exit_file_trouble, escaped(name)//': cannot be read: '//system_words(message))
         return
      end if
      read (unit, iostat=status) start
      if (status /= 0) start = ''
      place = len(mark) + 1
      if (start == mark) then
         call next()
         if (size(words) > 0) call next()
      end if
      if (start /= mark) then
         call fatal_error(error, exit_bad_input, escaped(name)// &
                          ': this is no checkpoint of this version of wavycon'//way_out)
      else if (size(words) == 0) then
         call damaged()
      else
         call describe(results, description)
         if (description == '') then
            call fatal_error(error, exit_file_trouble, escaped(name)//': nothing can be written beside it')
         else
            call compare(name, text_of_words(words), description, error)
         end if
      end if
      do while (.not. allocated(error))
         call next()
         if (.not. whole) exit
         call state_of_words(words, load, state, understood)
         if (understood) understood = load <= size(known)
         if (understood) understood = .not. known(load)
         if (understood) then
            results%states(load) = state
            known(load) = .true.
         else
            call damaged()
         end if
      end do
      close (unit)

   contains

      subroutine next()
         call get(unit, place, words, whole)
         place = place + (size(words) + 3)*bytes_of_word
      end subroutine next

      subroutine damaged()
         call fatal_error(error, exit_bad_input, escaped(name)//': the checkpoint is damaged'//way_out)
      end subroutine damaged

   end subroutine read_checkpoint

   !> What is being solved: the program, the deck but for where it lies and where the results go, and the
   !> surface, whose heights may come from a file. Empty if it cannot be written.
   subroutine describe(results, text)
      type(results_type), intent(in) :: results
      character(:), allocatable, intent(out) :: text

      type(deck_type) :: deck
      type(deck_text_type) :: resolved
      type(error_type), allocatable :: error
      character(:), allocatable :: working
      character(20) :: number
      integer :: status, unit

      text = ''
      working = working_name(results, 'description')
      call remove_when_interrupted(working)
      open (newunit=unit, file=working, status='replace', action='write', iostat=status)
      if (status /= 0) return
      deck = results%deck
      deck%path = ''
      call deck%output%set('directory', '')
      call write_resolved_deck(deck, unit, status)
      close (unit, iostat=status)
      call read_deck_text(working, resolved, error)
      call remove_file(working)
      if (allocated(error)) return
      write (number, '(i0)') surface_checksum(results%scene%surface)
      text = 'wavycon '//version//' ('//revision//')'//newline//'surface '//trim(number)//newline//resolved%content
   end subroutine describe

   !> Errors: exit_bad_input where what is to be solved is not what was.
   subroutine compare(name, before, now, error)
      character(*), intent(in) :: name                    !! of the checkpoint
      character(*), intent(in) :: before, now             !! as `describe` says it
      type(error_type), allocatable, intent(out) :: error

      type(deck_text_type) :: text_before, text_now
      character(:), allocatable :: line_before, line_now, words
      integer :: i

      text_before = deck_text_type(name, trim(before))
      text_now = deck_text_type(name, trim(now))
      if (text_before%content == text_now%content) return
      line_before = ''
      line_now = ''
      do i = 1, max(size(text_before%line_start), size(text_now%line_start))
         line_before = line(text_before, i)
         line_now = line(text_now, i)
         if (line_before /= line_now) exit
      end do
      select case (i)
      case (1)
         words = 'is of '//line_before//', this is '//line_now
      case (2)
         words = 'is of another surface: the deck or its height map has changed'
      case default
         words = "is of another deck: '"//excerpt(line_now)//"' was '"//excerpt(line_before)//"'"
      end select
      call fatal_error(error, exit_bad_input, escaped(name)//': the checkpoint '//words//way_out)
   end subroutine compare

   !> A line without its comment and the blanks around it; empty behind the last.
   pure function line(text, number)
      type(deck_text_type), intent(in) :: text
      integer, intent(in) :: number
      character(:), allocatable :: line

      integer :: behind, first, last

      line = ''
      if (number > size(text%line_start)) return
      call text%line_bounds(number, first, last)
      line = text%content(first:last)
      behind = index(line, '   ! ')
      if (behind > 0) line = line(:behind - 1)
      line = trim(adjustl(line))
   end function line

end module wavycon_checkpoint
