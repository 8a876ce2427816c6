!> Counts the iterations on self-affine surfaces, to a residual (C9) of 1e-8 on the last grid.
!>
!>    bench_iterations LARGEST
!>
!> The grids have 512 to LARGEST points a side. A row is a surface and load: iterations on the last grid, and on all
!> grids, each weighted by its points over those of the last; and pairs of transforms, weighted likewise. The last line
!> has the most iterations on a last grid.
module bench_iteration_count
   use wavycon_kinds, only: dp
   use wavycon_solver_progress, only: solver_progress
   implicit none (type, external)

   !> Of each grid: its iterations and the points along its side.
   integer :: numbers(20), sides(20), grids

   type, extends(solver_progress) :: iteration_count
   contains
      procedure :: grid_solved
   end type iteration_count

contains

   subroutine grid_solved(self, points, iterations, residual)
      class(iteration_count), intent(in) :: self
      integer, intent(in) :: points(2), iterations
      real(dp), intent(in) :: residual

      associate (unused => self, also_unused => residual); end associate
      grids = grids + 1
      sides(grids) = points(1)
      numbers(grids) = iterations
   end subroutine grid_solved

end module bench_iteration_count

program bench_iterations
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use bench_iteration_count, only: grids, iteration_count, numbers, sides
   use wavycon_error, only: error_type
   use wavycon_grid_sequence, only: sequence_answer, solve_by_sequence
   use wavycon_kinds, only: dp, pi
   use wavycon_map_statistics, only: map_statistics
   use wavycon_quantities, only: contact_area_counted
   use wavycon_self_affine, only: self_affine_spectrum, self_affine_surface
   use wavycon_surface, only: surface_type
   implicit none (type, external)

   integer, parameter :: cutoffs(2) = [4, 16], seeds = 3
   !> By Persson's estimate, which gives the mean pressure: area = erf(2^(1/2) p/(E* h')), with the rms slope h'.
   real(dp), parameter :: areas(*) = [0.001_dp, 0.01_dp, 0.05_dp, 0.2_dp, 0.5_dp, 0.9_dp, 0.99_dp, 0.999_dp]
   real(dp), parameter :: slope = 1.0_dp

   type(error_type), allocatable :: error
   type(iteration_count) :: progress
   type(map_statistics), allocatable :: map
   type(self_affine_spectrum) :: spectrum
   type(sequence_answer) :: answer
   type(surface_type) :: surface
   character(20) :: argument
   real(dp) :: full, weighted
   integer :: i, j, largest, seed, side, worst

   call get_command_argument(1, argument)
   read (argument, *, iostat=i) largest
   if (i /= 0) then
      write (error_unit, '(a)') 'usage: bench_iterations LARGEST'
      stop 1
   end if
   worst = 0
   write (output_unit, '(a)') &
      '# points  shortest_wave      area  seed    contact  iterations_on_last_grid  iterations_weighted  '// &
      'transform_pairs  residual'
   side = 512
   do while (side <= largest)
      do j = 1, size(cutoffs)
         do i = 1, size(areas)
            do seed = 1, seeds
               spectrum%length = 1.0_dp
               spectrum%longest = 0.125_dp
               spectrum%rolloff = 0.125_dp
               spectrum%shortest = real(cutoffs(j), dp)/side
               spectrum%seed = seed
               spectrum%by_slope = .true.
               spectrum%rms = slope
               call self_affine_surface('bench', spectrum, [side, side], surface, map, error)
               full = surface%full_contact_pressure(1.0_dp/pi)
               grids = 0
               call solve_by_sequence(surface, inverse_erf(areas(i))*slope/(sqrt(2.0_dp)*pi*full), 0.0_dp, &
                                      surface%points, answer, progress, 1e-8_dp)
               weighted = sum(numbers(:grids)*(real(sides(:grids), dp)/side)**2)
               write (output_unit, '(2x,i6,i15,f10.3,i6,f11.5,i25,f21.1,f17.2,es10.1)') &
                  side, cutoffs(j), areas(i), seed, answer%value(contact_area_counted), numbers(grids), weighted, &
                  answer%transform_pairs, answer%state%residual
               flush (output_unit)
               worst = max(worst, numbers(grids))
            end do
         end do
      end do
      side = 2*side
   end do
   write (output_unit, '(a,i0)') '# most iterations on a last grid: ', worst

contains

   !> By Newton's method, from below the root, where erf is concave.
   pure real(dp) function inverse_erf(y) result(x)
      real(dp), intent(in) :: y   !! in [0, 1)

      integer :: step

      x = 0.0_dp
      do step = 1, 60
         x = x - (erf(x) - y)*sqrt(pi)/2*exp(x**2)
      end do
   end function inverse_erf

end program bench_iterations
