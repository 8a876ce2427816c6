!> Times what the ranks of wavycon-mpi do in an iteration, for tests/bench/scaling.py.
!>
!>    mpirun -n RANKS bench_ranks DECK SECONDS
!>
!> DECK gives a height map that is made or read, and loads as mean pressures. SECONDS are spent on each part. All
!> times are those of the slowest rank [s]. The lines of standard output:
!>
!>    grid POINTS_X POINTS_Y RANKS COLUMNS
!>       COLUMNS: of the first rank. POINTS_X is even
!>    part NAME MEDIAN LEAST REPEATS
!>       a part of an iteration on all points; `rows` is one of the two exchanges of `pair`, a pair of transforms
!>    load P AREA ITERATIONS TIME PAIRS STEPS ALL
!>       AREA: fraction of the points in contact. On the last grid the iterations, the time of one, its pairs of
!>       transforms, those of them in double precision. ALL: the time of all grids
program bench_ranks
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use grid_clock, only: equal_iterations, grid_iterations, grid_solved_at, grid_started, grid_times, &
      start_grid_clock, wall_clock
   use samples, only: sample_set
   use wavycon_compliance_operator, only: compliance_operator
   use wavycon_contact_extension, only: contact_extension
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type
   use wavycon_grid_cascade, only: cascade_answer, solve_by_cascade
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_make_scene, only: make_scene
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_ranks, only: end_ranks, is_first_rank, largest_over_ranks, new_row_exchange, rank_count, &
      row_exchange
   use wavycon_read_deck, only: read_deck
   use wavycon_scene, only: scene_type
   implicit none (type, external)

   !> The parts of an iteration.
   integer, parameter :: pair = 1, rows = 2, extension = 3, vectors = 4, sums = 5, halo = 6
   character(*), parameter :: names(*) = [character(9) :: 'pair', 'rows', 'extension', 'vectors', 'sums', 'halo']
   !> Columns that the stencil and the edge need of each neighbour.
   integer, parameter :: reach = 3
   !> Sums that one message carries.
   integer, parameter :: sums_together = 3

   type(scene_type) :: scene
   type(grid_slab) :: slab
   type(compliance_operator) :: half_space
   type(contact_extension) :: extender
   class(row_exchange), allocatable :: exchange
   real(sp), allocatable :: contact(:, :), field(:, :), low(:, :), high(:, :), lines(:, :)
   real(dp) :: seconds
   integer :: i, part

   call start_mpi()
   call read_arguments(scene, seconds)
   associate (points => scene%surface%points)
      call slab%start(points)
      call half_space%start(scene%surface, points)
      call extender%start(points, scene%surface%shape%is_even())
      if (slab%is_spread) &
         call new_row_exchange(points(2), points(1)/2, slab%width, 2, sp, exchange)
      if (is_first_rank()) write (output_unit, '(a,4(1x,i0))') 'grid', points, rank_count(), slab%columns()
   end associate
   call make_fields()
   do part = 1, size(names)
      if (slab%is_spread .or. all(part /= [rows, sums, halo])) call measure_part(part)
   end do
   deallocate (contact, field, low, high)
   if (allocated(lines)) deallocate (lines)
   do i = 1, size(scene%target)
      call measure_load(scene%target(i))
   end do
   call end_ranks(0)

contains

   subroutine read_arguments(scene, seconds)
      type(scene_type), intent(out) :: scene
      real(dp), intent(out) :: seconds

      character(1000) :: argument(2)
      type(deck_type) :: deck
      type(error_type), allocatable :: error
      integer :: i

      if (command_argument_count() /= size(argument)) call stop_with('usage: bench_ranks DECK SECONDS')
      do i = 1, size(argument)
         call get_command_argument(i, argument(i))
      end do
      read (argument(2), *) seconds
      call read_deck(trim(argument(1)), deck, error)
      if (allocated(error)) call stop_with(error%message)
      call make_scene(deck, scene)
      if (.not. scene%surface%is_height_map()) call stop_with('bench_ranks: the surface is no height map')
   end subroutine read_arguments

   !> Half of the points are in contact, in stripes of 8 columns; no value is zero.
   subroutine make_fields()
      integer :: j

      associate (m => slab%points(1))
         allocate (contact(m, slab%columns()), field(m, slab%columns()))
         allocate (low(m, reach), high(m, reach), source=0.0_sp)
         if (slab%is_spread) allocate (lines(2*exchange%own_rows, exchange%columns))
      end associate
      do j = 1, slab%columns()
         contact(:, j) = merge(1.0_sp, 0.0_sp, modulo(j - 1, 16) < 8)
      end do
      call extender%set_contact(contact)
   end subroutine make_fields

   !> Repeats a part until its time is up, and tells the median.
   subroutine measure_part(part)
      integer, intent(in) :: part

      !> Of an even number of times `median` is the later one in the middle.
      integer, parameter :: least_repeats = 5
      type(sample_set) :: times
      real(dp) :: start, spent, time(1)

      ! A rehearsal: plans are made, and memory is touched.
      field = contact
      call do_part(part)
      spent = 0.0_dp
      do while (spent < seconds .or. times%count < least_repeats)
         field = contact
         call wait_for_all()
         start = wall_clock()
         call do_part(part)
         time = wall_clock() - start
         call largest_over_ranks(time)
         call times%add(time(1))
         spent = spent + time(1)
      end do
      if (is_first_rank()) write (output_unit, '(2a,2es12.4,1x,i0)') 'part ', names(part), times%median(), &
         times%least(), times%count
   end subroutine measure_part

   !> All ranks leave at about the same time.
   subroutine wait_for_all()
      real(dp) :: nothing(1)

      nothing = 0.0_dp
      call largest_over_ranks(nothing)
   end subroutine wait_for_all

   subroutine do_part(part)
      integer, intent(in) :: part

      real(dp) :: parts(sums_together, slab%strips()), totals(sums_together)
      select case (part)
      case (pair)
         call half_space%displacement(field)
      case (rows)
         call exchange%to_rows(field, lines)
      case (extension)
         call extender%extend(contact, field)
         call extender%collect(contact, field)
      case (vectors)
         field = field - 0.5_sp*contact
      case (sums)
         parts = 1.0_dp
         totals = slab%strip_totals(parts)
      case (halo)
         call slab%halo(field, .false., low, high)
      end select
   end subroutine do_part

   subroutine measure_load(load)
      real(dp), intent(in) :: load   !! P

      type(cascade_answer) :: answer
      type(grid_times) :: times
      real(dp) :: start

      start = wall_clock()
      call start_grid_clock()
      call solve_by_cascade(scene%surface, load, 0.0_dp, scene%surface%points, answer, times, &
                            scene%method%real('residual'))
      if (.not. answer%state%converged) call stop_with('bench_ranks: a load has not converged')
      if (is_first_rank()) write (output_unit, '(a,2es12.4,1x,i0,3es12.4,f10.3)') 'load', load, answer%counted_area, &
         grid_iterations, (grid_solved_at - grid_started)/grid_iterations, answer%transform_pairs/equal_iterations, &
         real(answer%state%corrections + 1, dp)/grid_iterations, wall_clock() - start
   end subroutine measure_load

   subroutine stop_with(words)
      character(*), intent(in) :: words

      if (is_first_rank()) write (error_unit, '(a)') words
      call end_ranks(1)
      stop 1
   end subroutine stop_with

end program bench_ranks
