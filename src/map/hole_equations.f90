!> Laplace's equation over the holes of a height map: (M3), (M4) of README.md in this directory.
!>
!> The unknowns are the heights of the missing points, those of neighbours that are there are given. The equations are
!> solved by conjugate gradients. Their preconditioner is one cycle over levels of ever coarser grids, on each of which
!> a point stands for the unknowns of two by two points of the finer one.
module wavycon_hole_equations
   use wavycon_kinds, only: dp
   use wavycon_map_tuning, only: overcorrection, visits
   implicit none (type, external)
   private

   public :: hole_equations

   !> One level. Unknown 0 stands for a neighbour that is no unknown: its value and its weights are 0.
   type :: equation_level
      integer :: points(2) = 0                  !! of the grid along x and y
      integer, allocatable :: place(:, :)       !! of each unknown, its indices along x and y, shape (2, n)
      integer, allocatable :: neighbour(:, :)   !! unknowns to the east, north, west and south, shape (4, n)
      real(dp), allocatable :: weight(:, :)     !! of the bonds to the east and north, shape (2, 0:n)
      real(dp), allocatable :: diagonal(:)      !! sum of the weights of all bonds, to given heights too, shape (n)
      integer, allocatable :: parent(:)         !! unknown of the next level that stands for it, shape (n)
      real(dp), allocatable :: right(:), rest(:)    !! work space of the cycle, shape (n)
      real(dp), allocatable :: value(:), total(:)   !! likewise, shape (0:n)
   end type equation_level

   type :: hole_equations
      private
      type(equation_level), allocatable :: level(:)   !! the first is that of the map
      real(dp) :: bond(2) = 1.0_dp                    !! of neighbours along x and y
      logical :: periodic = .false.                   !! whether the last points are neighbours of the first
   contains
      procedure :: start
      procedure :: solve
      procedure :: unknowns
   end type hole_equations

   integer, parameter :: east = 1, north = 2, west = 3, south = 4
   !> Iterations between two evaluations of the residual from the heights.
   integer, parameter :: most_iterations = 200

