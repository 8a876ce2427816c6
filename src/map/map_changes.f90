!> What was done to a measured map before it became a surface, for the log.
module wavycon_map_changes
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text, short_number
   implicit none (type, external)
   private

   public :: clauses, map_changes, percent

   type :: map_changes
      real(dp) :: step = 0.0_dp             !! along x [length]
      real(dp) :: uneven_steps(2) = 0.0_dp  !! as of measured_map
      character(9) :: detrend = 'none'      !! value of the key
      real(dp) :: rise(2) = 0.0_dp          !! of the linear part that was removed, from border to border [length]
      integer :: points(2) = 0              !! of the map along x and y
      integer :: filled = 0                 !! number of points that were missing
      character(8) :: edges = 'periodic'    !! value of the key
      real(dp) :: tapered = 0.0_dp          !! part of the points that the window changed
   contains
      procedure :: words
   end type map_changes

contains

   !> The changes in one line; empty if there are none.
   pure function words(self, length_unit)
      class(map_changes), intent(in) :: self
      character(*), intent(in) :: length_unit   !! label of the unit of lengths
      character(:), allocatable :: words

      character(:), allocatable :: trend

      words = ''
      if (self%uneven_steps(2) > 0.0_dp) words = 'resampled to '//integer_text(self%points(1))//' points '// &
         short_number(self%step)//' apart, which are '//short_number(self%uneven_steps(1))//' to '// &
         short_number(self%uneven_steps(2))//' apart in the file ['//length_unit//']'
      if (self%detrend /= 'none') then
         trend = 'mean'
         if (self%detrend == 'quadratic') trend = 'quadratic trend'
         if (self%detrend == 'plane') trend = 'plane'
         words = clauses(words, 'without its '//trend)
         if (self%detrend /= 'mean') then
            words = words//', which rises by '//short_number(self%rise(1))
            if (self%points(2) > 1) words = words//' along x and '//short_number(self%rise(2))//' along y'
            words = words//' ['//length_unit//']'
         end if
      end if
      if (self%filled > 0) words = clauses(words, integer_text(self%filled)//' missing height'// &
                                          trim(merge(' ', 's', self%filled == 1))//' filled ('// &
                                          percent(real(self%filled, dp)/product(self%points))//')')
      if (self%edges == 'mirror') words = clauses(words, 'continued by its mirror images')
      if (self%edges == 'window') words = clauses(words, 'tapered at its borders, which changes '// &
                                                 percent(self%tapered)//' of its points')
   end function words

   !> Two clauses.
   pure function clauses(first, second) result(words)
      character(*), intent(in) :: first    !! may be empty
      character(*), intent(in) :: second
      character(:), allocatable :: words

      words = second
      if (first /= '') words = first//'; '//second
   end function clauses

   !> A part in per cent, such as '2.5 %'.
   pure function percent(part) result(share)
      real(dp), intent(in) :: part   !! 0 .. 1
      character(:), allocatable :: share

      share = short_number(0.1_dp*nint(1000*part))//' %'
      if (part > 0.0_dp .and. nint(1000*part) == 0) share = 'below 0.1 %'
   end function percent

end module wavycon_map_changes
