!> The lattice of the fitted expansions that a surface has, and how the surface lies on it.
module wavycon_fitted_frame
   use wavycon_constants, only: pi, sqrt2, sqrt3
   use wavycon_kinds, only: dp
   use wavycon_surface, only: no_paper_wave, surface_type, turned_paper_wave
   use wavycon_wave_lattice, only: hexagonal_lattice, rectangular_lattice, rhombic_lattice, square_lattice, &
      wave_lattice
   implicit none (type, external)
   private

   public :: fitted_frame, find_frame, make_lattice, surfaces_with_frames

   !> Lattices that expansions exist for.
   integer, parameter :: no_lattice = 0, square = 1, rectangular = 2, rhombic = 3, hexagonal = 4

   !> A point x, y of the surface, measured from a crest, is (x + i y) turn/side on the lattice. Turns are rotations, without
   !> reflection.
   type :: fitted_frame
      real(dp) :: side = 1.0_dp                !! s [length]
      complex(dp) :: turn = (1.0_dp, 0.0_dp)
      integer :: crests = 1                    !! in the surface's cell: at its corners and, if two, at its centre
      real(dp) :: pressure_unit = 1.0_dp       !! the lattice's, pi E* Delta/s [p*]
      integer, private :: lattice = no_lattice
      real(dp), private :: aspect_ratio = 1.0_dp   !! long over short side, of a rectangular or a rhombic lattice
      real(dp), private :: amplitude_x = 0.5_dp    !! of the wave along x [Delta], of a rectangular lattice
   contains
      procedure :: is_found
      procedure :: place
   end type fitted_frame

   !> Limits of the long over the short side of a cell and of the ratio of a crest's curvatures: longer spots need
   !> polynomials of higher degree.
   real(dp), parameter :: largest_aspect_ratio = 3.0_dp, largest_curvature_ratio = 50.0_dp
   !> Relative difference of coefficients and lengths that count as equal.
   real(dp), parameter :: rounding = 1e-13_dp

contains

   !> Finds the frame of a surface. Expansions exist for the wave (21), also with two wavelengths, for two crossed waves that
   !> differ by no more than the limits above, and for the hexagonal wave.
   subroutine find_frame(surface, frame)
      type(surface_type), intent(in) :: surface
      type(fitted_frame), intent(out) :: frame

      real(dp) :: curvature(2)

      if (surface%dimension == 1 .or. .not. surface%shape%is_even() .or. surface%amplitude <= 0.0_dp) return
      associate (c => surface%shape%c, length => surface%length)
         if (surface%paper_wave() /= no_paper_wave) then
            frame%lattice = square
            frame%side = length(1)
            if (surface%paper_wave() /= turned_paper_wave) then
               frame%side = length(1)/sqrt2
               frame%turn = exp(cmplx(0.0_dp, -pi/4, dp))
               frame%crests = 2
            end if
         else if (has_only(reshape([1, 0, 0, 1], [2, 2]))) then
            if (maxval(length) > largest_aspect_ratio*minval(length)*(1.0_dp + rounding)) return
            curvature = [c(1, 0), c(0, 1)]/length**2
            if (maxval(curvature) > largest_curvature_ratio*minval(curvature)) return
            frame%side = minval(length)
            frame%amplitude_x = c(1, 0)
            if (length(1) > length(2)) then
               frame%turn = (0.0_dp, -1.0_dp)
               frame%amplitude_x = c(0, 1)
            end if
            frame%aspect_ratio = maxval(length)/minval(length)
            frame%lattice = rectangular
         else if (has_only(reshape([1, 1], [2, 1]))) then
            if (maxval(length) > largest_aspect_ratio*minval(length)*(1.0_dp + rounding)) return
            frame%side = minval(length)
            frame%crests = 2
            if (length(1) > length(2)) frame%turn = (0.0_dp, -1.0_dp)
            frame%aspect_ratio = maxval(length)/minval(length)
            frame%lattice = rhombic
         else if (has_only(reshape([1, 1, 0, 2], [2, 2]))) then
            if (abs(c(1, 1) - 2*c(0, 2)) > rounding .or. abs(length(2) - sqrt3*length(1)) > rounding*length(2)) return
            frame%side = length(1)
            frame%crests = 2
            frame%turn = (0.0_dp, -1.0_dp)
            frame%lattice = hexagonal
         else
            return
         end if
      end associate
      frame%pressure_unit = surface%stiffness/frame%side

   contains

      !> Whether the shape has these terms, all positive, and no others.
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

   !> The surfaces that have a frame, in words.
   pure function surfaces_with_frames() result(words)
      character(:), allocatable :: words

      words = "the paper's wave, also with two wavelengths up to 3:1, for crossed waves with crest curvatures up to 50:1 "// &
              'and for three equal waves at 60 degrees'
   end function surfaces_with_frames

   !> Whether there are expansions for the surface.
   pure logical function is_found(self)
      class(fitted_frame), intent(in) :: self

      is_found = self%lattice /= no_lattice
   end function is_found

   !> The lattice of a frame that is found, with its kernel, which takes some time to make.
   subroutine make_lattice(frame, lattice)
      type(fitted_frame), intent(in) :: frame
      type(wave_lattice), intent(out) :: lattice

      select case (frame%lattice)
      case (square)
         lattice = square_lattice()
      case (rectangular)
         lattice = rectangular_lattice(frame%aspect_ratio, frame%amplitude_x)
      case (rhombic)
         lattice = rhombic_lattice(frame%aspect_ratio)
      case (hexagonal)
         lattice = hexagonal_lattice()
      end select
   end subroutine make_lattice

   !> Where a point of the surface's cell is on the lattice.
   elemental complex(dp) function place(self, x, y)
      class(fitted_frame), intent(in) :: self
      real(dp), intent(in) :: x, y   !! from a crest [length]

      place = cmplx(x, y, dp)*self%turn/self%side
   end function place

end module wavycon_fitted_frame
