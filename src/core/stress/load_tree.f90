!> The smooth part of the stresses below a surface with free edges, where the pressure is not repeated periodically:
!> equations (S11), (S12) of README.md in this directory.
!>
!> The load is a lattice of point forces. At a distance, a block of forces is replaced by fewer forces that cause nearly
!> the same field. The blocks are a binary tree: all blocks have `nodes` x `nodes` forces, and a block of one level
!> covers two blocks of the level below.
module wavycon_load_tree
   use wavycon_kinds, only: dp
   use wavycon_stress_kernel, only: add_sources, all_fields, of_pressure, stress_field_count
   use wavycon_stress_tuning, only: nodes, smooth_places, whole_from
   implicit none (type, external)
   private

   public :: load_tree, plant_load_tree

   !> The depth-shifted terms of (S11): their number and their factors.
   integer, parameter :: order = 4
   real(dp), parameter :: factors(order) = [4.0_dp, -6.0_dp, 4.0_dp, -1.0_dp]

   type :: tree_level
      real(dp), allocatable :: force(:, :)   !! [p* rad^2]; a block is `nodes` x `nodes` of them
      real(dp) :: step(2) = 0.0_dp           !! distance of neighbouring forces along x and y [rad of x]
      integer :: way = 1                     !! direction of the pairs of blocks of the level below: 1 is x, 2 is y
   end type tree_level

   type :: load_tree
      private
      real(dp) :: shift = 0.0_dp             !! d of (S11) [rad of x]
      real(dp) :: corner(2) = 0.0_dp         !! x and y of the first block's lower corner [rad of x]
      type(tree_level), allocatable :: levels(:)   !! the first has the lattice's own forces, the last one block
   contains
      procedure :: left_out, sums, sums_on_plane
   end type load_tree

