!> Continues a field from the contact to the points outside it, over grids of ever larger steps, and the adjoint of
!> that: equations (C4a) to (C4c) of README.md in this directory.
!>
!> Each coarser grid has half the points each way: a point of it has the mean of four. It needs even numbers of points;
!> where they become odd the sequence ends.
module wavycon_contact_extension
   use wavycon_contact_tuning, only: decay_alone, decay_growth
   use wavycon_grid_transform, only: image_of_point
   use wavycon_kinds, only: dp, sp
   use wavycon_threads, only: threads_for
   implicit none (type, external)
   private

   public :: contact_extension

   !> The coarsest grid has at least this many points each way.
   integer, parameter :: least_points = 4

   type :: coarse_grid
      real(sp), allocatable :: contact(:, :)   !! part of a point's area that is in contact, 0 to 1
      real(sp), allocatable :: values(:, :)
   end type coarse_grid

   type :: contact_extension
      private
      logical :: even = .false.                !! whether the field is mirrored at the borders; otherwise it is periodic
      real(sp) :: decay = 1.0_sp               !! factor of a value for each doubling of the distance from the contact
      type(coarse_grid), allocatable :: grids(:)
   contains
      procedure :: start
      procedure :: set_contact
      procedure :: extend
      procedure :: collect
   end type contact_extension

