!> Times the method of Johnson, Greenwood & Higginson (1985) for the two-dimensional wave.
!>
!>    bench_paper_method REFERENCE SECONDS
!>
!> REFERENCE is a table with P and G in its first two columns, SECONDS the time for each comparison. The methods
!> run in turns, so that other load of the machine affects all of them alike.
!> The tables go to standard output as blocks for gnuplot (two empty lines before each but the first).
program bench_paper_method
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use samples, only: clock_ms, sample_set
   use wavycon_beale_contact, only: beale_contact, qp_options
   use wavycon_contact_status, only: status_name, status_of_programme
   use wavycon_fourier_series, only: fourier_series
   use wavycon_fourier_terms, only: symmetry_diagonal, symmetry_full
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_converged, qp_solution
   use wavycon_series_source, only: series_source
   use wavycon_wave_surfaces, only: wave_2d
   implicit none (type, external)

   !> A method to solve for one load, its times at that load and its last solution.
   type :: contender
      integer :: harmonics, points, symmetry
      logical :: straight = .false.      !! by Beale's method from x = 0 at the load itself
      type(beale_contact) :: fresh     !! that has solved nothing yet
      type(sample_set) :: times
      type(qp_solution) :: programme
   end type contender

   !> Least number of rounds of a comparison, however long they take.
   integer, parameter :: least_rounds = 3
   !> Solves of a method in a row: the first of them starts with a cold cache.
   integer, parameter :: solves_in_turn = 4
   !> Ratio of the times with 49 unknowns and 378 constraints and with 29 and 196, as the paper gives it.
   integer, parameter :: ratio_of_paper = 20

   real(dp), allocatable :: loads(:), gaps(:)
   real(dp) :: budget   ! [ms]
   logical :: all_good   ! whether every solution has converged

   call read_arguments()
   all_good = .true.
   call compare_methods()
   call compare_sweep()
   call time_large_series()
   if (.not. all_good) call give_up('some loads were not solved')

