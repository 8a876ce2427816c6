!> What all other spots or pools of the lattice, and the mean, add to the equations of one of them: README.md,
!> section 7.
!>
!> Where it pays and is as accurate this is a series made once for a size of the shape, otherwise a sum with the kernel
!> itself between all targets and sources. A cell with two pools has them too near to each other for the series.
module wavycon_lattice_images
   use wavycon_disc_rule, only: disc_rule
   use wavycon_expansion, only: expansion
   use wavycon_image_series, only: image_series, start_image_series
   use wavycon_image_sum, only: add_image_sum
   use wavycon_kinds, only: dp
   use wavycon_periodic_kernel, only: periodic_kernel
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: lattice_images

   type :: lattice_images
      type(image_series) :: series     !! of one regime
   contains
      procedure :: prepare
      procedure :: add_rows
   end type lattice_images

contains

   !> Makes the series for a shape, unless the one at hand holds for it.
   subroutine prepare(self, lattice, now, growth, tolerance)
      class(lattice_images), intent(inout) :: self
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now
      real(dp), intent(in) :: growth        !! >= 1, of the shape that the series is to hold for
      real(dp), intent(in) :: tolerance     !! > 0, of the series, relative

      if (self%series%holds_for(now%shape)) return
      if (two_in_a_cell(lattice, now)) return
      call start_image_series(self%series, lattice%kernel(merge(2, 1, now%pool)), now%basis%fold, &
                              growth*now%shape%radius(), tolerance)
   end subroutine prepare

   !> Adds the integrals of the terms of an expansion over all images for several targets, and the derivatives of their
   !> sum with respect to the shape.
   !>
   !> N.B. The derivatives are at fixed w_t: the targets move with the shape.
   subroutine add_rows(self, lattice, now, rule, values, target, rows, shape_rows)
      class(lattice_images), intent(in) :: self
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now
      type(disc_rule), intent(in) :: rule              !! with the weight of the expansion
      real(dp), intent(in) :: values(:, :)             !! of the basis at the rule's points, shape (n, N)
      complex(dp), intent(in) :: target(:)             !! w_t, |w_t| <= 1, shape (m)
      real(dp), intent(inout) :: rows(:, :)            !! integrals, shape (m, N)
      real(dp), intent(inout) :: shape_rows(:, 0:)     !! d(integral of the sum)/d b_k, shape (m, 0:K)

      type(periodic_kernel) :: whole

      if (self%series%holds_for(now%shape)) then
         call self%series%add_rows(now%shape, rule, values, now%c, target, rows, shape_rows)
         if (size(self%series%near%point, 2) > 0) &
            call add_image_sum(self%series%near, now%shape, rule, values, now%c, target, rows, shape_rows)
      else
         call add_image_sum(lattice%kernel(merge(2, 1, now%pool)), now%shape, rule, values, now%c, target, rows, &
                            shape_rows)
      end if
      if (two_in_a_cell(lattice, now)) then
         ! None of the second pools is the target's own.
         whole = lattice%kernel(2)
         whole%whole = .true.
         call add_image_sum(whole, now%shape, rule, values, now%c, target, rows, shape_rows, opposite=2*lattice%trough)
      end if
   end subroutine add_rows

   !> Whether a cell has a second pool, the first one turned by half a turn about a crest.
   pure logical function two_in_a_cell(lattice, now)
      type(wave_lattice), intent(in) :: lattice
      type(expansion), intent(in) :: now

      two_in_a_cell = now%pool .and. lattice%troughs == 2
   end function two_in_a_cell

end module wavycon_lattice_images
