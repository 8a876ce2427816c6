!> Height maps that the ranks read from a file together, against the same maps read by each rank alone: heights,
!> preparation and statistics must be the same to the last bit, on any number of ranks, but for a sum over lines.
!>
!> Run by mpirun; the exit status is 1 if a number differs on any rank.
program distributed_map_files
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
   use rank_checks, only: check, end_checks, same
   use wavycon_error, only: error_type
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp, sp
   use wavycon_map_file, only: read_height_map
   use wavycon_map_statistics, only: map_statistics, statistics_of
   use wavycon_measured_map, only: measured_map
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_prepare_map, only: map_changes, map_preparation, prepare_map
   use wavycon_ranks, only: any_rank, is_first_rank, rank_count, work_alone
   use wavycon_self_affine, only: make_heights, self_affine_spectrum
   implicit none (type, external)

   character(*), parameter :: path = 'distributed_map_files.tmp.npy'
   integer, parameter :: points(2) = [311, 260]
   integer :: kind

   call start_mpi()
   do kind = 1, 4
      call write_map(is_double=kind <= 2, by_columns=modulo(kind, 2) == 0, infinite=.false.)
      call compare_maps('none     ', 'periodic')
      call compare_maps('mean     ', 'window  ')
      call compare_maps('plane    ', 'mirror  ')
      call compare_maps('quadratic', 'window  ')
   end do
   call write_map(is_double=.true., by_columns=.true., infinite=.true.)
   call expect_trouble('the height in row 200, column 300 is infinite')
   call write_map(is_double=.false., by_columns=.false., infinite=.true.)
   call expect_trouble('the height in row 200, column 300 is infinite')
   call compare_self_affine([256, 300], 1.0_dp)
   call compare_self_affine([301, 256], 0.7_dp)
   if (is_first_rank()) call remove(path)
   call end_checks()

contains

   !> A map that is read and prepared in both ways.
   subroutine compare_maps(detrend, edges)
      character(*), intent(in) :: detrend, edges

      type(grid_slab) :: slab
      type(map_changes) :: changes(2)
      type(map_statistics) :: statistics(2)
      type(measured_map) :: alone, spread

      call prepared(detrend, edges, spread, changes(2))
      statistics(2) = statistics_of(spread%height, 'npy', spread%points())
      call slab%start(points)
      call check(slab%is_distributed .eqv. rank_count() > 1, 'maps of this size are spread')
      call check(size(spread%height, 2) == slab%columns(), 'own columns')
      call work_alone(.true.)
      call prepared(detrend, edges, alone, changes(1))
      statistics(1) = statistics_of(alone%height, 'npy')
      call work_alone(.false.)
      call check(same([alone%height(:, slab%first:slab%last)], [spread%height]), 'heights '//detrend//edges)
      call check(same([changes(1)%rise, changes(1)%tapered], [changes(2)%rise, changes(2)%tapered]), 'changes')
      call check(same(numbers_of(statistics(1)), numbers_of(statistics(2))), 'statistics')
      call check(abs(statistics(1)%largest_step(1) - statistics(2)%largest_step(1)) <= &
                 1e-15_dp*statistics(1)%largest_step(1), 'largest step along x')
   end subroutine compare_maps

   subroutine prepared(detrend, edges, map, changes)
      character(*), intent(in) :: detrend, edges
      type(measured_map), intent(out) :: map
      type(map_changes), intent(out) :: changes

      type(error_type), allocatable :: error

      call read_height_map(path, 'auto', map, error, in_slabs=.true.)
      call check(.not. allocated(error), 'reading')
      call prepare_map(path, map_preparation(detrend=detrend, edges=edges), [1.0_dp, 0.9_dp], map, changes, error)
      call check(.not. allocated(error), 'preparing')
   end subroutine prepared

   !> All ranks get the error, whichever of them finds it.
   subroutine expect_trouble(words)
      character(*), intent(in) :: words

      type(error_type), allocatable :: error
      type(measured_map) :: map

      call read_height_map(path, 'npy', map, error, in_slabs=.true.)
      call check(allocated(error), 'no error')
      if (allocated(error)) call check(index(error%message, words) > 0, error%message)
   end subroutine expect_trouble

   !> The same surface of one seed.
   subroutine compare_self_affine(grid, length_y)
      integer, intent(in) :: grid(2)
      real(dp), intent(in) :: length_y

      type(grid_slab) :: slab
      type(self_affine_spectrum) :: spectrum
      real(dp), allocatable :: alone(:, :), height(:, :)

      spectrum = self_affine_spectrum(length=[1.0_dp, length_y], shortest=0.02_dp, random_amplitudes=.true., &
                                      by_slope=.true., seed=7)
      call slab%start(grid)
      allocate (height(grid(1), slab%columns()), alone(grid(1), grid(2)))
      call make_heights(spectrum, height, grid)
      call work_alone(.true.)
      call make_heights(spectrum, alone)
      call work_alone(.false.)
      call check(same([alone(:, slab%first:slab%last)], [height]), 'self-affine')
   end subroutine compare_self_affine

   !> Writes heights in numpy's format, on the first rank, while no other reads or writes the file.
   subroutine write_map(is_double, by_columns, infinite)
      logical, intent(in) :: is_double, by_columns, infinite

      character(:), allocatable :: words
      character(80) :: shape_words
      real(dp) :: height(points(1), points(2))
      integer :: i, j, unit

      call wait_for_all()
      do j = 1, points(2)
         do i = 1, points(1)
            height(i, j) = 5 + sin(1.0_dp*i**2 + 7.0_dp*j**2) + 0.01_dp*i - 0.02_dp*j + 1e-4_dp*i*j
         end do
      end do
      if (infinite) height(300, 200) = ieee_value(1.0_dp, ieee_positive_inf)
      if (infinite) height(301, 200) = ieee_value(1.0_dp, ieee_quiet_nan)
      write (shape_words, '(a, i0, a, i0, a)') "'shape': (", points(2), ', ', points(1), '), }'
      words = "{'descr': '<f"//merge('8', '4', is_double)//"', 'fortran_order': "// &
              trim(merge('True ', 'False', by_columns))//', '//trim(shape_words)//new_line('a')
      if (is_first_rank()) then
         open (newunit=unit, file=path, access='stream', form='unformatted', status='replace')
         write (unit) char(147)//'NUMPY'//char(1)//char(0)//char(len(words))//char(0)//words
         if (by_columns) then
            if (is_double) write (unit) transpose(height)
            if (.not. is_double) write (unit) real(transpose(height), sp)
         else
            if (is_double) write (unit) height
            if (.not. is_double) write (unit) real(height, sp)
         end if
         close (unit)
      end if
      call wait_for_all()
   end subroutine write_map

   !> Ends on all ranks after all have begun it.
   subroutine wait_for_all()
      if (any_rank(.false.)) return
   end subroutine wait_for_all

   subroutine remove(file)
      character(*), intent(in) :: file

      integer :: unit

      open (newunit=unit, file=file)
      close (unit, status='delete')
   end subroutine remove

   pure function numbers_of(statistics) result(numbers)
      type(map_statistics), intent(in) :: statistics
      real(dp) :: numbers(10)

      numbers = [statistics%lowest, statistics%highest, statistics%rms, statistics%skewness, statistics%kurtosis, &
                 statistics%largest_step(2), statistics%border_step, statistics%slope_by_differences, &
                 statistics%curvature_by_differences]
   end function numbers_of

end program distributed_map_files
