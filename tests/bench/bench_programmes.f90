!> Solves one load at a time on request, so that another program can time its own solver in between.
!>
!>    bench_programmes HARMONICS POINTS SYMMETRY WAY
!>
!> takes the quadratic programme of the two-dimensional wave with a symmetry, 'full', 'diagonal' or 'none', min 1/2 x'Dx
!> - c'x subject to  Cx >= -P, to be solved by 'dual' or by 'beale' from x = 0. It writes the shape n and m of C', and
!> reads lines with a load P and a number of solves. Each is answered by three lines: status and pivots; the times of
!> the solves [ms], each from nothing; x. With 0 solves there is one, which starts from the last answer. With -1 the
!> answer is the programme: D (n numbers a line), c, and the columns of C' (n numbers a line).
program bench_programmes
   use, intrinsic :: iso_fortran_env, only: error_unit, input_unit, output_unit
   use wavycon_series_contact, only: series_contact, qp_options
   use wavycon_fourier_terms, only: symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_kinds, only: dp
   use wavycon_qp_problem, only: qp_solution
   use wavycon_solution_record, only: status_name, status_of_programme
   use wavycon_wave_surfaces, only: wave_2d
   implicit none (type, external)

   character(*), parameter :: numbers = '(*(es26.17e3))'
   type(series_contact) :: fresh, contact
   type(qp_solution) :: programme
   character(12) :: words(4)
   real(dp), allocatable :: times(:)
   real(dp) :: load, before, after
   integer :: harmonics, i, j, count, ios, points, symmetry

   do i = 1, size(words)
      call get_command_argument(i, words(i))
   end do
   read (words(:2), *, iostat=ios) harmonics, points
   if (ios /= 0) then
      write (error_unit, '(a)') 'usage: bench_programmes HARMONICS POINTS SYMMETRY WAY'
      stop 1
   end if
   select case (words(3))
   case ('diagonal')
      symmetry = symmetry_diagonal
   case ('none')
      symmetry = symmetry_none
   case default
      symmetry = symmetry_full
   end select
   call fresh%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), qp_options(harmonics, points, &
      symmetry, uses_beale=words(4) == 'beale'))
   contact = fresh
   write (output_unit, '(i0,1x,i0)') shape(fresh%problem%normals)
   flush (output_unit)
   do
      read (input_unit, *, iostat=ios) load, count
      if (ios /= 0) stop
      if (count < 0) then
         do i = 1, size(fresh%problem%linear)
            write (output_unit, numbers) [(merge(fresh%problem%hessian(i), 0.0_dp, j == i), &
                                           j=1, size(fresh%problem%linear))]
         end do
         write (output_unit, numbers) fresh%problem%linear
         do i = 1, size(fresh%problem%bounds)
            write (output_unit, numbers) fresh%problem%normals(:, i)
         end do
      else
         allocate (times(max(1, count)))
         do i = 1, size(times)
            if (count > 0) contact = fresh
            call cpu_time(before)
            call contact%solve_programme(load, programme)
            call cpu_time(after)
            times(i) = 1000*(after - before)
         end do
         write (output_unit, '(a,1x,i0)') trim(status_name(status_of_programme(programme%status))), programme%pivots
         write (output_unit, numbers) times
         write (output_unit, numbers) programme%x
         deallocate (times)
      end if
      flush (output_unit)
   end do

end program bench_programmes
