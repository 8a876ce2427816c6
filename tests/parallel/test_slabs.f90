!> Grids that are distributed over the ranks beside the same grids whole on each rank: equal to the last bit.
!>
!> `mpirun -n N test_slabs` prints a line for each subject, and ends with status 1 if one of them fails. Grids and slabs
!> are chosen for 1 to 5 ranks: all the same size, odd, ranks without columns, of the least width.
program test_slabs
   use, intrinsic :: iso_fortran_env, only: int64
   use rank_checks, only: check, end_checks, report, same
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab, most_reach, strip_columns
   use wavycon_kinds, only: dp, sp
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_ranks, only: rank_count, this_rank, work_alone
   implicit none (type, external)

   !> Those that are distributed over two ranks or more, and two that never are: one too narrow, one too small.
   integer, parameter :: distributed_grids(2, 4) = reshape([256, 256, 509, 257, 2048, 40, 1024, 160], [2, 4])
   integer, parameter :: whole_grids(2, 2) = reshape([2048, 36, 300, 200], [2, 2])

   call start_mpi()
   call test_layouts()
   call test_sums()
   call test_neighbours()
   call test_gathered_grids()
   call test_fetched_columns()
   call test_row_exchange()
   call end_checks()

contains

   subroutine test_layouts()
      type(grid_slab) :: coarse, slab
      integer :: k

      do k = 1, size(distributed_grids, 2)
         call slab%start(distributed_grids(:, k))
         call check(slab%is_distributed .eqv. rank_count() > 1)
         call check(slab%total_count(int(slab%columns(), int64)) == distributed_grids(2, k))
         call check(slab%columns() == 0 .or. slab%columns() >= most_reach)
         if (slab%columns() > 0) then
            call check(slab%first == this_rank()*slab%width + 1)
            call check(mod(slab%first - 1, strip_columns) == 0)
         end if
         if (mod(distributed_grids(2, k), 2) == 0) then
            coarse = slab%coarser()
            call check(2*coarse%first - 1 == slab%first .and. coarse%columns() == slab%columns()/2)
         end if
         call work_alone(.true.)
         call slab%start(distributed_grids(:, k))
         call work_alone(.false.)
         call check(.not. slab%is_distributed)
         call check(slab%columns() == distributed_grids(2, k))
      end do
      do k = 1, size(whole_grids, 2)
         call slab%start(whole_grids(:, k))
         call check(.not. slab%is_distributed)
         call check(slab%columns() == whole_grids(2, k))
      end do
      call report('slabs')
   end subroutine test_layouts

   subroutine test_sums()
      type(grid_slab) :: slab
      real(dp), allocatable :: columns(:, :), strips(:, :), whole(:, :)
      integer :: k, s

      do k = 1, size(distributed_grids, 2)
         call slab%start(distributed_grids(:, k))
         whole = numbers(distributed_grids(:, k))
         columns = reshape([sum(whole, dim=1), sum(whole**2, dim=1)], [2, size(whole, 2)], order=[2, 1])
         allocate (strips(1, (size(whole, 2) - 1)/strip_columns + 1))
         do s = 1, size(strips, 2)
            strips(1, s) = sum(whole(:, (s - 1)*strip_columns + 1:min(s*strip_columns, size(whole, 2))))
         end do
         call check(same(slab%column_totals(columns(:, slab%first:slab%last)), sum(columns, dim=2)))
         s = (slab%first - 1)/strip_columns
         call check(same(slab%strip_totals(strips(:, s + 1:s + slab%strips())), sum(strips, dim=2)))
         associate (own => whole(:, slab%first:slab%last))
            call check(slab%total_count(count(own < 0.3_dp, kind=int64)) == count(whole < 0.3_dp))
            call check(same(slab%largest([maxval([0.0_dp, own])]), [maxval(whole)]))
         end associate
         deallocate (strips)
      end do
      call report('sums, counts and extremes')
   end subroutine test_sums

   subroutine test_neighbours()
      integer, parameter :: reaches(3) = [1, 3, most_reach]
      type(grid_slab) :: slab
      real(dp), allocatable :: high(:, :), low(:, :), whole(:, :)
      real(sp), allocatable :: high_single(:, :), low_single(:, :), single(:, :)
      integer, allocatable :: before(:), behind(:)
      integer :: even, k, l, r

      do k = 1, size(distributed_grids, 2)
         call slab%start(distributed_grids(:, k))
         whole = numbers(distributed_grids(:, k))
         single = real(whole, sp)
         do l = 1, size(reaches)
            r = reaches(l)
            allocate (low(size(whole, 1), r), high(size(whole, 1), r))
            allocate (low_single(size(whole, 1), r), high_single(size(whole, 1), r))
            do even = 0, 1
               low = -1.0_dp
               high = -1.0_dp
               call slab%halo(whole(:, slab%first:slab%last), even == 1, low, high)
               call slab%halo(single(:, slab%first:slab%last), even == 1, low_single, high_single)
               if (slab%columns() > 0) then
                  before = places(slab%first - r, slab%first - 1, slab, even == 1)
                  behind = places(slab%last + 1, slab%last + r, slab, even == 1)
                  call check(same([low], [whole(:, before)]) .and. same([high], [whole(:, behind)]))
                  call check(same(real([low_single, high_single], dp), &
                                  real([single(:, before), single(:, behind)], dp)))
               else
                  call check(all(low < 0.0_dp) .and. all(high < 0.0_dp))
               end if
            end do
            deallocate (low, high, low_single, high_single)
         end do
      end do
      call report('neighbours')
   end subroutine test_neighbours

   !> The columns of the grid that continue it, from one to another.
   function places(first, last, slab, even)
      integer, intent(in) :: first, last
      type(grid_slab), intent(in) :: slab
      logical, intent(in) :: even
      integer, allocatable :: places(:)

      integer :: j

      places = [(image_of_point(j, slab%points(2), even), j=first, last)]
   end function places

   subroutine test_gathered_grids()
      type(grid_slab) :: slab
      real(dp), allocatable :: all_columns(:, :), gathered(:, :), whole(:, :)
      integer :: k

      do k = 1, size(distributed_grids, 2)
         call slab%start(distributed_grids(:, k))
         whole = numbers(distributed_grids(:, k))
         if (slab%is_distributed) then
            allocate (all_columns, mold=whole)
            call slab%gather(8*size(whole, 1), whole(:, slab%first:slab%last), all_columns, first_only=.false.)
            call check(same([all_columns], [whole]))
            deallocate (all_columns)
         end if
         call slab%gather_whole(whole(:, slab%first:slab%last), gathered, first_only=.true.)
         call check(allocated(gathered) .eqv. this_rank() == 0)
         if (allocated(gathered)) call check(same([gathered], [whole]))
      end do
      call report('gathered grids')
   end subroutine test_gathered_grids

   subroutine test_fetched_columns()
      ! Wanted columns overlap and some ranks want none: rank r the columns 7r to N/2 + 20r or N + 1, the image.
      type(grid_slab) :: slab
      real(dp), allocatable :: wanted(:, :), whole(:, :)
      integer :: first, j, k, last, n, rank
      logical :: even

      rank = this_rank()
      first = 7*rank
      do k = 0, 2*size(distributed_grids, 2) - 1
         even = mod(k, 2) == 0
         associate (grid => distributed_grids(:, 1 + k/2))
            call slab%start(grid)
            whole = numbers(grid)
         end associate
         n = size(whole, 2)
         last = merge(min(n/2 + 20*rank, n + 1), first - 1, rank /= 1)
         if (rank == rank_count() - 1 .and. rank > 1) last = n + 1
         allocate (wanted(size(whole, 1), first:last))
         call slab%fetch(whole(:, slab%first:slab%last), even, first, wanted)
         do j = first, last
            call check(same(wanted(:, j), whole(:, image_of_point(j, n, even))))
         end do
         deallocate (wanted)
      end do
      call report('fetched columns')
   end subroutine test_fetched_columns

   subroutine test_row_exchange()
      ! Columns and rows of the matrix; some ranks have no rows, others no columns.
      integer, parameter :: matrices(2, 5) = reshape([96, 7, 65, 33, 160, 2, 33, 64, 257, 129], [2, 5])
      type(grid_slab) :: slab
      type(grid_slab) :: rows
      real(dp), allocatable :: back(:, :, :), by_columns(:, :, :), by_rows(:, :, :), whole(:, :, :)
      integer :: k, number

      if (rank_count() == 1) return
      do k = 1, 2*size(matrices, 2)
         number = 1 + mod(k, 2)
         associate (matrix => matrices(:, (k + 1)/2))
            call slab%divide([1, matrix(1)])
            call rows%divide([1, matrix(2)])
            whole = reshape(numbers([number*matrix(2), matrix(1)]), [number, matrix(2), matrix(1)])
         end associate
         by_columns = whole(:, :, slab%first:slab%last)
         allocate (by_rows(number, rows%columns(), size(whole, 3)))
         allocate (back, mold=by_columns)
         call slab%exchange_rows(rows, 8*number, by_columns, by_rows, to_rows=.true.)
         whole = whole(:, rows%first:rows%last, :)
         call check(same(pack(by_rows, .true.), pack(whole, .true.)))
         call slab%exchange_rows(rows, 8*number, back, by_rows, to_rows=.false.)
         call check(same(pack(back, .true.), pack(by_columns, .true.)))
         deallocate (by_rows, back)
      end do
      call report('columns and rows')
   end subroutine test_row_exchange

   !> Numbers spread evenly over 0 .. 1, of the shape of a grid.
   pure function numbers(points)
      integer, intent(in) :: points(2)
      real(dp), allocatable :: numbers(:, :)

      integer :: i, j

      allocate (numbers(points(1), points(2)))
      do j = 1, points(2)
         do i = 1, points(1)
            numbers(i, j) = modulo(0.754877666_dp*i + 0.569840291_dp*j, 1.0_dp)
         end do
      end do
   end function numbers

end program test_slabs
