!> Pressure, displacement and gap anywhere on the surface, from an expansion and without a grid.
!>
!> Places are from a crest, in s. Inside the spot or the island the fields are the expansion and the condition
!> of contact. Elsewhere they are integrals over it and over all its images; those of the images that are near
!> have chords through the place where the map, continued, has it, which the rule of chords takes as well
!> outside the disc as inside.
module wavycon_fitted_fields
   use wavycon_chord_rule, only: chord_rule, start_chord_rule
   use wavycon_constants, only: pi
   use wavycon_disc_rule, only: disc_rule, plain_disc_rule
   use wavycon_expansion, only: expansion
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_tuning, only: chord_field_radius, field_angles, field_chord_points, field_chords, field_radii, &
      field_radius_margin, sharp_field_ratio, sharp_field_refinement
   use wavycon_kinds, only: dp
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: fitted_fields, start_fitted_fields, fitted_separations

   type :: fitted_fields
      type(wave_lattice) :: lattice
      type(fitted_answer) :: answer
      complex(dp) :: centre = 0.0_dp              !! of the spot or the island [s]
      integer :: places = 1                       !! in a cell: the centre and, if there are two, -centre
      real(dp) :: radius = 0.0_dp                 !! of a circle about the spot or the island [s]
      type(chord_rule) :: chords
      type(disc_rule) :: rule
      complex(dp), allocatable :: source(:)       !! the rule's points, all around, shape (n) [s]
      real(dp), allocatable :: strength(:)        !! of the expansion there, with area and weight, shape (n)
   contains
      procedure :: at
      procedure :: edge
      procedure, private :: find_inside
      procedure, private :: outside
   end type fitted_fields

