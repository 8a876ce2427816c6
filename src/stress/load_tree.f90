!> The smooth part of the stresses below a pressure that nothing repeats: a surface with free edges. Equations (S11),
!> (S12) of README.md in this directory.
!>
!> The load is a lattice of point forces. Square blocks of them are replaced, from afar, by fewer forces with the same
!> field: a tree of blocks, each with the same number of forces.
module wavycon_load_tree
   use wavycon_constants, only: pi
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: load_tree, plant_load_tree

   !> Forces of a block each way.
   integer, parameter :: nodes = 8
   !> A block is seen as a whole from this distance, over its longer side.
   real(dp), parameter :: whole_from = 1.5_dp
   !> Steps of the lattice in a shift of the depth: the field at that depth does not show the lattice.
   real(dp), parameter, public :: steps_in_shift = 3.0_dp
   !> Of (S11): the number of shifted depths, and their factors.
   integer, parameter :: order = 4
   real(dp), parameter :: factors(order) = [4.0_dp, -6.0_dp, 4.0_dp, -1.0_dp]

   type :: tree_level
      real(dp), allocatable :: force(:, :, :, :)   !! shape (nodes, nodes, blocks_x, blocks_y) [p* rad^2]
      real(dp) :: step(2) = 0.0_dp                 !! of the forces of a block [rad of x]
      integer :: merged(2) = 1                     !! blocks of the level below in a block, each way
   end type tree_level

   type :: load_tree
      private
      real(dp), public :: shift = 0.0_dp           !! d of (S11) [rad of x]
      real(dp) :: corner(2) = 0.0_dp               !! of the first block [rad of x]
      type(tree_level), allocatable :: levels(:)
   contains
      procedure :: left_out
      procedure :: sums
   end type load_tree

