!> Finds the lattice of crests of a surface, if fitted expansions exist for it, and the coordinates on that lattice.
module wavycon_fitted_frame
   use wavycon_constants, only: pi, sqrt2, sqrt3
   use wavycon_contact_tuning, only: largest_aspect_ratio, largest_curvature_ratio
   use wavycon_equivalent_points, only: equivalent_points
   use wavycon_kinds, only: dp
   use wavycon_paper_wave, only: no_paper_wave, paper_wave, rotated_paper_wave
   use wavycon_surface, only: surface_type
   use wavycon_wave_lattice, only: hexagonal_lattice, rectangular_lattice, rhombic_lattice, square_lattice, wave_lattice
   implicit none (type, external)
   private

   public :: fitted_frame, find_frame

   !> The point x, y of the surface, measured from a crest [length], is the point (x + i y) turn/side of the lattice.
   type :: fitted_frame
      real(dp) :: length(2) = 1.0_dp           !! sides of the surface's cell [length]
      real(dp) :: side = 1.0_dp                !! s, shorter side of the lattice's cell [length]
      complex(dp) :: turn = (1.0_dp, 0.0_dp)   !! rotation, of modulus 1
      integer :: crests = 1                    !! in the surface's cell: at its corners and, if two, at its centre
      real(dp) :: pressure_unit = 1.0_dp       !! the lattice's, pi E* Delta/s [p*]
      type(wave_lattice), allocatable :: lattice   !! of the crests; none if no expansions exist for the surface
   contains
      procedure :: place
      procedure :: symmetry
   end type fitted_frame

   !> Coefficients and lengths that differ by less than this, relatively, are equal.
   real(dp), parameter :: rounding = 1e-13_dp

contains

   !> Finds the frame of a surface; the kernels of its lattice are summed here, once for all loads. Expansions exist for
   !> the wave (21), also with two wavelengths, for two crossed waves within the limits of wavycon_contact_tuning, and
   !> for the hexagonal wave.
   subroutine find_frame(surface, frame)
      type(surface_type), intent(in) :: surface
      type(fitted_frame), intent(out) :: frame   !! without a lattice for all other surfaces

      real(dp) :: curvature(2)

      if (surface%dimension == 1 .or. surface%has_free_edges .or. surface%amplitude <= 0.0_dp) return
      if (surface%kernel%has_layer() .or. .not. surface%shape%is_even()) return
      if (surface%is_height_map()) return
      associate (c => surface%shape%c, length => surface%length)
         frame%side = minval(length)
         if (length(1) > length(2)) frame%turn = (0.0_dp, -1.0_dp)
         if (paper_wave(surface) /= no_paper_wave) then
            frame%lattice = square_lattice()
            if (paper_wave(surface) /= rotated_paper_wave) then
               frame%side = length(1)/sqrt2
               frame%turn = exp(cmplx(0.0_dp, -pi/4, dp))
               frame%crests = 2
            end if
         else if (has_only(reshape([1, 0, 0, 1], [2, 2]))) then
            if (maxval(length) > largest_aspect_ratio*minval(length)*(1.0_dp + rounding)) return
            curvature = [c(1, 0), c(0, 1)]/length**2
            if (maxval(curvature) > largest_curvature_ratio*minval(curvature)) return
            frame%lattice = rectangular_lattice(maxval(length)/minval(length), &
                                                merge(c(0, 1), c(1, 0), length(1) > length(2)))
         else if (has_only(reshape([1, 1], [2, 1]))) then
            if (maxval(length) > largest_aspect_ratio*minval(length)*(1.0_dp + rounding)) return
            frame%crests = 2
            frame%lattice = rhombic_lattice(maxval(length)/minval(length))
         else if (has_only(reshape([1, 1, 0, 2], [2, 2]))) then
            if (abs(c(1, 1) - 2*c(0, 2)) > rounding .or. abs(length(2) - sqrt3*length(1)) > rounding*length(2)) return
            frame%crests = 2
            frame%turn = (0.0_dp, -1.0_dp)
            frame%lattice = hexagonal_lattice()
         else
            return
         end if
      end associate
      frame%length = surface%length
      frame%pressure_unit = surface%stiffness/frame%side

   contains

      !> Whether the shape has these terms, all positive, and no others.
      logical function has_only(terms)
         integer, intent(in) :: terms(:, :)   !! wave numbers in X and Y, shape (2, n)

         logical, allocatable :: has_term(:, :)
         integer :: i

         associate (c => surface%shape%c)
            has_only = all(maxval(terms, 2) <= ubound(c))
            if (.not. has_only) return
            allocate (has_term(0:ubound(c, 1), 0:ubound(c, 2)), source=.false.)
            do i = 1, size(terms, 2)
               has_term(terms(1, i), terms(2, i)) = .true.
            end do
            has_only = all(merge(c > rounding, abs(c) <= rounding, has_term))
         end associate
      end function has_only

   end subroutine find_frame

   !> The coordinates on the lattice [s] of the point X, Y of the surface.
   pure complex(dp) function place(self, x, y)
      class(fitted_frame), intent(in) :: self
      real(dp), intent(in) :: x, y   !! from a crest [rad]

      place = cmplx(self%length(1)*x/(2*pi), self%length(2)*y/(2*pi), dp)*self%turn/self%side
   end function place

   !> Of the fields on the surface.
   pure type(equivalent_points) function symmetry(self)
      class(fitted_frame), intent(in) :: self

      symmetry = equivalent_points(self%lattice%square, self%crests)
   end function symmetry

end module wavycon_fitted_frame
