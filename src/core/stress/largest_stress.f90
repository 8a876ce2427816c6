!> The largest von Mises stress and the largest shear stress in a body, and where they are.
!>
!> The search starts from places that the stress fields propose, those with the largest stresses first. About each place
!> a quadratic function is fitted to the stress at points around the place. The maximum of this function is the next
!> place, and the distance of the points is reduced: (S6), (S7) of README.md in this directory. Depths are mirrored at
!> the surface, so that the search may end on the surface.
module wavycon_largest_stress
   use wavycon_kinds, only: dp, ieee_is_nan, not_a_number, pi
   use wavycon_lapack, only: dsyev
   use wavycon_stress_fields, only: start_point, stress_fields
   use wavycon_stress_tensor, only: elastic_body, largest_shear, von_mises
   use wavycon_stress_tuning, only: close_to_largest, error_of_invariant, first_reach, gain_part, likely_gain, &
      most_models, search_accuracy, reach_factor, refined_places
   implicit none (type, external)
   private

   public :: largest_stress, find_largest_stresses

   type :: largest_stress
      real(dp) :: value = 0.0_dp        !! [p*]
      real(dp) :: error = 0.0_dp        !! estimate of its error [p*]; NaN if there is none
      real(dp) :: position(3) = 0.0_dp  !! X, Y, Z [rad]
   contains
      procedure :: position_in_cell
   end type largest_stress

