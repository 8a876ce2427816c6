!> The &load group: the loads to solve for, by mean pressure, mean gap or contact area.
module wavycon_load_group
   use wavycon_deck_writer, only: deck_writer_type
   use wavycon_group_input, only: group_input_type
   use wavycon_key_table, only: integer_key, key_group, key_group_type, real_key
   use wavycon_kinds, only: dp
   use wavycon_problems, only: problem_list_type
   implicit none (type, external)
   private

   public :: load_group_type, load_table, read_load_group, write_load_group

   !> What the loads are given by.
   integer, parameter, public :: by_pressure = 1, by_mean_gap = 2, by_contact_area = 3

   !> What &load says. Exactly one of the lists is allocated in a deck read.
   type :: load_group_type
      real(dp), allocatable :: pbar_over_pstar(:)   !! mean pressures over p* [-]; a sweep fills it too
      real(dp), allocatable :: mean_pressure(:)     !! mean pressures [unit of e_star]
      real(dp), allocatable :: mean_gap_over_amplitude(:)   !! mean gaps over that before load [-]
      real(dp), allocatable :: mean_gap(:)                  !! mean gaps [length]
      real(dp), allocatable :: contact_area_fraction(:)     !! parts of the nominal area [-]
      integer :: sweep_steps = 0                    !! number of loads of a sweep; 0 where none was given
      real(dp) :: sweep_from = 0, sweep_to = 0      !! its ends, over p* [-]
   contains
      procedure :: given_by
   end type load_group_type

   !> Contact is complete at 1; a load beyond this is a slip, most likely of units.
   real(dp), parameter, public :: largest_pbar_over_pstar = 1.0e6_dp

   integer, parameter :: most_loads = 100000

   character(11), parameter :: sweep_keys(*) = ['sweep_from ', 'sweep_to   ', 'sweep_steps']
   character(*), parameter :: forms = &
      'pbar_over_pstar, mean_pressure, mean_gap_over_amplitude, mean_gap or contact_area_fraction, or '// &
      'sweep_from, sweep_to and sweep_steps'
   character(23), parameter :: lists(*) = [character(23) :: 'pbar_over_pstar', 'mean_pressure', &
                                           'mean_gap_over_amplitude', 'mean_gap', 'contact_area_fraction']

