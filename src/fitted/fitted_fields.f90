!> Pressure, displacement and gap anywhere on the surface, from an expansion and without a grid.
!>
!> Places are from a crest, in s. Inside the spot or island the fields are the expansion and the condition of contact.
!> Elsewhere they are integrals over the expansion and all its images: README.md (F2) and (F10). For an image that is
!> near, these are taken along chords through the preimage of the place under the continued map, or by a fine rule over
!> the disc where that map folds, and for all others by one coarser rule: README.md, section 12.
module wavycon_fitted_fields
   use wavycon_chord_rule, only: chord_rule, start_chord_rule
   use wavycon_constants, only: pi
   use wavycon_disc_sources, only: disc_sources, start_disc_sources
   use wavycon_exterior_map, only: find_exterior
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_tuning, only: field_angles, field_chord_points, field_chords, field_radii, field_radius_margin, &
      near_field_radius, near_field_refinement, outside_chords, outside_half_points
   use wavycon_kinds, only: dp
   use wavycon_outside_integral, only: outside_rule, start_outside_rule
   use wavycon_shape_search, only: find_preimage
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: fitted_fields, start_fitted_fields, fitted_separations

   !> Rules for the integral over one spot or island.
   integer, parameter :: by_plain_rule = 1, by_finer_rule = 2, by_chords = 3

   type :: fitted_fields
      type(wave_lattice) :: lattice
      type(fitted_answer) :: answer
      complex(dp) :: centre = 0.0_dp                     !! of the spot or the island [s]
      integer :: places = 1                              !! in a cell: the centre and, if there are two, -centre
      real(dp), private :: radius = 0.0_dp               !! of a circle about the spot or the island [s]
      complex(dp), allocatable, private :: image(:)      !! centres of the spot or island, 0, and of its near images [s]
      type(chord_rule), private :: chords
      type(outside_rule), private :: outside
      type(disc_sources), private :: sources             !! of the rule over the whole disc
      type(disc_sources), private :: near_sources        !! of a finer one for near places; made when first needed
      real(dp), private :: near_refinement = 1.0_dp
      real(dp), private :: reach = 0.0_dp                !! places farther from the centre have |v| > near_radius [s]
   contains
      procedure :: at
      procedure :: edge
      procedure :: fields_inside
      procedure :: fields_outside
      procedure :: outside_integral
      procedure, private :: find_inside
      procedure, private :: integral_at
   end type fitted_fields

