!> <case>.checkpoint: the loads solved so far, for --resume. It is removed when the tables are written.
!>
!> Only solutions that take long are written (contact_solution%is_kept); the others are fast to solve again. The file
!> holds a mark and a line feed, then records: the number of 8-byte words, the words and their checksum. The first
!> record is a text that describes what is solved, each further one is a solution. A last record that was cut short by
!> an interruption is ignored.
!>
!> Two runs of the same case do not mix: each writes to a file of its own, which a later run replaces as a whole.
!>
!> Where ranks share the work each has a checkpoint <case>.checkpoint.<rank> with the loads that it solved, or with its
!> columns of the grids. A run that resumes reads the checkpoints of all ranks of the interrupted run, and may have any
!> number of them itself.
module wavycon_checkpoint
   use, intrinsic :: iso_c_binding, only: c_int, c_null_char, c_null_ptr, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_solution, only: contact_solution
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: escaped, excerpt, integer_text, newline, system_words
   use wavycon_ranks, only: is_first_rank
   use wavycon_results, only: results_type
   use wavycon_system, only: end_written, file_size, note_kept, open_written, path_absent, path_file, path_kind, &
      put_bytes, put_text, remove_file
   use wavycon_version, only: revision, version
   use wavycon_work_sharing, only: distributed_grids
   implicit none (type, external)
   private

   public :: checkpoint_file, checkpoint_name, read_checkpoints

   !> Stands for the number of a rank in a run whose work is not shared.
   integer, parameter :: alone = -1
   character(*), parameter :: mark = 'wavycon checkpoint 10'//newline
   integer, parameter :: bytes_of_word = 8
   !> End of all messages about a checkpoint that cannot be used.
   character(*), parameter :: way_out = '. Without --resume all loads are solved, and the checkpoint is replaced.'

   type :: checkpoint_file
      logical :: is_complete = .false.                         !! whether all solutions added so far were written
      type(c_ptr), private :: file = c_null_ptr                !! of open_written
      logical, private :: has_name = .false.                   !! or a temporary one
      integer, private :: kept = -1                            !! solutions written; -1: not even the description
      integer, private :: loads = 0                            !! all loads of the run
      integer(int64), private :: bytes = 0                     !! written
      character(:), allocatable, private :: name
   contains
      procedure :: create
      procedure :: add
      procedure :: remove
   end type checkpoint_file

