!> Edges and peaks of grids that are distributed over the ranks beside those of the same grids whole on each rank: equal
!> to the last bit. Solutions are in test_same_tables.py.
!>
!> `mpirun -n N test_distributed_edges` prints a line for each subject, and ends with status 1 if one of them fails.
program test_distributed_edges
   use rank_checks, only: check, end_checks, report, same
   use wavycon_grid_area, only: corrected_area_fraction, counted_area_fraction, edge_crossings, edge_spread, &
      grid_contact_area
   use wavycon_grid_edge, only: grid_edge, start_grid_edge
   use wavycon_grid_error, only: unresolved_errors
   use wavycon_grid_peak, only: grid_peak_pressure
   use wavycon_grid_plan, only: fits_memory
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_ranks, only: rank_count
   use wavycon_surface, only: surface_type
   use wavycon_wave_surfaces, only: wave_2d, wave_sum
   implicit none (type, external)

   !> Grids that are distributed over two ranks or more.
   integer, parameter :: grids(2, 4) = reshape([256, 256, 509, 257, 2048, 40, 1024, 160], [2, 4])

   call start_mpi()
   call test_edges()
   call test_peaks()
   call test_memory()
   call end_checks()

contains

   subroutine test_edges()
      ! Fields with an edge everywhere, also between slabs and across the rims, and fields without a gap.
      real(dp), parameter :: levels(3) = [0.0_dp, 0.9_dp, -2.0_dp], stiffness(2) = [1.0_dp, 3.0_dp]
      type(grid_edge) :: spread_edge, whole_edge
      type(grid_slab) :: slab
      type(surface_type) :: ridges, surface
      real(dp), allocatable :: field(:, :)
      integer :: even, i, k

      surface = wave_2d(1.0_dp, 1.0_dp, 1.0_dp)
      ridges = wave_sum([1.0_dp, 1.0_dp], [1.0_dp], [1], [9], [0.5_dp])
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
               call check(same([edge_spread(spread_edge)], [edge_spread(whole_edge)]))
               call check(same([counted_area_fraction(spread_edge), corrected_area_fraction(spread_edge)], &
                               [counted_area_fraction(whole_edge), corrected_area_fraction(whole_edge)]))
               call check(same(unresolved_errors(surface, spread_edge, 1.0_dp), &
                               unresolved_errors(surface, whole_edge, 1.0_dp)))
               call check(same(unresolved_errors(ridges, spread_edge, 1.0_dp), &
                               unresolved_errors(ridges, whole_edge, 1.0_dp)))
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
      real(dp) :: bends(2), peaks(2)

      call start_grid_edge(whole_edge, max(field, 0.0_dp), max(-field, 0.0_dp), even)
      call grid_peak_pressure(whole_edge, peaks(1), bends(1))
      associate (own => field(:, slab%first:slab%last))
         call start_grid_edge(spread_edge, max(own, 0.0_dp), max(-own, 0.0_dp), even, slab=slab)
      end associate
      call spread_edge%fetch_neighbours()
      call grid_peak_pressure(spread_edge, peaks(2), bends(2))
      call check(same(peaks(:1), peaks(2:)))
      call check(same(bends(:1), bends(2:)))
   end subroutine compare_peaks

   subroutine test_memory()
      call check(fits_memory([512, 512]))
      call check(.not. fits_memory([1000000, 1000000]))
      call report('memory')
   end subroutine test_memory

end program test_distributed_edges
