!> Fills the holes of a height map by Laplace's equation: (M3) of README.md in this directory.
!>
!> The unknowns are the missing heights alone. Conjugate gradients solve the equations, from straight lines on (M4).
module wavycon_fill_missing
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_error, only: error_type, exit_file_trouble, fatal_error
   use wavycon_kinds, only: dp
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: escaped
   use wavycon_system, only: has_memory_for
   implicit none (type, external)
   private

   public :: fill_holes

   !> Iterations between two evaluations of the residual from the heights. Holes take fewer than ten times their width.
   integer, parameter :: most_iterations = 20000

contains

   !> Fills all holes by the solution of Laplace's equation (M3), the surface of least slope (rms) through the heights
   !> around them: it has no hill and no valley within a hole. Errors: exit_file_trouble without memory.
   subroutine fill_holes(source, step, periodic, map, error)
      character(*), intent(in) :: source          !! of the map, for the message
      real(dp), intent(in) :: step(2)             !! between points along x and y, in one unit, > 0
      logical, intent(in) :: periodic             !! whether the map is continued periodically; if not, holes at its
                                                  !! border end there with slope zero across it
      type(measured_map), intent(inout) :: map    !! with at least one height that is there; `missing` is deallocated
      type(error_type), allocatable, intent(out) :: error

      !> Real numbers for each height, and for each missing one.
      integer(int64), parameter :: numbers_a_height = 4, numbers_a_hole = 6
      real(dp), allocatable :: filled(:, :)
      integer :: there(2)
      real(dp) :: datum, unit

      if (.not. has_memory_for(numbers_a_hole*count(map%missing) + numbers_a_height*size(map%missing))) then
         call fatal_error(error, exit_file_trouble, escaped(source)//': there is not the memory to fill its holes')
         return
      end if
      ! Heights over one of them: those of a flat map are zero. Products of tiny ones would vanish.
      there = findloc(map%missing, .false.)
      datum = map%height(there(1), there(2))
      filled = merge(0.0_dp, map%height - datum, map%missing)
      unit = maxval(abs(filled))
      if (unit > 0.0_dp) then
         filled = filled/unit
         call start_on_lines(map%missing, filled)
         call solve(map%missing, (minval(step)/step)**2, periodic, filled)
      end if
      map%height = merge(datum + unit*filled, map%height, map%missing)
      deallocate (map%missing)
   end subroutine fill_holes

   !> Starts the missing heights on straight lines along x between those that are there (M4). Before the first and after
   !> the last of a column they are level; a column without any continues the one before.
   pure subroutine start_on_lines(missing, height)
      logical, intent(in) :: missing(:, :)
      real(dp), intent(inout) :: height(:, :)   !! zero where it is missing

      integer :: i, j, k, last

      do j = 1, size(height, 2)
         last = 0
         do i = 1, size(height, 1)
            if (missing(i, j)) cycle
            associate (from => height(merge(last, i, last > 0), j))
               do k = last + 1, i - 1
                  height(k, j) = from + (height(i, j) - from)*(k - last)/(i - last)
               end do
            end associate
            last = i
         end do
         if (last > 0) height(last + 1:, j) = height(last, j)
         if (last == 0 .and. j > 1) height(:, j) = height(:, j - 1)
      end do
   end subroutine start_on_lines

   !> Conjugate gradients, from the heights that are there, until the residual of (M3) is rounding.
   subroutine solve(missing, weight, periodic, height)
      logical, intent(in) :: missing(:, :)      !! shape (M, N)
      real(dp), intent(in) :: weight(2)         !! of neighbours along x and y, up to 1
      logical, intent(in) :: periodic           !! whether the last points are neighbours of the first
      real(dp), intent(inout) :: height(:, :)   !! of order 1; only the missing heights change

      real(dp), parameter :: goal = 4*epsilon(goal)
      real(dp), allocatable :: direction(:), field(:, :), image(:), residual(:), value(:)
      integer, allocatable :: place(:, :)       ! of each missing height, its indices along x and y
      real(dp) :: last, largest, square, square_before, step
      integer :: i, iteration, j

      value = pack(height, missing)
      allocate (direction, image, residual, mold=value)
      allocate (place(2, size(value)))
      place(1, :) = pack(spread([(i, i=1, size(missing, 1))], 2, size(missing, 2)), missing)
      place(2, :) = pack(spread([(j, j=1, size(missing, 2))], 1, size(missing, 1)), missing)
      allocate (field(size(height, 1), size(height, 2)), source=0.0_dp)
      last = huge(last)
      do
         call apply(value, place, weight, periodic, height, image)
         residual = -image
         largest = maxval(abs(residual))
         ! A residual that no longer falls is rounding.
         if (largest <= goal .or. largest > 0.5_dp*last) return
         last = largest
         direction = 0.0_dp
         square_before = 1.0_dp
         do iteration = 1, most_iterations
            square = sum(residual**2)
            direction = residual + square/square_before*direction
            call apply(direction, place, weight, periodic, field, image)
            step = square/dot_product(direction, image)
            value = value + step*direction
            residual = residual - step*image
            square_before = square
            if (maxval(abs(residual)) <= 0.5_dp*goal) exit
         end do
      end do
   end subroutine solve

   !> Sets the missing points of a field, and computes the left-hand side of (M3) there.
   subroutine apply(value, place, weight, periodic, field, image)
      real(dp), intent(in) :: value(:)
      integer, intent(in) :: place(:, :)        !! shape (2, n)
      real(dp), intent(in) :: weight(2)
      logical, intent(in) :: periodic
      real(dp), intent(inout) :: field(:, :)
      real(dp), intent(out) :: image(:)

      integer :: next_x(0:size(field, 1) + 1), next_y(0:size(field, 2) + 1)
      integer :: k, n

      ! Beyond a border is the other side or, without it, the last point itself, whose difference is zero.
      next_x = [merge(size(field, 1), 1, periodic), (k, k=1, size(field, 1)), merge(1, size(field, 1), periodic)]
      next_y = [merge(size(field, 2), 1, periodic), (k, k=1, size(field, 2)), merge(1, size(field, 2), periodic)]
      do n = 1, size(value)
         field(place(1, n), place(2, n)) = value(n)
      end do
      do n = 1, size(value)
         associate (i => place(1, n), j => place(2, n), here => value(n))
            image(n) = weight(1)*((here - field(next_x(i - 1), j)) + (here - field(next_x(i + 1), j))) &
                     + weight(2)*((here - field(i, next_y(j - 1))) + (here - field(i, next_y(j + 1))))
         end associate
      end do
   end subroutine apply

end module wavycon_fill_missing
