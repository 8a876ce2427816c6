!> Finds the lattice that the crests of a surface form, if the solver 'fitted' can solve the surface, and converts
!> between coordinates on the surface and on the lattice.
module wavycon_fitted_frame
   use wavycon_contact_tuning, only: largest_aspect_ratio, largest_curvature_ratio
   use wavycon_equivalent_points, only: equivalent_points
   use wavycon_kinds, only: dp, pi, sqrt2, sqrt3
   use wavycon_paper_wave, only: no_paper_wave, paper_wave, rotated_paper_wave
   use wavycon_surface, only: surface_type
   use wavycon_wave_lattice, only: hexagonal_lattice, rectangular_lattice, rhombic_lattice, square_lattice, wave_lattice
   implicit none (type, external)
   private

   public :: crests_form_lattice, fitted_frame, find_frame

   !> Position of the lattice on the surface. The point x, y of the surface, measured from a crest [length], is the
   !> point (x + i y) turn/side of the lattice.
   type :: fitted_frame
      real(dp) :: length(2) = 1.0_dp           !! sides of the surface's cell [length]
      real(dp) :: side = 1.0_dp                !! s, shorter side of the lattice's cell [length]
      complex(dp) :: turn = (1.0_dp, 0.0_dp)   !! rotation from the surface to the lattice, of modulus 1
      integer :: crests = 1                    !! crests in the surface's cell: at the corner and, if two, at the centre
      real(dp) :: pressure_unit = 1.0_dp       !! unit of pressure on the lattice, pi E* Delta/s [p*]
      type(wave_lattice), allocatable :: lattice   !! lattice of the crests; not allocated: 'fitted' cannot solve it
      type(equivalent_points) :: symmetry      !! symmetries of the fields on the surface
   contains
      procedure :: lattice_position
   end type fitted_frame

   !> The lattices.
   integer, parameter :: no_lattice = 0, square = 1, rectangular = 2, rhombic = 3, hexagonal = 4

   !> Coefficients and lengths whose relative difference is below this are taken as equal.
   real(dp), parameter :: rounding = 1e-13_dp

contains

   !> Whether the crests of a surface form a lattice that the solver 'fitted' can solve: whether it has a frame.
   pure logical function crests_form_lattice(surface)
      type(surface_type), intent(in) :: surface

      crests_form_lattice = lattice_of(surface) /= no_lattice
   end function crests_form_lattice

   !> Which lattice the crests of a surface form. There is one for the wave (21), also with two different wavelengths,
   !> for the sum of two waves along x and y, and for the hexagonal wave. Side and curvature ratios are limited by
   !> wavycon_contact_tuning.
   pure integer function lattice_of(surface) result(lattice)
      type(surface_type), intent(in) :: surface

      logical :: is_long
      real(dp) :: curvature(2)

      lattice = no_lattice
      if (surface%dimension == 1 .or. surface%has_free_edges .or. surface%amplitude <= 0.0_dp) return
      if (surface%kernel%has_layer() .or. .not. surface%shape%is_even()) return
      if (surface%is_height_map()) return
      associate (c => surface%shape%c, length => surface%length)
         is_long = maxval(length) > largest_aspect_ratio*minval(length)*(1.0_dp + rounding)
         if (paper_wave(surface) /= no_paper_wave) then
            lattice = square
         else if (has_only(reshape([1, 0, 0, 1], [2, 2]))) then
            curvature = [c(1, 0), c(0, 1)]/length**2
            if (.not. is_long .and. maxval(curvature) <= largest_curvature_ratio*minval(curvature)) &
               lattice = rectangular
         else if (has_only(reshape([1, 1], [2, 1]))) then
            if (.not. is_long) lattice = rhombic
         else if (has_only(reshape([1, 1, 0, 2], [2, 2]))) then
            if (abs(c(1, 1) - 2*c(0, 2)) <= rounding .and. abs(length(2) - sqrt3*length(1)) <= rounding*length(2)) &
               lattice = hexagonal
         end if
      end associate

   contains

      !> Whether the cosine series of the shape has the given terms, all with positive coefficients, and no other terms.
      pure logical function has_only(terms)
         integer, intent(in) :: terms(:, :)   !! wave numbers in X and Y of n terms, shape (2, n)

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

   end function lattice_of

   !> Finds the frame of a surface. This sums the kernels of the lattice, once for all loads.
   subroutine find_frame(surface, frame)
      type(surface_type), intent(in) :: surface
      type(fitted_frame), intent(out) :: frame   !! has no lattice unless crests_form_lattice(surface)

      integer :: lattice

      lattice = lattice_of(surface)
      if (lattice == no_lattice) return
      associate (c => surface%shape%c, length => surface%length)
         frame%length = length
         frame%side = minval(length)
         if (length(1) > length(2)) frame%turn = (0.0_dp, -1.0_dp)
         if (lattice == rhombic .or. lattice == hexagonal) frame%crests = 2
         select case (lattice)
         case (square)
            frame%lattice = square_lattice()
            if (paper_wave(surface) /= rotated_paper_wave) then
               frame%side = length(1)/sqrt2
               frame%turn = exp(cmplx(0.0_dp, -pi/4, dp))
               frame%crests = 2
            end if
         case (rectangular)
            frame%lattice = rectangular_lattice(maxval(length)/minval(length), &
                                                merge(c(0, 1), c(1, 0), length(1) > length(2)))
         case (rhombic)
            frame%lattice = rhombic_lattice(maxval(length)/minval(length))
         case (hexagonal)
            frame%turn = (0.0_dp, -1.0_dp)
            frame%lattice = hexagonal_lattice()
         end select
      end associate
      frame%pressure_unit = surface%stiffness/frame%side
      frame%symmetry = equivalent_points(frame%lattice%square, frame%crests)
   end subroutine find_frame

   !> The coordinates on the lattice, in units of s, of a point of the surface.
   pure complex(dp) function lattice_position(self, x, y)
      class(fitted_frame), intent(in) :: self
      real(dp), intent(in) :: x, y   !! angles X, Y of the point, measured from a crest [rad]

      lattice_position = cmplx(self%length(1)*x/(2*pi), self%length(2)*y/(2*pi), dp)*self%turn/self%side
   end function lattice_position

end module wavycon_fitted_frame
