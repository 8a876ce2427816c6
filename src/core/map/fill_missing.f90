!> Fills the holes of a height map by the solution of Laplace's equation: (M3) of README.md in this directory.
!>
!> The unknowns are the missing heights alone. The equations are solved by conjugate gradients, which start from
!> straight lines along x, (M4).
module wavycon_fill_missing
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp, int64
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: fill_holes

   !> Most iterations before the residual is computed anew from the heights. A hole takes fewer iterations than ten
   !> times its width in points.
   integer, parameter :: most_iterations = 20000

contains

   !> Fills all holes by the solution of Laplace's equation, (M3). Of all surfaces through the heights around a hole it
   !> has the least rms slope, and it has no hill and no valley inside the hole. Errors: exit_file_trouble if there is
   !> not enough memory.
   subroutine fill_holes(source, step, periodic, map, error)
      character(*), intent(in) :: source          !! name of the map, for the message
      real(dp), intent(in) :: step(2)             !! steps between points along x and y, in one unit, > 0
      !> Whether the map is continued periodically. If not, the slope across the border of the map is zero at a hole
      !> there.
      logical, intent(in) :: periodic
      !> On entry at least one height is not missing. On exit all heights are set, and `missing` is deallocated.
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      !> Memory in real numbers: for each height, and for each missing one.
      integer(int64), parameter :: numbers_a_height = 4, numbers_a_hole = 6
      real(dp), allocatable :: filled(:, :)
      integer :: first(2)
      real(dp) :: datum, unit

      if (.not. has_memory_for(numbers_a_hole*count(map%missing) + numbers_a_height*size(map%missing))) then
         call fatal_error(error, exit_file_trouble, escaped(source)//': there is not the memory to fill its holes')
         return
      end if
      ! Solve for the heights less one of them, in units of the largest difference. So a flat map stays exactly flat,
      ! and products of tiny heights do not underflow.
      first = findloc(map%missing, .false.)
      datum = map%height(first(1), first(2))
      filled = map%height - datum
      where (map%missing) filled = 0.0_dp
      unit = maxval(abs(filled))
      if (unit > 0.0_dp) then
         filled = filled/unit
         call start_on_lines(map%missing, filled)
         call solve(map%missing, (minval(step)/step)**2, periodic, filled)
      end if
      where (map%missing) map%height = datum + unit*filled
      deallocate (map%missing)
   end subroutine fill_holes

   !> Sets the missing heights to start values: on straight lines along x between the heights that are there, (M4).
   !> Before the first and after the last of these the line is level. A line along x without any height gets the values
   !> of the line before; the first such lines keep zeros.
   pure subroutine start_on_lines(missing, height)
      logical, intent(in) :: missing(:, :)      !! shape (M, N)
      real(dp), intent(inout) :: height(:, :)   !! on entry zero where a height is missing

      real(dp) :: level
      integer :: i, j, k, last   ! last: number along x of the last height that is there, 0 if there is none yet

      do j = 1, size(height, 2)
         last = 0
         do i = 1, size(height, 1)
            if (missing(i, j)) cycle
            level = height(i, j)
            if (last > 0) level = height(last, j)
            do k = last + 1, i - 1
               height(k, j) = level + (height(i, j) - level)*(k - last)/(i - last)
            end do
            last = i
         end do
         if (last > 0) height(last + 1:, j) = height(last, j)
         if (last == 0 .and. j > 1) height(:, j) = height(:, j - 1)
      end do
   end subroutine start_on_lines

   !> Solves (M3) for the missing heights by conjugate gradients, until the residual is rounding or stops falling.
   subroutine solve(missing, weight, periodic, height)
      logical, intent(in) :: missing(:, :)      !! shape (M, N)
      real(dp), intent(in) :: weight(2)         !! 1/d^2 of the steps d along x and y, over the larger one
      logical, intent(in) :: periodic           !! whether the last points are neighbours of the first
      !> The heights, of order 1. The missing ones are start values on entry and the solution on exit.
      real(dp), intent(inout) :: height(:, :)

      real(dp), parameter :: goal = 4*epsilon(goal)   ! of the largest residual
      real(dp), allocatable :: direction(:), field(:, :), image(:), residual(:), value(:)
      integer, allocatable :: point(:, :)       ! numbers along x and y of each missing height, shape (2, n)
      real(dp) :: last, largest, square, square_before, step
      integer :: i, iteration, j

      value = pack(height, missing)
      allocate (direction, image, residual, mold=value)
      allocate (point(2, size(value)))
      point(1, :) = pack(spread([(i, i=1, size(missing, 1))], 2, size(missing, 2)), missing)
      point(2, :) = pack(spread([(j, j=1, size(missing, 2))], 1, size(missing, 1)), missing)
      allocate (field(size(height, 1), size(height, 2)), source=0.0_dp)
      last = huge(last)
      do
         call apply(value, point, weight, periodic, height, image)
         residual = -image
         largest = maxval(abs(residual))
         ! The residual is recomputed from the heights. If it is not half of the last one, it has reached rounding.
         if (largest <= goal .or. largest > 0.5_dp*last) return
         last = largest
         direction = 0.0_dp
         square_before = 1.0_dp
         do iteration = 1, most_iterations
            square = sum(residual**2)
            direction = residual + square/square_before*direction
            call apply(direction, point, weight, periodic, field, image)
            step = square/dot_product(direction, image)
            value = value + step*direction
            residual = residual - step*image
            square_before = square
            if (maxval(abs(residual)) <= 0.5_dp*goal) exit
         end do
      end do
   end subroutine solve

   !> Sets the missing points of a field to given values, and computes minus the left-hand side of (M3) at these points.
   subroutine apply(value, point, weight, periodic, field, image)
      real(dp), intent(in) :: value(:)          !! values at the n missing points
      integer, intent(in) :: point(:, :)        !! their numbers along x and y, shape (2, n)
      real(dp), intent(in) :: weight(2)         !! as of `solve`
      logical, intent(in) :: periodic           !! as of `solve`
      real(dp), intent(inout) :: field(:, :)    !! shape (M, N)
      real(dp), intent(out) :: image(:)         !! sum of weight times (value - neighbour), at the n points

      integer :: next_x(0:size(field, 1) + 1), next_y(0:size(field, 2) + 1), k, n

      ! Beyond a border there is the point itself, whose difference from itself is zero, or in a periodic map the point
      ! on the other side.
      next_x = [1, (k, k=1, size(field, 1)), size(field, 1)]
      next_y = [1, (k, k=1, size(field, 2)), size(field, 2)]
      if (periodic) next_x = [size(field, 1), (k, k=1, size(field, 1)), 1]
      if (periodic) next_y = [size(field, 2), (k, k=1, size(field, 2)), 1]
      do n = 1, size(value)
         field(point(1, n), point(2, n)) = value(n)
      end do
      do n = 1, size(value)
         associate (i => point(1, n), j => point(2, n), here => value(n))
            image(n) = weight(1)*((here - field(next_x(i - 1), j)) + (here - field(next_x(i + 1), j))) &
                     + weight(2)*((here - field(i, next_y(j - 1))) + (here - field(i, next_y(j + 1))))
         end associate
      end do
   end subroutine apply

end module wavycon_fill_missing
