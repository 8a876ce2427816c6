!> Grids that are distributed over the ranks beside the same grids whole on each rank: equal to the last bit.
!>
!> `mpirun -n N test_slabs` prints a line for each subject, and ends with status 1 if one of them fails. Grids and slabs
!> are chosen for 1 to 5 ranks: all the same size, odd, ranks without columns, of the least width.
program test_slabs
   use, intrinsic :: iso_c_binding, only: c_bool
   use, intrinsic :: iso_fortran_env, only: int64
   use rank_checks, only: check, end_checks, report
   use wavycon_multilevel_preconditioner, only: multilevel_preconditioner
   use wavycon_contact_region, only: contact_region
   use wavycon_grid_refinement, only: refine_pressure
   use wavycon_grid_points, only: image_of_point
   use wavycon_grid_slab, only: grid_slab, most_reach, strip_columns
   use wavycon_kinds, only: dp, sp
   use wavycon_local_stiffness, only: local_stiffness
   use wavycon_mpi_ranks, only: start_mpi
   use wavycon_ranks, only: add_over_ranks, comm, rank_count, row_exchange, this_rank, work_alone
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_wave_surfaces, only: wave_2d
   implicit none (type, external)

   !> Those that are distributed over two ranks or more, and two that never are: one too narrow, one too small.
   integer, parameter :: distributed_grids(2, 4) = reshape([256, 256, 509, 257, 2048, 40, 1024, 160], [2, 4])
   integer, parameter :: whole_grids(2, 2) = reshape([2048, 36, 300, 200], [2, 2])

   !> Whether two arrays are equal to the last bit.
   interface same
      procedure :: same_line, same_grid, same_single
   end interface same

   call start_mpi()
   call test_layouts()
   call test_sums()
   call test_neighbours()
   call test_gathered_grids()
   call test_fetched_columns()
   call test_first_rank()
   call test_row_exchange()
   call test_extension()
   call test_stencil()
   call test_refinement()
   call end_checks()

