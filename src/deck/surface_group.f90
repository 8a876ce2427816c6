!> The &surface group: what the gap between the bodies is.
module wavycon_surface_group
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_group_input, only: group_input_type
   use wavycon_key_table, only: choice_key, integer_key, key_group, key_group_type, real_key, text_key
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: integer_text
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: surface_group_type, surface_table, read_surface_group, write_surface_group
   public :: surface_dimension, surface_is_paper_wave

   integer, parameter :: longest_path = 1000, most_waves = 1000, highest_wave = 128

   !> What &surface says. Of each kind the keys that it has no use for keep what stands here.
   type :: surface_group_type
      character(12) :: kind = ''                       !! one of `kinds`
      real(dp) :: amplitude = 1, wavelength = 1        !! [length]
      real(dp) :: wavelength_y = 0                     !! of wave_2d [length]; `wavelength`, where not given
      real(dp) :: amplitude1 = 0, amplitude2 = 0       !! of the two blocks of crossed_1d [length]
      real(dp) :: wavelength1 = 0, wavelength2 = 0     !! of the two blocks of crossed_1d [length]
      real(dp) :: length_x = 1, length_y = 0           !! sides of the cell of sum and file [length]; y: `length_x`
      real(dp), allocatable :: amplitudes(:)           !! of the waves of sum [length]
      integer, allocatable :: waves_x(:), waves_y(:)   !! their numbers in the cell
      real(dp), allocatable :: phases(:)               !! [degree]
      character(longest_path) :: file = ''             !! of file
      character(12) :: file_format = 'auto'            !! 'auto', 'matrix' or 'xyz'
      real(dp) :: height_scale = 1                     !! [length] of one unit of the file's heights
   end type surface_group_type

   character(10), parameter :: kinds(*) = [character(10) :: 'wave_1d', 'wave_2d', 'crossed_1d', 'hexagonal', &
                                           'sum', 'file']
   !> The keys of each kind, and those that it cannot do without.
   character(60), parameter :: keys_of(*) = [character(60) :: &
      'amplitude wavelength', 'amplitude wavelength wavelength_y', &
      'amplitude1 wavelength1 amplitude2 wavelength2', 'amplitude wavelength', &
      'length_x length_y amplitudes waves_x waves_y phases', 'length_x length_y file file_format height_scale']
   character(60), parameter :: needed_by(*) = [character(60) :: '', '', &
      'amplitude1 wavelength1 amplitude2 wavelength2', '', 'amplitudes waves_x', 'file']

