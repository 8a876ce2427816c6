!> The largest von Mises stress and the largest shear stress in a body, and where they are.
!>
!> The search starts from the best of the places that the stress fields propose. A quadratic function through the points
!> about a place predicts the next, better one, while the distance of the points falls: (S6), (S7) of README.md in this
!> directory. Depths are mirrored at the surface, so that the search may end on it.
module wavycon_largest_stress
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use wavycon_constants, only: pi
   use wavycon_elastic_body, only: elastic_body
   use wavycon_kinds, only: dp
   use wavycon_lapack, only: dsyev
   use wavycon_stress_fields, only: start_place, stress_fields
   use wavycon_stress_tensor, only: largest_shear, von_mises
   use wavycon_stress_tuning, only: close_to_largest, error_of_invariant, first_reach, gain_part, likely_gain, &
      most_models, search_accuracy, reach_factor, refined_places
   implicit none (type, external)
   private

   public :: largest_stress, find_largest_stresses

   type :: largest_stress
      real(dp) :: value = 0.0_dp        !! [p*]
      real(dp) :: error = 0.0_dp        !! estimate of its error [p*]; NaN if there is none
      real(dp) :: place(3) = 0.0_dp     !! X, Y, Z [rad]
   contains
      procedure :: place_in_cell
   end type largest_stress

