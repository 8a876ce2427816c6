!> What was done to a measured map, in words for the log and the heads of tables.
module wavycon_preparation_words
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: clauses, integer_text, percent, short_number
   use wavycon_prepare_map, only: map_changes
   implicit none (type, external)
   private

   public :: preparation_words

contains

   !> The changes in one line; empty if there are none.
   pure function preparation_words(changes, length_unit) result(words)
      type(map_changes), intent(in) :: changes
      character(*), intent(in) :: length_unit   !! label of the unit of lengths
      character(:), allocatable :: words

      character(:), allocatable :: trend

      words = ''
      if (changes%head_lines > 0) words = 'without a head of '//integer_text(changes%head_lines)//' line'// &
         trim(merge(' ', 's', changes%head_lines == 1))//' in words'
      if (changes%uneven_steps(2) > 0.0_dp) words = clauses(words, 'resampled to '// &
         integer_text(changes%points(1))//' points '//short_number(changes%step)//' apart, which are '// &
         short_number(changes%uneven_steps(1))//' to '//short_number(changes%uneven_steps(2))// &
         ' apart in the file ['//length_unit//']')
      if (changes%cropped_from(1) > 0) words = clauses(words, 'cropped from '// &
         integer_text(changes%cropped_from(1))//' x '//integer_text(changes%cropped_from(2))//' points')
      if (changes%spikes > 0) words = clauses(words, integer_text(changes%spikes)//' spike'// &
         trim(merge(' ', 's', changes%spikes == 1))//' replaced by the median of the heights around')
      if (changes%detrend /= 'none') then
         trend = 'mean'
         if (changes%detrend == 'quadratic') trend = 'quadratic trend'
         if (changes%detrend == 'plane') trend = 'plane'
         words = clauses(words, 'without its '//trend)
         if (changes%detrend /= 'mean') then
            words = words//', which rises by '//short_number(changes%rise(1))
            if (changes%points(2) > 1) words = words//' along x and '//short_number(changes%rise(2))//' along y'
            words = words//' ['//length_unit//']'
         end if
      end if
      if (changes%filled > 0) words = clauses(words, integer_text(changes%filled)//' missing height'// &
                                              trim(merge(' ', 's', changes%filled == 1))//' filled ('// &
                                              percent(real(changes%filled, dp)/product(changes%points))//')')
      if (changes%edges == 'mirror') words = clauses(words, 'continued by its mirror images')
      if (changes%edges == 'free') words = clauses(words, 'with free edges: nothing continues it')
      if (changes%edges == 'window') words = clauses(words, 'tapered at its borders, which changes '// &
                                                    percent(changes%tapered)//' of its points')
      if (changes%short_wavelength > 0.0_dp) words = clauses(words, 'without waves shorter than '// &
         short_number(changes%short_wavelength)//', whose rms was '//short_number(changes%rms_of_short)// &
         ' ['//length_unit//']')
   end function preparation_words

end module wavycon_preparation_words
