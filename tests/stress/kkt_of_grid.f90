!> The contact conditions of a solution on a grid, in quadruple precision and without a transform.
!>
!> The displacement is the sum over the points in contact of the pressure times the displacement of the half-space under
!> a unit pressure at one point, a sum of cosines. The check is independent of the library's operator and uses only the
!> pressure and the mean gap of the solution; its gap is checked.
module stress_kkt_of_grid
   use, intrinsic :: iso_fortran_env, only: real128
   use wavycon_grid_edge, only: grid_edge
   use wavycon_grid_source, only: grid_source
   use wavycon_kinds, only: dp
   use wavycon_quantities, only: approach
   use wavycon_solution_record, only: solution_record
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: check_grid, grid_kkt

   integer, parameter :: qp = real128
   real(qp), parameter :: two_pi = 8*atan(1.0_qp)

   !> Violations.
   type :: grid_kkt
      logical :: well_formed = .false.         !! there are finite pressures and gaps, and some contact
      real(dp) :: load = huge(1.0_dp)          !! of the mean pressure [P]
      !> Root mean square of gaps in contact, where p = H only those above zero, and of overlaps elsewhere [Delta].
      real(dp) :: residual = huge(1.0_dp)
      real(dp) :: complementarity = huge(1.0_dp)   !! mean of |pressure times gap| where p < H [p* Delta]
      real(dp) :: gap = huge(1.0_dp)           !! largest error of the gaps reported, out of contact [Delta]
      real(dp) :: size_of_gaps = huge(1.0_dp)  !! mean of gaps and of overlaps where p = H [Delta]
      real(dp) :: depth = huge(1.0_dp)         !! of the surface's lowest point below its highest [Delta]
      !> Root mean square of the gap at the points beside those with 0 < p < H, times the square root of the part of all
      !> points that these are [Delta]: the default tolerance is a part of it.
      real(dp) :: edge_gap = huge(1.0_dp)
   end type grid_kkt

