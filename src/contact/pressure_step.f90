!> Moves the pressure of a correction by a step: (C7), or (C24) where points pass the hardness. Numbers (C..) are the
!> equations of README.md in this directory.
module wavycon_pressure_step
   use, intrinsic :: iso_fortran_env, only: int8, int64
   use wavycon_assertion, only: assert
   use wavycon_contact_region, only: longest_chunk
   use wavycon_correction_state, only: correction_state, gap_sums
   use wavycon_kinds, only: dp, sp
   use wavycon_lapack, only: sdot
   use wavycon_pressure_load, only: bounded_shift
   implicit none (type, external)
   private

   public :: take_step

   real(sp), parameter :: ones(longest_chunk) = 1.0_sp

contains

   !> Moves pressure and gap by a step. Points whose pressure would not stay positive are removed from the active set;
   !> the others are then multiplied by a factor that restores the mean pressure (C7). Where points pass H, (C24) takes
   !> its place.
   subroutine take_step(state, direction, step, field, sums, has_met_bounds)
      type(correction_state), intent(inout) :: state
      real(sp), intent(in), contiguous :: direction(:)   !! d, shape (region%points)
      real(sp), intent(in) :: step
      real(sp), intent(inout), contiguous :: field(:, :)   !! Sd; if points met a bound, what p changes besides the step
      real(dp), intent(out) :: sums(gap_sums)   !! of `measure_gap`, if no point met a bound
      logical, intent(out) :: has_met_bounds

      real(dp) :: all_sums(gap_sums + 3)

      call assert(size(direction) == state%region%points, 'the direction is a vector of the region')
      has_met_bounds = .true.
      if (passes_hardness(state, direction, step)) then
         call move_between_bounds(state, direction, step, field)
      else
         call move_freely(state, direction, step, field, all_sums)
         sums = all_sums(:gap_sums)
         has_met_bounds = all_sums(gap_sums + 1) > 0.0_dp
         if (has_met_bounds) call restore_mean(state, all_sums(gap_sums + 2), all_sums(gap_sums + 3), field)
      end if
   end subroutine take_step

   !> Whether a step takes free points to H or beyond.
   logical function passes_hardness(state, direction, step) result(passes)
      type(correction_state), intent(in) :: state
      real(sp), intent(in), contiguous :: direction(:)
      real(sp), intent(in) :: step

      integer(int64) :: slabs(1)   ! in which a point does

      passes = .false.
      if (state%hardness >= huge(state%hardness)) return
      slabs = merge(1, 0, any(state%contact > 0 .and. state%change - step*direction >= state%room))
      call state%slab%add(slabs)
      passes = slabs(1) > 0
   end function passes_hardness

   !> A step that no point ends at H. What points that leave the contact pass zero by stays in `change`; if there are
   !> any, `restore_mean` follows.
   subroutine move_freely(state, direction, step, field, sums)
      type(correction_state), intent(inout) :: state
      real(sp), intent(in), contiguous :: direction(:)
      real(sp), intent(in) :: step
      real(sp), intent(in), contiguous :: field(:, :)   !! Sd
      !> Those of `measure_gap`, which hold if no point leaves; the points that leave, the sum of the pressures at the
      !> others, and that of the changes since the start.
      real(dp), intent(out) :: sums(gap_sums + 3)

      real(dp), allocatable :: parts(:, :)
      real(sp), dimension(longest_chunk) :: contact, image, pressure
      integer :: c, n

      allocate (parts(size(sums), state%region%chunks))
      !$omp parallel do num_threads(state%region%threads) private(contact, image, n, pressure)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            call state%region%take_chunk(c, field, image)
            state%gap(a:b) = (state%gap(a:b) - state%approach) - step*image(:n)
            state%change(a:b) = state%change(a:b) - step*direction(a:b)
            pressure(:n) = state%start_pressure(a:b) + state%change(a:b)
            contact(:n) = state%contact(a:b)
            image(:n) = merge(contact(:n), 0.0_sp, pressure(:n) <= 0.0_sp)
            contact(:n) = contact(:n) - image(:n)
            parts(gap_sums + 1, c) = sdot(n, image, 1, image, 1)
            if (parts(gap_sums + 1, c) > 0.0_dp) state%contact(a:b) = int(contact(:n), int8)
            parts(gap_sums + 2, c) = sdot(n, contact, 1, pressure, 1)
            image(:n) = max(state%change(a:b), -state%start_pressure(a:b))
            parts(gap_sums + 3, c) = sdot(n, image, 1, ones, 1)
            call state%measure_chunk(c, contact, parts(:gap_sums, c))
         end associate
      end do
      state%approach = 0.0_sp
      sums = state%totals(parts)
   end subroutine move_freely

   !> A step that ends at H for some points: the pressure at all free points changes by the same that restores the mean,
   !> and then to the nearer bound if it is beyond it (C24). Close to H the step is much longer than what is left of it,
   !> and is computed in double precision.
   subroutine move_between_bounds(state, direction, step, field)
      type(correction_state), intent(inout) :: state
      real(sp), intent(in), contiguous :: direction(:)
      real(sp), intent(in) :: step
      real(sp), intent(inout), contiguous :: field(:, :)   !! Sd, then what the pressure changes besides the step

      real(dp), allocatable :: change(:), parts(:, :)
      real(dp) :: shift, total(1)
      real(sp) :: image(longest_chunk)
      logical, allocatable :: free(:)
      integer, allocatable :: first(:)
      integer :: c, n, s

      allocate (change, source=state%change - real(step, dp)*direction)
      allocate (free, source=state%contact > 0)
      allocate (first(state%slab%strips() + 1), parts(1, state%slab%strips()))
      first(1) = 1
      do s = 1, size(parts, 2)
         associate (a => state%region%strip(s), b => state%region%strip(s + 1) - 1)
            first(s + 1) = first(s) + count(free(a:b))
            parts(1, s) = sum(change(a:b))
         end associate
      end do
      total = state%slab%strip_totals(parts)
      shift = bounded_shift(state%slab, first, pack(state%start_pressure + change, free), &
                            pack(state%room - change, free), -total(1))
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            call state%region%take_chunk(c, field, image)
            state%gap(a:b) = (state%gap(a:b) - state%approach) - step*image(:n)
            where (free(a:b))
               state%change(a:b) = real(min(max(change(a:b) + shift, -real(state%start_pressure(a:b), dp)), &
                                            real(state%room(a:b), dp)), sp)
               state%contact(a:b) = merge(0_int8, 1_int8, state%change(a:b) <= -state%start_pressure(a:b) .or. &
                                                          state%change(a:b) >= state%room(a:b))
            end where
            image(:n) = merge(real(state%change(a:b) - change(a:b), sp), 0.0_sp, free(a:b))
            call state%region%put_chunk(c, image, field)
         end associate
      end do
      state%approach = 0.0_sp
   end subroutine move_between_bounds

   !> Sets the pressure of the points that have left to zero and multiplies that at the free points by a factor, so that
   !> its mean is that of the start.
   subroutine restore_mean(state, load, change, field)
      type(correction_state), intent(inout) :: state
      real(dp), intent(in) :: load     !! sum of the pressures at the free points
      real(dp), intent(in) :: change   !! sum of the changes since the start, with those that have left at zero
      real(sp), intent(inout), contiguous :: field(:, :)   !! becomes what the pressure changes by both

      real(dp), allocatable :: parts(:, :)
      real(dp) :: start(1)
      real(sp) :: excess, factor
      real(sp), dimension(longest_chunk) :: contact, growth, image, pressure
      integer :: c, n
      logical :: shrinks

      excess = 0.0_sp
      factor = 0.0_sp
      if (load > 0.0_dp) excess = real(-change/load, sp)
      ! The step may be so much longer than the pressure that what is left of it would be rounded to zero.
      shrinks = excess <= -1.0_sp
      if (shrinks) then
         allocate (parts(1, state%region%chunks))
         do c = 1, state%region%chunks
            associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
               parts(1, c) = sdot(b - a + 1, state%start_pressure(a:b), 1, ones, 1)
            end associate
         end do
         start = state%totals(parts)
         factor = real(start(1)/load, sp)
      end if
      !$omp parallel do num_threads(state%region%threads) private(contact, growth, image, n, pressure)
      do c = 1, state%region%chunks
         associate (a => state%region%chunk(c), b => state%region%chunk(c + 1) - 1)
            n = b - a + 1
            pressure(:n) = state%start_pressure(a:b) + state%change(a:b)
            contact(:n) = state%contact(a:b)
            ! What points that have left are below zero; at others the pressure is not negative.
            image(:n) = max(-pressure(:n), 0.0_sp)
            if (shrinks) then
               growth(:n) = contact(:n)*(factor*pressure(:n) - state%start_pressure(a:b) - state%change(a:b))
               state%change(a:b) = merge(factor*pressure(:n) - state%start_pressure(a:b), &
                                        max(state%change(a:b), -state%start_pressure(a:b)), contact(:n) > 0.0_sp)
            else
               growth(:n) = contact(:n)*(excess*pressure(:n))
               state%change(a:b) = max(state%change(a:b), -state%start_pressure(a:b)) + growth(:n)
            end if
            image(:n) = image(:n) + growth(:n)
            call state%region%put_chunk(c, image, field)
         end associate
      end do
   end subroutine restore_mean

end module wavycon_pressure_step