contains

   !> Sets up the equations of all levels.
   subroutine start(self, missing, step, periodic)
      class(hole_equations), intent(out) :: self
      logical, intent(in) :: missing(:, :)   !! shape (M, N); at least one is .false.
      real(dp), intent(in) :: step(2)        !! between points along x and y, in any unit, > 0
      logical, intent(in) :: periodic        !! whether the last points are neighbours of the first

      integer, allocatable :: number(:, :)
      integer :: levels, points(2)

      points = shape(missing)
      levels = 1
      do while (any(points > 1))
         points = (points + 1)/2
         levels = levels + 1
      end do
      allocate (self%level(levels))
      self%bond = (minval(step)/step)**2
      self%periodic = periodic
      call number_unknowns(missing, number)
      call start_finest(self, number)
      do levels = 2, size(self%level)
         call start_coarser(self%level(levels - 1), periodic, number, self%level(levels))
      end do
   end subroutine start

   !> The number of missing heights.
   pure integer function unknowns(self)
      class(hole_equations), intent(in) :: self

      unknowns = size(self%level(1)%diagonal)
   end function unknowns

   !> Numbers the unknowns in the order of the points.
   pure subroutine number_unknowns(missing, number)
      logical, intent(in) :: missing(:, :)
      integer, allocatable, intent(out) :: number(:, :)   !! 0 where the height is given, shape of `missing`

      integer :: i, j, n

      allocate (number(size(missing, 1), size(missing, 2)), source=0)
      n = 0
      do j = 1, size(missing, 2)
         do i = 1, size(missing, 1)
            if (.not. missing(i, j)) cycle
            n = n + 1
            number(i, j) = n
         end do
      end do
   end subroutine number_unknowns

   !> The equations (M3) of the map.
   subroutine start_finest(self, number)
      type(hole_equations), intent(inout) :: self
      integer, intent(in) :: number(:, :)

      integer :: at(2), i, j, side, u

      associate (level => self%level(1))
         call allocate_level(level, shape(number), count(number > 0))
         do j = 1, size(number, 2)
            do i = 1, size(number, 1)
               u = number(i, j)
               if (u == 0) cycle
               level%place(:, u) = [i, j]
               do side = 1, 4
                  at = neighbour_of([i, j], side, level%points, self%periodic)
                  if (all(at == 0)) cycle
                  associate (bond => self%bond(1 + mod(side - 1, 2)))
                     level%diagonal(u) = level%diagonal(u) + bond
                     level%neighbour(side, u) = number(at(1), at(2))
                     if (side <= north .and. level%neighbour(side, u) > 0) level%weight(side, u) = bond
                  end associate
               end do
            end do
         end do
      end associate
   end subroutine start_finest

   !> The equations of a level whose unknowns stand for those of two by two points of the finer one (M4).
   subroutine start_coarser(fine, periodic, number, level)
      type(equation_level), intent(inout) :: fine
      logical, intent(in) :: periodic
      integer, allocatable, intent(inout) :: number(:, :)   !! of the unknowns of the finer level, then of this one
      type(equation_level), intent(out) :: level

      integer, allocatable :: parents(:, :)
      integer :: at(2), n, other, points(2), side, u

      points = (fine%points + 1)/2
      allocate (parents(points(1), points(2)), source=0)
      n = 0
      do u = 1, size(fine%diagonal)
         associate (parent => parents((fine%place(1, u) + 1)/2, (fine%place(2, u) + 1)/2))
            if (parent == 0) then
               n = n + 1
               parent = n
            end if
            fine%parent(u) = parent
         end associate
      end do
      call allocate_level(level, points, n)
      do u = 1, size(fine%diagonal)
         associate (parent => fine%parent(u))
            level%place(:, parent) = (fine%place(:, u) + 1)/2
            level%diagonal(parent) = level%diagonal(parent) + fine%diagonal(u)
            do side = east, north
               other = fine%neighbour(side, u)
               if (other == 0) cycle
               if (fine%parent(other) == parent) then
                  level%diagonal(parent) = level%diagonal(parent) - 2*fine%weight(side, u)
               else
                  level%weight(side, parent) = level%weight(side, parent) + fine%weight(side, u)
               end if
            end do
         end associate
      end do
      do u = 1, n
         do side = 1, 4
            at = neighbour_of(level%place(:, u), side, points, periodic)
            if (any(at > 0)) level%neighbour(side, u) = parents(at(1), at(2))
         end do
      end do
      call move_alloc(parents, number)
   end subroutine start_coarser

   subroutine allocate_level(level, points, n)
      type(equation_level), intent(inout) :: level
      integer, intent(in) :: points(2)
      integer, intent(in) :: n             !! number of unknowns

      level%points = points
      allocate (level%place(2, n), level%neighbour(4, n), level%parent(n), source=0)
      allocate (level%weight(2, 0:n), level%diagonal(n), level%right(n), level%rest(n), level%value(0:n), &
                level%total(0:n), source=0.0_dp)
   end subroutine allocate_level

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

   !> Fills the holes of a map: conjugate gradients, preconditioned by `cycle`, until the residual of (M3) is rounding.
   !> Heights count from one of those around the holes: rounding is that of their differences, none if they are equal.
   subroutine solve(self, height)
      class(hole_equations), intent(inout) :: self
      real(dp), intent(inout) :: height(:, :)   !! shape (M, N); only the missing heights change

      real(dp), allocatable :: direction(:), given(:), image(:), residual(:), value(:)
      real(dp) :: datum, goal, largest, last, slope, slope_before, step, unit
      integer :: iteration, u

      associate (finest => self%level(1), n => self%unknowns())
         allocate (value(0:n), direction(0:n), source=0.0_dp)
         allocate (residual(n), image(n))
         call given_part(self, height, given, datum)
         ! Products of tiny heights would vanish.
         unit = maxval(abs(given))
         if (unit > 0.0_dp) given = given/unit
         goal = 4*epsilon(goal)
         last = huge(last)
         do
            call multiply(finest, value, image)
            residual = given - image
            largest = maxval(abs(residual))
            ! A residual that no longer falls is rounding.
            if (largest <= goal .or. largest > 0.5_dp*last) exit
            last = largest
            slope_before = 0.0_dp
            do iteration = 1, most_iterations
               finest%right = residual
               call cycle_from(self%level, 1)
               slope = dot_product(residual, finest%value(1:))
               if (iteration == 1) then
                  direction = finest%value
               else
                  direction = finest%value + slope/slope_before*direction
               end if
               call multiply(finest, direction, image)
               step = slope/dot_product(direction(1:), image)
               value = value + step*direction
               residual = residual - step*image
               slope_before = slope
               if (maxval(abs(residual)) <= 0.5_dp*goal) exit
            end do
         end do
         do u = 1, n
            height(finest%place(1, u), finest%place(2, u)) = datum + unit*value(u)
         end do
      end associate
   end subroutine solve

   !> What the given heights over one of them contribute to (M3).
   subroutine given_part(self, height, given, datum)
      type(hole_equations), intent(in) :: self
      real(dp), intent(in) :: height(:, :)
      real(dp), allocatable, intent(out) :: given(:)   !! shape (n)
      real(dp), intent(out) :: datum                   !! the first of the given heights

      integer :: at(2), side, u
      logical :: has_datum

      associate (finest => self%level(1))
         allocate (given(size(finest%diagonal)), source=0.0_dp)
         has_datum = .false.
         datum = 0.0_dp
         do u = 1, size(given)
            do side = 1, 4
               if (finest%neighbour(side, u) > 0) cycle
               at = neighbour_of(finest%place(:, u), side, finest%points, self%periodic)
               if (all(at == 0)) cycle
               if (.not. has_datum) datum = height(at(1), at(2))
               has_datum = .true.
               given(u) = given(u) + self%bond(1 + mod(side - 1, 2))*(height(at(1), at(2)) - datum)
            end do
         end do
      end associate
   end subroutine given_part

   !> The sums of the bonds (M3) of values that are 0 where heights are given.
   subroutine multiply(level, value, image)
      type(equation_level), intent(in) :: level
      real(dp), intent(in) :: value(0:)
      real(dp), intent(out) :: image(:)

      integer :: u

      do u = 1, size(image)
         image(u) = level%diagonal(u)*value(u) - of_neighbours(level, value, u)
      end do
   end subroutine multiply

   !> The weighted sum of the values of an unknown's neighbours.
   pure real(dp) function of_neighbours(level, value, u)
      type(equation_level), intent(in) :: level
      real(dp), intent(in) :: value(0:)
      integer, intent(in) :: u

      associate (to => level%neighbour(:, u), weight => level%weight)
         of_neighbours = weight(east, u)*value(to(east)) + weight(north, u)*value(to(north)) &
                         + weight(east, to(west))*value(to(west)) + weight(north, to(south))*value(to(south))
      end associate
   end function of_neighbours

   !> One cycle (M4) from a level down: from `right`, an approximation of the solution in `value`. It is symmetric, as
   !> conjugate gradients need it: the sweep after the coarser level has the opposite order of the one before it.
   recursive subroutine cycle_from(level, first)
      type(equation_level), intent(inout) :: level(:)
      integer, intent(in) :: first

      integer :: u, visit

      associate (fine => level(first))
         fine%value = 0.0_dp
         call sweep(fine, 1, size(fine%diagonal), 1)
         if (first == size(level)) return
         call multiply(fine, fine%value, fine%rest)
         fine%rest = fine%right - fine%rest
         associate (coarse => level(first + 1))
            coarse%right = 0.0_dp
            do u = 1, size(fine%parent)
               coarse%right(fine%parent(u)) = coarse%right(fine%parent(u)) + fine%rest(u)
            end do
            coarse%total = 0.0_dp
            do visit = 1, visits
               call cycle_from(level, first + 1)
               coarse%total = coarse%total + coarse%value
               if (visit == visits .or. first + 1 == size(level)) exit
               call multiply(coarse, coarse%value, coarse%rest)
               coarse%right = coarse%right - coarse%rest
            end do
            do u = 1, size(fine%parent)
               fine%value(u) = fine%value(u) + overcorrection*coarse%total(fine%parent(u))
            end do
         end associate
         call sweep(fine, size(fine%diagonal), 1, -1)
      end associate
   end subroutine cycle_from

   !> A sweep of Gauss-Seidel.
   subroutine sweep(level, from, to, by)
      type(equation_level), intent(inout) :: level
      integer, intent(in) :: from, to, by   !! order of the unknowns

      integer :: u

      do u = from, to, by
         level%value(u) = (level%right(u) + of_neighbours(level, level%value, u))/level%diagonal(u)
      end do
   end subroutine sweep

end module wavycon_hole_equations