contains

   !> Finds the largest von Mises stress and the largest shear stress in a body. NaN if there is no solution.
   subroutine find_largest_stresses(fields, body, yielding, shear)
      class(stress_fields), intent(inout) :: fields
      type(elastic_body), intent(in) :: body
      type(largest_stress), intent(out), optional :: yielding, shear

      real(dp) :: none
      type(start_place), allocatable :: places(:)

      none = ieee_value(none, ieee_quiet_nan)
      if (present(yielding)) yielding = largest_stress(none, none, none)
      if (present(shear)) shear = largest_stress(none, none, none)
      if (.not. fields%exist) return
      call fields%start_places(body, places)
      if (present(yielding)) call search(fields, body, .false., places, yielding)
      if (present(shear)) call search(fields, body, .true., places, shear)
   end subroutine find_largest_stresses

   !> The place over the sides of the cell, X and Y from 0 to 1, and Z over L_x. Of a mirrored height map that of the
   !> point of the map whose image it is. NaN if there is no solution.
   pure function place_in_cell(self, parts) result(place)
      class(largest_stress), intent(in) :: self
      integer, intent(in) :: parts(2)   !! of the surface
      real(dp) :: place(3)

      !> A place so close to 0 is at 0 but for rounding: not on the far side of the cell.
      real(dp), parameter :: rounding = 1e-6_dp   ! [rad]

      place = self%place
      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      if (ieee_is_nan(self%value)) return
      place(:2) = modulo(place(:2) + rounding, 2*pi) - rounding
      where (abs(place(:2)) <= rounding) place(:2) = 0.0_dp
      place = place/(2*pi)
      where (parts > 1) place(:2) = abs(place(:2) - anint(place(:2)))
   end function place_in_cell

   !> Refines the best of the places, each farther from those before it than twice the width of the stress. The largest
   !> stress is the one that is largest less its error: one at the edge of contact may be large by its error alone. That
   !> another one plus its error is larger is an error of the largest.
   subroutine search(fields, body, by_shear, places, answer)
      class(stress_fields), intent(inout) :: fields
      type(elastic_body), intent(in) :: body
      logical, intent(in) :: by_shear   !! whether for the largest shear stress or the largest von Mises stress
      type(start_place), intent(in) :: places(:)
      type(largest_stress), intent(out) :: answer

      real(dp) :: certain, doubt, enough, error, gain, highest, least, parts(6, 2), values(size(places))
      logical :: is_doubtful, is_larger
      type(largest_stress) :: other
      integer :: best, i, k

      values = [(size_of(by_shear, places(i)%stress), i=1, size(places))]
      best = maxloc(values, dim=1)
      enough = search_accuracy*values(best)
      associate (here => places(best)%place)
         call fields%at(here(1), here(2), here(3), parts, error)
      end associate
      if (.not. ieee_is_nan(error)) enough = min(gain_part*error, enough)
      answer%value = -1.0_dp
      certain = -huge(certain)
      least = 0.0_dp
      highest = 0.0_dp
      do i = 1, refined_places
         best = maxloc(values, dim=1)
         if (values(best) < least) exit
         other%value = values(best)
         other%place = places(best)%place
         call refine(fields, body, by_shear, places(best)%width, enough, answer%value, other, gain)
         if (fields%dimension == 1) other%place(2) = 0.0_dp
         call fields%at(other%place(1), other%place(2), other%place(3), parts, error)
         other%value = size_of(by_shear, body%stress(parts, fields%pbar_over_pstar))
         other%error = error_of_invariant*error + gain
         doubt = merge(0.0_dp, error_of_invariant*error, ieee_is_nan(error))
         highest = max(highest, other%value + doubt)
         is_doubtful = doubt > (1.0_dp - close_to_largest)*other%value
         is_larger = other%value - merge(doubt, 0.0_dp, is_doubtful) > certain
         if (is_doubtful .and. certain < answer%value) is_larger = other%value > answer%value
         if (is_larger) then
            answer = other
            certain = other%value - merge(doubt, 0.0_dp, is_doubtful)
         end if
         ! Where a stress is this doubtful it is so at all places no deeper: they leave the others their turn.
         if (is_doubtful) then
            associate (no_deeper => places%place(3) <= places(best)%place(3))
               highest = max(highest, maxval(values, mask=no_deeper) + doubt)
               where (no_deeper) values = -1.0_dp
            end associate
         else
            least = max(least, close_to_largest*values(best))
         end if
         associate (distances => [(norm2(places(k)%place - places(best)%place), k=1, size(places))])
            where (distances <= 2*places(best)%width) values = -1.0_dp
         end associate
      end do
      if (.not. ieee_is_nan(answer%error)) answer%error = max(answer%error, highest - answer%value)
   end subroutine search

   !> Improves a place by quadratic models.
   subroutine refine(fields, body, by_shear, width, enough, to_beat, best, gain)
      class(stress_fields), intent(inout) :: fields
      type(elastic_body), intent(in) :: body
      logical, intent(in) :: by_shear                !! as of search
      real(dp), intent(in) :: width                  !! of the maximum [rad]
      real(dp), intent(in) :: enough                 !! the search ends when a model gains less [p*]
      real(dp), intent(in) :: to_beat                !! and when it seems to end below this [p*]
      type(largest_stress), intent(inout) :: best    !! value and place
      real(dp), intent(out) :: gain                  !! by the last model, or what it promised if that is more [p*]

      !> Relative gains below this are rounding.
      real(dp), parameter :: rounding = 1e-14_dp
      integer, allocatable :: axes(:)   ! the directions of the search
      !> The size of a model, where it starts, and changes of the stress by rounding and the like.
      real(dp) :: noise, reach, start(3)
      real(dp) :: before, least, promise, step
      integer :: i

      allocate (axes, source=pack([1, 2, 3], [.true., fields%dimension > 1, .true.]))
      least = max(enough, rounding*best%value)
      reach = first_reach*width
      do i = 1, most_models
         before = best%value
         start = best%place
         call fields%expand(start, width, reach, noise)
         if (noise > 0.0_dp) best%value = size_near(start)
         noise = max(noise, rounding)*best%value
         call improve(promise)
         step = maxval(abs(best%place - start))
         ! A model that is too large for the stress may promise much and gain nothing: the next one is smaller.
         gain = max(best%value - before, promise)
         if (gain <= least .or. best%value + likely_gain*gain < to_beat) exit
         ! A place at the border of the model may be far from the maximum: the next model is as large.
         if (step < 0.9_dp*reach) reach = max(reach_factor*reach, min(step, reach))
      end do

   contains

      !> Moves the best place to the maximum of a quadratic function within the reach along each axis, or to the best of
      !> the points that the function is made from.
      subroutine improve(promise)
         real(dp), intent(out) :: promise   !! gain of the maximum; variation along axes without one [p*]

         real(dp) :: axis(size(axes), size(axes)), curvature(size(axes)), move(3), slope(size(axes)), &
            to_maximum(size(axes)), value, value_here, values(-1:1), work(3*3)
         integer :: i, j, k, l, status

         value_here = best%value
         ! The directions are in the order of `axes`, depth last: points of one depth follow each other.
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

      !> The value at a place, mirrored at the surface if it is outside the body; one that is better by more than noise
      !> is kept.
      subroutine try(move, value)
         real(dp), intent(in) :: move(3)   !! from the start
         real(dp), intent(out) :: value

         real(dp) :: place(3)

         place = start + move
         place(3) = abs(place(3))
         value = size_near(place)
         if (value > best%value + noise) then
            best%value = value
            best%place = place
         end if
      end subroutine try

      !> The stress that is searched for, at a place near that of the last `expand`.
      real(dp) function size_near(place)
         real(dp), intent(in) :: place(3)   !! X, Y, Z [rad]

         real(dp) :: parts(6, 2)

         call fields%near(place, parts)
         size_near = size_of(by_shear, body%stress(parts, fields%pbar_over_pstar))
      end function size_near

   end subroutine refine

   !> The von Mises stress or the largest shear stress.
   pure real(dp) function size_of(by_shear, stress)
      logical, intent(in) :: by_shear
      real(dp), intent(in) :: stress(6)

      if (by_shear) then
         size_of = largest_shear(stress)
      else
         size_of = von_mises(stress)
      end if
   end function size_of

end module wavycon_largest_stress
