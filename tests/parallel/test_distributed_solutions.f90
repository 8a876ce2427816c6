!> Edges, measures and solutions of grids that are distributed over the ranks beside those of the same grids whole on
!> each rank: equal to the last bit. Grids solved to an accuracy, loads by area and gap and a hardness are in
!> test_same_tables.py.
!>
!> `mpirun -n N test_distributed_solutions` prints a line for each subject, and ends with status 1 if one of them fails.
program test_distributed_solutions
   use, intrinsic :: iso_fortran_env, only: int64
   use rank_checks, only: check, end_checks, report, same
   use wavycon_constants, only: pi
   use wavycon_contact_solution, only: contact_solution
   use wavycon_grid_area, only: corrected_area_fraction, counted_area_fraction, edge_crossings, grid_contact_area
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_grid_edge, only: grid_edge, start_grid_edge
   use wavycon_grid_error, only: unresolved_errors
   use wavycon_grid_peak, only: grid_peak_pressure
   use wavycon_grid_plan, only: fits_memory
   use wavycon_grid_slab, only: grid_slab, least_distributed_points
   use wavycon_grid_source, only: grid_source
   use wavycon_kept_solution, only: pack_solution, unpack_solution
   use wavycon_kinds, only: dp
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_own_waves, only: gather_series
   use wavycon_ranks, only: is_first_rank, rank_count, work_alone
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_wave_surfaces, only: wave_2d, wave_sum
   implicit none (type, external)

   !> Grids that are distributed over two ranks or more.
   integer, parameter :: grids(2, 4) = reshape([256, 256, 509, 257, 2048, 40, 1024, 160], [2, 4])

   call start_mpi()
   call test_edges()
   call test_peaks()
   call test_memory()
   call test_given_grids()
   call test_maps()
   call end_checks()