contains

   !> Makes the tree of a lattice of pressures. Blocks are joined in pairs along the direction of the smaller step, so
   !> that they become nearly square. A force gives each node of the joined block its value times the node's Lagrange
   !> polynomial there.
   pure subroutine plant_load_tree(tree, pressure, first, step, shift)
      type(load_tree), intent(out) :: tree
      real(dp), intent(in) :: pressure(:, :)   !! [p*]
      real(dp), intent(in) :: first(2)         !! x and y of pressure(1, 1) [rad of x]
      real(dp), intent(in) :: step(2)          !! steps of the lattice along x and y, at most shift/3 [rad of x]
      real(dp), intent(in) :: shift            !! d of (S11) [rad of x]

      real(dp), allocatable :: below(:, :)
      real(dp) :: weight(nodes, 2*nodes)
      integer :: blocks(2), i, k

      tree%shift = shift
      tree%corner = first - 0.5_dp*step
      weight = reshape([(lagrange(0.5_dp*i + 0.25_dp, nodes), i=1, 2*nodes)], shape(weight))
      blocks = (shape(pressure) + nodes - 1)/nodes
      allocate (tree%levels(1 + sum(bit_size(blocks) - leadz(blocks - 1))))
      allocate (tree%levels(1)%force(nodes*blocks(1), nodes*blocks(2)), source=0.0_dp)
      tree%levels(1)%force(:size(pressure, 1), :size(pressure, 2)) = pressure*product(step)
      tree%levels(1)%step = step
      do k = 2, size(tree%levels)
         associate (level => tree%levels(k), way => tree%levels(k)%way)
            level%step = tree%levels(k - 1)%step
            way = minloc(level%step, dim=1, mask=blocks > 1)
            level%step(way) = 2*level%step(way)
            below = tree%levels(k - 1)%force
            if (way == 2) below = transpose(below)
            blocks(way) = (blocks(way) + 1)/2
            allocate (level%force(nodes*blocks(way), size(below, 2)))
            do i = 1, blocks(way)
               associate (last => min(2*nodes, size(below, 1) - 2*nodes*(i - 1)))
                  level%force(nodes*(i - 1) + 1:nodes*i, :) = &
                     matmul(weight(:, :last), below(2*nodes*(i - 1) + 1:2*nodes*(i - 1) + last, :))
               end associate
            end do
            if (way == 2) level%force = transpose(level%force)
         end associate
      end do
   end subroutine plant_load_tree

   !> The values at a coordinate of the Lagrange polynomials of the nodes 1, 2 .. n.
   pure function lagrange(place, n) result(weight)
      real(dp), intent(in) :: place   !! the coordinate, in steps of the nodes
      integer, intent(in) :: n
      real(dp) :: weight(n)

      integer :: a, b, others(n - 1)

      do a = 1, n
         others = [(b, b=1, a - 1), (b, b=a + 1, n)]
         weight(a) = product((place - others)/(a - others))
      end do
   end function lagrange

   !> The first factor of (S11), (1 - e^(-q d))^4: which part of a wave of the pressure the smooth part leaves out, and
   !> the sum over waves must add.
   elemental real(dp) function left_out(self, q)
      class(load_tree), intent(in) :: self
      real(dp), intent(in) :: q   !! length of the wave vector [1/rad of x]

      left_out = (1.0_dp - exp(-q*self%shift))**order
   end function left_out

   !> The sums (S4) of the smooth part at one point.
   pure function sums(self, place)
      class(load_tree), intent(in) :: self
      real(dp), intent(in) :: place(3)   !! x, y, Z [rad of x]
      real(dp) :: sums(stress_field_count)

      sums = 0.0_dp
      call add_block(self, size(self%levels), [0, 0], place, sums)
   end function sums

   !> The sums (S4) of the smooth part at the points of a plane. Where the points are closer to each other than the
   !> smooth part needs, the sums are computed at fewer points and interpolated by Lagrange polynomials.
   pure subroutine sums_on_plane(self, first, step, points, depth, sums)
      class(load_tree), intent(in) :: self
      real(dp), intent(in) :: first(2), step(2)   !! first point, and distance of points along x and y [rad of x]
      integer, intent(in) :: points(2)            !! N_x, N_y
      real(dp), intent(in) :: depth               !! Z [rad of x]
      real(dp), allocatable, intent(out) :: sums(:, :, :)   !! shape (8, N_x, N_y)

      real(dp), allocatable :: at_few(:, :, :)
      !> The points of the computed sums: their distance [rad of x], how many lie before the plane's first point, and
      !> how many there are.
      real(dp) :: few_step(2)
      integer :: before(2), few(2), i, k, l

      few_step = (depth + self%shift)/smooth_places
      few = ceiling(step*(points - 1)/few_step) + nodes
      before = nodes/2 - 1
      where (few >= points)
         before = 0
         few_step = step
      end where
      few = min(few, points)
      allocate (at_few(8, few(1), few(2)), sums(8, points(1), points(2)))
      do l = 1, few(2)
         do k = 1, few(1)
            at_few(:, k, l) = self%sums([first + ([k, l] - 1 - before)*few_step, depth])
         end do
      end do
      do i = 1, 8
         sums(i, :, :) = matmul(transpose(weights(1)), matmul(at_few(i, :, :), weights(2)))
      end do

   contains

      !> The weights of the computed sums, in one direction, in the interpolated value at each point of the plane.
      pure function weights(way) result(weight)
         integer, intent(in) :: way   !! the direction: 1 is x, 2 is y
         real(dp) :: weight(few(way), points(way)), position
         integer :: from, k, n

         weight = 0.0_dp
         n = min(nodes, few(way))
         do k = 1, points(way)
            position = 1 + before(way) + (k - 1)*step(way)/few_step(way)
            from = max(0, min(floor(position) - n/2, few(way) - n))
            weight(from + 1:from + n, k) = lagrange(position - from, n)
         end do
      end function weights

   end subroutine sums_on_plane

   !> Adds the sums (S4) that a block of forces causes at a point: by its nodes if the point is farther from the block's
   !> middle than `whole_from` times its longer side, otherwise by the two blocks of the level below.
   pure recursive subroutine add_block(tree, number, block, place, sums)
      type(load_tree), intent(in) :: tree
      integer, intent(in) :: number     !! of the block's level
      integer, intent(in) :: block(2)   !! number of the block along x and y, from 0
      real(dp), intent(in) :: place(3)  !! x, y, Z of the point [rad of x]
      real(dp), intent(inout) :: sums(stress_field_count)

      real(dp) :: depth, distance, fields(stress_field_count), from_corner(2)
      real(dp), dimension(nodes, nodes) :: x, y
      integer :: i, lower(2)

      associate (level => tree%levels(number), first => nodes*block)
         if (any(first >= shape(level%force))) return
         associate (force => level%force(first(1) + 1:first(1) + nodes, first(2) + 1:first(2) + nodes))
            if (all(abs(force) <= 0.0_dp)) return
            from_corner = place(:2) - tree%corner - first*level%step
            distance = norm2([from_corner - 0.5_dp*nodes*level%step, place(3) + tree%shift])
            if (number > 1 .and. distance < whole_from*nodes*maxval(level%step)) then
               do i = 0, 1
                  lower = block
                  lower(level%way) = 2*block(level%way) + i
                  call add_block(tree, number - 1, lower, place, sums)
               end do
               return
            end if
            x = spread(from_corner(1) - [(i - 0.5_dp, i=1, nodes)]*level%step(1), 2, nodes)
            y = spread(from_corner(2) - [(i - 0.5_dp, i=1, nodes)]*level%step(2), 1, nodes)
            ! (S12). `add_sources` takes the shifted depth Z_j in all fields. Five fields have the depth as a factor as
            ! well, and this factor is Z: they are times Z/Z_j.
            do i = 1, order
               depth = place(3) + i*tree%shift
               fields = 0.0_dp
               call add_sources(all_fields, of_pressure, size(x), x, y, depth, factors(i)*force, force, fields)
               fields([2, 5, 6, 7, 8]) = fields([2, 5, 6, 7, 8])*place(3)/depth
               sums = sums + fields
            end do
         end associate
      end associate
   end subroutine add_block

end module wavycon_load_tree
