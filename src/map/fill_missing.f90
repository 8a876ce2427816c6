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

   type :: hole_equations
      integer, allocatable :: place(:, :)       !! of each missing height, its indices along x and y, shape (2, n)
      integer, allocatable :: neighbour(:, :)   !! missing heights to the east, north, west and south; 0: none. (4, n)
      real(dp), allocatable :: diagonal(:)      !! sum of the weights of all neighbours, given ones too, shape (n)
      real(dp), allocatable :: given(:)         !! weighted sum of the given neighbours over `datum`, shape (n)
      real(dp) :: datum = 0.0_dp                !! a height beside a hole
      real(dp) :: weight(2) = 1.0_dp            !! of neighbours along x and y
   end type hole_equations

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

      !> Real numbers for each missing height: the equations and the vectors of the iteration, on coarser maps too.
      integer(int64), parameter :: numbers_a_hole = 16

      if (.not. has_memory_for(numbers_a_hole*count(map%missing) + size(map%missing))) then
         call fatal_error(error, exit_file_trouble, escaped(source)//': there is not the memory to fill its holes')
         return
      end if
      call fill_by_neighbours(map%height, map%missing, step, periodic)
      deallocate (map%missing)
   end subroutine fill_holes

   !> Replaces the missing heights by the solution of (M3).
   recursive subroutine fill_by_neighbours(height, missing, step, periodic)
      real(dp), intent(inout) :: height(:, :)   !! shape (M, N)
      logical, intent(in) :: missing(:, :)      !! shape (M, N); at least one is .false.
      real(dp), intent(in) :: step(2)           !! between points along x and y, in any unit, > 0
      logical, intent(in) :: periodic           !! whether the last points are neighbours of the first

      type(hole_equations) :: equations

      if (.not. any(missing)) return
      call start_from_coarser(height, missing, step, periodic)
      call set_up(equations, height, missing, step, periodic)
      call solve(equations, height)
   end subroutine fill_by_neighbours

   !> Sets the missing heights from the filled map of half the points each way (M4). A point of that map has the mean of
   !> those of two by two heights that are there, and is missing if none is.
   recursive subroutine start_from_coarser(height, missing, step, periodic)
      real(dp), intent(inout) :: height(:, :)
      logical, intent(in) :: missing(:, :)
      real(dp), intent(in) :: step(2)
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
      call fill_by_neighbours(coarse, none, step, periodic)
      do j = 1, size(height, 2)
         do i = 1, size(height, 1)
            if (missing(i, j)) height(i, j) = coarse((i + 1)/2, (j + 1)/2)
         end do
      end do
   end subroutine start_from_coarser

   !> Sets up the equations of the missing heights, in the order of the points.
   subroutine set_up(self, height, missing, step, periodic)
      type(hole_equations), intent(out) :: self
      real(dp), intent(in) :: height(:, :)
      logical, intent(in) :: missing(:, :)
      real(dp), intent(in) :: step(2)
      logical, intent(in) :: periodic

      integer, allocatable :: number(:, :)
      integer :: at(2), i, j, n, side
      logical :: has_datum

      self%weight = (minval(step)/step)**2
      n = count(missing)
      allocate (number(size(missing, 1), size(missing, 2)), source=0)
      allocate (self%place(2, n), self%neighbour(4, n), source=0)
      allocate (self%diagonal(n), self%given(n), source=0.0_dp)
      n = 0
      do j = 1, size(missing, 2)
         do i = 1, size(missing, 1)
            if (.not. missing(i, j)) cycle
            n = n + 1
            number(i, j) = n
            self%place(:, n) = [i, j]
         end do
      end do
      has_datum = .false.
      do n = 1, size(self%given)
         do side = 1, 4
            at = neighbour_of(self%place(:, n), side, shape(missing), periodic)
            if (all(at == 0)) cycle
            associate (weight => self%weight(1 + mod(side - 1, 2)))
               self%diagonal(n) = self%diagonal(n) + weight
               self%neighbour(side, n) = number(at(1), at(2))
               if (self%neighbour(side, n) > 0) cycle
               if (.not. has_datum) self%datum = height(at(1), at(2))
               has_datum = .true.
               self%given(n) = self%given(n) + weight*(height(at(1), at(2)) - self%datum)
            end associate
         end do
      end do
   end subroutine set_up

   !> The indices of a neighbour; zeros if it lies beyond the border.
   pure function neighbour_of(place, side, points, periodic) result(at)
      integer, intent(in) :: place(2), side, points(2)
      logical, intent(in) :: periodic
      integer :: at(2)

      integer, parameter :: way(2, 4) = reshape([1, 0, 0, 1, -1, 0, 0, -1], [2, 4])

      at = place + way(:, side)
      if (periodic) then
         at = modulo(at - 1, points) + 1
         ! The one row of a profile is no neighbour of itself.
         if (all(at == place)) at = 0
      else if (any(at < 1 .or. at > points)) then
         at = 0
      end if
   end function neighbour_of

   !> Conjugate gradients, from the heights that are there, until the residual of (M3) is rounding. Heights are relative
   !> to one of those around the holes, so that rounding is that of their differences.
   subroutine solve(self, height)
      type(hole_equations), intent(in) :: self
      real(dp), intent(inout) :: height(:, :)   !! only the missing heights change

      real(dp), allocatable :: direction(:), given(:), image(:), residual(:), value(:)
      real(dp) :: goal, largest, last, slope, slope_before, step, unit
      integer :: iteration, n

      ! Products of tiny heights would vanish.
      unit = maxval(abs(self%given))
      allocate (given(size(self%given)), image(size(self%given)), source=0.0_dp)
      allocate (value(0:size(given)), direction(0:size(given)), source=0.0_dp)   ! 0: a neighbour that is given
      if (unit > 0.0_dp) then
         given = self%given/unit
         do n = 1, size(given)
            value(n) = (height(self%place(1, n), self%place(2, n)) - self%datum)/unit
         end do
      end if
      goal = 4*epsilon(goal)
      last = huge(last)
      do
         call multiply(self, value, image)
         residual = given - image
         largest = maxval(abs(residual))
         ! A residual that no longer falls is rounding.
         if (largest <= goal .or. largest > 0.5_dp*last) exit
         last = largest
         do iteration = 1, most_iterations
            slope = sum(residual**2/self%diagonal)
            if (iteration == 1) then
               direction(1:) = residual/self%diagonal
            else
               direction(1:) = residual/self%diagonal + slope/slope_before*direction(1:)
            end if
            call multiply(self, direction, image)
            step = slope/dot_product(direction(1:), image)
            value = value + step*direction
            residual = residual - step*image
            slope_before = slope
            if (maxval(abs(residual)) <= 0.5_dp*goal) exit
         end do
      end do
      do n = 1, size(given)
         height(self%place(1, n), self%place(2, n)) = self%datum + unit*value(n)
      end do
   end subroutine solve

   !> The left-hand side of (M3) for the unknown heights; given heights count as 0.
   subroutine multiply(self, value, image)
      type(hole_equations), intent(in) :: self
      real(dp), intent(in) :: value(0:)
      real(dp), intent(out) :: image(:)

      integer :: n

      do n = 1, size(image)
         associate (to => self%neighbour(:, n))
            image(n) = self%diagonal(n)*value(n) - (self%weight(1)*(value(to(1)) + value(to(3))) &
                                                    + self%weight(2)*(value(to(2)) + value(to(4))))
         end associate
      end do
   end subroutine multiply

end module wavycon_fill_missing