contains

   !> Allocates the coarser grids of a grid.
   subroutine start(self, points, even)
      class(contact_extension), intent(out) :: self
      integer, intent(in) :: points(2)   !! M, N; N = 1 in 1-D
      logical, intent(in) :: even        !! whether the points are those of a quarter of an even field's cell

      integer :: grid(2), k, levels

      self%even = even
      grid = points
      levels = 0
      do while (all((mod(grid, 2) == 0 .and. grid >= 2*least_points) .or. grid == 1))
         grid = max(grid/2, 1)
         levels = levels + 1
      end do
      allocate (self%grids(levels))
      do k = 1, levels
         grid = max(points/2**k, 1)
         allocate (self%grids(k)%contact(grid(1), grid(2)), self%grids(k)%values(grid(1), grid(2)))
      end do
   end subroutine start

   !> Sets the points in contact.
   subroutine set_contact(self, contact)
      class(contact_extension), intent(inout) :: self
      real(sp), intent(in) :: contact(:, :)   !! 1 in contact, 0 outside, shape (M, N)

      integer :: k, levels

      levels = size(self%grids)
      if (levels == 0) return
      call average(contact, self%grids(1)%contact)
      do k = 2, levels
         call average(self%grids(k - 1)%contact, self%grids(k)%contact)
      end do
      associate (parts => self%grids(levels)%contact)
         self%decay = real(min(1.0_dp, decay_alone + decay_growth*sqrt(sum(real(parts, dp))/size(parts))), sp)
      end associate
   end subroutine set_contact

   !> Continues a field to the points outside the contact.
   subroutine extend(self, contact, field)
      class(contact_extension), intent(inout) :: self
      real(sp), intent(in) :: contact(:, :)     !! that of `set_contact`
      real(sp), intent(inout) :: field(:, :)    !! zero outside the contact, shape (M, N)

      integer :: k, levels

      levels = size(self%grids)
      if (levels == 0) return
      call average(field, self%grids(1)%values)
      do k = 2, levels
         call average(self%grids(k - 1)%values, self%grids(k)%values)
      end do
      call normalise(self%grids(levels))
      do k = levels - 1, 1, -1
         call fill(self, self%grids(k + 1)%values, self%grids(k)%contact, self%grids(k)%values)
      end do
      call fill(self, self%grids(1)%values, contact, field)
   end subroutine extend

   !> The adjoint of `extend`: adds to the values in contact those outside that the extension takes from them.
   subroutine collect(self, contact, field)
      class(contact_extension), intent(inout) :: self
      real(sp), intent(in) :: contact(:, :)     !! that of `set_contact`
      real(sp), intent(inout) :: field(:, :)    !! shape (M, N); its values outside the contact are of no use afterwards

      integer :: k, levels

      levels = size(self%grids)
      if (levels == 0) return
      call adjoint_fill(self, field, contact, self%grids(1)%values)
      do k = 2, levels
         call adjoint_fill(self, self%grids(k - 1)%values, self%grids(k - 1)%contact, self%grids(k)%values)
      end do
      call normalise(self%grids(levels))
      do k = levels - 1, 1, -1
         call adjoint_average(self%grids(k + 1)%values, self%grids(k)%values)
      end do
      call adjoint_average(self%grids(1)%values, field)
   end subroutine collect

   !> Divides the values by the part of their area in contact; points without contact get zero.
   pure subroutine normalise(grid)
      type(coarse_grid), intent(inout) :: grid

      where (grid%contact > 0.0_sp)
         grid%values = grid%values/grid%contact
      elsewhere
         grid%values = 0.0_sp
      end where
   end subroutine normalise

   !> Means of two by two points; in 1-D of two.
   subroutine average(fine, coarse)
      real(sp), intent(in) :: fine(:, :)
      real(sp), intent(out) :: coarse(:, :)

      integer :: i, j

      if (size(fine, 2) == 1) then
         coarse(:, 1) = 0.5_sp*(fine(1::2, 1) + fine(2::2, 1))
         return
      end if
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, size(coarse, 2)
         do i = 1, size(coarse, 1)
            coarse(i, j) = 0.25_sp*((fine(2*i - 1, 2*j - 1) + fine(2*i, 2*j - 1)) &
                                    + (fine(2*i - 1, 2*j) + fine(2*i, 2*j)))
         end do
      end do
   end subroutine average

   !> The adjoint of `average`, added to a field.
   subroutine adjoint_average(coarse, fine)
      real(sp), intent(in) :: coarse(:, :)
      real(sp), intent(inout) :: fine(:, :)

      integer :: i, j
      real(sp) :: part

      part = 0.25_sp
      if (size(fine, 2) == 1) part = 0.5_sp
      !$omp parallel do num_threads(threads_for(size(fine))) private(i)
      do j = 1, size(fine, 2)
         do i = 1, size(coarse, 1)
            fine(2*i - 1, j) = fine(2*i - 1, j) + part*coarse(i, (j + 1)/2)
            fine(2*i, j) = fine(2*i, j) + part*coarse(i, (j + 1)/2)
         end do
      end do
   end subroutine adjoint_average

   !> Adds to a field, outside the contact, the decayed values of the coarser grid, linear between its points.
   subroutine fill(self, coarse, contact, fine)
      type(contact_extension), intent(in) :: self
      real(sp), intent(in) :: coarse(:, :), contact(:, :)
      real(sp), intent(inout) :: fine(:, :)

      real(sp) :: column(0:size(coarse, 1) + 1)
      integer :: i, j, other

      associate (m => size(coarse, 1), n => size(coarse, 2), a => 0.75_sp*self%decay, b => 0.25_sp*self%decay)
         !$omp parallel do num_threads(threads_for(size(fine))) private(column, i, other)
         do j = 1, size(fine, 2)
            if (n < size(fine, 2)) then
               other = image_of_point((j + 1)/2 + merge(-1, 1, mod(j, 2) == 1), n, self%even)
               column(1:m) = a*coarse(:, (j + 1)/2) + b*coarse(:, other)
            else
               column(1:m) = self%decay*coarse(:, j)
            end if
            column(0) = column(image_of_point(0, m, self%even))
            column(m + 1) = column(image_of_point(m + 1, m, self%even))
            do i = 1, m
               fine(2*i - 1, j) = fine(2*i - 1, j) + (1.0_sp - contact(2*i - 1, j)) &
                  *(0.75_sp*column(i) + 0.25_sp*column(i - 1))
               fine(2*i, j) = fine(2*i, j) + (1.0_sp - contact(2*i, j))*(0.75_sp*column(i) + 0.25_sp*column(i + 1))
            end do
         end do
      end associate
   end subroutine fill

   !> The adjoint of `fill` without the field itself.
   subroutine adjoint_fill(self, fine, contact, coarse)
      type(contact_extension), intent(in) :: self
      real(sp), intent(in) :: fine(:, :), contact(:, :)
      real(sp), intent(out) :: coarse(:, :)

      real(sp) :: open_part(0:size(fine, 1) + 1)
      real(sp) :: near, far
      integer :: i, j, k, columns(4)
      real(sp) :: parts(4)

      associate (m => size(coarse, 1), n => size(coarse, 2))
         near = 0.75_sp*self%decay
         far = 0.25_sp*self%decay
         !$omp parallel do num_threads(threads_for(size(fine))) private(open_part, i, k, columns, parts)
         do j = 1, n
            if (n < size(fine, 2)) then
               columns = [2*j - 1, 2*j, image_of_point(2*j - 2, 2*n, self%even), &
                          image_of_point(2*j + 1, 2*n, self%even)]
               parts = [near, near, far, far]
            else
               columns = j
               parts = [self%decay, 0.0_sp, 0.0_sp, 0.0_sp]
            end if
            open_part(1:2*m) = 0.0_sp
            do k = 1, 4
               do i = 1, 2*m
                  open_part(i) = open_part(i) + parts(k)*(1.0_sp - contact(i, columns(k)))*fine(i, columns(k))
               end do
            end do
            open_part(0) = open_part(image_of_point(0, 2*m, self%even))
            open_part(2*m + 1) = open_part(image_of_point(2*m + 1, 2*m, self%even))
            do i = 1, m
               coarse(i, j) = 0.75_sp*(open_part(2*i - 1) + open_part(2*i)) &
                  + 0.25_sp*(open_part(2*i - 2) + open_part(2*i + 1))
            end do
         end do
      end associate
   end subroutine adjoint_fill

end module wavycon_contact_extension
