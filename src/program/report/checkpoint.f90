!> <case>.checkpoint: the loads solved so far, for --resume. The file is removed when the tables are written. Where the
!> deck is one of several, a checkpoint that says that this deck is done stays until the run ends.
!>
!> Only solutions that take long are written (contact_solution%is_kept); the others are fast to solve again. The file
!> begins with a mark and a line feed. Records follow, each as the number of its 8-byte words, the words and their
!> checksum. The first record is a text that describes what is solved, each further one is a solution, or 0 and the
!> exit status of a deck that is done. A last record that an interruption cut short is ignored.
!>
!> Two runs of the same case do not mix their records: each run writes to a file of its own, which a later run replaces
!> as a whole.
!>
!> Where ranks (processes of the parallel program) share the work, each rank has a checkpoint <case>.checkpoint.<rank>
!> with the loads that it solved, or with its columns of the grids. A run that resumes reads the checkpoints of all
!> ranks of the interrupted run, and may have another number of ranks.
module wavycon_checkpoint
   use, intrinsic :: iso_c_binding, only: c_int, c_null_char, c_null_ptr, c_ptr, c_size_t
   use wavycon_contact_solution, only: contact_solution
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_file_bytes, only: open_file
   use wavycon_kinds, only: dp, int64
   use wavycon_plain_text, only: escaped, excerpt, integer_text, newline
   use wavycon_ranks, only: is_first_rank
   use wavycon_results, only: results_type
   use wavycon_system, only: end_written, file_size, note_kept, open_written, path_absent, path_file, path_kind, &
      put_bytes, put_text, remove_file
   use wavycon_version, only: revision, version
   use wavycon_work_sharing, only: distributed_grids
   implicit none (type, external)
   private

   public :: checkpoint_file, checkpoint_name, read_checkpoints, remove_done

   !> In place of the number of a rank: the run's work is not shared, and the checkpoint's name has no number.
   integer, parameter :: alone = -1
   character(*), parameter :: ending = '.checkpoint'
   character(*), parameter :: mark = 'wavycon checkpoint 10'//newline
   integer, parameter :: bytes_of_word = 8
   !> The end of all messages about a checkpoint that cannot be used.
   character(*), parameter :: advice = '. Without --resume all loads are solved, and the checkpoint is replaced.'

   type :: checkpoint_file
      logical :: is_complete = .false.                         !! whether all solutions added so far were written
      type(c_ptr), private :: file = c_null_ptr                !! the file, from open_written
      logical, private :: has_name = .false.                   !! whether the file has its name, not a temporary one
      integer, private :: kept = -1                            !! number of solutions written; -1: no record at all yet
      integer, private :: loads = 0                            !! number of loads of the run
      integer(int64), private :: bytes = 0                     !! length of the file so far
      character(:), allocatable, private :: name               !! path of the file
      character(:), allocatable, private :: description        !! of the run, from describe
   contains
      procedure :: create, add, finish
   end type checkpoint_file

