!> FFTW's transforms of one-dimensional arrays, in both precisions. Each plan is made once and kept until the program
!> ends.
!>
!> N.B. Plans are made with FFTW_ESTIMATE. With FFTW_MEASURE the plan that is found to be the fastest would differ from
!> run to run, and so would the last digits of the results.
module wavycon_line_plans
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_f_procpointer, c_float, c_float_complex, &
      c_funloc, c_funptr, c_int, c_null_funptr, c_null_ptr, c_ptr
   use wavycon_fftw, only: FFTW_BACKWARD, FFTW_DESTROY_INPUT, FFTW_ESTIMATE, fftw_execute_dft, fftw_execute_dft_c2r, &
      fftw_execute_dft_r2c, fftw_execute_r2r, FFTW_FORWARD, fftw_plan_dft_1d, fftw_plan_dft_c2r_1d, &
      fftw_plan_dft_r2c_1d, fftw_plan_r2r_1d, FFTW_REDFT01, FFTW_REDFT10, fftwf_execute_dft, fftwf_execute_dft_c2r, &
      fftwf_execute_dft_r2c, fftwf_plan_dft_1d, fftwf_plan_dft_c2r_1d, fftwf_plan_dft_r2c_1d
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: line_plan, plan_of_line

   !> Transforms of real numbers to complex waves and back, and of complex numbers to complex waves and back.
   integer, parameter, public :: real_to_waves = 1, waves_to_real = 2, waves_forward = 3, waves_backward = 4
   !> Transforms of the values of an even field to its cosines (DCT-II) and back (DCT-III), in double precision only.
   integer, parameter, public :: values_to_cosines = 5, cosines_to_values = 6

   type :: line_plan
      integer, private :: key(3) = 0     !! transform, length and precision, as in plan_of_line
      type(c_ptr) :: plan = c_null_ptr   !! FFTW's plan
      procedure(execute_plan), pointer, nopass :: execute => null()   !! FFTW's procedure for this kind of plan
   end type line_plan

   abstract interface
      !> `execute`: transforms one array to another. Both must be of the type and kind that the plan is for, and aligned
      !> in memory as `allocate` aligns arrays. The input is overwritten.
      subroutine execute_plan(plan, from, to) bind(c)
         import :: c_ptr
         type(c_ptr), value :: plan               !! component `plan` of the same line_plan
         type(*), intent(inout) :: from(*), to(*) !! input and output
      end subroutine execute_plan
   end interface

   type(line_plan), allocatable :: kept(:)   !! all plans made so far

contains

   !> The plan of a transform, which is made if there is none yet. Several threads may execute a plan at the same time.
   !> A plan is never destroyed.
   type(line_plan) function plan_of_line(transform, length, number_kind) result(plan)
      integer, intent(in) :: transform     !! one of the six transforms above
      integer, intent(in) :: length        !! number of real values, for complex transforms of complex ones, >= 1
      integer, intent(in) :: number_kind   !! kind of the numbers: dp or sp

      type(line_plan), allocatable :: more(:)
      integer :: i

      ! FFTW's planner is not thread-safe.
      !$omp critical (wavycon_fftw_planner)
      if (.not. allocated(kept)) allocate (kept(0))
      do i = 1, size(kept)
         if (all(kept(i)%key == [transform, length, number_kind])) exit
      end do
      if (i > size(kept)) then
         allocate (more(i))
         more(:i - 1) = kept
         more(i) = new_plan(transform, int(length, c_int), number_kind)
         call move_alloc(more, kept)
      end if
      plan = kept(i)
      !$omp end critical (wavycon_fftw_planner)
   end function plan_of_line

   !> Makes a plan.
   type(line_plan) function new_plan(transform, length, number_kind) result(new)
      integer, intent(in) :: transform, number_kind   !! as in plan_of_line, and `length`
      integer(c_int), intent(in) :: length

      integer(c_int), parameter :: flags = ior(FFTW_ESTIMATE, FFTW_DESTROY_INPUT)
      complex(c_double_complex), allocatable :: more_waves(:), waves(:)
      complex(c_float_complex), allocatable :: more_single_waves(:), single_waves(:)
      real(c_double), allocatable :: more_values(:), values(:)
      real(c_float), allocatable :: single_values(:)
      integer(c_int) :: kind_of_cosines, sign_of_waves
      type(c_funptr) :: execute

      ! FFTW uses only the alignment of these arrays, not their values.
      allocate (values(length), more_values(length), waves(length), more_waves(length))
      allocate (single_values(length), single_waves(length), more_single_waves(length))
      new%key = [transform, int(length), number_kind]
      execute = c_null_funptr
      sign_of_waves = FFTW_BACKWARD
      if (transform == waves_forward) sign_of_waves = FFTW_FORWARD
      kind_of_cosines = FFTW_REDFT01
      if (transform == values_to_cosines) kind_of_cosines = FFTW_REDFT10
      associate (plan => new%plan)
         ! The cases of single precision have negative numbers.
         select case (merge(transform, -transform, number_kind == dp))
         case (real_to_waves)
            plan = fftw_plan_dft_r2c_1d(length, values, waves, flags)
            execute = c_funloc(fftw_execute_dft_r2c)
         case (waves_to_real)
            plan = fftw_plan_dft_c2r_1d(length, waves, values, flags)
            execute = c_funloc(fftw_execute_dft_c2r)
         case (waves_forward, waves_backward)
            plan = fftw_plan_dft_1d(length, waves, more_waves, sign_of_waves, flags)
            execute = c_funloc(fftw_execute_dft)
         case (values_to_cosines, cosines_to_values)
            plan = fftw_plan_r2r_1d(length, values, more_values, kind_of_cosines, flags)
            execute = c_funloc(fftw_execute_r2r)
         case (-real_to_waves)
            plan = fftwf_plan_dft_r2c_1d(length, single_values, single_waves, flags)
            execute = c_funloc(fftwf_execute_dft_r2c)
         case (-waves_to_real)
            plan = fftwf_plan_dft_c2r_1d(length, single_waves, single_values, flags)
            execute = c_funloc(fftwf_execute_dft_c2r)
         case (-waves_forward, -waves_backward)
            plan = fftwf_plan_dft_1d(length, single_waves, more_single_waves, sign_of_waves, flags)
            execute = c_funloc(fftwf_execute_dft)
         end select
      end associate
      call c_f_procpointer(execute, new%execute)
   end function new_plan

end module wavycon_line_plans