contains

   !> Checks a solution between no load and full contact on a grid of the whole cell.
   type(grid_kkt) function check_grid(surface, record, source) result(kkt)
      type(surface_type), intent(in) :: surface
      type(solution_record), intent(in) :: record
      type(grid_source), intent(in) :: source   !! of a grid that carries all waves of the surface

      real(qp), allocatable :: pressure(:, :), gap(:, :)
      logical, allocatable :: beside(:, :), contact(:, :), free(:, :)
      real(qp) :: told, undeformed
      integer :: i, j, m, n

      associate (field => source%edge%pressure_or_gap)
         kkt%well_formed = all(abs(field) <= huge(1.0_dp)) .and. any(field > 0.0_dp) .and. &
                           all(field <= surface%hardness)
         if (.not. kkt%well_formed) return
         m = size(field, 1)
         n = size(field, 2)
         if (source%edge%even) m = 2*m
         if (source%edge%even .and. n > 1) n = 2*n
         allocate (pressure(m, n), gap(m, n))
         do j = 1, n
            do i = 1, m
               pressure(i, j) = max(field(source%edge%index_in_grid(i, 1), source%edge%index_in_grid(j, 2)), 0.0_dp)
            end do
         end do
         contact = pressure > 0.0_qp
         free = contact .and. pressure < surface%hardness
         kkt%load = relative(sum(pressure)/size(pressure), record%pbar_over_pstar)

         call displace(surface, pressure, gap)
         kkt%depth = 0.0_dp
         do j = 1, n
            do i = 1, m
               undeformed = undeformed_gap(surface, source%edge, i, j)
               kkt%depth = max(kkt%depth, real(abs(undeformed), dp))
               gap(i, j) = gap(i, j) + undeformed - record%value(approach)
            end do
         end do
         kkt%residual = real(sqrt((sum(merge(gap, min(gap, 0.0_qp), contact)**2, free .or. .not. contact) &
                                   + sum(max(gap, 0.0_qp)**2, contact .and. .not. free))/size(gap)), dp)
         kkt%complementarity = real(sum(abs(pressure*gap), free .or. .not. contact)/size(gap), dp)
         kkt%size_of_gaps = real(sum(abs(gap), .not. free)/size(gap), dp)
         beside = .not. free .and. (cshift(free, 1, 1) .or. cshift(free, -1, 1) &
                                    .or. cshift(free, 1, 2) .or. cshift(free, -1, 2))
         kkt%edge_gap = real(sqrt(sum(gap**2, beside)/max(count(beside), 1)*count(free)/size(gap)), dp)
         kkt%gap = 0.0_dp
         do j = 1, n
            do i = 1, m
               if (contact(i, j)) cycle
               told = -field(source%edge%index_in_grid(i, 1), source%edge%index_in_grid(j, 2))
               kkt%gap = max(kkt%gap, real(abs(told - max(gap(i, j), 0.0_qp)), dp))
            end do
         end do
      end associate
   end function check_grid

   !> h/Delta of a point. The points of a quarter of the cell start half a step from its rim.
   real(qp) function undeformed_gap(surface, edge, i, j) result(h)
      type(surface_type), intent(in) :: surface
      type(grid_edge), intent(in) :: edge
      integer, intent(in) :: i, j

      real(dp) :: angle(2)

      angle = edge%angles(real([i, j], dp))
      if (surface%dimension == 1) angle(2) = 0.0_dp
      h = 1 - surface%shape_at(angle(1), angle(2))
   end function undeformed_gap

   !> u - ubar [Delta] of a pressure [p*] on the points of the whole cell.
   subroutine displace(surface, pressure, displacement)
      type(surface_type), intent(in) :: surface
      real(qp), intent(in) :: pressure(:, :)        !! shape (m, n)
      real(qp), intent(out) :: displacement(:, :)   !! shape (m, n)

      real(qp), dimension(0:size(pressure, 1) - 1, 0:size(pressure, 2) - 1) :: answer
      integer :: i, j, k, l, m, n

      m = size(pressure, 1)
      n = size(pressure, 2)
      answer = answer_to_a_point(surface, m, n)
      displacement = 0.0_qp
      do l = 1, n
         do k = 1, m
            if (.not. pressure(k, l) > 0.0_qp) cycle
            do j = 1, n
               do i = 1, m
                  displacement(i, j) = displacement(i, j) + pressure(k, l)*answer(abs(i - k), abs(j - l))
               end do
            end do
         end do
      end do
   end subroutine displace

   !> u - ubar at a number of steps from a point with unit pressure: the sum over all waves that the grid resolves, each
   !> with u = p times its wavelength over the stiffness.
   function answer_to_a_point(surface, m, n) result(u)
      type(surface_type), intent(in) :: surface
      integer, intent(in) :: m, n
      real(qp) :: u(0:m - 1, 0:n - 1)

      real(qp) :: along_x(0:m - 1, 0:n/2), weight(0:m/2, 0:n/2)
      integer :: i, j, k, l

      do l = 0, n/2
         do k = 0, m/2
            weight(k, l) = 0.0_qp
            if (k + l == 0) cycle
            ! Waves come in pairs k and -k, except wave number zero and the shortest.
            weight(k, l) = merge(1, 2, k == 0 .or. 2*k == m)*merge(1, 2, l == 0 .or. 2*l == n) &
                           /sqrt((k/real(surface%length(1), qp))**2 + (l/real(surface%length(2), qp))**2)
         end do
      end do
      weight = weight/(real(m, qp)*n*surface%stiffness)
      along_x = 0.0_qp
      do l = 0, n/2
         do k = 0, m/2
            do i = 0, m - 1
               along_x(i, l) = along_x(i, l) + weight(k, l)*cos(two_pi*modulo(k*i, m)/m)
            end do
         end do
      end do
      u = 0.0_qp
      do j = 0, n - 1
         do l = 0, n/2
            u(:, j) = u(:, j) + along_x(:, l)*cos(two_pi*modulo(l*j, n)/n)
         end do
      end do
   end function answer_to_a_point

   !> |a - b|/b.
   pure real(dp) function relative(a, b)
      real(qp), intent(in) :: a
      real(dp), intent(in) :: b

      relative = real(abs(a - b)/b, dp)
   end function relative

end module stress_kkt_of_grid
