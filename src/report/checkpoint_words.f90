!> What a checkpoint holds, as words of 64 bits, so that every number comes back as the same bits.
module wavycon_checkpoint_words
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_contact_measures, only: contact_measures
   use wavycon_contact_state, only: contact_state
   use wavycon_grid_edge, only: start_grid_edge
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: checksum, state_of_words, surface_checksum, text_of_words, words_of_state, words_of_text

   integer, parameter :: bytes_of_word = 8
   !> Words of a state: its load's number, P, eight measures, three numbers of the solver's work, two texts,
   !> and of the grid that follows its size, none if there is none, and whether it is that of a quarter.
   integer, parameter :: fixed_words = 20
   integer, parameter :: text_bytes = 16

contains

   !> A number below 2^31 that another word, or another order of them, changes but for one in 2^31.
   pure integer(int64) function checksum(words) result(total)
      integer(int64), intent(in) :: words(:)

      integer :: i

      total = 1
      do i = 1, size(words)
         call add_to_checksum(total, words(i))
      end do
   end function checksum

   !> Half a word at a time, so that no product overflows.
   elemental subroutine add_to_checksum(total, word)
      integer(int64), intent(inout) :: total
      integer(int64), intent(in) :: word

      integer(int64), parameter :: prime = 2_int64**31 - 1, factor = 1103515245_int64, low_half = 2_int64**32 - 1

      total = modulo(total*factor + iand(word, low_half), prime)
      total = modulo(total*factor + shiftr(word, 32), prime)
   end subroutine add_to_checksum

   !> Of the heights of a surface, or of the waves that it is a sum of.
   pure integer(int64) function surface_checksum(surface) result(total)
      type(surface_type), intent(in) :: surface

      total = 1
      call add_reals(reshape([surface%amplitude, surface%length], [3, 1]))
      call add_reals(surface%shape%c)
      if (surface%shape%is_even()) return
      call add_reals(surface%shape%cs)
      call add_reals(surface%shape%sc)
      call add_reals(surface%shape%ss)

   contains

      pure subroutine add_reals(values)
         real(dp), intent(in) :: values(:, :)

         integer :: i, j

         do j = 1, size(values, 2)
            do i = 1, size(values, 1)
               call add_to_checksum(total, transfer(values(i, j), 0_int64))
            end do
         end do
      end subroutine add_reals

   end function surface_checksum

   !> A text, with blanks up to a whole number of words.
   pure function words_of_text(text) result(words)
      character(*), intent(in) :: text
      integer(int64), allocatable :: words(:)

      words = transfer(text//repeat(' ', modulo(-len(text), bytes_of_word)), [0_int64])
   end function words_of_text

   !> The text without the blanks at its end.
   pure function text_of_words(words) result(text)
      integer(int64), intent(in) :: words(:)
      character(:), allocatable :: text

      text = trim(transfer(words, repeat(' ', bytes_of_word*size(words))))
   end function text_of_words

   !> All of a state but the answers of the solvers whose loads are solved again: a series' and an
   !> expansion's.
   pure subroutine words_of_state(load, state, words)
      integer, intent(in) :: load
      type(contact_state), intent(in) :: state
      integer(int64), allocatable, intent(out) :: words(:)   !! not allocated if there is not the memory

      integer :: i, j, points(2), status
      character(text_bytes) :: texts(2)

      points = 0
      if (allocated(state%edge)) points = shape(state%edge%pressure_or_gap)
      texts = [character(text_bytes) :: state%solver, state%status]
      allocate (words(fixed_words + product(points)), stat=status)
      if (status /= 0) return
      associate (measures => state%measures)
         words(:fixed_words) = [ &
            int(load, int64), transfer([state%pbar_over_pstar, &
            measures%mean_gap_over_amplitude, measures%approach_over_amplitude, measures%contact_area_fraction, &
            measures%peak_pressure_over_pstar, measures%min_pressure_over_pstar, measures%mean_gap_error, &
            measures%contact_area_error, measures%peak_pressure_error, state%kkt_residual], [0_int64]), &
            int([state%active_constraints, state%pivots], int64), words_of_text(texts(1)), &
            words_of_text(texts(2)), int(points, int64), 0_int64]
      end associate
      if (.not. allocated(state%edge)) return
      if (state%edge%even) words(fixed_words) = 1
      do j = 1, points(2)
         do i = 1, points(1)
            words(fixed_words + (j - 1)*points(1) + i) = transfer(state%edge%pressure_or_gap(i, j), 0_int64)
         end do
      end do
   end subroutine words_of_state

   !> The state again.
   pure subroutine state_of_words(words, load, state, understood)
      integer(int64), intent(in) :: words(:)
      integer, intent(out) :: load
      type(contact_state), intent(out) :: state
      logical, intent(out) :: understood   !! false: these words are no state, and nothing of it is of use

      integer :: i, j, points(2)
      real(dp) :: numbers(10)
      real(dp), allocatable :: field(:, :)

      load = 0
      understood = size(words) >= fixed_words
      if (.not. understood) return
      understood = all(words(18:19) >= 0 .and. words(18:19) <= huge(points)) .and. &
                   words(1) > 0 .and. words(1) <= huge(load) .and. all(abs(words(12:13)) <= huge(load))
      if (understood) understood = words(18)*words(19) == size(words) - fixed_words
      if (.not. understood) return
      load = int(words(1))
      numbers = transfer(words(2:11), numbers)
      state%pbar_over_pstar = numbers(1)
      state%measures = contact_measures(numbers(2), numbers(3), numbers(4), numbers(5), numbers(6), numbers(7), &
                                        numbers(8), numbers(9))
      state%kkt_residual = numbers(10)
      state%active_constraints = int(words(12))
      state%pivots = int(words(13))
      state%solver = text_of_words(words(14:15))
      state%status = text_of_words(words(16:17))
      points = int(words(18:19))
      if (product(points) == 0) return
      allocate (field(points(1), points(2)))
      do j = 1, points(2)
         do i = 1, points(1)
            field(i, j) = transfer(words(fixed_words + (j - 1)*points(1) + i), 0.0_dp)
         end do
      end do
      allocate (state%edge)
      call start_grid_edge(state%edge, field, -field, words(fixed_words) == 1)
   end subroutine state_of_words

end module wavycon_checkpoint_words