contains

   !> Prepares to evaluate an answer.
   subroutine start_fitted_fields(fields, lattice, answer, fineness)
      type(fitted_fields), intent(out) :: fields
      type(wave_lattice), intent(in) :: lattice    !! the answer's
      type(fitted_answer), intent(in) :: answer    !! solved, status <= fitted_less_exact
      integer, intent(in), optional :: fineness    !! of the rules, >= 1; 1 if it is not there

      real(dp), allocatable :: density(:), values(:, :)
      complex(dp) :: turn
      integer :: factor, g, m, n, own

      own = 1
      if (present(fineness)) own = fineness
      factor = own*merge(sharp_field_refinement, 1, answer%reach > sharp_field_ratio)
      fields%lattice = lattice
      fields%answer = answer
      if (answer%island) then
         fields%centre = lattice%trough
         fields%places = lattice%troughs
      end if
      associate (solution => fields%answer%solution)
         m = solution%basis%fold
         fields%radius = field_radius_margin*solution%shape%radius()
         call start_chord_rule(fields%chords, solution%basis, ubound(solution%shape%b, 1), own*field_chords, &
                               own*field_chord_points)
         call plain_disc_rule(fields%rule, solution%basis%power, m, factor*field_radii, &
                              factor*field_angles/(2*m))
         n = size(fields%rule%point)
         allocate (values(n, solution%basis%terms), density(n))
         call solution%basis%evaluate(n, fields%rule%point, values)
         density = matmul(values, solution%c)*fields%rule%weight/(2*m) &
            *solution%shape%jacobian(fields%rule%point)
         allocate (fields%source(2*m*n), fields%strength(2*m*n))
         do g = 0, m - 1
            turn = exp(cmplx(0.0_dp, 2*pi*g/m, dp))
            fields%source(2*g*n + 1:(2*g + 1)*n) = solution%shape%place(turn*fields%rule%point)
            fields%source((2*g + 1)*n + 1:(2*g + 2)*n) = solution%shape%place(turn*conjg(fields%rule%point))
            fields%strength(2*g*n + 1:(2*g + 1)*n) = density
            fields%strength((2*g + 1)*n + 1:(2*g + 2)*n) = density
         end do
      end associate
   end subroutine start_fitted_fields

   !> The fields at a place.
   subroutine at(self, place, pressure, displacement, gap)
      class(fitted_fields), intent(inout) :: self
      complex(dp), intent(in) :: place             !! x + i y from a crest [s]
      real(dp), intent(out) :: pressure            !! [p*], 0 where the gap is open
      real(dp), intent(out) :: displacement        !! u less its mean [Delta]
      real(dp), intent(out) :: gap                 !! [Delta], 0 in contact

      complex(dp) :: mirrored, w, z
      real(dp) :: approach, h, outside, value
      logical :: inside

      z = self%lattice%kernel%reduced(place - self%centre)
      call self%find_inside(z, w, inside)
      if (self%places == 2) then
         ! The second island of a cell is the first one turned by half a turn about a crest, with all its fields.
         mirrored = self%lattice%kernel%reduced(-place - self%centre)
         if (.not. inside) call self%find_inside(mirrored, w, inside)
      end if
      h = self%lattice%undeformed_gap(place)
      approach = 1.0_dp - self%answer%mean_gap
      pressure = 0.0_dp
      gap = 0.0_dp
      if (inside) then
         value = self%answer%solution%at(w)
         if (self%answer%island) then
            gap = value
         else
            pressure = value
         end if
         displacement = gap + approach - h
      else if (self%answer%island) then
         outside = self%outside(z)
         if (self%places == 2) outside = outside + self%outside(mirrored)
         pressure = self%answer%pbar_over_pstar - self%lattice%closing_pressure &
            + self%lattice%pressure_rise(place - self%lattice%trough) - outside/(4*pi**2)
         displacement = approach - h
      else
         displacement = self%outside(z)
         gap = displacement + h - approach
      end if
   end subroutine at

   !> Whether a place is inside the spot or the island at the centre, or in an image of it, and where the map has it.
   subroutine find_inside(self, z, w, inside)
      class(fitted_fields), intent(in) :: self
      complex(dp), intent(in) :: z          !! from the centre, reduced [s]
      complex(dp), intent(out) :: w
      logical, intent(out) :: inside

      complex(dp) :: image
      integer :: k

      ! Long spots and islands of a rhombic lattice leave the rectangle that places are reduced to.
      do k = 0, size(self%lattice%kernel%image, 2)
         image = 0.0_dp
         if (k > 0) image = cmplx(self%lattice%kernel%image(1, k), self%lattice%kernel%image(2, k), dp)
         inside = .false.
         if (abs(z - image) > self%radius) cycle
         call self%answer%solution%shape%find(z - image, w, inside)
         inside = inside .and. abs(w) <= 1.0_dp
         if (inside) return
      end do
   end subroutine find_inside

   !> Gaps at the trough and at the lattice's saddle, and the saddle's pressure.
   subroutine fitted_separations(lattice, answer, trough_gap, saddle_gap, saddle_pressure, fineness)
      type(wave_lattice), intent(in) :: lattice    !! the answer's
      type(fitted_answer), intent(in) :: answer    !! solved, status <= fitted_less_exact
      real(dp), intent(out) :: trough_gap          !! [Delta]
      real(dp), intent(out) :: saddle_gap          !! 0 above merging [Delta]
      real(dp), intent(out) :: saddle_pressure     !! 0 below merging [p*]
      integer, intent(in), optional :: fineness    !! as of start_fitted_fields

      type(fitted_fields) :: fields
      real(dp) :: displacement, pressure

      call start_fitted_fields(fields, lattice, answer, fineness)
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

   !> At a place outside of all spots the displacement, the integral of Gp p; outside of all islands that of the
   !> Laplacian of Gp times the gap, of one island a cell.
   real(dp) function outside(self, z) result(total)
      class(fitted_fields), intent(inout) :: self
      complex(dp), intent(in) :: z      !! from the centre, reduced

      real(dp), dimension(size(self%source)) :: slope_x, slope_y, value, x, y
      real(dp) :: row(size(self%answer%solution%c)), shape_row(0:ubound(self%answer%solution%shape%b, 1))
      complex(dp) :: image, w
      integer :: k, n, power
      logical :: by_chords, found

      n = size(self%source)
      x = z%re - self%source%re
      y = z%im - self%source%im
      if (self%answer%island) then
         call self%lattice%kernel%smooth_laplacian(n, x, y, value, slope_x, slope_y)
         power = 3
      else
         call self%lattice%kernel%smooth_part(n, x, y, value, slope_x, slope_y)
         power = 1
      end if
      total = 0.0_dp
      associate (solution => self%answer%solution, images => self%lattice%kernel%image)
         do k = 0, size(images, 2)
            image = 0.0_dp
            if (k > 0) image = cmplx(images(1, k), images(2, k), dp)
            call solution%shape%find(z - image, w, found)
            by_chords = found .and. abs(w) < chord_field_radius
            if (by_chords .and. self%answer%island) then
               total = total + self%chords%cube_integral(solution%basis, solution%shape, w, solution%c)
            else if (by_chords) then
               call self%chords%rows(solution%basis, solution%shape, w, solution%c, row, shape_row)
               total = total + dot_product(row, solution%c)
            end if
            ! The smooth part has the 1/r^power of all images but that of the one at the origin.
            if (by_chords .and. k > 0) value = value - 1.0_dp/hypot(x - image%re, y - image%im)**power
            if (.not. by_chords .and. k == 0) value = value + 1.0_dp/hypot(x, y)**power
         end do
      end associate
      total = total + dot_product(self%strength, value)
   end function outside

end module wavycon_fitted_fields
