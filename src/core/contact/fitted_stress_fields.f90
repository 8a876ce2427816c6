!> The stresses below a pressure that the solver 'fitted' has computed, in the axes and units of the surface.
module wavycon_fitted_stress_fields
   use wavycon_fitted_answer_stress, only: fitted_answer_stress
   use wavycon_fitted_frame, only: fitted_frame
   use wavycon_kinds, only: dp, pi
   use wavycon_stress_fields, only: start_point, stress_fields
   use wavycon_stress_tensor, only: elastic_body, xx, xy, xz, yy, yz, zz
   use wavycon_stress_tuning, only: depths_of_spot, depths_of_cell, edge_ratios
   implicit none (type, external)
   private

   public :: fitted_stress_fields

   type, extends(stress_fields) :: fitted_stress_fields
      type(fitted_frame) :: frame            !! frame of the surface
      type(fitted_answer_stress) :: fitted   !! stresses in the axes and units of the lattice, already started
   contains
      procedure :: at, start_points
   end type fitted_stress_fields

contains

   !> The stresses at a point, converted from the axes and units of the lattice.
   subroutine at(self, x, y, depth, nu_terms, error)
      class(fitted_stress_fields), intent(inout) :: self
      real(dp), intent(in) :: x, y, depth
      real(dp), intent(out) :: nu_terms(6, 2)
      real(dp), intent(out), optional :: error

      integer :: i

      call self%fitted%at(self%frame%lattice_position(x, y), &
                          self%frame%length(1)*depth/(2*pi*self%frame%side), nu_terms, error)
      do i = 1, 2
         nu_terms(:, i) = self%frame%pressure_unit*rotated(nu_terms(:, i), conjg(self%frame%turn))
      end do
      if (present(error)) error = self%frame%pressure_unit*error
   end subroutine at

   !> The components of a stress after a rotation about the z axis.
   pure function rotated(stress, turn)
      real(dp), intent(in) :: stress(6)
      complex(dp), intent(in) :: turn     !! e^(i angle) of the rotation
      real(dp) :: rotated(6)

      complex(dp) :: deviator, shear
      real(dp) :: mean

      ! A rotation turns the complex number (xx - yy)/2 + i xy by twice the angle, and xz + i yz by the angle.
      mean = 0.5_dp*(stress(xx) + stress(yy))
      deviator = cmplx(0.5_dp*(stress(xx) - stress(yy)), stress(xy), dp)*turn**2
      shear = cmplx(stress(xz), stress(yz), dp)*turn
      rotated = [mean + deviator%re, mean - deviator%re, stress(zz), deviator%im, shear%re, shear%im]
   end function rotated

   !> Places at which searches for the largest stress start, on the lines of symmetry of the lattice. Before the spots
   !> merge they are below the spot; afterwards they are below the crest and about the pool.
   subroutine start_points(self, body, places)
      class(fitted_stress_fields), intent(inout) :: self
      type(elastic_body), intent(in) :: body
      type(start_point), allocatable, intent(out) :: places(:)

      complex(dp) :: centre
      complex(dp), allocatable :: at_surface(:), edge(:)
      real(dp), allocatable :: below(:)
      real(dp) :: radius
      integer :: directions, i, k, n

      associate (map => self%fitted%answer%solution%shape)
         centre = (0.0_dp, 0.0_dp)
         if (self%fitted%answer%pool) centre = self%frame%lattice%trough
         directions = 2*map%fold
         allocate (edge(directions/2 + 1))
         edge(:) = [(map%position_of(exp(cmplx(0.0_dp, 2*pi*i/directions, dp))), i=0, directions/2)]
         radius = maxval(abs(edge))
      end associate
      allocate (at_surface, source=[(centre + edge_ratios(i)*edge, i=1, size(edge_ratios))])
      if (self%fitted%answer%pool) then
         at_surface = [at_surface, (0.0_dp, 0.0_dp), self%frame%lattice%saddle, 0.5_dp*self%frame%lattice%saddle, &
                       0.5_dp*self%frame%lattice%trough, 0.25_dp*self%frame%lattice%trough]
         below = [radius*depths_of_spot, depths_of_cell]
      else
         at_surface = [at_surface, (0.0_dp, 0.0_dp), self%frame%lattice%saddle]
         below = radius*depths_of_spot
      end if
      n = size(at_surface)
      allocate (places(n*size(below)))
      do k = 1, size(below)
         do i = 1, n
            associate (z => at_surface(i)*self%frame%side/self%frame%turn, here => places((k - 1)*n + i))
               here%position = 2*pi*([z%re, z%im, below(k)*self%frame%side]/self%frame%length([1, 2, 1]))
               here%width = 2*pi*max(below(k), 0.25_dp*radius)*self%frame%side/self%frame%length(1)
            end associate
         end do
      end do
      call self%set_stresses(body, places)
   end subroutine start_points

end module wavycon_fitted_stress_fields
