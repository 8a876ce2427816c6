!> The spots of contact and the pools of gap that the points of a grid belong to.
!>
!> Points in contact are connected with their eight neighbours, and points of the gap with four. So two parts in contact
!> that meet at a corner are one spot, as in the curves of the edge. Runs of points of one kind along the rows are
!> joined where they touch (union-find). The time is proportional to the number of points.
module wavycon_region_numbers
   use wavycon_contact_edge, only: contact_edge
   implicit none (type, external)
   private

   public :: find_region_numbers, region_numbers

   type :: region_numbers
      !> For each point of one periodic cell the number of its spot, from 1, or minus the number of its pool; shape
      !> (0:cell_k - 1, 0:cell_l - 1).
      integer, allocatable :: region_at(:, :)
      integer :: spots = 0, pools = 0   !! numbers of spots and of pools
      integer :: skew = 0               !! steps along k by which a row of cells is shifted against the row below
   contains
      procedure :: wrap
   end type region_numbers

contains

   !> Numbers the regions of one periodic cell, in the order in which they appear row by row.
   subroutine find_region_numbers(edge, cell, skew, numbers, with_images)
      class(contact_edge), intent(in) :: edge        !! says which points are in contact
      integer, intent(in) :: cell(2)                 !! points of the cell along k and l, >= 1
      integer, intent(in) :: skew                    !! the component `skew`; 0 if the cell repeats along k and l
      type(region_numbers), intent(out) :: numbers
      !> Whether a region and its mirror images get the same number. The cell then consists of a map, the points
      !> 1 .. cell/2, and its mirror images. Absent: .false.
      logical, intent(in), optional :: with_images

      integer, allocatable :: parent(:), number_of(:)
      logical :: is_contact, last, with_mirrored
      integer :: k, l, root, runs

      allocate (numbers%region_at(0:cell(1) - 1, 0:cell(2) - 1))
      numbers%skew = skew
      ! Number the runs of points of one kind along the rows: positive in contact, negative elsewhere.
      runs = 0
      last = .false.
      do l = 0, cell(2) - 1
         do k = 0, cell(1) - 1
            is_contact = edge%in_contact(k, l)
            if (k == 0 .or. (is_contact .neqv. last)) runs = runs + 1
            numbers%region_at(k, l) = merge(runs, -runs, is_contact)
            last = is_contact
         end do
      end do
      with_mirrored = .false.
      if (present(with_images)) with_mirrored = with_images
      parent = [(k, k=1, runs)]
      do l = 0, cell(2) - 1
         call join_row(l)
      end do

      allocate (number_of(runs), source=0)
      do l = 0, cell(2) - 1
         do k = 0, cell(1) - 1
            associate (run => numbers%region_at(k, l))
               call find_root(parent, abs(run), root)
               if (number_of(root) == 0) then
                  if (run > 0) then
                     numbers%spots = numbers%spots + 1
                     number_of(root) = numbers%spots
                  else
                     numbers%pools = numbers%pools + 1
                     number_of(root) = -numbers%pools
                  end if
               end if
               run = number_of(root)
            end associate
         end do
      end do

   contains

      !> Joins the runs of a row with the runs that they touch: across the side of the cell in the same row, and in the
      !> next row.
      subroutine join_row(l)
         integer, intent(in) :: l   !! the row, from 0

         integer :: above(-1:size(numbers%region_at, 1)), k

         associate (last => ubound(numbers%region_at, 1), rows => size(numbers%region_at, 2))
            call join(parent, numbers%region_at(0, l), numbers%region_at(last, l))
            above(0:last) = numbers%region_at(:, modulo(l + 1, rows))
            if (l + 1 == rows) above(0:last) = cshift(above(0:last), -numbers%skew)
            above(-1) = above(last)
            above(last + 1) = above(0)
            do k = 0, last
               call join(parent, numbers%region_at(k, l), above(k))
               if (with_mirrored) then
                  call join(parent, numbers%region_at(k, l), numbers%region_at(modulo(1 - k, last + 1), l))
                  call join(parent, numbers%region_at(k, l), numbers%region_at(k, modulo(1 - l, rows)))
               end if
               if (numbers%region_at(k, l) < 0) cycle
               call join(parent, numbers%region_at(k, l), above(k - 1))
               call join(parent, numbers%region_at(k, l), above(k + 1))
            end do
         end associate
      end subroutine join_row

   end subroutine find_region_numbers

   !> The point of the cell of which a point of the plane is a periodic image.
   pure function wrap(self, k, l) result(point)
      class(region_numbers), intent(in) :: self
      integer, intent(in) :: k, l   !! the point of the plane, any integers
      integer :: point(2)           !! its image in the cell, from 0

      integer :: rows

      rows = size(self%region_at, 2)
      point(2) = modulo(l, rows)
      point(1) = modulo(k - self%skew*((l - point(2))/rows), size(self%region_at, 1))
   end function wrap

   !> Joins two runs if they are of one kind: both in contact or both outside. The lower number becomes the root.
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

   !> Finds the root of a run, the first run of its region. On the way each run visited is attached to its grandparent,
   !> which halves the path of later searches.
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