contains

   function surface_table() result(table)
      type(key_group_type) :: table

      table = key_group('surface', 'which waves the bodies carry', [ &
         choice_key('kind', '', &
            "'wave_1d': gap amplitude (1 - cos phi), phi = 2 pi x/wavelength. 'wave_2d': amplitude (1 - cos "// &
            "phi cos theta), theta = 2 pi y/wavelength_y. 'crossed_1d': a wave on each of two blocks. "// &
            "'hexagonal': three waves. 'sum': any waves. 'file': a height map.", kinds, required=.true.), &
         real_key('amplitude', '1.0', 'length', &
            'Of wave_1d, wave_2d and hexagonal: mean gap before load; of wave_1d and wave_2d half the height '// &
            'from trough to crest. 0 is a flat surface.', least=0.0_dp), &
         real_key('wavelength', '1.0', 'length', &
            'Of wave_1d and wave_2d, along x (and y); of hexagonal, of each of its three waves.', above=0.0_dp), &
         real_key('wavelength_y', 'wavelength', 'length', 'Of wave_2d along y.', above=0.0_dp), &
         real_key('amplitude1', '', 'length', 'Of crossed_1d: the wave along x, on the first block.', &
                  least=0.0_dp), &
         real_key('wavelength1', '', 'length', 'Of crossed_1d: the wave along x.', above=0.0_dp), &
         real_key('amplitude2', '', 'length', 'Of crossed_1d: the wave along y, on the second block.', &
                  least=0.0_dp), &
         real_key('wavelength2', '', 'length', 'Of crossed_1d: the wave along y.', above=0.0_dp), &
         real_key('length_x', '1.0', 'length', 'Of sum and file: side of the periodic cell along x.', &
                  above=0.0_dp), &
         real_key('length_y', 'length_x', 'length', &
            'Of sum and file: side of the cell along y. Of a file of x, y, z both sides are the columns'' own.', &
            above=0.0_dp), &
         real_key('amplitudes', '', 'length', &
            'Of sum: the height is the sum of amplitudes cos(2 pi (waves_x x/length_x + waves_y y/length_y) '// &
            '- phases).', &
            most_values=most_waves), &
         integer_key('waves_x', '', 'Of sum: number of waves in the cell along x, of each amplitude.', &
            -highest_wave, highest_wave, most_values=most_waves), &
         integer_key('waves_y', '0', 'Of sum: likewise along y. If all are 0 the surface is a profile.', &
            -highest_wave, highest_wave, most_values=most_waves), &
         real_key('phases', '0', 'degree', 'Of sum: the phase of each wave.', least=-360.0_dp, most=360.0_dp, &
            most_values=most_waves), &
         text_key('file', '', &
            'Of file: a periodic map of heights, upwards to the other body; looked for beside the deck. '// &
            "The last row and column are the cell's last, not copies of the first.", longest_path), &
         choice_key('file_format', "'auto'", &
            "Of file: 'matrix', a row of heights for each y; 'xyz', lines of x, y, z on a regular grid; "// &
            "'auto', xyz if all lines have three numbers.", [character(6) :: 'auto', 'matrix', 'xyz']), &
         real_key('height_scale', '1.0', 'length', "Of file: one unit of its heights.", above=0.0_dp)], &
         required=.true.)
   end function surface_table

   subroutine read_surface_group(input, group, problems)
      type(group_input_type), intent(in) :: input
      type(surface_group_type), intent(out) :: group
      type(problem_list_type), intent(inout) :: problems

      character(len(group%kind)) :: kind
      character(len(group%file)) :: file
      character(len(group%file_format)) :: file_format
      real(dp) :: amplitude, amplitude1, amplitude2, height_scale, length_x, length_y
      real(dp) :: wavelength, wavelength1, wavelength2, wavelength_y
      real(dp), allocatable :: amplitudes(:), phases(:)
      integer, allocatable :: waves_x(:), waves_y(:)
      character(200) :: message
      integer :: status
      namelist /surface/ kind, amplitude, wavelength, wavelength_y, amplitude1, wavelength1, amplitude2, &
         wavelength2, length_x, length_y, amplitudes, waves_x, waves_y, phases, file, file_format, height_scale

      kind = group%kind
      amplitude = group%amplitude
      wavelength = group%wavelength
      wavelength_y = group%wavelength_y
      amplitude1 = group%amplitude1
      wavelength1 = group%wavelength1
      amplitude2 = group%amplitude2
      wavelength2 = group%wavelength2
      length_x = group%length_x
      length_y = group%length_y
      file = group%file
      file_format = group%file_format
      height_scale = group%height_scale
      allocate (amplitudes(input%values_of('amplitudes')), phases(input%values_of('phases')), source=0.0_dp)
      allocate (waves_x(input%values_of('waves_x')), waves_y(input%values_of('waves_y')), source=0)
      read (input%record, nml=surface, iostat=status, iomsg=message)
      if (status /= 0) call problems%add(input%place, trim(message))

      if (.not. input%has('wavelength_y')) wavelength_y = wavelength
      if (.not. input%has('length_y')) length_y = length_x
      group%kind = kind
      group%amplitude = amplitude
      group%wavelength = wavelength
      group%wavelength_y = wavelength_y
      group%amplitude1 = amplitude1
      group%wavelength1 = wavelength1
      group%amplitude2 = amplitude2
      group%wavelength2 = wavelength2
      group%length_x = length_x
      group%length_y = length_y
      group%file = file
      group%file_format = file_format
      group%height_scale = height_scale
      group%amplitudes = amplitudes
      group%waves_x = waves_x
      group%waves_y = waves_y
      group%phases = phases
      if (.not. input%has('waves_y')) group%waves_y = 0*waves_x
      if (.not. input%has('phases')) group%phases = 0*amplitudes

      if (all(kinds /= kind)) return
      call check_keys()
      if (kind == 'sum') call check_waves()

   contains

      !> Keys of other kinds, and missing ones.
      subroutine check_keys()
         character(:), allocatable :: key
         integer :: i, own

         own = findloc(kinds == kind, .true., dim=1)
         do i = 1, size(input%table%keys)
            key = trim(input%table%keys(i)%name)
            if (key == 'kind') cycle
            if (is_among(needed_by(own), key) .and. .not. input%has(key)) &
               call problems%add(input%place_of('kind'), "kind = '"//trim(kind)//"' needs "//key)
            if (input%has(key) .and. .not. is_among(keys_of(own), key)) call problems%add(input%place_of(key), &
               key//' is a key of '//kinds_with(key)//", not of '"//trim(kind)//"'"//advice(key))
         end do
      end subroutine check_keys

      function advice(key) result(words)
         character(*), intent(in) :: key
         character(:), allocatable :: words

         words = ''
         if (kind == 'crossed_1d' .and. any(key == [character(10) :: 'amplitude', 'wavelength'])) &
            words = ': give '//key//'1 and '//key//'2'
         if (kind == 'sum' .and. key == 'amplitude') words = ': give amplitudes'
      end function advice

      subroutine check_waves()
         integer :: i

         call check_count('waves_x', size(waves_x))
         if (input%has('waves_y')) call check_count('waves_y', size(waves_y))
         if (input%has('phases')) call check_count('phases', size(phases))
         if (input%is_bad('amplitudes') .or. input%is_bad('waves_x') .or. input%is_bad('waves_y')) return
         if (size(group%waves_x) /= size(group%waves_y) .or. size(waves_x) == 0) return
         do i = 1, size(waves_x)
            if (waves_x(i) /= 0 .or. group%waves_y(i) /= 0) cycle
            call problems%add(input%place_of('waves_x'), 'wave '//integer_text(i)// &
               ' has waves_x = 0 and waves_y = 0: '// &
               'it is a height and no wave; leave it out')
            return
         end do
         if (all(waves_x == 0)) call problems%add(input%place_of('waves_x'), &
            'all waves_x are 0: turn the profile, so that it runs along x')
      end subroutine check_waves

      subroutine check_count(key, number)
         character(*), intent(in) :: key
         integer, intent(in) :: number

         if (.not. input%has(key) .or. input%is_bad(key) .or. input%is_bad('amplitudes')) return
         if (number /= size(amplitudes)) call problems%add(input%place_of(key), key//' has '// &
            integer_text(number)// &
            ' values and amplitudes '//integer_text(size(amplitudes))//': give one for each wave')
      end subroutine check_count

   end subroutine read_surface_group

   subroutine write_surface_group(group, writer)
      type(surface_group_type), intent(in) :: group
      type(deck_writer_type), intent(inout) :: writer

      call writer%open_group(surface_table())
      call writer%put('kind', group%kind)
      select case (group%kind)
      case ('crossed_1d')
         call writer%put('amplitude1', group%amplitude1)
         call writer%put('wavelength1', group%wavelength1)
         call writer%put('amplitude2', group%amplitude2)
         call writer%put('wavelength2', group%wavelength2)
      case ('sum')
         call writer%put('length_x', group%length_x)
         call writer%put('length_y', group%length_y)
         call writer%put('amplitudes', group%amplitudes)
         call writer%put('waves_x', group%waves_x)
         call writer%put('waves_y', group%waves_y)
         call writer%put('phases', group%phases)
      case ('file')
         call writer%put('file', group%file)
         call writer%put('file_format', group%file_format)
         call writer%put('length_x', group%length_x)
         call writer%put('length_y', group%length_y)
         call writer%put('height_scale', group%height_scale)
      case default
         call writer%put('amplitude', group%amplitude)
         call writer%put('wavelength', group%wavelength)
         if (group%kind == 'wave_2d') call writer%put('wavelength_y', group%wavelength_y)
      end select
      call writer%close_group()
   end subroutine write_surface_group

   !> 1 where the gap depends on x alone, else 2. What a file holds is not known here: 2.
   pure integer function surface_dimension(group)
      type(surface_group_type), intent(in) :: group

      surface_dimension = 2
      if (group%kind == 'wave_1d') surface_dimension = 1
      if (group%kind == 'sum') surface_dimension = merge(1, 2, all(group%waves_y == 0))
   end function surface_dimension

   !> Whether it is one of the waves of Johnson, Greenwood & Higginson (1985), eqs. (3) and (21).
   pure logical function surface_is_paper_wave(group)
      type(surface_group_type), intent(in) :: group

      select case (group%kind)
      case ('wave_1d')
         surface_is_paper_wave = .true.
      case ('wave_2d')
         surface_is_paper_wave = .not. abs(group%wavelength_y - group%wavelength) > 0
      case ('crossed_1d')
         surface_is_paper_wave = .not. (abs(group%amplitude1 - group%amplitude2) > 0 .or. &
                                        abs(group%wavelength1 - group%wavelength2) > 0)
      case default
         surface_is_paper_wave = .false.
      end select
   end function surface_is_paper_wave

   !> Whether a list of words parted by blanks has a word.
   pure logical function is_among(list, word)
      character(*), intent(in) :: list, word

      is_among = index(' '//trim(list)//' ', ' '//word//' ') > 0
   end function is_among

   !> "'a', 'b' and 'c'": the kinds that have a key.
   function kinds_with(key) result(words)
      character(*), intent(in) :: key
      character(:), allocatable :: words

      integer :: i, left

      words = ''
      left = count([(is_among(keys_of(i), key), i=1, size(kinds))])
      do i = 1, size(kinds)
         if (.not. is_among(keys_of(i), key)) cycle
         left = left - 1
         words = words//"'"//trim(kinds(i))//"'"
         if (left > 1) words = words//', '
         if (left == 1) words = words//' and '
      end do
   end function kinds_with

end module wavycon_surface_group
