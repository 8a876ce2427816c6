!> The spots of contact and the pools of gap that the points of a grid belong to.
!>
!> Points in contact are connected with their eight neighbours and points of the gap with four, as the curves of the
!> edge are traced: where two parts in contact meet at a corner they are one. The method is that of runs along rows,
!> joined where they touch (union-find): its time is proportional to the number of points.
module wavycon_region_numbers
   use wavycon_contact_edge, only: contact_edge
   implicit none (type, external)
   private

   public :: find_region_numbers, region_numbers

   type :: region_numbers
      !> The number of the spot, from 1, or minus the number of the pool, of the points of one cell; shape
      !> (0:cell_k - 1, 0:cell_l - 1).
      integer, allocatable :: at(:, :)
      integer :: spots = 0, pools = 0
      integer :: skew = 0   !! steps along k after which the cell comes again, cell_l rows on
   contains
      procedure :: wrap
   end type region_numbers

contains

   !> Numbers the regions of one cell, in the order in which its rows meet them.
   subroutine find_region_numbers(edge, cell, skew, numbers, with_images)
      class(contact_edge), intent(in) :: edge
      integer, intent(in) :: cell(2)    !! points of the cell along k and l, >= 1
      integer, intent(in) :: skew       !! as above; 0 if the cell is that of the grid's axes
      type(region_numbers), intent(out) :: numbers
      !> Whether a region and its mirror images have one number: the cell is a map, the points 1 .. cell/2, and its
      !> images. Absent: they do not.
      logical, intent(in), optional :: with_images

      integer, allocatable :: parent(:), number_of(:)
      logical :: contact, last, with_mirrored
      integer :: k, l, root, runs

      allocate (numbers%at(0:cell(1) - 1, 0:cell(2) - 1))
      numbers%skew = skew
      ! Runs of equal points along the rows: positive in contact, negative elsewhere.
      runs = 0
      last = .false.
      do l = 0, cell(2) - 1
         do k = 0, cell(1) - 1
            contact = edge%in_contact(k, l)
            if (k == 0 .or. (contact .neqv. last)) runs = runs + 1
            numbers%at(k, l) = merge(runs, -runs, contact)
            last = contact
         end do
      end do
      with_mirrored = .false.
      if (present(with_images)) with_mirrored = with_images
      parent = [(k, k=1, runs)]
      do l = 0, cell(2) - 1
         call join_row(numbers, l, with_mirrored, parent)
      end do

      allocate (number_of(runs), source=0)
      do l = 0, cell(2) - 1
         do k = 0, cell(1) - 1
            associate (at => numbers%at(k, l))
               call find_root(parent, abs(at), root)
               if (number_of(root) == 0) then
                  if (at > 0) then
                     numbers%spots = numbers%spots + 1
                     number_of(root) = numbers%spots
                  else
                     numbers%pools = numbers%pools + 1
                     number_of(root) = -numbers%pools
                  end if
               end if
               at = number_of(root)
            end associate
         end do
      end do
   end subroutine find_region_numbers

   !> The point of the cell of which a point of the plane is the image.
   pure function wrap(self, k, l) result(place)
      class(region_numbers), intent(in) :: self
      integer, intent(in) :: k, l   !! any
      integer :: place(2)

      integer :: rows

      rows = size(self%at, 2)
      place(2) = modulo(l, rows)
      place(1) = modulo(k - self%skew*((l - place(2))/rows), size(self%at, 1))
   end function wrap

   !> Joins the runs of a row with those that they touch in the same row, over the side of the cell, and in the next.
   subroutine join_row(numbers, l, with_images, parent)
      type(region_numbers), intent(in) :: numbers   !! its `at` has the numbers of runs
      integer, intent(in) :: l
      logical, intent(in) :: with_images            !! whether to join mirror images, which are of one kind, too
      integer, intent(inout) :: parent(:)

      integer :: above(-1:size(numbers%at, 1)), k

      associate (last => ubound(numbers%at, 1), rows => size(numbers%at, 2))
         call join(parent, numbers%at(0, l), numbers%at(last, l))
         above(0:last) = numbers%at(:, modulo(l + 1, rows))
         if (l + 1 == rows) above(0:last) = cshift(above(0:last), -numbers%skew)
         above(-1) = above(last)
         above(last + 1) = above(0)
         do k = 0, last
            call join(parent, numbers%at(k, l), above(k))
            if (with_images) then
               call join(parent, numbers%at(k, l), numbers%at(modulo(1 - k, last + 1), l))
               call join(parent, numbers%at(k, l), numbers%at(k, modulo(1 - l, rows)))
            end if
            if (numbers%at(k, l) < 0) cycle
            call join(parent, numbers%at(k, l), above(k - 1))
            call join(parent, numbers%at(k, l), above(k + 1))
         end do
      end associate
   end subroutine join_row

   !> Joins two runs, if both or neither are in contact.
   pure subroutine join(parent, a, b)
      integer, intent(inout) :: parent(:)
      integer, intent(in) :: a, b   !! numbers of runs with their signs

      integer :: root_a, root_b

      if ((a > 0) .neqv. (b > 0)) return
      if (parent(abs(a)) == parent(abs(b))) return
      call find_root(parent, abs(a), root_a)
      call find_root(parent, abs(b), root_b)
      parent(max(root_a, root_b)) = min(root_a, root_b)
   end subroutine join

   !> The first run of the region of a run. Halves the way to it for the next time.
   pure subroutine find_root(parent, run, root)
      integer, intent(inout) :: parent(:)
      integer, intent(in) :: run
      integer, intent(out) :: root

      root = run
      do while (parent(root) /= root)
         parent(root) = parent(parent(root))
         root = parent(root)
      end do
   end subroutine find_root

end module wavycon_region_numbers
