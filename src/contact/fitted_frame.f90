!> How a surface lies on the lattices of the boundary-fitted solver.
module wavycon_fitted_frame
   use wavycon_constants, only: pi, sqrt2, sqrt3
   use wavycon_kinds, only: dp
   use wavycon_surface, only: no_paper_wave, surface_type, turned_paper_wave
   use wavycon_wave_lattice, only: hexagonal_lattice, rectangular_lattice, rhombic_lattice, square_lattice, &
      wave_lattice
   implicit none (type, external)
   private

   public :: fitted_frame, find_frame

   !> A place of the lattice is (x + i y) turn/side, x and y from a crest. All are proper turns: what is left stays
   !> left.
   type :: fitted_frame
      logical :: covered = .false.             !! whether there is a lattice for the surface
      real(dp) :: side = 1.0_dp                !! s [length]
      complex(dp) :: turn = (1.0_dp, 0.0_dp)
      integer :: crests = 1                    !! in the surface's cell: at its corners, and at its middle if there are two
      real(dp) :: pressure_unit = 1.0_dp       !! the lattice's, pi E* Delta/s [p*]
      type(wave_lattice) :: lattice
   contains
      procedure :: place
   end type fitted_frame

   !> The longest cell that is covered, over its width; and the most unlike curvatures of a crest: a spot of any length
   !> would take polynomials of any degree.
   real(dp), parameter :: longest = 3.0_dp, most_unlike = 50.0_dp
   !> Of coefficients and lengths that are to be equal.
   real(dp), parameter :: rounding = 1e-13_dp

contains

   !> The frame of a surface. Covered are the wave (21), also with a wavelength of its own each way, two crossed waves
   !> that are not too unlike, and the hexagonal wave.
   subroutine find_frame(surface, frame)
      type(surface_type), intent(in) :: surface
      type(fitted_frame), intent(out) :: frame

      real(dp) :: amplitude_x, curvature(2)

      if (surface%dimension == 1 .or. .not. surface%shape%is_even() .or. surface%amplitude <= 0.0_dp) return
      associate (c => surface%shape%c, length => surface%length)
         if (surface%paper_wave() /= no_paper_wave) then
            frame%lattice = square_lattice()
            frame%side = length(1)
            if (surface%paper_wave() /= turned_paper_wave) then
               frame%side = length(1)/sqrt2
               frame%turn = exp(cmplx(0.0_dp, -pi/4, dp))
               frame%crests = 2
            end if
         else if (has_only(reshape([1, 0, 0, 1], [2, 2]))) then
            if (maxval(length) > longest*minval(length)*(1.0_dp + rounding)) return
            curvature = [c(1, 0), c(0, 1)]/length**2
            if (maxval(curvature) > most_unlike*minval(curvature)) return
            frame%side = minval(length)
            amplitude_x = c(1, 0)
            if (length(1) > length(2)) then
               frame%turn = (0.0_dp, -1.0_dp)
               amplitude_x = c(0, 1)
            end if
            frame%lattice = rectangular_lattice(maxval(length)/minval(length), amplitude_x)
         else if (has_only(reshape([1, 1], [2, 1]))) then
            if (maxval(length) > longest*minval(length)*(1.0_dp + rounding)) return
            frame%side = minval(length)
            frame%crests = 2
            if (length(1) > length(2)) frame%turn = (0.0_dp, -1.0_dp)
            frame%lattice = rhombic_lattice(maxval(length)/minval(length))
         else if (has_only(reshape([1, 1, 0, 2], [2, 2]))) then
            if (abs(c(1, 1) - 2*c(0, 2)) > rounding .or. abs(length(2) - sqrt3*length(1)) > rounding*length(2)) return
            frame%side = length(1)
            frame%crests = 2
            frame%turn = (0.0_dp, -1.0_dp)
            frame%lattice = hexagonal_lattice()
         else
            return
         end if
      end associate
      frame%covered = .true.
      frame%pressure_unit = surface%stiffness/frame%side

   contains

      !> Whether the shape has these terms, all above zero, and no others.
      logical function has_only(terms)
         integer, intent(in) :: terms(:, :)   !! wave numbers in X and Y, shape (2, n)

         integer :: i, j

         associate (c => surface%shape%c)
            has_only = all(maxval(terms, 2) <= ubound(c))
            if (.not. has_only) return
            do j = 0, ubound(c, 2)
               do i = 0, ubound(c, 1)
                  if (any(terms(1, :) == i .and. terms(2, :) == j)) then
                     has_only = has_only .and. c(i, j) > rounding
                  else
                     has_only = has_only .and. abs(c(i, j)) <= rounding
                  end if
               end do
            end do
         end associate
      end function has_only

   end subroutine find_frame

   !> Where a point of the surface's cell is on the lattice.
   elemental complex(dp) function place(self, x, y)
      class(fitted_frame), intent(in) :: self
      real(dp), intent(in) :: x, y   !! from a crest [length]

      place = cmplx(x, y, dp)*self%turn/self%side
   end function place

end module wavycon_fitted_frame
