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
      procedure :: of_point
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
      integer :: k, l, root, runs

      allocate (numbers%at(0:cell(1) - 1, 0:cell(2) - 1))
      numbers%skew = skew
      call number_runs(edge, numbers%at, runs)
      parent = [(k, k=1, runs)]
      do l = 0, cell(2) - 1
         call join_row(numbers, l, parent)
      end do
      if (present(with_images)) then
         if (with_images) call join_images(numbers%at, parent)
      end if

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

   !> The number of a point of the plane.
   pure integer function of_point(self, k, l)
      class(region_numbers), intent(in) :: self
      integer, intent(in) :: k, l   !! any

      integer :: place(2)

      place = self%wrap(k, l)
      of_point = self%at(place(1), place(2))
   end function of_point

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

   !> Numbers the runs of equal points along the rows: positive in contact, negative elsewhere.
   subroutine number_runs(edge, at, runs)
      class(contact_edge), intent(in) :: edge
      integer, intent(out) :: at(0:, 0:)
      integer, intent(out) :: runs

      logical :: contact, last
      integer :: k, l

      runs = 0
      last = .false.
      do l = 0, ubound(at, 2)
         do k = 0, ubound(at, 1)
            contact = edge%in_contact(k, l)
            if (k == 0 .or. (contact .neqv. last)) runs = runs + 1
            at(k, l) = merge(runs, -runs, contact)
            last = contact
         end do
      end do
   end subroutine number_runs

   !> Joins the runs of a row with those that they touch in the same row, over the side of the cell, and in the next.
   subroutine join_row(numbers, l, parent)
      type(region_numbers), intent(in) :: numbers   !! its `at` has the numbers of runs
      integer, intent(in) :: l
      integer, intent(inout) :: parent(:)

      integer :: above(-1:size(numbers%at, 1)), k

      associate (last => ubound(numbers%at, 1))
         call join(parent, numbers%at(0, l), numbers%at(last, l))
         do k = 0, last
            if (l < ubound(numbers%at, 2)) then
               above(k) = numbers%at(k, l + 1)
            else
               above(k) = numbers%of_point(k, l + 1)
            end if
         end do
         above(-1) = above(last)
         above(last + 1) = above(0)
         do k = 0, last
            call join(parent, numbers%at(k, l), above(k))
            if (numbers%at(k, l) < 0) cycle
            call join(parent, numbers%at(k, l), above(k - 1))
            call join(parent, numbers%at(k, l), above(k + 1))
         end do
      end associate
   end subroutine join_row

   !> Joins the runs of each point with those of its mirror images, which are of one kind.
   pure subroutine join_images(at, parent)
      integer, intent(in) :: at(0:, 0:)   !! the numbers of runs
      integer, intent(inout) :: parent(:)

      integer :: k, l

      associate (points => shape(at))
         do l = 0, points(2) - 1
            do k = 0, points(1) - 1
               call join(parent, at(k, l), at(modulo(1 - k, points(1)), l))
               call join(parent, at(k, l), at(k, modulo(1 - l, points(2))))
            end do
         end do
      end associate
   end subroutine join_images

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
