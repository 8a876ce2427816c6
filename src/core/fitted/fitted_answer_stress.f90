!> Stresses in the half-space below a fitted answer, with error estimates from the lower degrees: README.md, section 13.
!>
!> Their integration adds errors of 1e-10 of the peak pressure at most, at any depth, the surface included. The errors
!> of the solution itself come on top.
module wavycon_fitted_answer_stress
   use wavycon_degree_history, only: error_estimate
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_function_stress, only: fitted_function_stress, start_fitted_function_stress
   use wavycon_fitted_tuning, only: fastest_decay_at_point, stress_error_safety
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: contact_area, or_nan, peak_pressure, perimeter, unknown
   use wavycon_shape_search, only: edge_points
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: fitted_answer_stress, start_fitted_answer_stress

   type :: fitted_answer_stress
      type(fitted_answer) :: answer
      real(dp), private :: accuracy = 0.0_dp              !! error of the integrals over the peak pressure
      real(dp), private :: peak = 0.0_dp                  !! peak pressure; with adhesion plus the tension at the edge
      real(dp), private :: relative_error = 0.0_dp        !! relative error of the peak pressure or, if larger, the area
      real(dp), private :: edge_error = 0.0_dp            !! mean error of the edge's position [s]
      real(dp), private :: edge_shift = 0.0_dp            !! with adhesion the largest error of the edge's position [s]
      type(fitted_function_stress), allocatable, private :: of_degree(:)
         !! stresses of the answer's fitted function, 0, and of those of lower degrees, from 1 on
   contains
      procedure :: at
   end type fitted_answer_stress

contains

   !> Prepares the stresses of a solution. Series, tables and rules are made when a point first needs them.
   subroutine start_fitted_answer_stress(stress, lattice, answer, accuracy)
      type(fitted_answer_stress), intent(out) :: stress
      type(wave_lattice), intent(in) :: lattice    !! the lattice that was solved
      type(fitted_answer), intent(in) :: answer    !! the solution, status <= fitted_less_exact
      real(dp), intent(in) :: accuracy             !! error of the integrals over the peak pressure, > 0

      !> `away`: the largest distance of the edge of each degree from that of the answer.
      real(dp) :: area, area_error, away(1, 0:size(answer%previous)), shift(1)
      integer :: i, k

      stress%answer = answer
      stress%accuracy = accuracy
      allocate (stress%of_degree(0:size(answer%previous)))
      call start_fitted_function_stress(stress%of_degree(0), lattice, answer%solution, accuracy)
      do i = 1, ubound(stress%of_degree, 1)
         call start_fitted_function_stress(stress%of_degree(i), lattice, answer%previous(i), accuracy)
      end do
      ! The area of one spot or pool, and its error.
      area = answer%solution%shape%area()
      area_error = answer%error(contact_area)*lattice%area
      if (answer%pool) area_error = area_error/lattice%troughs
      stress%peak = answer%value(peak_pressure)
      if (answer%solution%work > 0.0_dp) then
         ! The peak may be 0 or a tension: as in `measure_fitted_function`.
         stress%peak = abs(stress%peak) + sqrt(answer%solution%work/(2*sqrt(area/pi)))
         away = 0.0_dp
         do i = 1, ubound(away, 2)
            associate (edge => edge_points(answer%previous(i)%shape) &
                       + merge(lattice%trough, (0.0_dp, 0.0_dp), answer%pool))
               away(1, i) = maxval([(stress%of_degree(0)%distance_from_edges(edge(k)), k=1, size(edge))])
            end associate
         end do
         shift = error_estimate(away, max(answer%misfit_decay, fastest_decay_at_point), [answer%solution%shape%b(0)])
         stress%edge_shift = shift(1)
      end if
      stress%relative_error = max(answer%error(peak_pressure)/stress%peak, area_error/area)
      ! Next to the edge stresses are larger than all pressures: the integrals have an error relative to the stress.
      if (answer%solution%work > 0.0_dp) stress%relative_error = stress%relative_error + accuracy
      stress%edge_error = area_error/answer%value(perimeter)
   end subroutine start_fitted_answer_stress

   !> The stresses at a point, less those of the mean pressure. The error is estimated by README.md (F64): from the
   !> stresses of lower degrees, the errors of peak pressure and area, and, next to the edge, the error of the edge's
   !> position. With adhesion it is NaN where the edge may be at the point, as stresses are infinite there.
   !>
   !> N.B. On the surface inside a pool the pressure is not exactly 0, but the residual of the equations.
   subroutine at(self, place, depth, nu_terms, error)
      class(fitted_answer_stress), intent(inout) :: self
      complex(dp), intent(in) :: place             !! x + i y from a crest [s]
      real(dp), intent(in) :: depth                !! depth z >= 0 [s]
      real(dp), intent(out) :: nu_terms(6, 2)
         !! xx, yy, zz, xy, xz, yz [pi E* Delta/s], tension > 0: the stress is nu_terms(:, 1) + nu*nu_terms(:, 2)
      real(dp), intent(out), optional :: error
         !! estimate of the largest error of the components for any 0 <= nu <= 1/2 [pi E* Delta/s]

      !> The matrix that makes the stresses for nu = 0 and nu = 1/2 of `nu_terms`.
      real(dp), parameter :: at_limits(2, 2) = reshape([1.0_dp, 0.0_dp, 1.0_dp, 0.5_dp], [2, 2])
      real(dp) :: distance, lower(6, 2), values(12, 0:ubound(self%of_degree, 1))
      integer :: i

      call self%of_degree(0)%at(place, depth, nu_terms)
      if (.not. present(error)) return
      values(:, 0) = reshape(matmul(nu_terms, at_limits), [12])
      do i = 1, ubound(values, 2)
         call self%of_degree(i)%at(place, depth, lower)
         values(:, i) = reshape(matmul(lower, at_limits), [12])
      end do
      distance = hypot(self%of_degree(0)%distance_from_edges(place), depth)
      associate (peak => self%peak)
         error = stress_error_safety*maxval(error_estimate(values, max(self%answer%misfit_decay, &
                                                                       fastest_decay_at_point), spread(peak, 1, 12))) &
            + self%accuracy*peak + self%relative_error*maxval(abs(values(:, 0))) &
            + peak/sqrt(self%answer%solution%shape%b(0)) &
            *self%edge_error/(sqrt(distance + self%edge_error) + sqrt(distance))
      end associate
      ! The change of (F65).
      associate (shift => self%edge_shift, tension => sqrt(self%answer%solution%work)/pi)
         if (shift >= distance) then
            error = or_nan(unknown)
         else if (shift > 0.0_dp) then
            error = error + tension*shift/(distance - shift)/sqrt(distance)
         end if
      end associate
   end subroutine at

end module wavycon_fitted_answer_stress
