!> Fills the holes of a height map by Laplace's equation: (M3) of README.md in this directory.
!>
!> The unknowns are the missing heights alone. Conjugate gradients solve the equations. They start from the solution on
!> a grid of half the points each way, which is found in the same way (M4).
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

      !> Real numbers for each height, and for each missing one, on coarser maps too.
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
         call fill(filled, map%missing, (minval(step)/step)**2, periodic)
      end if
      map%height = merge(datum + unit*filled, map%height, map%missing)
      deallocate (map%missing)
   end subroutine fill_holes

   !> Replaces the missing heights by the solution of (M3).
   recursive subroutine fill(height, missing, weight, periodic)
      real(dp), intent(inout) :: height(:, :)   !! shape (M, N), of order 1
      logical, intent(in) :: missing(:, :)      !! shape (M, N); at least one is .false.
      real(dp), intent(in) :: weight(2)         !! of neighbours along x and y, up to 1
      logical, intent(in) :: periodic           !! whether the last points are neighbours of the first

      integer, allocatable :: place(:, :)       ! of each missing height, its indices along x and y, shape (2, n)
      integer :: i, j, n

      if (.not. any(missing)) return
      call start_from_coarser(height, missing, weight, periodic)
      allocate (place(2, count(missing)))
      n = 0
      do j = 1, size(missing, 2)
         do i = 1, size(missing, 1)
            if (.not. missing(i, j)) cycle
            n = n + 1
            place(:, n) = [i, j]
         end do
      end do
      call solve(place, weight, periodic, height)
   end subroutine fill

   !> Sets the missing heights from the filled map of half the points each way (M4). A point of that map has the mean of
   !> those of two by two heights that are there, and is missing if none is.
   recursive subroutine start_from_coarser(height, missing, weight, periodic)
      real(dp), intent(inout) :: height(:, :)
      logical, intent(in) :: missing(:, :)
      real(dp), intent(in) :: weight(2)
      logical, intent(in) :: periodic

      real(dp), allocatable :: coarse(:, :)
      logical, allocatable :: none(:, :)
      integer :: i, j, number, points(2)

      points = (shape(height) + 1)/2
      allocate (coarse(points(1), points(2)), source=0.0_dp)
      allocate (none(points(1), points(2)))
      do j = 1, points(2)
         do i = 1, points(1)
            associate (heights => height(2*i - 1:min(2*i, size(height, 1)), 2*j - 1:min(2*j, size(height, 2))), &
                       gaps => missing(2*i - 1:min(2*i, size(height, 1)), 2*j - 1:min(2*j, size(height, 2))))
               number = count(.not. gaps)
               none(i, j) = number == 0
               if (number > 0) coarse(i, j) = sum(heights, mask=.not. gaps)/number
            end associate
         end do
      end do
      call fill(coarse, none, weight, periodic)
      do j = 1, size(height, 2)
         do i = 1, size(height, 1)
            if (missing(i, j)) height(i, j) = coarse((i + 1)/2, (j + 1)/2)
         end do
      end do
   end subroutine start_from_coarser

   !> Conjugate gradients, from the heights that are there, until the residual of (M3) is rounding.
   subroutine solve(place, weight, periodic, height)
      integer, intent(in) :: place(:, :)        !! of the missing heights
      real(dp), intent(in) :: weight(2)
      logical, intent(in) :: periodic
      real(dp), intent(inout) :: height(:, :)   !! only the missing heights change

      real(dp), parameter :: goal = 4*epsilon(goal)
      real(dp), allocatable :: direction(:), field(:, :), image(:), residual(:), value(:)
      real(dp) :: last, largest, square, square_before, step
      integer :: iteration, n

      n = size(place, 2)
      allocate (direction(n), image(n), residual(n))
      allocate (value(n), source=[(height(place(1, n), place(2, n)), n=1, size(place, 2))])
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
      integer, intent(in) :: place(:, :)
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