contains

   function load_table() result(table)
      type(key_group_type) :: table

      table = key_group('load', 'the loads to solve for: a list of one kind, or a sweep', [ &
         real_key('pbar_over_pstar', '', '-', &
            'Mean pressures over p*, the mean pressure that just closes the gap everywhere.', &
            least=0.0_dp, most=largest_pbar_over_pstar, most_values=most_loads), &
         real_key('mean_pressure', '', 'unit of e_star', 'Mean pressures, over the nominal area.', &
            least=0.0_dp, most_values=most_loads), &
         real_key('mean_gap_over_amplitude', '', '-', &
            'Mean gaps over the mean gap before load, the amplitude of a wave; the loads that leave them '// &
            'are found.', &
            least=0.0_dp, most=1.0_dp, most_values=most_loads), &
         real_key('mean_gap', '', 'length', 'Mean gaps; the loads that leave them are found.', least=0.0_dp, &
            most_values=most_loads), &
         real_key('contact_area_fraction', '', '-', &
            'Parts of the nominal area in contact; the loads that make them are found.', &
            least=0.0_dp, most=1.0_dp, most_values=most_loads), &
         real_key('sweep_from', '', '-', 'First mean pressure over p* of a sweep in equal steps.', &
            least=0.0_dp, most=largest_pbar_over_pstar), &
         real_key('sweep_to', '', '-', 'Last mean pressure over p* of the sweep, above or below the first.', &
            least=0.0_dp, most=largest_pbar_over_pstar), &
         integer_key('sweep_steps', '', &
            'Number of loads of the sweep, both ends included; 1 only if the ends are equal.', &
            1, most_loads)], required=.true.)
   end function load_table

   subroutine read_load_group(input, group, problems)
      type(group_input_type), intent(in) :: input
      type(load_group_type), intent(out) :: group
      type(problem_list_type), intent(inout) :: problems

      real(dp), allocatable :: contact_area_fraction(:), mean_gap(:), mean_gap_over_amplitude(:), &
                               mean_pressure(:), pbar_over_pstar(:)
      real(dp) :: sweep_from, sweep_to
      integer :: i, status, sweep_steps
      logical :: has_sweep
      character(200) :: message
      namelist /load/ pbar_over_pstar, mean_pressure, mean_gap_over_amplitude, mean_gap, &
         contact_area_fraction, sweep_from, sweep_to, sweep_steps

      allocate (pbar_over_pstar(input%values_of('pbar_over_pstar')), &
                mean_pressure(input%values_of('mean_pressure')), &
                mean_gap_over_amplitude(input%values_of('mean_gap_over_amplitude')), &
                mean_gap(input%values_of('mean_gap')), &
                contact_area_fraction(input%values_of('contact_area_fraction')), source=0.0_dp)
      sweep_from = group%sweep_from
      sweep_to = group%sweep_to
      sweep_steps = group%sweep_steps
      read (input%record, nml=load, iostat=status, iomsg=message)
      if (status /= 0) call problems%add(input%place, trim(message))

      has_sweep = .false.
      do i = 1, size(sweep_keys)
         has_sweep = has_sweep .or. input%has(sweep_keys(i))
      end do
      call check_forms()

      if (has_sweep) then
         group%sweep_from = sweep_from
         group%sweep_to = sweep_to
         group%sweep_steps = sweep_steps
         if (sweep_is_good()) group%pbar_over_pstar = sweep(group)
      else if (input%has('mean_pressure')) then
         group%mean_pressure = mean_pressure
      else if (input%has('mean_gap_over_amplitude')) then
         group%mean_gap_over_amplitude = mean_gap_over_amplitude
      else if (input%has('mean_gap')) then
         group%mean_gap = mean_gap
      else if (input%has('contact_area_fraction')) then
         group%contact_area_fraction = contact_area_fraction
      else
         group%pbar_over_pstar = pbar_over_pstar
      end if

   contains

      subroutine check_forms()
         integer :: k, ways

         ways = count([has_sweep, (input%has(trim(lists(k))), k=1, size(lists))])
         if (input%place > 0 .and. ways == 0) call problems%add(input%place, '&load needs '//forms)
         if (ways > 1) then
            call problems%add(input%place, 'loads are given in more than one way: give '//forms)
            return
         end if
         if (.not. has_sweep) return
         do k = 1, size(sweep_keys)
            if (.not. input%has(sweep_keys(k))) call problems%add(place_of_sweep(), &
               'a sweep needs '//trim(sweep_keys(k))//' too')
         end do
      end subroutine check_forms

      integer function place_of_sweep()
         integer :: k

         place_of_sweep = input%place
         do k = size(sweep_keys), 1, -1
            if (input%has(sweep_keys(k))) place_of_sweep = input%place_of(sweep_keys(k))
         end do
      end function place_of_sweep

      logical function sweep_is_good()
         integer :: k

         sweep_is_good = .false.
         do k = 1, size(sweep_keys)
            if (.not. input%has(sweep_keys(k)) .or. input%is_bad(sweep_keys(k))) return
         end do
         sweep_is_good = sweep_steps > 1 .or. .not. abs(sweep_to - sweep_from) > 0
         if (.not. sweep_is_good) call problems%add(input%place_of('sweep_steps'), &
            'sweep_steps = 1 leaves out sweep_to: the ends count as loads; give at least 2')
      end function sweep_is_good

   end subroutine read_load_group

   subroutine write_load_group(group, writer)
      type(load_group_type), intent(in) :: group
      type(deck_writer_type), intent(inout) :: writer

      call writer%open_group(load_table())
      if (group%sweep_steps > 0) then
         call writer%put('sweep_from', group%sweep_from)
         call writer%put('sweep_to', group%sweep_to)
         call writer%put('sweep_steps', group%sweep_steps)
      else if (allocated(group%mean_pressure)) then
         call writer%put('mean_pressure', group%mean_pressure)
      else if (allocated(group%mean_gap_over_amplitude)) then
         call writer%put('mean_gap_over_amplitude', group%mean_gap_over_amplitude)
      else if (allocated(group%mean_gap)) then
         call writer%put('mean_gap', group%mean_gap)
      else if (allocated(group%contact_area_fraction)) then
         call writer%put('contact_area_fraction', group%contact_area_fraction)
      else
         call writer%put('pbar_over_pstar', group%pbar_over_pstar)
      end if
      call writer%close_group()
   end subroutine write_load_group

   !> One of the names above.
   pure integer function given_by(self)
      class(load_group_type), intent(in) :: self

      given_by = by_pressure
      if (allocated(self%mean_gap_over_amplitude) .or. allocated(self%mean_gap)) given_by = by_mean_gap
      if (allocated(self%contact_area_fraction)) given_by = by_contact_area
   end function given_by

   !> The loads of a sweep, equally spaced; the ends are met exactly.
   pure function sweep(group) result(loads)
      type(load_group_type), intent(in) :: group
      real(dp) :: loads(group%sweep_steps)

      integer :: i, intervals

      intervals = max(1, group%sweep_steps - 1)
      do i = 1, group%sweep_steps
         loads(i) = (group%sweep_from*(intervals - i + 1) + group%sweep_to*(i - 1))/intervals
      end do
      loads(group%sweep_steps) = group%sweep_to
      loads(1) = group%sweep_from
   end function sweep

end module wavycon_load_group
