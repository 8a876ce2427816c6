!> The &surface group: which waves the bodies carry.
module wavycon_surface_group
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_group_input, only: group_input_type
   use wavycon_key_table, only: choice_key, key_group, key_group_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: surface_group_type, surface_table, read_surface_group, write_surface_group, surface_dimension

   !> What &surface says.
   type :: surface_group_type
      character(12) :: kind = ''                     !! 'wave_1d', 'wave_2d' or 'crossed_1d'
      real(dp) :: amplitude = 1, wavelength = 1      !! of wave_1d and wave_2d [length]
      real(dp) :: amplitude1 = 0, amplitude2 = 0     !! of the two blocks of crossed_1d [length]
      real(dp) :: wavelength1 = 0, wavelength2 = 0   !! of the two blocks of crossed_1d [length]
   end type surface_group_type

   !> The keys that describe one wave, and those that describe the waves of two blocks.
   character(11), parameter :: of_one_wave(*) = ['amplitude  ', 'wavelength ']
   character(11), parameter :: of_crossed(*) = ['amplitude1 ', 'wavelength1', 'amplitude2 ', 'wavelength2']

contains

   function surface_table() result(table)
      type(key_group_type) :: table

      table = key_group('surface', 'which waves the bodies carry', [ &
         choice_key('kind', '', &
            "'wave_1d': gap amplitude (1 - cos phi), phi = 2 pi x/wavelength. 'wave_2d': gap amplitude "// &
            "(1 - cos phi cos theta), theta = 2 pi y/wavelength. 'crossed_1d': a 1-D wave on each of two "// &
            'blocks, at right angles.', ['wave_1d   ', 'wave_2d   ', 'crossed_1d'], required=.true.), &
         real_key('amplitude', '1.0', 'length', &
            'Of wave_1d and wave_2d: half the height from trough to crest; 0 is a flat surface.', &
            least=0.0_dp), &
         real_key('wavelength', '1.0', 'length', 'Of wave_1d and wave_2d, along x (and y).', above=0.0_dp), &
         real_key('amplitude1', '', 'length', 'Of crossed_1d: the wave of the first block.', least=0.0_dp), &
         real_key('wavelength1', '', 'length', 'Of crossed_1d: the wave of the first block.', above=0.0_dp), &
         real_key('amplitude2', '', 'length', 'Of crossed_1d: must be equal to amplitude1.', least=0.0_dp), &
         real_key('wavelength2', '', 'length', 'Of crossed_1d: must be equal to wavelength1.', &
            above=0.0_dp)], required=.true.)
   end function surface_table

   subroutine read_surface_group(input, group, problems)
      type(group_input_type), intent(in) :: input
      type(surface_group_type), intent(out) :: group
      type(problem_list_type), intent(inout) :: problems

      character(len(group%kind)) :: kind
      real(dp) :: amplitude, amplitude1, amplitude2, wavelength, wavelength1, wavelength2
      character(200) :: message
      integer :: status
      namelist /surface/ kind, amplitude, wavelength, amplitude1, wavelength1, amplitude2, wavelength2

      kind = group%kind
      amplitude = group%amplitude
      wavelength = group%wavelength
      amplitude1 = group%amplitude1
      wavelength1 = group%wavelength1
      amplitude2 = group%amplitude2
      wavelength2 = group%wavelength2
      read (input%record, nml=surface, iostat=status, iomsg=message)
      if (status /= 0) call problems%add(input%place, trim(message))
      group = surface_group_type(kind, amplitude, wavelength, amplitude1, amplitude2, wavelength1, &
         wavelength2)

      select case (kind)
      case ('wave_1d', 'wave_2d')
         call check_one_wave()
      case ('crossed_1d')
         call check_crossed()
      end select

   contains

      subroutine check_one_wave()
         integer :: i

         do i = 1, size(of_crossed)
            if (input%has(of_crossed(i))) call problems%add(input%place_of(of_crossed(i)), &
               trim(of_crossed(i))//" is a key of 'crossed_1d', not of '"//trim(kind)//"'")
         end do
      end subroutine check_one_wave

      subroutine check_crossed()
         integer :: i

         do i = 1, size(of_one_wave)
            if (input%has(of_one_wave(i))) call problems%add(input%place_of(of_one_wave(i)), &
               trim(of_one_wave(i))//" is a key of 'wave_1d' and 'wave_2d', not of 'crossed_1d': give "// &
               trim(of_one_wave(i))//'1 and '//trim(of_one_wave(i))//'2')
         end do
         do i = 1, size(of_crossed)
            if (.not. input%has(of_crossed(i))) call problems%add(input%place_of('kind'), &
               "kind = 'crossed_1d' needs "//trim(of_crossed(i)))
         end do
         call check_equal('amplitude', amplitude1, amplitude2)
         call check_equal('wavelength', wavelength1, wavelength2)
      end subroutine check_crossed

      !> Unequal waves make another lattice: that of the square is all there is so far.
      subroutine check_equal(key, first, second)
         character(*), intent(in) :: key
         real(dp), intent(in) :: first, second

         if (.not. (input%has(key//'1') .and. input%has(key//'2'))) return
         if (input%is_bad(key//'1') .or. input%is_bad(key//'2')) return
         if (abs(first - second) > 0) call problems%add(input%place_of(key//'2'), &
            key//'2 differs from '//key//'1: crossed waves of unequal '//key// &
            ' are not supported yet, equal ones are')
      end subroutine check_equal

   end subroutine read_surface_group

   subroutine write_surface_group(group, writer)
      type(surface_group_type), intent(in) :: group
      type(deck_writer_type), intent(inout) :: writer

      call writer%open_group(surface_table())
      call writer%put('kind', group%kind)
      if (group%kind == 'crossed_1d') then
         call writer%put('amplitude1', group%amplitude1)
         call writer%put('wavelength1', group%wavelength1)
         call writer%put('amplitude2', group%amplitude2)
         call writer%put('wavelength2', group%wavelength2)
      else
         call writer%put('amplitude', group%amplitude)
         call writer%put('wavelength', group%wavelength)
      end if
      call writer%close_group()
   end subroutine write_surface_group

   !> 1 where the gap depends on x alone, else 2.
   pure integer function surface_dimension(group)
      type(surface_group_type), intent(in) :: group

      surface_dimension = merge(1, 2, group%kind == 'wave_1d')
   end function surface_dimension

end module wavycon_surface_group