contains

   !> The path of the checkpoint, <directory>/<case>.checkpoint or <directory>/<case>.checkpoint.<rank>.
   function checkpoint_name(results, number) result(name)
      type(results_type), intent(in) :: results
      !> Number of a rank, or `alone` for a run whose work is not shared; absent: that of this run and rank.
      integer, intent(in), optional :: number
      character(:), allocatable :: name

      integer :: owner

      owner = alone
      if (results%sharing%is_shared) owner = results%sharing%rank
      if (present(number)) owner = number
      name = results%scene%directory//'/'//results%scene%case//ending
      if (owner /= alone) name = name//'.'//integer_text(owner)
   end function checkpoint_name

   !> Removes the checkpoints that an earlier run with more ranks, or with shared work, has left: those that this run
   !> does not replace.
   subroutine remove_others(results)
      type(results_type), intent(in) :: results

      integer :: number

      if (.not. results%sharing%is_first) return
      number = 0
      if (results%sharing%is_shared) then
         call remove_file(checkpoint_name(results, alone))
         number = results%sharing%ranks
      end if
      do while (path_kind(checkpoint_name(results, number)) == path_file)
         call remove_file(checkpoint_name(results, number))
         number = number + 1
      end do
   end subroutine remove_others

   !> Creates the checkpoint of a run with the solutions that are known already. The file replaces the checkpoint of an
   !> earlier run only when it holds all of these. An error of writing does not stop the run: `is_complete` is then
   !> .false.
   subroutine create(self, results, known)
      class(checkpoint_file), intent(out) :: self
      type(results_type), intent(in) :: results   !! its directory exists
      logical, intent(in) :: known(:)             !! whether the solution of each load is known

      integer :: load

      self%name = checkpoint_name(results)
      self%loads = size(results%loads)
      self%description = describe(results)
      call remove_others(results)
      call begin(self)
      do load = 1, size(results%loads)
         if (known(load)) call self%add(load, results%loads(load))
      end do
      call give_name(self)
   end subroutine create

   !> Begins a file with the description of the run. It has no name yet.
   subroutine begin(self)
      type(checkpoint_file), intent(inout) :: self

      self%file = open_written(self%name//c_null_char)
      self%is_complete = .true.
      self%has_name = .false.
      self%kept = -1
      self%bytes = len(mark)
      if (put_text(self%file, mark, len(mark, c_size_t)) /= 0) call close_file(self)
      associate (text => self%description)
         call put(self, transfer(text//repeat(' ', modulo(-len(text), bytes_of_word)), [0_int64]))
      end associate
   end subroutine begin

   !> Gives a file its name. It replaces the checkpoint that has this name.
   subroutine give_name(self)
      type(checkpoint_file), intent(inout) :: self

      self%has_name = .true.
      if (.not. self%is_complete) return
      if (end_written(self%file, 1_c_int, 1_c_int) /= 0) call close_file(self)
   end subroutine give_name

   !> Adds a solution, if it took long (contact_solution%is_kept).
   subroutine add(self, load, solution)
      class(checkpoint_file), intent(inout) :: self
      integer, intent(in) :: load             !! number of the load in the deck's order
      type(contact_solution), intent(in) :: solution

      integer(int64), allocatable :: words(:)

      if (.not. self%is_complete .or. .not. solution%is_kept()) return
      call solution%pack(words)
      if (allocated(words)) then
         call put(self, [int(load, int64), words])
      else
         call close_file(self)
      end if
   end subroutine add

   !> Ends the checkpoint after the tables are written: removes it, or replaces it by one that says that the deck is
   !> done. If the file has another size than this run has written, another run has replaced it meanwhile, and it stays.
   subroutine finish(self, results, status, says_done)
      class(checkpoint_file), intent(inout) :: self
      type(results_type), intent(in) :: results
      integer, intent(in) :: status      !! exit status of the deck
      logical, intent(in) :: says_done   !! whether a checkpoint that says so stays, until remove_done

      call close_file(self)
      if (file_size(self%name) == self%bytes) then
         if (says_done .and. results%sharing%is_first) then
            call begin(self)
            call put(self, [0_int64, int(status, int64)])
            call give_name(self)
            call close_file(self)
         else
            call remove_file(self%name)
         end if
      end if
      call note_kept(c_null_char)
   end subroutine finish

   !> Removes the checkpoint that says that a deck is done.
   subroutine remove_done(stem)
      character(*), intent(in) :: stem   !! <directory>/<case>

      call remove_file(stem//ending)
      call remove_file(stem//ending//'.0')
   end subroutine remove_done

   !> Closes the file. Nothing is written to it afterwards.
   subroutine close_file(self)
      type(checkpoint_file), intent(inout) :: self

      integer(c_int) :: ignored

      if (self%is_complete) ignored = end_written(self%file, 0_c_int, 0_c_int)
      self%is_complete = .false.
   end subroutine close_file

   !> Writes a record, and sets the message that tells after an interruption how many loads are kept. If the file has
   !> another size afterwards than this run has written, another run has replaced it, and the file is closed.
   subroutine put(self, words)
      type(checkpoint_file), intent(inout) :: self
      integer(int64), intent(in) :: words(:)   !! the words of the record without length and checksum

      integer(c_int) :: status
      integer(c_size_t) :: bytes

      if (.not. self%is_complete) return
      bytes = bytes_of_word*size(words, kind=c_size_t)
      self%bytes = self%bytes + bytes + 2*bytes_of_word
      ! The status is that of the first error of the file, so that the last one counts for all three.
      status = put_bytes(self%file, [bytes/bytes_of_word], int(bytes_of_word, c_size_t))
      status = put_bytes(self%file, words, bytes)
      status = put_bytes(self%file, [checksum(words)], int(bytes_of_word, c_size_t))
      if (self%has_name) then
         status = end_written(self%file, 1_c_int, 1_c_int)
         if (file_size(self%name) /= self%bytes) status = 1
      end if
      if (status /= 0) call close_file(self)
      if (status /= 0) return
      self%kept = self%kept + 1
      if (is_first_rank()) call note_kept(integer_text(self%kept)//' of '//integer_text(self%loads)// &
                                          ' loads are kept in '//self%name//c_null_char)
   end subroutine put

   !> Reads the next record of a checkpoint.
   subroutine get(unit, words)
      integer, intent(in) :: unit   !! unit of the file, which is open for reading as a stream
      !> The words of the record; not allocated if the file ends before the record does; size 0 if they do not agree
      !> with their checksum.
      integer(int64), allocatable, intent(out) :: words(:)

      integer(int64) :: bytes, length, position, sum_of_words
      integer :: status

      read (unit, iostat=status) length
      if (status /= 0) return
      ! A damaged length may be huge: allocate no more than the file holds.
      inquire (unit=unit, size=bytes, pos=position)
      if (length < 0 .or. length > (bytes - position + 1)/bytes_of_word - 1) return
      allocate (words(length))
      read (unit, iostat=status) words, sum_of_words
      if (status /= 0 .or. sum_of_words /= checksum(words)) words = words(:0)
   end subroutine get

   !> Reads the solutions of an interrupted run, which may have had another number of ranks, from all its checkpoints.
   !> Errors: exit_bad_input for a damaged checkpoint and for the checkpoint of another run, exit_file_trouble.
   subroutine read_checkpoints(results, known, status, first_name, error)
      !> `loads` has an element for each load and takes the solutions.
      type(results_type), intent(inout) :: results
      logical, intent(out) :: known(:)   !! whether the solution of each load was read; .false. for loads of other ranks
      integer, intent(out) :: status     !! exit status of a deck that is done; -1 if it is not
      character(:), allocatable, intent(out) :: first_name   !! path of the first checkpoint; not allocated without one
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: name, now
      integer :: load, number

      known = .false.
      status = -1
      now = describe(results)
      number = alone
      do while (.not. allocated(error))
         name = checkpoint_name(results, number)
         if (path_kind(name) /= path_absent) then
            if (.not. allocated(first_name)) first_name = name
            call read_checkpoint()
         else if (number >= results%sharing%ranks) then
            exit
         end if
         number = number + 1
      end do
      ! At the interruption some ranks may have written their columns of a load and others not: forget these columns.
      do load = 1, size(known)
         if (allocated(results%loads(load)%source) .and. .not. known(load)) deallocate (results%loads(load)%source)
      end do

   contains

      !> Reads the checkpoint of a path.
      subroutine read_checkpoint()
         character(len(mark)) :: start
         character(:), allocatable :: trouble
         integer(int64), allocatable :: words(:)
         integer :: ios, record, unit

         call open_file(name, unit, error)
         if (allocated(error)) return
         trouble = ''
         read (unit, iostat=ios) start
         if (ios /= 0 .or. start /= mark) trouble = 'this is no checkpoint of this version of wavycon'
         record = 0
         do while (trouble == '')
            call get(unit, words)
            record = record + 1
            if (.not. allocated(words)) then
               if (record > 1) exit
               allocate (words(0))
            end if
            if (size(words) == 0) then
               trouble = 'the checkpoint is damaged'
            else if (record == 1) then
               trouble = difference(trim(transfer(words, repeat(' ', bytes_of_word*size(words)))), now)
            else if (words(1) == 0) then
               status = int(words(2))
            else
               load = int(words(1))
               if (.not. known(load) .and. results%sharing%is_own_load(load)) call results%loads(load)%unpack( &
                  words(2:), results%sharing%kind /= distributed_grids, known(load))
            end if
         end do
         close (unit)
         if (trouble /= '') call fatal_error(error, exit_bad_input, escaped(name)//': '//trouble//advice)
      end subroutine read_checkpoint

   end subroutine read_checkpoints

   !> A sentence that says how the descriptions of two runs differ; empty if they are equal.
   function difference(before, now) result(words)
      character(*), intent(in) :: before, now   !! descriptions of the interrupted run and of this one
      character(:), allocatable :: words

      integer :: i, k

      words = ''
      if (before == now) return
      ! The first byte that differs, and the number of its line.
      do k = 1, min(len(before), len(now))
         if (before(k:k) /= now(k:k)) exit
      end do
      select case (count([(now(i:i) == newline, i=1, k - 1)]))
      case (0)
         words = 'the checkpoint is of '//line_at(before)//', this is '//line_at(now)
      case (1)
         words = 'the checkpoint is of another surface: the deck or its height map has changed'
      case default
         words = "the checkpoint is of another deck: '"//excerpt(line_at(now))//"' was '"// &
                 excerpt(line_at(before))//"'"
      end select

   contains

      !> The line of the text that holds byte k, without comment and without blanks at both ends.
      pure function line_at(text) result(line)
         character(*), intent(in) :: text
         character(:), allocatable :: line

         line = text(index(text(:k - 1), newline, back=.true.) + 1:)
         line = line(:index(line//newline, newline) - 1)
         line = trim(adjustl(line(:index(line//'   ! ', '   ! ') - 1)))
      end function line_at

   end function difference

   !> Checksum of words: a polynomial whose coefficients are the half words, modulo a prime. A change of one word
   !> changes the checksum.
   pure integer(int64) function checksum(words) result(total)
      integer(int64), intent(in) :: words(:)

      integer :: i

      total = 1
      do i = 1, size(words)
         total = with_word(total, words(i))
      end do
   end function checksum

   !> The checksum of a sequence of words with one more word at its end.
   elemental integer(int64) function with_word(before, word) result(total)
      integer(int64), intent(in) :: before   !! checksum of the sequence without that word
      integer(int64), intent(in) :: word

      integer(int64), parameter :: prime = 2_int64**31 - 1, factor = 1103515245_int64, low_half = 2_int64**32 - 1

      total = modulo(before*factor + iand(word, low_half), prime)
      total = modulo(total*factor + shiftr(word, 32), prime)
   end function with_word

   !> A text that identifies what is solved: version, surface, and the resolved deck without the paths of deck and
   !> results. The surface is told by a checksum of its amplitude, the sides of its cell and its Fourier coefficients,
   !> which does not depend on how the coefficients are distributed over the ranks.
   function describe(results) result(text)
      type(results_type), intent(in) :: results
      character(:), allocatable :: text

      integer(int64) :: sums(2)

      associate (surface => results%solver%surface, series => results%solver%surface%shape)
         if (series%is_even()) then
            sums = [sum_over_waves(series%c, series%first()), 0_int64]
         else
            sums = [sum_over_waves(series%wave%re, series%first()), sum_over_waves(series%wave%im, series%first())]
         end if
         if (results%sharing%kind == distributed_grids .and. surface%is_distributed()) call results%sharing%add(sums)
         text = 'wavycon '//version//' ('//revision//')'//newline//'surface '// &
                integer_text(checksum([transfer([surface%amplitude, surface%length], sums(:0)), sums]))//newline// &
                results%scene%fingerprint
      end associate
   end function describe

   !> The sum, over the wave numbers in X that this rank has, of a checksum of the coefficients of that wave number. The
   !> sum of these over the ranks is the same however wave numbers are distributed.
   pure integer(int64) function sum_over_waves(values, first) result(total)
      real(dp), intent(in) :: values(:, :)   !! shape (own wave numbers in X, wave numbers in Y)
      integer, intent(in) :: first           !! the first of the own wave numbers in X

      integer(int64) :: of_wave(size(values, 1))
      integer :: i, j

      of_wave = [(first + i, i=1, size(values, 1))]
      do j = 1, size(values, 2)
         of_wave = with_word(of_wave, transfer(values(:, j), of_wave))
      end do
      total = sum(of_wave)
   end function sum_over_waves

end module wavycon_checkpoint