contains

   !> Makes the tree of a lattice of pressures.
   pure subroutine plant_load_tree(tree, pressure, first, step, shift)
      type(load_tree), intent(out) :: tree
      real(dp), intent(in) :: pressure(:, :)   !! [p*]
      real(dp), intent(in) :: first(2)         !! place of the first of them, x and y [rad of x]
      real(dp), intent(in) :: step(2)          !! of the lattice, at most shift/steps_in_shift
      real(dp), intent(in) :: shift            !! d

      type(tree_level) :: below, level
      real(dp) :: weight(2*nodes, nodes), x(2*nodes)
      integer :: a, b, blocks(2), i, j, k, l

      tree%shift = shift
      tree%corner = first - 0.5_dp*step
      level%step = step
      blocks = (shape(pressure) + nodes - 1)/nodes
      allocate (level%force(nodes, nodes, blocks(1), blocks(2)), source=0.0_dp)
      do j = 1, size(pressure, 2)
         do i = 1, size(pressure, 1)
            level%force(modulo(i - 1, nodes) + 1, modulo(j - 1, nodes) + 1, (i - 1)/nodes + 1, (j - 1)/nodes + 1) = &
               pressure(i, j)*product(step)
         end do
      end do
      ! Lagrange's polynomials of the nodes of a block, at the nodes of the two blocks in it.
      x = [(0.5_dp*i + 0.25_dp, i=1, 2*nodes)]
      do a = 1, nodes
         weight(:, a) = 1.0_dp
         do b = 1, nodes
            if (b /= a) weight(:, a) = weight(:, a)*(x - b)/(a - b)
         end do
      end do
      allocate (tree%levels(0))
      do
         tree%levels = [tree%levels, level]
         if (all(blocks == 1)) exit
         below = level
         ! Blocks become square.
         level%merged = merge(2, 1, below%step < 1.5_dp*minval(below%step, mask=blocks > 1) .and. blocks > 1)
         level%step = below%step*level%merged
         blocks = (blocks + level%merged - 1)/level%merged
         deallocate (level%force)
         allocate (level%force(nodes, nodes, blocks(1), blocks(2)), source=0.0_dp)
         do l = 1, size(below%force, 4)
            do k = 1, size(below%force, 3)
               associate (i => (k - 1)/level%merged(1), j => (l - 1)/level%merged(2))
                  level%force(:, :, i + 1, j + 1) = level%force(:, :, i + 1, j + 1) + matmul(transpose( &
                     weights_of(k - 1 - i*level%merged(1), level%merged(1))), matmul(below%force(:, :, k, l), &
                     weights_of(l - 1 - j*level%merged(2), level%merged(2))))
               end associate
            end do
         end do
      end do

   contains

      !> What a block of the level below gives to the nodes of the block that it is in.
      pure function weights_of(place, merged) result(weights)
         integer, intent(in) :: place    !! in that block, from 0
         integer, intent(in) :: merged   !! 1, or 2 of them
         real(dp) :: weights(nodes, nodes)

         if (merged == 2) then
            weights = weight(place*nodes + 1:(place + 1)*nodes, :)
         else
            weights = reshape([((merge(1.0_dp, 0.0_dp, a == b), a=1, nodes), b=1, nodes)], [nodes, nodes])
         end if
      end function weights_of

   end subroutine plant_load_tree

   !> The factor of a wave in what the tree leaves out, (S11).
   elemental real(dp) function left_out(self, q)
      class(load_tree), intent(in) :: self
      real(dp), intent(in) :: q   !! [1/rad of x]

      left_out = (1.0_dp - exp(-q*self%shift))**order
   end function left_out

   !> The sums (S4) of the smooth part.
   pure function sums(self, place)
      class(load_tree), intent(in) :: self
      real(dp), intent(in) :: place(3)   !! x, y, Z [rad of x]
      real(dp) :: sums(8)

      sums = 0.0_dp
      call add_block(self, size(self%levels), [1, 1], place, sums)
      sums = sums/(2*pi)
   end function sums

   !> Adds what a block, or those in it, cause.
   pure recursive subroutine add_block(tree, number, block, place, sums)
      type(load_tree), intent(in) :: tree
      integer, intent(in) :: number     !! of the level
      integer, intent(in) :: block(2)
      real(dp), intent(in) :: place(3)
      real(dp), intent(inout) :: sums(8)

      real(dp) :: from_corner(2), side(2)
      integer :: a, b, i, j

      associate (level => tree%levels(number), force => tree%levels(number)%force(:, :, block(1), block(2)))
         if (all(abs(force) <= 0.0_dp)) return
         side = nodes*level%step
         from_corner = place(:2) - tree%corner - (block - 1)*side
         if (number > 1 .and. norm2([from_corner - 0.5_dp*side, place(3) + tree%shift]) < whole_from*maxval(side)) then
            do j = level%merged(2)*(block(2) - 1) + 1, min(level%merged(2)*block(2), size(tree%levels(number - 1)%force, 4))
               do i = level%merged(1)*(block(1) - 1) + 1, &
                  min(level%merged(1)*block(1), size(tree%levels(number - 1)%force, 3))
                  call add_block(tree, number - 1, [i, j], place, sums)
               end do
            end do
         else
            do b = 1, nodes
               do a = 1, nodes
                  sums = sums + force(a, b)*of_force(from_corner - ([a, b] - 0.5_dp)*level%step, place(3), tree%shift)
               end do
            end do
         end if
      end associate
   end subroutine add_block

   !> The sums (S4) of a unit force at the shifted depths, times 2 pi: (S12).
   pure function of_force(r, z, shift) result(sums)
      real(dp), intent(in) :: r(2)    !! x, y from the force
      real(dp), intent(in) :: z       !! depth
      real(dp), intent(in) :: shift   !! d
      real(dp) :: sums(8)

      real(dp) :: c3, c5, depth, rho, s, t
      integer :: j

      sums = 0.0_dp
      do j = 1, order
         depth = z + j*shift
         rho = sqrt(r(1)**2 + r(2)**2 + depth**2)
         c3 = factors(j)/rho**3
         c5 = 3*c3/rho**2
         s = factors(j)/(rho*(rho + depth))
         t = c3/(rho + depth) + s/(rho*(rho + depth))
         sums = sums + [depth*c3, z*(c5*depth**2 - c3), s - r(1)**2*t, z*(c3 - c5*r(1)**2), -r(1)*r(2)*t, &
                        -z*c5*r(1)*r(2), -z*c5*depth*r(1), -z*c5*depth*r(2)]
      end do
   end function of_force

end module wavycon_load_tree
