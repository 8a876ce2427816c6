!> Surfaces whose heights are distributed over the ranks, against the same surfaces that each rank makes by itself:
!> every number must be the same to the last bit, on any number of ranks.
!>
!> Run by mpirun; the exit status is 1 if a number differs on any rank.
program distributed_maps
   use rank_checks, only: check, end_checks, same
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_own_waves, only: gather_series
   use wavycon_ranks, only: rank_count, this_rank, work_alone
   use wavycon_roughness, only: roughness_type
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_undeformed_gap, only: sample_undeformed_gap
   use wavycon_wave_surfaces, only: wave_2d
   implicit none (type, external)

   call start_mpi()
   call compare_maps([512, 256], mirrored=.false.)
   call compare_maps([301, 263], mirrored=.false.)
   call compare_maps([300, 263], mirrored=.true.)
   call compare_maps([1100, 75], mirrored=.false.)
   call compare_waves()
   call end_checks()

contains

   !> A map on its own points, and on coarser and finer ones, odd ones and few.
   subroutine compare_maps(points, mirrored)
      integer, intent(in) :: points(2)
      logical, intent(in) :: mirrored

      type(grid_slab) :: slab
      type(roughness_type) :: roughness(2)
      type(surface_type) :: alone, spread
      real(dp), allocatable :: height(:, :)
      integer :: parts(2)

      call slab%start(points)
      call check(slab%is_distributed .eqv. rank_count() > 1, 'grids of this size are spread')
      height = heights_of(points, slab%first, slab%last)
      spread = surface_of_points([1.0_dp, 0.7_dp], height, mirrored, points)
      roughness(2) = spread%roughness()
      call check(spread%is_distributed() .eqv. rank_count() > 1, 'is_distributed')
      call work_alone(.true.)
      height = heights_of(points, 1, points(2))
      alone = surface_of_points([1.0_dp, 0.7_dp], height, mirrored)
      roughness(1) = alone%roughness()
      call work_alone(.false.)
      call check(.not. alone%is_distributed(), 'not spread')
      call check(same([alone%amplitude, alone%crest, alone%stiffness, alone%full_contact_peak, alone%crest_curvature, &
                       alone%length], &
                      [spread%amplitude, spread%crest, spread%stiffness, spread%full_contact_peak, &
                       spread%crest_curvature, spread%length]), 'numbers of the surface')
      call check(same(numbers_of(roughness(1)), numbers_of(roughness(2))), 'roughness')
      parts = merge(2, 1, mirrored)
      call compare_gaps(alone, spread, points)
      call compare_gaps(alone, spread, points/2)
      call compare_gaps(alone, spread, points/4)
      call compare_gaps(alone, spread, 2*points)
      call compare_gaps(alone, spread, [257, 301])
      call compare_gaps(alone, spread, [64, 7])
      call gather_series(spread%shape, first_only=.true.)
      if (this_rank() == 0) call check(same_shapes(alone, spread), 'shape on the first rank')
      call gather_series(spread%shape, first_only=.true.)
   end subroutine compare_maps

   !> Waves, which are whole on all ranks, on grids that are distributed.
   subroutine compare_waves()
      type(surface_type) :: surface

      surface = wave_2d(1.0_dp, 1.0_dp)
      call compare_gaps(surface, surface, [256, 512])
      call compare_gaps(surface, surface, [257, 301])
   end subroutine compare_waves

   !> The gap of a surface that this rank has, and of the one that all have together.
   subroutine compare_gaps(alone, spread, points)
      type(surface_type), intent(in) :: alone, spread
      integer, intent(in) :: points(2)

      type(grid_slab) :: slab, whole
      real(dp), allocatable :: expected(:, :), h(:, :)

      call slab%start(points)
      allocate (h(points(1), slab%columns()))
      call sample_undeformed_gap(spread, slab, h)
      call work_alone(.true.)
      call whole%start(points)
      allocate (expected(points(1), points(2)))
      call sample_undeformed_gap(alone, whole, expected)
      call work_alone(.false.)
      call check(same([expected(:, slab%first:slab%last)], [h]), 'gap')
   end subroutine compare_gaps

   !> Columns of heights without a pattern.
   function heights_of(points, first, last) result(height)
      integer, intent(in) :: points(2), first, last
      real(dp), allocatable :: height(:, :)

      integer :: i, j

      allocate (height(points(1), last - first + 1))
      do j = first, last
         do i = 1, points(1)
            height(i, j - first + 1) = sin(1.0_dp*i**2 + 7.0_dp*j**2) + 3*cos(6.3_dp*i/points(1) + 12.6_dp*j/points(2))
         end do
      end do
   end function heights_of

   pure function numbers_of(roughness) result(numbers)
      type(roughness_type), intent(in) :: roughness
      real(dp) :: numbers(4)

      numbers = [roughness%height, roughness%slope, roughness%curvature, roughness%frequency_moment]
   end function numbers_of

   logical function same_shapes(a, b)
      type(surface_type), intent(in) :: a, b

      same_shapes = all(shape(a%shape%c) == shape(b%shape%c)) .and. .not. b%is_distributed()
      if (same_shapes) same_shapes = same([a%shape%c], [b%shape%c])
      if (.not. same_shapes .or. a%shape%is_even()) return
      same_shapes = same([a%shape%cs], [b%shape%cs]) .and. same([a%shape%sc], [b%shape%sc]) .and. &
                    same([a%shape%ss], [b%shape%ss])
   end function same_shapes

end program distributed_maps