contains

   !> Finds the largest von Mises stress and the largest shear stress in a body, each if its argument is present. Both
   !> are NaN if the load has no solution.
   subroutine find_largest_stresses(fields, body, yielding, shear)
      class(stress_fields), intent(inout) :: fields                    !! the stresses of one load
      type(elastic_body), intent(in) :: body                           !! Poisson's ratio and the lateral stress
      type(largest_stress), intent(out), optional :: yielding, shear   !! von Mises stress; shear stress

      real(dp) :: unknown
      type(start_point), allocatable :: places(:)

      unknown = not_a_number()
      if (present(yielding)) yielding = largest_stress(unknown, unknown, unknown)
      if (present(shear)) shear = largest_stress(unknown, unknown, unknown)
      if (.not. fields%exist) return
      call fields%start_points(body, places)
      if (present(yielding)) call search(fields, body, .false., places, yielding)
      if (present(shear)) call search(fields, body, .true., places, shear)
   end subroutine find_largest_stresses

   !> The position of the largest stress as parts of the cell: x/L_x and y/L_y, from 0 to 1, and z/L_x. In a cell of a
   !> height map and its mirror images the position is moved to the equivalent one in the map itself. NaN if the load
   !> has no solution.
   pure function position_in_cell(self, maps_in_cell) result(place)
      class(largest_stress), intent(in) :: self
      integer, intent(in) :: maps_in_cell(2)   !! maps along x and y in the cell: 2 if mirrored, otherwise 1
      real(dp) :: place(3)                     !! [-]

      !> An angle between -1e-6 and 0 is 0 but for rounding. Without this tolerance the position would be reported on
      !> the far side of the cell.
      real(dp), parameter :: rounding = 1e-6_dp   ! [rad]

      place = self%position
      ! Comparisons with NaN raise an exception, which Debug builds trap.
      if (ieee_is_nan(self%value)) return
      place(:2) = modulo(place(:2) + rounding, 2*pi) - rounding
      where (abs(place(:2)) <= rounding) place(:2) = 0.0_dp
      place = place/(2*pi)
      where (maps_in_cell > 1) place(:2) = abs(place(:2) - anint(place(:2)))
   end function position_in_cell

   !> Refines the places with the largest stresses, at most `refined_places` of them, and returns
   !> the largest refined stress.
   !>
   !> Two refined places are farther apart than twice the width of the maximum at the first one: closer places lead to
   !> the same maximum. The local error is what the place adds to the error that all places at its depth have. It is
   !> large at the edge of contact and falls with depth. So where a deeper place may have a larger stress by the local
   !> error, the places that are no deeper are given up, and deeper ones are refined. The error of the answer is at
   !> least the largest sum of a stress and its own error, less the answer.
   subroutine search(fields, body, by_shear, places, answer)
      class(stress_fields), intent(inout) :: fields
      type(elastic_body), intent(in) :: body
      logical, intent(in) :: by_shear   !! true: the shear stress is searched for; false: the von Mises stress
      type(start_point), intent(in) :: places(:)   !! at least one
      type(largest_stress), intent(out) :: answer

      !> Sizes of stresses [p*]: at the start places, -1 where a place is not to be refined; the least one that is
      !> refined; the largest one plus its error.
      real(dp) :: values(size(places)), threshold, highest
      real(dp) :: component_error, least_gain, gain, nu_terms(6, 2)
      real(dp) :: local, uncertainty   ! local error; whole error [p*], both 0 if unknown
      logical :: hides_deeper
      type(largest_stress) :: other
      integer :: best, i, k, refined

      values = [(size_of(by_shear, places(i)%stress), i=1, size(places))]
      best = maxloc(values, dim=1)
      least_gain = search_accuracy*values(best)
      associate (here => places(best)%position)
         call fields%at(here(1), here(2), here(3), nu_terms, component_error)
      end associate
      if (.not. ieee_is_nan(component_error)) least_gain = min(gain_part*component_error, least_gain)
      answer%value = -1.0_dp
      threshold = 0.0_dp
      highest = 0.0_dp
      hides_deeper = .false.
      refined = 0
      do while (refined < refined_places)
         best = maxloc(values, dim=1)
         if (values(best) < threshold) exit
         other%value = values(best)
         other%position = places(best)%position
         gain = 0.0_dp
         ! One place of those that hide deeper ones is refined.
         if (hides_deeper) call measure()
         if (.not. hides_deeper) then
            call refine(fields, body, by_shear, places(best)%width, least_gain, answer%value, other, gain)
            if (fields%dimension == 1) other%position(2) = 0.0_dp
            call measure()
         end if
         if (.not. hides_deeper) refined = refined + 1
         highest = max(highest, other%value + uncertainty)
         if (other%value > answer%value) answer = other
         if (hides_deeper) then
            associate (no_deeper => places%position(3) <= places(best)%position(3))
               highest = max(highest, maxval(values, mask=no_deeper) + uncertainty)
               where (no_deeper) values = -1.0_dp
            end associate
         else
            threshold = max(threshold, close_to_largest*values(best))
         end if
         associate (distances => [(norm2(places(k)%position - places(best)%position), k=1, size(places))])
            where (distances <= 2*places(best)%width) values = -1.0_dp
         end associate
      end do
      if (.not. ieee_is_nan(answer%error)) answer%error = max(answer%error, highest - answer%value)

   contains

      !> Computes the stress at the current place by the sums over all waves, and its error, (S7).
      subroutine measure()
         call fields%at(other%position(1), other%position(2), other%position(3), nu_terms, component_error)
         other%value = size_of(by_shear, body%stress(nu_terms, fields%pbar_over_pstar))
         other%error = error_of_invariant*component_error + gain
         local = 0.0_dp
         uncertainty = 0.0_dp
         if (.not. ieee_is_nan(component_error)) then
            uncertainty = error_of_invariant*component_error
            local = component_error - fields%pressure_error_at(other%position(3))
         end if
         hides_deeper = any(values >= other%value - local .and. places%position(3) > places(best)%position(3))
      end subroutine measure

   end subroutine search

   !> Moves a place to a maximum of the stress, by a sequence of quadratic models (S6) of falling size.
   subroutine refine(fields, body, by_shear, width, least_gain, value_to_exceed, best, gain)
      class(stress_fields), intent(inout) :: fields
      type(elastic_body), intent(in) :: body
      logical, intent(in) :: by_shear                !! as of `search`
      real(dp), intent(in) :: width                  !! distance over which the stress changes at the start [rad]
      real(dp), intent(in) :: least_gain             !! the search ends when a model gains less than this [p*]
      !> The search is given up when it seems to end at a stress below this [p*].
      real(dp), intent(in) :: value_to_exceed
      type(largest_stress), intent(inout) :: best    !! value and place: on entry those of the start
      !> The increase of the stress by the last model, or the increase that this model promised if that is larger [p*].
      real(dp), intent(out) :: gain

      !> Increases of the stress below this part of the stress are rounding.
      real(dp), parameter :: rounding = 1e-14_dp
      integer, allocatable :: axes(:)   ! the directions of the search: 1, 3 in 1-D, otherwise 1, 2, 3
      !> Of the current model: bound of the stress's error [p*], distance of its points [rad], its centre X, Y, Z [rad].
      real(dp) :: noise, reach, start(3), smallest, last_value, promise, step
      integer :: i

      allocate (axes, source=pack([1, 2, 3], [.true., fields%dimension > 1, .true.]))
      smallest = max(least_gain, rounding*best%value)
      reach = first_reach*width
      do i = 1, most_models
         last_value = best%value
         start = best%position
         call fields%expand(start, width, reach, noise)
         if (noise > 0.0_dp) best%value = size_near(start)
         noise = max(noise, rounding)*best%value
         call improve(promise)
         step = maxval(abs(best%position - start))
         ! A model that is so large that the stress is not quadratic over it may promise much and gain nothing. The
         ! promise then keeps the search going, with a smaller model.
         gain = max(best%value - last_value, promise)
         if (gain <= smallest .or. best%value + likely_gain*gain < value_to_exceed) exit
         ! A place at the border of the model may be far from the maximum. Then the next model is as large as the last.
         if (step < 0.9_dp*reach) reach = max(reach_factor*reach, min(step, reach))
      end do

   contains

      !> Fits a quadratic function to the stress at `start` and around it, and moves the best place to the maximum of
      !> this function, at most by `reach` along each axis. If one of the points of the fit has a larger stress than the
      !> maximum, the best place is moved to that point.
      subroutine improve(promise)
         !> Increase of the quadratic function up to its maximum. Along eigenvectors without a maximum, where the
         !> curvature is not positive, the largest change of the function over the distance `reach` [p*].
         real(dp), intent(out) :: promise

         real(dp) :: axis(size(axes), size(axes)), curvature(size(axes)), move(3), slope(size(axes)), &
            to_maximum(size(axes)), value, value_here, values(-1:1), work(3*3)
         integer :: i, j, k, l, status

         value_here = best%value
         ! The directions are in the order of `axes`, with depth as the last. So points at one depth follow each other,
         ! which `fields` can evaluate faster than points at changing depths.
         axis = 0.0_dp
         do i = 1, size(axes)
            do k = -1, 1, 2
               move = 0.0_dp
               move(axes(i)) = k*reach
               call try(move, values(k))
               do j = 1, i - 1
                  do l = -1, 1, 2
                     move(axes(j)) = l*reach
                     call try(move, value)
                     axis(i, j) = axis(i, j) - 0.25_dp*k*l*value
                  end do
                  move(axes(j)) = 0.0_dp
               end do
            end do
            slope(i) = 0.5_dp*(values(1) - values(-1))
            axis(i, i) = 2*value_here - values(1) - values(-1)
         end do
         call dsyev('V', 'L', size(axes), axis, size(axes), curvature, work, size(work), status)
         slope = matmul(slope, axis)
         to_maximum = 0.0_dp
         promise = 0.0_dp
         do i = 1, size(axes)
            if (curvature(i) > noise) then
               to_maximum = to_maximum + axis(:, i)*(slope(i)/curvature(i))
               promise = promise + 0.5_dp*slope(i)**2/curvature(i)
            else if (max(abs(slope(i)), abs(curvature(i))) > noise) then
               promise = promise + abs(slope(i)) + 0.5_dp*abs(curvature(i))
            end if
         end do
         move = 0.0_dp
         move(axes) = reach*to_maximum/max(1.0_dp, maxval(abs(to_maximum)))
         call try(move, value)
      end subroutine improve

      !> Evaluates the stress at a place, and keeps the place as the best one if the stress there is larger by more than
      !> the noise. A place outside the body is first mirrored at the surface.
      subroutine try(move, value)
         real(dp), intent(in) :: move(3)      !! the place less `start` [rad]
         real(dp), intent(out) :: value       !! the stress there [p*]

         real(dp) :: position(3)

         position = start + move
         position(3) = abs(position(3))
         value = size_near(position)
         if (value > best%value + noise) then
            best%value = value
            best%position = position
         end if
      end subroutine try

      !> The von Mises or shear stress [p*] at a place near that of the last call of `expand`.
      real(dp) function size_near(position)
         real(dp), intent(in) :: position(3)   !! X, Y, Z [rad]

         real(dp) :: nu_terms(6, 2)

         call fields%near(position, nu_terms)
         size_near = size_of(by_shear, body%stress(nu_terms, fields%pbar_over_pstar))
      end function size_near

   end subroutine refine

   !> The von Mises stress or the largest shear stress of a state of stress.
   pure real(dp) function size_of(by_shear, stress)
      logical, intent(in) :: by_shear      !! true: the shear stress
      real(dp), intent(in) :: stress(6)    !! xx, yy, zz, xy, xz, yz

      if (by_shear) then
         size_of = largest_shear(stress)
      else
         size_of = von_mises(stress)
      end if
   end function size_of

end module wavycon_largest_stress
