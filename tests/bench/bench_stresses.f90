!> Measures what stresses cost beside the solution: a section of 128 x 64 points, a search for the largest stresses (von
!> Mises and shear), and a plane; of the closed form, of expansions from light to heavy load, and of grids.
program bench_stresses
   use, intrinsic :: iso_fortran_env, only: output_unit
   use samples, only: clock_ms, sample_set
   use wavycon_closed_form_contact, only: closed_form_contact
   use wavycon_constants, only: pi
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_elastic_body, only: elastic_body
   use wavycon_fitted_contact, only: fitted_contact, fitted_options
   use wavycon_grid_contact, only: grid_contact, grid_options
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: find_largest_stresses, largest_stress
   use wavycon_self_affine, only: make_heights, self_affine_spectrum
   use wavycon_stress_fields, only: stress_fields
   use wavycon_surface, only: surface_of_points, surface_type
   use wavycon_wave_surfaces, only: hexagonal, wave_1d, wave_2d
   implicit none (type, external)

   !> Repetitions, of which the median is reported, and their time limit [ms].
   integer, parameter :: repeats = 9
   real(dp), parameter :: enough = 1500.0_dp
   real(dp), parameter :: loads(*) = [1e-3_dp, 0.1_dp, 0.3_dp, 0.9_dp]
   !> Points of a section along the line and in depth.
   integer, parameter :: across = 128, down = 64

   type(closed_form_contact) :: closed
   type(fitted_contact) :: fitted
   type(grid_contact) :: grid
   integer :: i
   integer, parameter :: map_sides(*) = [256, 1024]

   write (output_unit, '(a)') '# Stresses: a load solved, a section of 128 x 64 points, the search for the largest '// &
      'von Mises and shear stress, and a'
   write (output_unit, '(a)') '# plane of 128 x 128 points, or of those of the height map, '// &
         'at a depth of 0.1 of the '// &
      'cell; medians [ms]'
   write (output_unit, '(a)') '# solver      surface    accuracy       P      solve    section     search      plane'
   call closed%start(wave_1d(1.0_dp, 1.0_dp))
   call measure(closed, 'closed_form', 'wave_1d', epsilon(1.0_dp), [128, 1])
   call fitted%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), fitted_options(1e-4_dp), keep_fields=.true.)
   call measure(fitted, 'fitted', 'wave_2d', 1e-4_dp, [128, 128])
   call fitted%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), fitted_options(1e-10_dp), keep_fields=.true.)
   call measure(fitted, 'fitted', 'wave_2d', 1e-10_dp, [128, 128])
   call fitted%start(hexagonal(1.0_dp, 1.0_dp), fitted_options(1e-10_dp), keep_fields=.true.)
   call measure(fitted, 'fitted', 'hexagonal', 1e-10_dp, [128, 128])
   call grid%start(wave_2d(1.0_dp, 1.0_dp, 1.0_dp), grid_options(), keep_fields=.true.)
   call measure(grid, 'grid', 'wave_2d', 1e-3_dp, [128, 128])
   do i = 1, size(map_sides)
      call grid%start(rough_surface(map_sides(i)), grid_options(points=[1, 1]*map_sides(i)), keep_fields=.true.)
      call measure(grid, 'grid', 'rough'//merge('_256 ', '_1024', map_sides(i) == 256), 1e-3_dp, [1, 1]*map_sides(i))
   end do

contains

   subroutine measure(solver, name, surface_name, accuracy, points)
      class(contact_solver), intent(inout) :: solver   !! started
      character(*), intent(in) :: name, surface_name
      real(dp), intent(in) :: accuracy
      integer, intent(in) :: points(2)                 !! of the plane

      type(contact_solution) :: solution
      class(stress_fields), allocatable :: fields
      type(sample_set) :: times(3)
      real(dp) :: solve, spent, start
      integer :: i, k

      do i = 1, size(loads)
         start = clock_ms()
         call solver%solve(loads(i), solution)
         solve = clock_ms() - start
         do k = 1, size(times)
            times(k) = sample_set()
            spent = 0.0_dp
            do while (times(k)%count < repeats .and. spent < enough)
               start = clock_ms()
               ! Each begins with nothing prepared.
               call solution%stresses(solver%surface, fields)
               if (k == 1) call section(solver%surface, fields)
               if (k == 2) call search(fields)
               if (k == 3) call plane(points, fields)
               call times(k)%add(clock_ms() - start)
               spent = spent + clock_ms() - start
            end do
         end do
         write (output_unit, '(2x, a11, 1x, a10, es9.1, es9.1, 4f11.2)') name, surface_name, accuracy, loads(i), &
            solve, (times(k)%median(), k=1, size(times))
      end do
   end subroutine measure

   !> From the surface to a cell's side below it.
   subroutine section(surface, fields)
      type(surface_type), intent(in) :: surface
      class(stress_fields), intent(inout) :: fields

      real(dp) :: errors(across), parts(6, 2, across), t(across)
      integer :: k

      t = [(2*pi*k/across, k=0, across - 1)]
      do k = 0, down - 1
         call fields%on_line(surface%crest, [1, 0], t, 2*pi*k/down, parts, errors)
      end do
   end subroutine section

   subroutine search(fields)
      class(stress_fields), intent(inout) :: fields

      type(largest_stress) :: shear, yielding

      call find_largest_stresses(fields, elastic_body(), yielding, shear)
   end subroutine search

   subroutine plane(points, fields)
      integer, intent(in) :: points(2)
      class(stress_fields), intent(inout) :: fields

      real(dp), allocatable :: errors(:, :), stress(:, :, :)

      call fields%on_plane(points, [0.0_dp, 0.0_dp], 0.1_dp*2*pi, elastic_body(), stress, errors)
   end subroutine plane

   !> A rough height map, waves of 8 to 64 in a cell.
   type(surface_type) function rough_surface(side) result(surface)
      integer, intent(in) :: side   !! points of a side

      real(dp), allocatable :: height(:, :)

      allocate (height(side, side))
      call make_heights(self_affine_spectrum(longest=1/8.0_dp, rolloff=1/8.0_dp, shortest=1/64.0_dp), height)
      surface = surface_of_points([1.0_dp, 1.0_dp], height)
   end function rough_surface

end program bench_stresses