contains

   !> Prepares to evaluate an answer.
   subroutine start_fitted_fields(fields, lattice, answer, refinement)
      type(fitted_fields), intent(out) :: fields
      type(wave_lattice), intent(in) :: lattice    !! the answer's
      type(fitted_answer), intent(in) :: answer    !! with a solution, status <= fitted_less_exact
      real(dp), intent(in), optional :: refinement !! factor on the points of the rules either way, > 0; 1 if absent

      real(dp) :: finer

      finer = 1.0_dp
      if (present(refinement)) finer = refinement
      fields%lattice = lattice
      fields%answer = answer
      if (answer%island) then
         fields%centre = lattice%trough
         fields%places = lattice%troughs
      end if
      associate (near => lattice%displacement_kernel%near_points())
         fields%image = [(0.0_dp, 0.0_dp), cmplx(near(1, :), near(2, :), dp)]
      end associate
      associate (solution => fields%answer%solution)
         fields%radius = field_radius_margin*solution%shape%radius()
         call start_chord_rule(fields%chords, solution%basis, ubound(solution%shape%b, 1), &
                               ceiling(finer*field_chords), ceiling(finer*field_chord_points))
         call start_outside_rule(fields%outside, solution%basis%power, ceiling(finer*outside_chords), &
                                 ceiling(finer*outside_half_points))
      end associate
      associate (solution => fields%answer%solution)
         call start_disc_sources(fields%sources, solution, ceiling(finer*field_radii), ceiling(finer*field_angles))
         fields%near_refinement = finer*near_field_refinement
         associate (b => solution%shape%b)
            fields%reach = near_field_radius*b(0)*(1.0_dp + solution%shape%clustering) + sum(abs(b(1:)))
         end associate
      end associate
   end subroutine start_fitted_fields

   !> The fields at a place.
   subroutine at(self, place, pressure, displacement, gap)
      class(fitted_fields), intent(inout) :: self
      complex(dp), intent(in) :: place             !! x + i y from a crest [s]
      real(dp), intent(out) :: pressure            !! [p*], 0 where the gap is open
      real(dp), intent(out) :: displacement        !! u less its mean [Delta]
      real(dp), intent(out) :: gap                 !! [Delta], 0 in contact

      complex(dp) :: w
      logical :: inside

      call self%find_inside(self%lattice%rows%reduced(place - self%centre), w, inside)
      ! The second island of a cell is the first one turned by half a turn about a crest, with all its fields.
      if (self%places == 2 .and. .not. inside) &
         call self%find_inside(self%lattice%rows%reduced(-place - self%centre), w, inside)
      if (inside) then
         call self%fields_inside(place, w, pressure, displacement, gap)
      else
         call self%fields_outside(place, self%outside_integral(place), pressure, displacement, gap)
      end if
   end subroutine at

   !> The fields at a place inside a spot or island.
   subroutine fields_inside(self, place, w, pressure, displacement, gap)
      class(fitted_fields), intent(in) :: self
      complex(dp), intent(in) :: place                           !! as of at
      complex(dp), intent(in) :: w                               !! its preimage, or that of an equivalent place
      real(dp), intent(out) :: pressure, displacement, gap       !! as of at

      real(dp) :: value

      value = self%answer%solution%at(w)
      pressure = merge(0.0_dp, value, self%answer%island)
      gap = merge(value, 0.0_dp, self%answer%island)
      displacement = gap + 1.0_dp - self%answer%mean_gap - self%lattice%undeformed_gap(place)
   end subroutine fields_inside

   !> The fields at a place outside of all spots and islands.
   subroutine fields_outside(self, place, integral, pressure, displacement, gap)
      class(fitted_fields), intent(in) :: self
      complex(dp), intent(in) :: place                           !! as of at
      real(dp), intent(in) :: integral                           !! the outside_integral at the place
      real(dp), intent(out) :: pressure, displacement, gap       !! as of at

      real(dp) :: without_gap

      without_gap = 1.0_dp - self%answer%mean_gap - self%lattice%undeformed_gap(place)
      if (self%answer%island) then
         pressure = self%answer%pbar_over_pstar - self%lattice%closing_pressure &
            + self%lattice%pressure_rise(place - self%lattice%trough) - integral/(4*pi**2)
         displacement = without_gap
         gap = 0.0_dp
      else
         pressure = 0.0_dp
         displacement = integral
         gap = integral - without_gap
      end if
   end subroutine fields_outside

   !> At a place outside of all spots the displacement, the integral of Gp and p [Delta]; outside of all islands the
   !> integral of the Laplacian of Gp and the gap [Delta/s].
   real(dp) function outside_integral(self, place) result(integral)
      class(fitted_fields), intent(inout) :: self
      complex(dp), intent(in) :: place             !! as of at

      integral = self%integral_at(self%lattice%rows%reduced(place - self%centre))
      if (self%places == 2) integral = integral + self%integral_at(self%lattice%rows%reduced(-place - self%centre))
   end function outside_integral

   !> Whether a place is inside the spot or island at the centre, or inside a near image of it; and its preimage there.
   subroutine find_inside(self, z, w, inside)
      class(fitted_fields), intent(in) :: self
      complex(dp), intent(in) :: z          !! from the centre, reduced [s]
      complex(dp), intent(out) :: w
      logical, intent(out) :: inside

      integer :: k

      ! Long spots and islands of a rhombic lattice reach beyond the rectangle that places are reduced to.
      do k = 1, size(self%image)
         inside = .false.
         if (abs(z - self%image(k)) > self%radius) cycle
         call find_preimage(self%answer%solution%shape, z - self%image(k), w, inside)
         inside = inside .and. abs(w) <= 1.0_dp
         if (inside) return
      end do
   end subroutine find_inside

   !> Gaps at the trough and at the lattice's saddle, and the pressure at the saddle.
   subroutine fitted_separations(lattice, answer, trough_gap, saddle_gap, saddle_pressure, refinement)
      type(wave_lattice), intent(in) :: lattice    !! the answer's
      type(fitted_answer), intent(in) :: answer    !! with a solution, status <= fitted_less_exact
      real(dp), intent(out) :: trough_gap          !! [Delta]
      real(dp), intent(out) :: saddle_gap          !! 0 above merging [Delta]
      real(dp), intent(out) :: saddle_pressure     !! 0 below merging [p*]
      real(dp), intent(in), optional :: refinement !! as of start_fitted_fields

      type(fitted_fields) :: fields
      real(dp) :: displacement, pressure

      call start_fitted_fields(fields, lattice, answer, refinement)
      call fields%at(lattice%trough, pressure, displacement, trough_gap)
      call fields%at(lattice%saddle, saddle_pressure, displacement, saddle_gap)
   end subroutine fitted_separations

   !> Points of the edge, once around the spot or island.
   function edge(self, points) result(z)
      class(fitted_fields), intent(in) :: self
      integer, intent(in) :: points
      complex(dp) :: z(points)       !! x + i y from a crest, shape (points) [s]

      integer :: i

      do i = 1, points
         z(i) = self%centre + self%answer%solution%shape%place(exp(cmplx(0.0_dp, 2*pi*(i - 1)/points, dp)))
      end do
   end function edge

   !> The same with one island a cell.
   real(dp) function integral_at(self, z) result(total)
      class(fitted_fields), intent(inout) :: self
      complex(dp), intent(in) :: z      !! from the centre, reduced [s]

      real(dp), dimension(size(self%sources%place)) :: value, x, y
      complex(dp) :: from_image, w
      integer :: k, n, power, rule

      n = size(self%sources%place)
      x = z%re - self%sources%place%re
      y = z%im - self%sources%place%im
      if (self%answer%island) then
         call self%lattice%pressure_kernel%evaluate(n, x, y, value)
         power = self%lattice%pressure_kernel%power
      else
         call self%lattice%displacement_kernel%evaluate(n, x, y, value)
         power = self%lattice%displacement_kernel%power
      end if
      total = dot_product(self%sources%strength, value)
      do k = 1, size(self%image)
         from_image = z - self%image(k)
         call find_rule(self, from_image, w, rule)
         if (rule == by_chords) total = total + integral_by_chords(self, w)
         if (rule == by_finer_rule) then
            if (.not. allocated(self%near_sources%place)) &
               call start_disc_sources(self%near_sources, self%answer%solution, &
                                       ceiling(self%near_refinement*field_radii), &
                                       ceiling(self%near_refinement*field_angles))
            total = total + self%near_sources%sum_at(from_image, power)
         end if
         ! The smooth part has the terms 1/r^power of all images but not that of the one at the origin.
         if (rule == by_plain_rule .and. k == 1) total = total + self%sources%sum_at(from_image, power)
         if (rule /= by_plain_rule .and. k > 1) total = total - self%sources%sum_at(from_image, power)
      end do
   end function integral_at

   !> How to take the integral of 1/r or 1/r^3 over one spot or island for a place.
   !>
   !> A rule over the disc converges as the powers of |v| of the exterior map. Near places take chords through their
   !> preimage under the continued map, as far as that goes, which beyond sharp tips is not far.
   pure subroutine find_rule(fields, z, w, rule)
      type(fitted_fields), intent(in) :: fields
      complex(dp), intent(in) :: z                 !! from the centre of this spot or island [s]
      complex(dp), intent(out) :: w                !! the preimage, for chords
      integer, intent(out) :: rule

      complex(dp) :: v
      logical :: found

      rule = by_plain_rule
      if (abs(z) > fields%reach) return
      call find_exterior(fields%answer%solution%shape, z, v, found)
      if (found .and. abs(v) > near_field_radius) return
      call find_preimage(fields%answer%solution%shape, z, w, found)
      rule = merge(by_chords, by_finer_rule, found)
   end subroutine find_rule

   !> The integral over one spot or island with 1/r, or over an island with 1/r^3.
   real(dp) function integral_by_chords(fields, w) result(integral)
      type(fitted_fields), intent(inout) :: fields
      complex(dp), intent(in) :: w      !! preimage of the place, outside the disc

      real(dp) :: row(size(fields%answer%solution%c))

      associate (solution => fields%answer%solution)
         if (solution%island) then
            integral = fields%outside%integral(solution%basis, solution%shape, w, solution%c)
         else
            call fields%chords%rows(solution%basis, solution%shape, w, solution%c, row)
            integral = dot_product(row, solution%c)
         end if
      end associate
   end function integral_by_chords

end module wavycon_fitted_fields
