!> Solves one load at a time on request, so that another program can time its own solver in between.
!>
!>    bench_single_solves HARMONICS POINTS
!>
!> writes the quadratic programme of the two-dimensional wave with full symmetry,  min 1/2 x'Dx - c'x
!> subject to  Cx >= -P:  n and m, then D (n numbers a line), c, and the columns of C' (n numbers a line).
!> Then it reads lines with a load P and a number of solves, and answers each with three lines: status and
!> pivots; the times of the solves [ms]; x.
program bench_single_solves
   use, intrinsic :: iso_fortran_env, only: error_unit, input_unit, output_unit
   use samples, only: clock_ms
   use wavycon_contact_status, only: status_name, status_of_programme
   use wavycon_beale_contact, only: beale_contact, qp_options
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_solution
   use wavycon_wave_surfaces, only: wave_2d
   implicit none (type, external)

   character(*), parameter :: numbers = '(*(es26.17e3))'
   type(beale_contact) :: fresh, contact
   type(qp_solution) :: programme
   real(dp), allocatable :: times(:)
   real(dp) :: load, before
   integer :: i, count, ios

   call fresh%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), qp_options(argument(1), argument(2)))
   write (output_unit, '(i0,1x,i0)') shape(fresh%problem%normals)
   do i = 1, size(fresh%problem%linear)
      write (output_unit, numbers) fresh%problem%hessian(:, i)
   end do
   write (output_unit, numbers) fresh%problem%linear
   do i = 1, size(fresh%problem%bounds)
      write (output_unit, numbers) fresh%problem%normals(:, i)
   end do
   flush (output_unit)

   do
      read (input_unit, *, iostat=ios) load, count
      if (ios /= 0) stop
      allocate (times(count))
      do i = 1, count
         contact = fresh
         before = clock_ms()
         call contact%solve_programme(load, programme)
         times(i) = clock_ms() - before
      end do
      write (output_unit, '(a,1x,i0)') trim(status_name(status_of_programme(programme%status))), programme%pivots
      write (output_unit, numbers) times
      write (output_unit, numbers) programme%x
      flush (output_unit)
      deallocate (times)
   end do

contains

   !> A whole number from the command line.
   integer function argument(place)
      integer, intent(in) :: place

      character(12) :: word
      integer :: failed

      call get_command_argument(place, word)
      read (word, *, iostat=failed) argument
      if (failed /= 0) then
         write (error_unit, '(a)') 'usage: bench_single_solves HARMONICS POINTS'
         stop 1
      end if
   end function argument

end program bench_single_solves
