!> The lines that say what is solved. They are the head of tables and, with numbers of fewer digits, of the log.
module wavycon_head_lines
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: clauses, escaped, exact_number, integer_text, newline, percent, short_number
   use wavycon_prepare_map, only: map_changes
   use wavycon_scene, only: scene_type
   use wavycon_surface, only: surface_type
   use wavycon_version, only: revision, version
   implicit none (type, external)
   private

   public :: head_lines, preparation_words

   !> The slopes along x and along y are told if one is more than so many times the other: the surface has a lay.
   real(dp), parameter :: directed = 1.5_dp

contains

   !> The lines of version, deck, surface, statistics of a height map, material, layer and method, separated by
   !> newlines. The last line has no newline.
   function head_lines(scene, surface, method, prefix) result(lines)
      type(scene_type), intent(in) :: scene
      type(surface_type), intent(in) :: surface   !! the surface that is solved, with its amplitude and sides
      character(*), intent(in) :: method          !! the solver and its discretisation in words
      !> Text at the start of each line: '# ' for tables, whose numbers have all digits, so that they read back exactly;
      !> '' for the log, whose numbers have some.
      character(*), intent(in) :: prefix
      character(:), allocatable :: lines

      character(:), allocatable :: words
      integer :: i
      real(dp) :: side(2)

      lines = prefix//'wavycon '//version//' ('//revision//')'
      call add('deck: '//escaped(scene%deck_path))
      words = scene%scene_values%title%text
      if (words /= '') call add('title: '//escaped(words))
      associate (length => scene%length_unit, pressure => scene%pressure_unit)
         side = surface%sides()
         words = scene%surface_values%kind%text//number('Delta', length, surface%amplitude)// &
                 number('cell_x', length, side(1))
         if (surface%dimension == 2) words = words//number('cell_y', length, side(2))
         if (surface%has_free_edges) then
            words = words//', free edges'
         else if (surface%mirrored) then
            words = words//', mirrored'
         end if
         call add('surface: '//words)
         ! The statistics of a height map, and how it was prepared.
         if (allocated(scene%map)) then
            associate (map => scene%map, roughness => scene%roughness)
               call add('map: points_x[-] = '//integer_text(map%points(1))// &
                        ', points_y[-] = '//integer_text(map%points(2))//number('lowest', length, map%lowest)// &
                        number('highest', length, map%highest)//number('rms_height', length, map%rms)// &
                        ', format = '//trim(map%format))
               if (map%assumed_sides /= '') call add('sides: '//map%assumed_sides)
               words = preparation_words(map%changes, length)
               if (words /= '' .and. .not. allocated(scene%two_maps)) call add('prepared: '//words)
               words = number('rms_slope', '-', roughness%slope)
               if (surface%dimension == 2 .and. maxval(roughness%slopes) > directed*minval(roughness%slopes)) &
                  words = words//number('rms_slope_x', '-', roughness%slopes(1))// &
                          number('rms_slope_y', '-', roughness%slopes(2))
               if (map%rms > 0.0_dp) call add('roughness: skewness[-] = '//text_of(map%skewness)// &
                  number('kurtosis', '-', map%kurtosis)//words// &
                  number('rms_slope_by_differences', '-', map%slope_by_differences)// &
                  number('rms_curvature', '1/'//length, roughness%curvature)// &
                  number('rms_curvature_by_differences', '1/'//length, map%curvature_by_differences))
            end associate
         end if
         if (allocated(scene%two_maps)) then
            do i = 1, 2
               associate (map => scene%two_maps(i))
                  words = ''
                  if (i == 2 .and. scene%surface_values%file2_flip%is_true) words = 'turned over about the y axis'
                  words = clauses(words, preparation_words(map%changes, length))
                  if (words /= '') words = '; '//words
                  call add('map of body '//integer_text(i)//': format = '//trim(map%format)// &
                     number('lowest', length, map%lowest)//number('highest', length, map%highest)// &
                     number('rms_height', length, map%rms)//number('skewness', '-', map%skewness)// &
                     number('kurtosis', '-', map%kurtosis)// &
                     number('rms_slope_by_differences', '-', map%slope_by_differences)//words)
               end associate
            end do
         end if
         words = 'e_star['//pressure//'] = '//text_of(scene%e_star)
         if (.not. surface%has_free_edges) words = words//number('p*', pressure, scene%p_star)
         if (surface%has_hardness()) words = words//number('hardness', pressure, scene%material%hardness%number)
         call add('material: '//words)
         if (surface%kernel%has_layer()) then
            associate (material => scene%material, layer => surface%kernel%layer)
               words = 'slides on a rigid base'
               if (.not. layer%slides) words = 'bonded to a rigid base'//number('nu', '-', layer%nu)
               if (material%base_e%is_given) words = 'bonded to a half-space'//number('nu', '-', layer%nu)// &
                  number('base_e', pressure, material%base_e%number)//number('base_nu', '-', layer%base_nu)
               call add('layer: '//words//number('thickness', length, material%layer_thickness%number))
            end associate
         end if
      end associate
      call add('method: '//method)

   contains

      subroutine add(line)
         character(*), intent(in) :: line

         lines = lines//newline//prefix//line
      end subroutine add

      !> A name, its unit and its value, such as ', rms_height[mm] = 0.1'.
      pure function number(name, unit, value) result(text)
         character(*), intent(in) :: name, unit
         real(dp), intent(in) :: value
         character(:), allocatable :: text

         text = ', '//name//'['//unit//'] = '//text_of(value)
      end function number

      pure function text_of(value) result(text)
         real(dp), intent(in) :: value
         character(:), allocatable :: text

         text = short_number(value)
         if (prefix /= '') text = exact_number(value)
      end function text_of

   end function head_lines

   !> The changes that were made to a height map, in one line; empty if there are none.
   pure function preparation_words(changes, length_unit) result(words)
      type(map_changes), intent(in) :: changes
      character(*), intent(in) :: length_unit   !! label of the unit of lengths
      character(:), allocatable :: words

      character(:), allocatable :: trend

      words = ''
      if (changes%head_lines > 0) words = 'without a head of '//counted(changes%head_lines, 'line')//' in words'
      if (changes%uneven_steps(2) > 0.0_dp) words = clauses(words, 'resampled to '// &
         integer_text(changes%points(1))//' points '//short_number(changes%step)//' apart, which are '// &
         short_number(changes%uneven_steps(1))//' to '//short_number(changes%uneven_steps(2))// &
         ' apart in the file ['//length_unit//']')
      if (changes%cropped_from(1) > 0) words = clauses(words, 'cropped from '// &
         integer_text(changes%cropped_from(1))//' x '//integer_text(changes%cropped_from(2))//' points')
      if (changes%spikes > 0) words = clauses(words, counted(changes%spikes, 'spike')// &
                                              ' replaced by the median of the heights around')
      if (changes%detrend /= 'none') then
         trend = 'mean'
         if (changes%detrend == 'quadratic') trend = 'quadratic trend'
         if (changes%detrend == 'plane') trend = 'plane'
         if (changes%detrend == 'lines') trend = 'rows'' medians'
         words = clauses(words, 'without its '//trend)
         if (all(changes%detrend /= ['mean ', 'lines'])) then
            words = words//', which rises by '//short_number(changes%rise(1))
            if (changes%points(2) > 1) words = words//' along x and '//short_number(changes%rise(2))//' along y'
            words = words//' ['//length_unit//']'
         end if
      end if
      if (changes%filled > 0) words = clauses(words, counted(changes%filled, 'missing height')//' filled ('// &
                                              percent(real(changes%filled, dp)/product(changes%points))//')')
      if (changes%edges == 'mirror') words = clauses(words, 'continued by its mirror images')
      if (changes%edges == 'free') words = clauses(words, 'with free edges: nothing continues it')
      if (changes%edges == 'window') words = clauses(words, 'tapered at its borders, which changes '// &
                                                    percent(changes%tapered)//' of its points')
      if (changes%short_wavelength > 0.0_dp) &
         words = clauses(words, without_waves('shorter', changes%short_wavelength, changes%rms_of_short))
      if (changes%long_wavelength > 0.0_dp) &
         words = clauses(words, without_waves('longer', changes%long_wavelength, changes%rms_of_long))

   contains

      !> Words about waves that were left out.
      pure function without_waves(which, wavelength, rms) result(words)
         character(*), intent(in) :: which   !! 'shorter' or 'longer' than the wavelength
         real(dp), intent(in) :: wavelength, rms
         character(:), allocatable :: words

         words = 'without waves '//which//' than '//short_number(wavelength)//' ['//length_unit//']'
         if (changes%filter == 'gaussian') words = words//' (Gaussian filter)'
         words = words//', whose rms was '//short_number(rms)//' ['//length_unit//']'
      end function without_waves

   end function preparation_words

   !> A number of things in words, such as '1 line' or '3 lines'.
   pure function counted(number, noun) result(words)
      integer, intent(in) :: number
      character(*), intent(in) :: noun   !! in the singular
      character(:), allocatable :: words

      words = integer_text(number)//' '//noun
      if (number /= 1) words = words//'s'
   end function counted

end module wavycon_head_lines
