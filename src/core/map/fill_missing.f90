!> Fills the holes of a height map by the solution of Laplace's equation: (M3) of README.md in this directory.
!>
!> The unknowns are the missing heights alone. The equations are solved by conjugate gradients with a preconditioner,
!> (M3a).
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

   !> m of (M3a). It was measured with holes of 52 to 1024 points; with 1 rounding could make a pivot zero.
   real(dp), parameter :: moved = 0.9999_dp

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
      integer(int64), parameter :: numbers_a_height = 6, numbers_a_hole = 7
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
         call solve(map%missing, (minval(step)/step([1, 1, 2, 2]))**2, periodic, filled)
      end if
      where (map%missing) map%height = datum + unit*filled
      deallocate (map%missing)
   end subroutine fill_holes

   !> Solves (M3) for the missing heights by conjugate gradients with the preconditioner (M3a), until the residual is
   !> rounding or stops falling.
   subroutine solve(missing, weight, periodic, height)
      logical, intent(in) :: missing(:, :)      !! shape (M, N)
      real(dp), intent(in) :: weight(4)         !! 1/d^2 of the steps d to the neighbours, over the larger one
      logical, intent(in) :: periodic           !! whether the last points are neighbours of the first
      !> The heights, of order 1. The missing ones are start values on entry and the solution on exit.
      real(dp), intent(inout), contiguous :: height(:, :)

      real(dp), parameter :: goal = 4*epsilon(goal)   ! of the largest residual
      real(dp), allocatable :: direction(:), image(:), residual(:), value(:)
      ! At all points: a field; 1/e of (M3a), 0 where a height is there; sum of the weights of later missing neighbours.
      real(dp), allocatable :: field(:), inverse(:), later(:)
      integer, allocatable :: point(:)          ! numbers of the missing points in memory, shape (n)
      integer, allocatable :: next(:, :)        ! those of their neighbours along x and y, shape (4, n)
      integer :: at(4), iteration, k, sides(4)
      real(dp) :: last, largest, square, square_before, step

      point = pack(reshape([(k, k=1, size(missing))], shape(missing)), missing)
      sides = [size(missing, 1), size(missing, 1), size(missing, 2), size(missing, 2)]
      allocate (next(4, size(point)))
      do k = 1, size(point)
         associate (i => modulo(point(k) - 1, sides(1)), j => (point(k) - 1)/sides(1))
            at = [i - 1, i + 1, j - 1, j + 1]
            ! Beyond a border there is the point itself, whose difference from itself is zero, or in a periodic map the
            ! point on the other side.
            at = merge(modulo(at, sides), min(max(at, 0), sides - 1), periodic)
            next(:, k) = 1 + [at(:2) + sides(1)*j, i + sides(1)*at(3:)]
         end associate
      end do
      ! Later points have the inverse 1 so far.
      inverse = reshape(merge(1.0_dp, 0.0_dp, missing), [size(missing)])
      field = 0.0_dp*inverse
      later = field
      do k = 1, size(point)
         associate (here => point(k), other => next(:, k))
            later(here) = sum(weight*inverse(other), other > here)
            inverse(here) = 1/(sum(weight, other /= here) &
                               - sum(weight*inverse(other)*(weight + moved*(later(other) - weight)), other < here))
         end associate
      end do
      value = pack(height, missing)
      allocate (direction, image, residual, mold=value)
      last = huge(last)
      do
         call apply(value, point, next, weight, height, image)
         residual = -image
         largest = maxval(abs(residual))
         ! The residual is recomputed from the heights. If it is not half of the last one, it has reached rounding.
         if (largest <= goal .or. largest > 0.5_dp*last) return
         last = largest
         direction = 0.0_dp
         square_before = 1.0_dp
         do iteration = 1, most_iterations
            do k = 1, size(point)
               field(point(k)) = inverse(point(k)) &
                                 *(residual(k) + sum(weight*field(next(:, k)), next(:, k) < point(k)))
            end do
            do k = size(point), 1, -1
               image(k) = field(point(k)) + inverse(point(k))*sum(weight*field(next(:, k)), next(:, k) > point(k))
               field(point(k)) = image(k)
            end do
            square = dot_product(residual, image)
            direction = image + square/square_before*direction
            call apply(direction, point, next, weight, field, image)
            step = square/dot_product(direction, image)
            value = value + step*direction
            residual = residual - step*image
            square_before = square
            if (maxval(abs(residual)) <= 0.5_dp*goal) exit
         end do
      end do
   end subroutine solve

   !> Sets the missing points of a field to given values, and computes minus the left-hand side of (M3) at these points.
   subroutine apply(value, point, next, weight, field, image)
      real(dp), intent(in) :: value(:)                !! values at the n missing points
      integer, intent(in) :: point(:), next(:, :)     !! as of `solve`
      real(dp), intent(in) :: weight(4)               !! as of `solve`
      real(dp), intent(inout) :: field(*)             !! at all points
      real(dp), intent(out) :: image(:)               !! sum of weight times (value - neighbour), at the n points

      integer :: k

      field(point) = value
      do k = 1, size(value)
         associate (difference => value(k) - field(next(:, k)))
            image(k) = weight(1)*(difference(1) + difference(2)) + weight(3)*(difference(3) + difference(4))
         end associate
      end do
   end subroutine apply

end module wavycon_fill_missing