contains

   subroutine test_edges()
      ! Fields with an edge everywhere, also between slabs and across the rims, and fields without a gap.
      real(dp), parameter :: levels(3) = [0.0_dp, 0.9_dp, -2.0_dp], stiffness(2) = [1.0_dp, 3.0_dp]
      type(grid_edge) :: spread_edge, whole_edge
      type(grid_slab) :: slab
      type(surface_type) :: surface
      real(dp), allocatable :: field(:, :)
      integer :: even, i, k

      surface = wave_2d(1.0_dp, 1.0_dp, 1.0_dp)
      do k = 1, size(grids, 2)
         call slab%start(grids(:, k))
         call check(slab%is_distributed .eqv. rank_count() > 1)
         do i = 1, size(levels)
            do even = 0, 1
               field = rough_field(grids(:, k)) - levels(i)
               call start_grid_edge(whole_edge, max(field, 0.0_dp), max(-field, 0.0_dp), even == 1, stiffness)
               associate (own => field(:, slab%first:slab%last))
                  call start_grid_edge(spread_edge, max(own, 0.0_dp), max(-own, 0.0_dp), even == 1, stiffness, slab)
               end associate
               call spread_edge%fetch_neighbours()
               call check(same([grid_contact_area(spread_edge)], [grid_contact_area(whole_edge)]))
               call check(edge_crossings(spread_edge) == edge_crossings(whole_edge))
               call check(same([counted_area_fraction(spread_edge), corrected_area_fraction(spread_edge)], &
                               [counted_area_fraction(whole_edge), corrected_area_fraction(whole_edge)]))
               call check(same(unresolved_errors(surface, spread_edge, .false.), &
                               unresolved_errors(surface, whole_edge, .false.)))
            end do
         end do
      end do
      call report('edges')
   end subroutine test_edges

   !> Waves of a few points and longer ones, none of them periodic on the grid, between -1.7 and 1.7.
   function rough_field(points) result(field)
      integer, intent(in) :: points(2)
      real(dp), allocatable :: field(:, :)

      integer :: i, j

      allocate (field(points(1), points(2)))
      do j = 1, points(2)
         field(:, j) = [(sin(0.37_dp*i + 0.21_dp*j) + 0.5_dp*cos(0.93_dp*j - 0.11_dp*i) + 0.2_dp*sin(1.0_dp*i*j), &
                         i=1, points(1))]
      end do
   end function rough_field

   subroutine test_peaks()
      ! A crest about every few columns, so that it and its 6 x 6 points lie on each side of each rim of a slab; two
      ! points of the largest pressure; and a spot of one point.
      type(grid_slab) :: slab
      real(dp), allocatable :: field(:, :)
      integer :: even, j, k

      do k = 1, size(grids, 2)
         call slab%start(grids(:, k))
         do even = 0, 1
            do j = 1, grids(2, k), 3
               field = crest(grids(:, k), [30.3_dp, j + 0.4_dp])
               call compare_peaks(field, even == 1, slab)
            end do
            ! Two points of the same pressure, whose neighbours differ.
            field = max(crest(grids(:, k), [30.3_dp, 7.4_dp]), crest(grids(:, k), [60.0_dp, grids(2, k) - 8.0_dp]))
            field(60, grids(2, k) - 8) = field(30, 7)
            call compare_peaks(field, even == 1, slab)
            field = -1.0_dp
            field(5, grids(2, k)/2) = 1.0_dp
            call compare_peaks(field, even == 1, slab)
         end do
      end do
      call report('peaks')
   end subroutine test_peaks

   !> A hill of ten points' radius.
   pure function crest(points, place) result(field)
      integer, intent(in) :: points(2)
      real(dp), intent(in) :: place(2)
      real(dp), allocatable :: field(:, :)

      integer :: i, j

      allocate (field(points(1), points(2)))
      do j = 1, points(2)
         field(:, j) = [(100.0_dp - (i - place(1))**2 - 0.7_dp*(j - place(2))**2, i=1, points(1))]
      end do
   end function crest

   subroutine compare_peaks(field, even, slab)
      real(dp), intent(in) :: field(:, :)
      logical, intent(in) :: even
      type(grid_slab), intent(in) :: slab

      type(grid_edge) :: spread_edge, whole_edge
      real(dp) :: peaks(2)
      logical :: resolved(2)

      call start_grid_edge(whole_edge, max(field, 0.0_dp), max(-field, 0.0_dp), even)
      call grid_peak_pressure(whole_edge, peaks(1), resolved(1))
      associate (own => field(:, slab%first:slab%last))
         call start_grid_edge(spread_edge, max(own, 0.0_dp), max(-own, 0.0_dp), even, slab=slab)
      end associate
      call spread_edge%fetch_neighbours()
      call grid_peak_pressure(spread_edge, peaks(2), resolved(2))
      call check(same(peaks(:1), peaks(2:)))
      call check(resolved(1) .eqv. resolved(2))
   end subroutine compare_peaks

   subroutine test_memory()
      call check(fits_memory([512, 512]))
      call check(.not. fits_memory([1000000, 1000000]))
      call report('memory')
   end subroutine test_memory

   subroutine test_given_grids()
      ! Even and not, with sides of different lengths, with ranks that have no columns.
      real(dp), parameter :: loads(2) = [0.003_dp, 0.97_dp]
      integer :: i

      do i = 1, size(loads)
         call compare(wave_2d(1.0_dp, 1.0_dp, 1.7_dp), loads(i), [512, 1024])
         call compare(tilted_waves(), loads(i), [270, 386])
         call compare(tilted_waves(), loads(i), [2048, 40])
      end do
      call report('given grids')
   end subroutine test_given_grids

   subroutine test_maps()
      ! Rough maps on their own points, fewer and more: the gap and the region of contact have no order. One is
      ! mirrored, with an odd number of columns.
      integer, parameter :: points(2, 2) = reshape([288, 256, 300, 263], [2, 2])
      real(dp), allocatable :: height(:, :)
      type(grid_slab) :: slab
      type(surface_type) :: spread_surface, surface
      integer :: k

      do k = 1, 2
         height = rough_field(points(:, k))
         call slab%start(points(:, k))
         spread_surface = surface_of_points([1.0_dp, 0.8_dp], height(:, slab%first:slab%last), k == 2, points(:, k))
         call check(spread_surface%is_distributed() .eqv. rank_count() > 1)
         call work_alone(.true.)
         surface = surface_of_points([1.0_dp, 0.8_dp], height, k == 2)
         call work_alone(.false.)
         call check(same([surface%amplitude, surface%crest, surface%full_contact_peak, surface%crest_curvature], &
                         [spread_surface%amplitude, spread_surface%crest, spread_surface%full_contact_peak, &
                          spread_surface%crest_curvature]))
         call compare(surface, 0.05_dp, points(:, k), spread_surface)
         call compare(surface, 0.6_dp, points(:, k)/2, spread_surface)
         call compare(surface, 0.6_dp, 2*points(:, k), spread_surface)
         call gather_series(spread_surface%shape, first_only=.true.)
         if (is_first_rank()) call check(same([spread_surface%shape%c], [surface%shape%c]))
      end do
      call report('maps')
   end subroutine test_maps

   !> A sum of waves without mirror symmetry.
   type(surface_type) function tilted_waves()
      tilted_waves = wave_sum([1.0_dp, 1.3_dp], [1.0_dp, 0.5_dp, 0.2_dp], [1, 2, 3], [1, -2, 0], &
                              pi/180*[10.0_dp, 50.0_dp, 30.0_dp])
   end function tilted_waves

   !> Solves a load on grids that are whole and on grids that are distributed, compares numbers and fields, and sends
   !> the fields through a checkpoint.
   subroutine compare(surface, load, points, spread_surface)
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: load
      integer, intent(in) :: points(2)
      type(surface_type), intent(in), optional :: spread_surface   !! the same surface, if it is distributed too

      type(grid_contact) :: solver
      type(contact_solution) :: again
      type(contact_solution) :: spread_solution, whole_solution
      integer(int64), allocatable :: packed(:)
      logical :: complete, understood

      call solver%start(surface, grid_options(points=points), keep_fields=.true.)
      call work_alone(.true.)
      call solver%solve(load, whole_solution)
      call work_alone(.false.)
      if (present(spread_surface)) call solver%start(spread_surface, grid_options(points=points), &
                                                     keep_fields=.true.)
      call solver%solve(load, spread_solution)
      call check(whole_solution%is_good())
      call check(whole_solution%status == spread_solution%status)
      call check(same(numbers(whole_solution), numbers(spread_solution)))
      call pack_solution(spread_solution, packed)
      call unpack_solution(packed, .false., again, complete, understood)
      call check(understood .and. complete)
      call check_spread(spread_solution, whole_solution)
      call check_spread(again, whole_solution)
      call again%collect_fields()
      call check(again%distributed_points() == 0)
      if (is_first_rank() .or. spread_solution%distributed_points() == 0) then
         call check(same([field_of(again)], [field_of(whole_solution)]))
      else
         call check(.not. allocated(again%source))
      end if
   end subroutine compare

   !> Checks the columns that this rank has of a grid that is distributed, if it is large enough to be.
   subroutine check_spread(solution, whole_solution)
      type(contact_solution), intent(in) :: solution, whole_solution

      real(dp), allocatable :: whole(:, :)

      whole = field_of(whole_solution)
      call check((solution%distributed_points() > 0) .eqv. &
                 (rank_count() > 1 .and. size(whole, kind=int64) >= least_distributed_points))
      select type (source => solution%source)
      type is (grid_source)
         associate (slab => source%edge%slab)
            call check(same([source%edge%pressure_or_gap], [whole(:, slab%first:slab%last)]))
         end associate
      end select
   end subroutine check_spread

   !> Pressure, or minus the gap, at the points that this rank has.
   function field_of(solution) result(field)
      type(contact_solution), intent(in) :: solution
      real(dp), allocatable :: field(:, :)

      allocate (field(0, 0))
      select type (source => solution%source)
      type is (grid_source)
         field = source%edge%pressure_or_gap
      end select
   end function field_of

   !> The numbers of a solution that tables show.
   function numbers(solution) result(values)
      type(contact_solution), intent(in) :: solution
      real(dp), allocatable :: values(:)

      associate (m => solution%measures)
         values = [solution%pbar_over_pstar, m%mean_gap_over_amplitude, m%approach_over_amplitude, &
                   m%contact_area_fraction, m%peak_pressure_over_pstar, m%min_pressure_over_pstar, m%errors(), &
                   m%area_at_hardness_fraction, m%contact_area_counted_fraction, m%contact_area_corrected_fraction, &
                   real(solution%active_constraints, dp), real(solution%iterations, dp), solution%residual]
      end associate
   end function numbers

end program test_distributed_solutions