contains

   subroutine test_layouts()
      type(grid_slab) :: coarse, slab
      integer(int64) :: columns(1)
      integer :: k

      do k = 1, size(distributed_grids, 2)
         call slab%start(distributed_grids(:, k))
         columns = slab%columns()
         call slab%add(columns)
         call check(slab%is_distributed .eqv. rank_count() > 1)
         call check(columns(1) == distributed_grids(2, k))
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
      real(dp) :: most(1)
      integer(int64) :: number(1)
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
            number = count(own < 0.3_dp)
            most = maxval([0.0_dp, own])
         end associate
         call slab%add(number)
         call slab%largest(most)
         call check(number(1) == count(whole < 0.3_dp))
         call check(same(most, [maxval(whole)]))
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
                  call check(same(low, whole(:, before)) .and. same(high, whole(:, behind)))
                  call check(same(low_single, single(:, before)) .and. same(high_single, single(:, behind)))
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
      real(dp), allocatable :: all_columns(:, :), whole(:, :)
      real(sp), allocatable :: all_single(:, :), single(:, :)
      integer :: k

      do k = 1, size(distributed_grids, 2)
         call slab%start(distributed_grids(:, k))
         whole = numbers(distributed_grids(:, k))
         single = real(whole, sp)
         allocate (all_columns, mold=whole)
         allocate (all_single, mold=single)
         call slab%gather(whole(:, slab%first:slab%last), all_columns)
         call slab%gather(single(:, slab%first:slab%last), all_single)
         call check(same(all_columns, whole))
         call check(same(all_single, single))
         deallocate (all_columns, all_single)
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
            call check(same(wanted(:, j:j), whole(:, image_of_point(j, n, even):image_of_point(j, n, even))))
         end do
         deallocate (wanted)
      end do
      call report('fetched columns')
   end subroutine test_fetched_columns

   subroutine test_first_rank()
      type(grid_slab) :: slab
      real(dp), allocatable :: gathered(:, :), whole(:, :)
      integer :: k

      do k = 1, size(distributed_grids, 2)
         call slab%start(distributed_grids(:, k))
         whole = numbers(distributed_grids(:, k))
         call slab%gather_to_first(whole(:, slab%first:slab%last), gathered)
         call check(allocated(gathered) .eqv. this_rank() == 0)
         if (allocated(gathered)) call check(same(gathered, whole))
      end do
      call report('grids gathered to the first rank')
   end subroutine test_first_rank

   subroutine test_row_exchange()
      ! Columns and rows of the matrix; some ranks have no rows, others no columns.
      integer, parameter :: matrices(2, 5) = reshape([96, 7, 65, 33, 160, 2, 33, 64, 257, 129], [2, 5])
      class(row_exchange), allocatable :: exchange
      real(dp), allocatable :: back(:, :, :), by_columns(:, :, :), by_rows(:, :, :), whole(:, :, :)
      real(sp), allocatable :: back_single(:, :, :), single(:, :, :)
      integer(int64) :: all_rows(1)
      integer :: k, number, width

      do k = 1, 2*size(matrices, 2)
         number = 1 + mod(k, 2)
         associate (columns => matrices(1, (k + 1)/2), rows => matrices(2, (k + 1)/2))
            width = strip_columns*(((columns - 1)/strip_columns)/rank_count() + 1)
            whole = reshape(numbers([number*rows, columns]), [number, rows, columns])
            associate (first => min(this_rank()*width, columns) + 1, last => min((this_rank() + 1)*width, columns))
               by_columns = whole(:, :, first:last)
               call comm%new_row_exchange(columns, rows, width, number, dp, exchange)
               call check(exchange%own_columns == last - first + 1)
            end associate
            all_rows = exchange%own_rows
            call add_over_ranks(all_rows)
            call check(all_rows(1) == rows)
            allocate (by_rows(number, exchange%own_rows, columns))
            call exchange%to_rows(by_columns, by_rows)
            whole = whole(:, exchange%first_row:exchange%first_row + exchange%own_rows - 1, :)
            call check(same(pack(by_rows, .true.), pack(whole, .true.)))
            allocate (back, mold=by_columns)
            call exchange%to_columns(by_rows, back)
            call check(same(pack(back, .true.), pack(by_columns, .true.)))
            call comm%new_row_exchange(columns, rows, width, number, sp, exchange)
            allocate (single(number, exchange%own_rows, columns), back_single(number, rows, exchange%own_columns))
            call exchange%to_rows(real(by_columns, sp), single)
            call check(same(real(pack(single, .true.), dp), real(real(pack(whole, .true.), sp), dp)))
            call exchange%to_columns(single, back_single)
            call check(same(real(pack(back_single, .true.), dp), real(real(pack(by_columns, .true.), sp), dp)))
         end associate
         deallocate (by_rows, back, single, back_single)
      end do
      call report('columns and rows')
   end subroutine test_row_exchange

   subroutine test_extension()
      ! Without coarser grids; with small ones only; with some that are distributed, all of them or not.
      integer, parameter :: grids(2, 6) = reshape([509, 257, 256, 256, 2048, 40, 1024, 160, 802, 666, 2048, 640], &
                                                  [2, 6])
      type(grid_slab) :: slab
      real(sp), allocatable, dimension(:, :) :: contact, collected, extended, own_collected, own_contact, own_extended
      integer :: k
      logical :: even

      do k = 1, 2*size(grids, 2)
         even = mod(k, 2) == 0
         associate (points => grids(:, (k + 1)/2))
            collected = real(numbers(points), sp)
            contact = merge(1.0_sp, 0.0_sp, collected < 0.2_sp)
            extended = contact*collected
            call slab%start(points)
            own_collected = collected(:, slab%first:slab%last)
            own_contact = contact(:, slab%first:slab%last)
            own_extended = extended(:, slab%first:slab%last)
            call extend_and_collect(points, even, own_contact, own_extended, own_collected)
            call work_alone(.true.)
            call extend_and_collect(points, even, contact, extended, collected)
            call work_alone(.false.)
         end associate
         call check(same(own_extended, extended(:, slab%first:slab%last)))
         call check(same(own_collected, collected(:, slab%first:slab%last)))
      end do
      call report('extension of the contact')
   end subroutine test_extension

   subroutine extend_and_collect(points, even, contact, extended, collected)
      integer, intent(in) :: points(2)
      logical, intent(in) :: even
      real(sp), intent(in), contiguous :: contact(:, :)
      real(sp), intent(inout), contiguous :: extended(:, :), collected(:, :)

      type(multilevel_preconditioner) :: extension

      call extension%start(points, even)
      call extension%set_contact(contact)
      call extension%extend(contact, extended)
      call extension%collect(contact, collected)
   end subroutine extend_and_collect

   subroutine test_stencil()
      ! Contact at the rims only, so that some ranks have none of it.
      type(surface_type) :: surfaces(2)
      type(grid_slab) :: slab
      real(dp) :: height(64, 60)
      real(sp), allocatable :: own(:, :), whole(:, :)
      logical(c_bool), allocatable :: inside(:, :)
      integer :: k, n

      height = numbers(shape(height))
      surfaces(1) = surface_of_points([1.0_dp, 1.0_dp], height)
      surfaces(2) = wave_2d(1.0_dp, 1.0_dp, 1.0_dp)
      do k = 1, 4
         n = merge(256, 320, k > 2)
         whole = real(numbers([n, n]), sp)
         inside = whole < 0.4_sp
         inside(:, 50:n - 20) = .false.
         call slab%start([n, n])
         own = whole(:, slab%first:slab%last)
         call apply_stencil(surfaces(1 + mod(k, 2)), [n, n], inside(:, slab%first:slab%last), own)
         call work_alone(.true.)
         call apply_stencil(surfaces(1 + mod(k, 2)), [n, n], inside, whole)
         call work_alone(.false.)
         call check(same(own, whole(:, slab%first:slab%last)))
      end do
      call report('stencil')
   end subroutine test_stencil

   !> Displacements to pressures at the points of a region; others keep their values.
   subroutine apply_stencil(surface, points, inside, field)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: points(2)
      logical(c_bool), intent(in) :: inside(:, :)
      real(sp), intent(inout) :: field(:, :)

      type(contact_region) :: region
      type(local_stiffness) :: stencil
      real(sp), allocatable :: vector(:)

      call region%start(inside)
      allocate (vector(region%points))
      call region%gather(field, vector)
      call stencil%start(surface, points)
      call stencil%apply(region, points, vector)
      call region%scatter(vector, field)
   end subroutine apply_stencil

   subroutine test_refinement()
      ! From grids that are whole on each rank, and from grids that are distributed. Slabs of the finer grid are not
      ! twice those of the coarser one.
      integer, parameter :: grids(2, 6) = reshape([128, 128, 1024, 40, 256, 256, 509, 257, 1024, 96, 512, 416], [2, 6])
      type(grid_slab) :: coarse_slab, fine_slab
      real(dp), allocatable :: coarse(:, :), fine(:, :), own(:, :)
      integer :: k
      logical :: even

      do k = 1, 2*size(grids, 2)
         even = mod(k, 2) == 0
         associate (points => grids(:, (k + 1)/2))
            coarse = numbers(points)
            call coarse_slab%start(points)
            call fine_slab%start(2*points)
            call check(fine_slab%is_distributed .eqv. rank_count() > 1)
            call check(coarse_slab%is_distributed .eqv. (rank_count() > 1 .and. k > 4))
            own = coarse(:, coarse_slab%first:coarse_slab%last)
            call refine_pressure(own, coarse_slab, even, fine_slab, fine)
            own = fine
            associate (first => fine_slab%first, last => fine_slab%last)
               call work_alone(.true.)
               call coarse_slab%start(points)
               call fine_slab%start(2*points)
               call refine_pressure(coarse, coarse_slab, even, fine_slab, fine)
               call work_alone(.false.)
               call fine_slab%start(2*points)
               call check(same(own, fine(:, first:last)))
            end associate
         end associate
      end do
      call report('refinement')
   end subroutine test_refinement

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

   pure logical function same_line(a, b)
      real(dp), intent(in) :: a(:), b(:)

      same_line = size(a) == size(b)
      if (same_line) same_line = all(abs(a - b) <= 0.0_dp)
   end function same_line

   pure logical function same_grid(a, b)
      real(dp), intent(in) :: a(:, :), b(:, :)

      same_grid = all(shape(a) == shape(b))
      if (same_grid) same_grid = all(abs(a - b) <= 0.0_dp)
   end function same_grid

   pure logical function same_single(a, b)
      real(sp), intent(in) :: a(:, :), b(:, :)

      same_single = same_grid(real(a, dp), real(b, dp))
   end function same_single

end program test_slabs