contains

   !> The paper's two discretisations, in the usual way and by Beale's method alone; and points on as many
   !> intervals as there are harmonics.
   subroutine compare_methods()
      type(contender) :: contenders(5)
      real(dp) :: medians(size(loads), size(contenders)), leasts(size(loads), size(contenders))
      integer :: i, j, unsolved

      contenders(1) = new_contender(9, 27, symmetry_full)
      contenders(2) = new_contender(9, 27, symmetry_diagonal)
      contenders(3) = new_contender(9, 27, symmetry_full, straight=.true.)
      contenders(4) = new_contender(9, 27, symmetry_diagonal, straight=.true.)
      contenders(5) = new_contender(9, 10, symmetry_full)
      unsolved = 0
      call write_table_head('One load. dual: the dual method, as the program does; beale: Beale''s method from x = 0')
      do i = 1, size(loads)
         call race(contenders, loads(i))
         do j = 1, size(contenders)
            medians(i, j) = contenders(j)%times%median()
            leasts(i, j) = contenders(j)%times%least()
            call write_row(contenders(j), loads(i), gaps(i))
            if (contenders(j)%straight .and. contenders(j)%programme%status /= qp_converged) unsolved = unsolved + 1
         end do
      end do
      if (unsolved > 0) then
         write (output_unit, '(a,i0,a)') '# Beale''s method from x = 0 did not solve ', unsolved, ' of these'
      end if

      call write_head('Means over the loads [ms]: name, of the median times, of the least times')
      associate (median => sum(medians, 1)/size(loads), least => sum(leasts, 1)/size(loads))
         call write_values('29/196', [median(1), least(1)])
         call write_values('49/378', [median(2), least(2)])
         call write_values('49/378 over 29/196', [median(2)/median(1), least(2)/least(1)])
         write (output_unit, '(a,i3)') '#    the paper: about', ratio_of_paper
         call write_values('29/196, Beale from x = 0', [median(3), least(3)])
         call write_values('49/378, Beale from x = 0', [median(4), least(4)])
         call write_values('49/378 over 29/196, Beale from x = 0', [median(4)/median(3), least(4)/least(3)])
         call write_values('29/196, Beale from x = 0 over dual', [median(3)/median(1), least(3)/least(1)])
         call write_values('29/30, points on 9 intervals', [median(5), least(5)])
      end associate
   end subroutine compare_methods

   !> All loads from the highest to the lowest, each from the one before, against each load on its own.
   subroutine compare_sweep()
      type(beale_contact) :: fresh, contact
      type(qp_solution) :: programme
      type(sample_set) :: sweeps, singles
      real(dp) :: before, start
      integer :: i

      call fresh%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), qp_options())
      start = clock_ms()
      do while (clock_ms() - start < budget .or. sweeps%count < least_rounds)
         contact = fresh
         before = clock_ms()
         do i = size(loads), 1, -1
            call contact%solve_programme(loads(i), programme)
         end do
         call sweeps%add(clock_ms() - before)

         before = clock_ms()
         do i = size(loads), 1, -1
            contact = fresh
            call contact%solve_programme(loads(i), programme)
         end do
         call singles%add(clock_ms() - before)
      end do

      call write_head('The sweep of all loads, 29/196 [ms]: name, median, least, largest')
      call write_values('from load to load', [sweeps%median(), sweeps%least(), sweeps%largest()])
      call write_values('each load on its own', [singles%median(), singles%least(), singles%largest()])
      call write_head('The same, ratios: name, of the median times, of the least times')
      associate (ratio => [sweeps%median()/singles%median(), sweeps%least()/singles%least()])
         call write_values('from load to load over each on its own', ratio)
      end associate
   end subroutine compare_sweep

   !> A sweep of the largest series, once.
   subroutine time_large_series()
      real(dp), parameter :: swept(*) = [0.8_dp, 0.6_dp, 0.4_dp, 0.2_dp]
      type(beale_contact) :: contact
      type(qp_solution) :: programme
      real(dp) :: start
      integer :: i

      call contact%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), qp_options(60, 121))
      start = clock_ms()
      do i = 1, size(swept)
         call contact%solve_programme(swept(i), programme)
         all_good = all_good .and. programme%status == qp_converged
      end do
      call write_head('960/3721, mean of four loads from 0.8 to 0.2 [ms]')
      associate (mean => (clock_ms() - start)/size(swept))
         call write_values('from load to load', [mean])
      end associate
   end subroutine time_large_series

   function new_contender(harmonics, points, symmetry, straight) result(new)
      integer, intent(in) :: harmonics, points, symmetry
      logical, intent(in), optional :: straight
      type(contender) :: new

      new%harmonics = harmonics
      new%points = points
      new%symmetry = symmetry
      if (present(straight)) new%straight = straight
      call new%fresh%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), &
                           qp_options(harmonics, points, symmetry, by_beale=new%straight))
   end function new_contender

   !> Solves for one load by every method in turn until the time is over.
   subroutine race(contenders, load)
      type(contender), intent(inout) :: contenders(:)
      real(dp), intent(in) :: load

      real(dp) :: start
      integer :: i, j, round

      do i = 1, size(contenders)
         contenders(i)%times = sample_set()
      end do
      start = clock_ms()
      round = 0
      do while (clock_ms() - start < budget .or. round < least_rounds)
         round = round + 1
         do i = 1, size(contenders)
            do j = 1, solves_in_turn
               call run(contenders(i), load)
            end do
         end do
      end do
   end subroutine race

   subroutine run(self, load)
      type(contender), intent(inout) :: self
      real(dp), intent(in) :: load

      type(beale_contact) :: contact
      real(dp) :: before

      contact = self%fresh
      before = clock_ms()
      call contact%solve_programme(load, self%programme)
      call self%times%add(clock_ms() - before)
   end subroutine run

   subroutine write_table_head(title)
      character(*), intent(in) :: title

      call write_head(title)
      write (output_unit, '(a1,a4,a7,a10,a6,a9,a12,3a7,3a10,2a14,1x,a)') '#', 'n', 'points', 'symmetry', &
         'way', 'unknowns', 'constraints', 'P', 'pivots', 'solves', 'time[ms]', 'least', 'largest', 'G', &
         'error', 'status'
   end subroutine write_table_head

   subroutine write_row(self, load, gap)
      type(contender), intent(inout) :: self
      real(dp), intent(in) :: load
      real(dp), intent(in) :: gap   !! G that the answer is compared with

      type(fourier_series) :: displacement
      type(series_source) :: source
      real(dp) :: own_gap

      own_gap = 1.0_dp
      if (allocated(self%programme%x)) then
         source = self%fresh%series
         source%x = self%programme%x
         displacement = source%displacement()
         own_gap = 1.0_dp - displacement%at(0.0_dp, 0.0_dp)   ! eq. (28)
      end if
      write (output_unit, '(i5,i7,a10,a6,i9,i12,f7.2,2i7,3f10.4,f14.9,es14.3,1x,a)') &
         self%harmonics, self%points, merge('full    ', 'diagonal', self%symmetry == symmetry_full), &
         merge('beale', 'dual ', self%straight), shape(self%fresh%problem%normals), load, self%programme%pivots, &
         self%times%count, self%times%median(), self%times%least(), self%times%largest(), own_gap, &
         own_gap - gap, trim(status_name(status_of_programme(self%programme%status)))
      flush (output_unit)
      all_good = all_good .and. (self%straight .or. self%programme%status == qp_converged)
   end subroutine write_row

   subroutine write_head(title)
      character(*), intent(in) :: title

      logical, save :: first = .true.

      if (.not. first) write (output_unit, '(/)')
      first = .false.
      write (output_unit, '(2a)') '# ', title
   end subroutine write_head

   subroutine write_values(name, values)
      character(*), intent(in) :: name
      real(dp), intent(in) :: values(:)

      character(40) :: quoted

      quoted = '"'//name//'"'
      write (output_unit, '(a,*(f10.4))') quoted, values
      flush (output_unit)
   end subroutine write_values

   subroutine read_arguments()
      character(4096) :: path
      character(200) :: line
      real(dp) :: load, gap
      integer :: unit, failed

      call get_command_argument(2, line)
      read (line, *, iostat=failed) budget
      if (failed /= 0) call give_up('usage: bench_paper_method REFERENCE SECONDS')
      budget = 1000*budget

      call get_command_argument(1, path)
      open (newunit=unit, file=path, status='old', action='read', iostat=failed)
      if (failed /= 0) call give_up('the reference table cannot be opened')
      allocate (loads(0), gaps(0))
      do
         read (unit, '(a)', iostat=failed) line
         if (failed /= 0) exit
         if (line == '' .or. line(1:1) == '#' .or. index(line, 'pbar_over_pstar') > 0) cycle
         read (line, *, iostat=failed) load, gap
         if (failed /= 0) call give_up('a line of the reference table cannot be read')
         loads = [loads, load]
         gaps = [gaps, gap]
      end do
      close (unit)
   end subroutine read_arguments

   subroutine give_up(message)
      character(*), intent(in) :: message

      write (error_unit, '(2a)') 'bench_paper_method: ', message
      stop 1
   end subroutine give_up

end program bench_paper_method