contains

   !> The path of the checkpoint, <directory>/<case>.checkpoint or <directory>/<case>.checkpoint.<rank>.
   function checkpoint_name(results, rank) result(name)
      type(results_type), intent(in) :: results
      integer, intent(in), optional :: rank   !! alone: of a run whose work is not shared; absent: this one
      character(:), allocatable :: name

      integer :: of_rank

      of_rank = merge(results%sharing%rank, alone, results%sharing%is_shared)
      if (present(rank)) of_rank = rank
      name = results%scene%directory//'/'//results%scene%case//'.checkpoint'
      if (of_rank /= alone) name = name//'.'//integer_text(of_rank)
   end function checkpoint_name

   !> Removes the checkpoints of an earlier run that had another number of ranks.
   subroutine remove_others(results)
      type(results_type), intent(in) :: results

      integer :: rank

      if (.not. results%sharing%is_first) return
      if (results%sharing%is_shared) call remove_file(checkpoint_name(results, alone))
      rank = merge(results%sharing%ranks, 0, results%sharing%is_shared)
      do while (path_kind(checkpoint_name(results, rank)) == path_file)
         call remove_file(checkpoint_name(results, rank))
         rank = rank + 1
      end do
   end subroutine remove_others

   !> Creates the checkpoint of a run with the solutions that are known already; it replaces that of an earlier run. A
   !> checkpoint that cannot be written does not stop the run: see is_complete.
   subroutine create(self, results, known)
      class(checkpoint_file), intent(out) :: self
      type(results_type), intent(in) :: results   !! its directory exists
      logical, intent(in) :: known(:)             !! of each load: whether its solution is known

      character(:), allocatable :: text
      integer :: load

      self%name = checkpoint_name(results)
      call remove_others(results)
      self%file = open_written(self%name//c_null_char)
      self%is_complete = .true.
      self%bytes = len(mark)
      self%loads = size(results%loads)
      text = description(results)
      if (put_text(self%file, mark, len(mark, c_size_t)) /= 0) call close_file(self)
      call put(self, transfer(text//repeat(' ', modulo(-len(text), bytes_of_word)), [0_int64]))
      do load = 1, size(results%loads)
         if (known(load)) call self%add(load, results%loads(load))
      end do
      self%has_name = .true.
      if (.not. self%is_complete) return
      if (end_written(self%file, 1_c_int, 1_c_int) /= 0) call close_file(self)
   end subroutine create

   !> Adds a solution, if it is worth keeping.
   subroutine add(self, load, solution)
      class(checkpoint_file), intent(inout) :: self
      integer, intent(in) :: load             !! its number in the deck's order
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

   !> Removes the checkpoint after the tables are written, unless another run has replaced it meanwhile: as `put` sees
   !> by its size.
   subroutine remove(self)
      class(checkpoint_file), intent(inout) :: self

      call note_kept(c_null_char)
      call close_file(self)
      if (file_size(self%name) == self%bytes) call remove_file(self%name)
   end subroutine remove

   !> Closes the file; nothing more is written to it.
   subroutine close_file(self)
      type(checkpoint_file), intent(inout) :: self

      integer(c_int) :: ignored

      if (self%is_complete) ignored = end_written(self%file, 0_c_int, 0_c_int)
      self%is_complete = .false.
   end subroutine close_file

   !> Writes a record and says what an interruption leaves from now on. Nothing is written any more once another run has
   !> replaced the file, as its size shows.
   subroutine put(self, words)
      type(checkpoint_file), intent(inout) :: self
      integer(int64), intent(in) :: words(:)

      integer(c_int) :: status
      integer(c_size_t) :: bytes

      if (.not. self%is_complete) return
      bytes = bytes_of_word*size(words, kind=c_size_t)
      self%bytes = self%bytes + bytes + 2*bytes_of_word
      ! The status is that of all so far.
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

   !> Reads the next record of a file.
   subroutine get(unit, words)
      integer, intent(in) :: unit
      !> Not allocated if the file ends before the record does; size 0 if the record is damaged.
      integer(int64), allocatable, intent(out) :: words(:)

      integer(int64) :: bytes, length, place, sum_of_words
      integer :: status

      read (unit, iostat=status) length
      if (status /= 0) return
      ! A damaged length may be huge: allocate no more than the file holds.
      inquire (unit=unit, size=bytes, pos=place)
      if (length < 0 .or. length > (bytes - place + 1)/bytes_of_word - 1) return
      allocate (words(length))
      read (unit, iostat=status) words, sum_of_words
      if (status /= 0 .or. sum_of_words /= checksum(words)) words = words(:0)
   end subroutine get

   !> Reads the solutions of an interrupted run, which may have had any number of ranks. Errors: exit_bad_input for a
   !> damaged checkpoint and for one of another run, exit_file_trouble.
   subroutine read_checkpoints(results, known, first_name, error)
      type(results_type), intent(inout) :: results   !! with room for all loads, which are ordered
      logical, intent(out) :: known(:)               !! of each own load: whether its solution was in the checkpoints
      character(:), allocatable, intent(out) :: first_name   !! of a checkpoint; not allocated if there is none
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: name, now
      integer :: load, rank

      known = .false.
      now = description(results)
      rank = alone
      do while (.not. allocated(error))
         name = checkpoint_name(results, rank)
         if (path_kind(name) /= path_absent) then
            if (.not. allocated(first_name)) first_name = name
            call read_checkpoint(name, now, results, known, error)
         else if (rank >= results%sharing%ranks) then
            exit
         end if
         rank = rank + 1
      end do
      ! Some ranks may have written their columns of the load that was interrupted, others not.
      do load = 1, size(known)
         if (allocated(results%loads(load)%source) .and. .not. known(load)) deallocate (results%loads(load)%source)
      end do
   end subroutine read_checkpoints

   !> Reads one checkpoint. Errors: as of read_checkpoints.
   subroutine read_checkpoint(name, now, results, known, error)
      character(*), intent(in) :: name
      character(*), intent(in) :: now                !! description of this run
      type(results_type), intent(inout) :: results
      logical, intent(inout) :: known(:)
      type(error_type), allocatable, intent(out) :: error

      character(len(mark)) :: start
      character(200) :: message
      character(:), allocatable :: trouble
      integer(int64), allocatable :: words(:)
      integer :: load, record, status, unit

      open (newunit=unit, file=name, access='stream', form='unformatted', status='old', action='read', &
            iostat=status, iomsg=message)
      if (status /= 0) then
         call fatal_error(error, exit_file_trouble, escaped(name)//': cannot be read: '//system_words(message))
         return
      end if
      trouble = ''
      read (unit, iostat=status) start
      if (status /= 0 .or. start /= mark) trouble = 'this is no checkpoint of this version of wavycon'
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
         else
            load = int(words(1))
            if (.not. known(load) .and. results%sharing%is_own_load(load)) call results%loads(load)%unpack( &
               words(2:), results%sharing%kind /= distributed_grids, known(load))
         end if
      end do
      close (unit)
      if (trouble /= '') call fatal_error(error, exit_bad_input, escaped(name)//': '//trouble//way_out)
   end subroutine read_checkpoint

   !> A text that identifies what is solved: version, surface, and the resolved deck without the paths of deck and
   !> results.
   function description(results) result(text)
      type(results_type), intent(in) :: results
      character(:), allocatable :: text

      text = 'wavycon '//version//' ('//revision//')'//newline//'surface '//integer_text(surface_checksum(results))// &
             newline//results%scene%fingerprint
   end function description

   !> How the descriptions of two runs differ; empty if they do not.
   function difference(before, now) result(words)
      character(*), intent(in) :: before, now   !! of the interrupted run and of this one
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

      !> The line of byte k, without comment and without blanks at both ends.
      pure function line_at(text) result(line)
         character(*), intent(in) :: text
         character(:), allocatable :: line

         line = text(index(text(:k - 1), newline, back=.true.) + 1:)
         line = line(:index(line//newline, newline) - 1)
         line = trim(adjustl(line(:index(line//'   ! ', '   ! ') - 1)))
      end function line_at

   end function difference

   !> Checksum: a polynomial whose coefficients are the half words, modulo a prime. A change of one word changes it.
   pure integer(int64) function checksum(words) result(total)
      integer(int64), intent(in) :: words(:)

      integer :: i

      total = 1
      do i = 1, size(words)
         total = with_word(total, words(i))
      end do
   end function checksum

   !> The checksum of words and one more.
   elemental integer(int64) function with_word(before, word) result(total)
      integer(int64), intent(in) :: before   !! checksum of the words before
      integer(int64), intent(in) :: word

      integer(int64), parameter :: prime = 2_int64**31 - 1, factor = 1103515245_int64, low_half = 2_int64**32 - 1

      total = modulo(before*factor + iand(word, low_half), prime)
      total = modulo(total*factor + shiftr(word, 32), prime)
   end function with_word

   !> Checksum of a surface: amplitude, cell and Fourier coefficients. It does not depend on how these are distributed
   !> over the ranks.
   integer(int64) function surface_checksum(results) result(total)
      type(results_type), intent(in) :: results

      integer(int64) :: sums(2)

      associate (surface => results%solver%surface, shape => results%solver%surface%shape)
         if (shape%is_even()) then
            sums = [sum_over_waves(shape%c, shape%first()), 0_int64]
         else
            sums = [sum_over_waves(shape%wave%re, shape%first()), sum_over_waves(shape%wave%im, shape%first())]
         end if
         if (results%sharing%kind == distributed_grids .and. surface%is_distributed()) call results%sharing%add(sums)
         total = checksum([transfer([surface%amplitude, surface%length], sums(:0)), sums])
      end associate
   end function surface_checksum

   !> The sum of the checksums of the coefficients of each wave number in X.
   pure integer(int64) function sum_over_waves(values, first) result(total)
      real(dp), intent(in) :: values(:, :)   !! shape (own wave numbers in X, wave numbers in Y)
      integer, intent(in) :: first           !! of the own wave numbers

      integer(int64) :: of_wave(size(values, 1))
      integer :: i, j

      of_wave = [(first + i, i=1, size(values, 1))]
      do j = 1, size(values, 2)
         of_wave = with_word(of_wave, transfer(values(:, j), of_wave))
      end do
      total = sum(of_wave)
   end function sum_over_waves

end module wavycon_checkpoint
