!> Pressure, displacement and gap anywhere on the surface, from a fitted function and without a grid.
!>
!> Positions are measured from a crest, in s. Inside the spot or pool the fields follow from the fitted function and the
!> condition of contact. Elsewhere they are integrals over the fitted function and all its images: README.md (F2) and
!> (F10). The integrals over near images are computed by fine rules or along rays, the others by one coarse rule:
!> README.md, section 12.
module wavycon_fitted_fields
   use wavycon_chebyshev_table, only: chebyshev_table, square_argument, square_nodes
   use wavycon_degree_history, only: error_estimate
   use wavycon_disc_sources, only: disc_sources, start_disc_sources
   use wavycon_exterior_series, only: exterior_series, start_exterior_series
   use wavycon_fitted_answer, only: fitted_answer
   use wavycon_fitted_tuning, only: fastest_decay_at_point, field_accuracy, least_map
   use wavycon_kinds, only: dp, pi
   use wavycon_quantities, only: contact_area, mean_gap, peak_pressure
   use wavycon_shape_search, only: find_preimage
   use wavycon_spot_integral, only: far_level, spot_integral, start_spot_integral
   use wavycon_stress_kernel, only: stress_field_count, surface_field
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: find_fitted_details, fitted_fields, start_fitted_fields, fitted_separations

   type :: fitted_fields
      type(wave_lattice) :: lattice
      type(fitted_answer) :: answer
      complex(dp) :: centre = 0.0_dp                     !! centre of the spot or of the pool [s]
      integer :: places = 1                              !! spots or pools in a cell; the second one is at -centre
      complex(dp), allocatable, private :: image(:)
         !! centres of the near images from that of the spot or pool, 0 among them; for maps of those with series [s]
      type(spot_integral), private :: spot               !! the integral over one spot or pool
      type(disc_sources), private :: sources             !! point sources of the coarse rule, of far_level
      complex(dp), allocatable, private :: preimage(:, :, :)
         !! preimages of the last two positions, 0 if there is none, shape (2, images, places)
      ! For maps, after `prepare_map`.
      type(exterior_series), allocatable :: series       !! the field of one spot or pool outside of it
      type(chebyshev_table), private :: far              !! the field of all far images: even part, and odd part over x
   contains
      procedure :: at, prepare_map
   end type fitted_fields

contains

   !> Prepares the fields of a solution.
   subroutine start_fitted_fields(fields, lattice, answer, accuracy)
      type(fitted_fields), intent(out) :: fields
      type(wave_lattice), intent(in) :: lattice    !! the lattice that was solved
      type(fitted_answer), intent(in) :: answer    !! the solution, status <= fitted_less_exact
      real(dp), intent(in), optional :: accuracy   !! relative error of the integrals; field_accuracy if absent

      real(dp) :: asked

      asked = field_accuracy
      if (present(accuracy)) asked = accuracy
      fields%lattice = lattice
      fields%answer = answer
      fields%centre = merge(lattice%trough, (0.0_dp, 0.0_dp), answer%pool)
      fields%places = merge(lattice%troughs, 1, answer%pool)
      call start_spot_integral(fields%spot, answer%solution, asked, surface_field)
      call start_disc_sources(fields%sources, answer%solution, .false., fields%spot%radii(far_level), &
                              fields%spot%angles(far_level))
      call find_images(fields, fields%spot%radius)
   end subroutine start_fitted_fields

   !> Lists the near images: those whose centres are within a distance of the rectangle to which positions are reduced,
   !> and all others that the coarse rule may not resolve there.
   subroutine find_images(fields, least)
      type(fitted_fields), intent(inout) :: fields
      real(dp), intent(in) :: least                !! the distance [s]

      real(dp) :: reach

      reach = least
      do while (.not. fields%spot%is_resolved(cmplx(reach, 0.0_dp, dp)))
         reach = 1.1_dp*reach
      end do
      fields%image = fields%lattice%rows%points_about(reach, (0.0_dp, 0.0_dp))
      fields%preimage = reshape([(0.0_dp, 0.0_dp)], [2, size(fields%image), fields%places], pad=[(0.0_dp, 0.0_dp)])
   end subroutine find_images

   !> Pressure, displacement and gap at a position.
   subroutine at(self, place, pressure, displacement, gap)
      class(fitted_fields), intent(inout) :: self
      complex(dp), intent(in) :: place             !! x + i y from a crest [s]
      real(dp), intent(out) :: pressure            !! pressure [pi E* Delta/s], 0 where the gap is open
      real(dp), intent(out) :: displacement        !! u less its mean [Delta]
      real(dp), intent(out) :: gap                 !! gap [Delta], 0 in contact

      complex(dp) :: w, z(self%places)
      real(dp) :: without_gap
      logical :: inside   ! whether the position is inside one of the spots or pools
      integer :: i

      pressure = 0.0_dp
      gap = 0.0_dp
      without_gap = 1.0_dp - self%answer%value(mean_gap) + self%lattice%rise(.false., place)
      displacement = without_gap
      ! The second pool of a cell, with its fields, is the first one rotated by half a turn about a crest.
      do i = 1, self%places
         z(i) = self%lattice%rows%reduced(merge(place, -place, i == 1) - self%centre)
         call find_preimages(z(i), i)
         if (.not. inside) cycle
         if (self%answer%pool) then
            gap = self%answer%solution%at(w)
            displacement = gap + without_gap
         else
            pressure = self%answer%solution%at(w)
         end if
         return
      end do
      if (self%answer%pool) then
         pressure = self%answer%pbar_over_pstar - self%lattice%closing_pressure &
            + self%lattice%rise(.true., place - self%lattice%trough)
         do i = 1, self%places
            pressure = pressure + sum_over_images(z(i), i)
         end do
      else
         displacement = sum_over_images(z(1), 1)
         gap = displacement - without_gap
      end if

   contains

      !> Finds the preimages of a position under the maps of the spot or pool and its near images: of those that the
      !> position may be inside of, or of all if the series needs them. Sets `inside` and, if it is true, the preimage
      !> w.
      subroutine find_preimages(z, centre)
         complex(dp), intent(in) :: z          !! position from the centre, reduced to the rectangle [s]
         integer, intent(in) :: centre         !! number of the centre, 1 to `places`

         logical :: found
         integer :: k

         inside = .false.
         ! All images are tried: long spots and pools of a rhombic lattice reach beyond the rectangle of reduced
         ! positions.
         do k = 1, size(self%image)
            if (.not. allocated(self%series) .and. abs(z - self%image(k)) > self%spot%radius) cycle
            associate (last => self%preimage(:, k, centre))
               ! Most positions are asked for in rows with equal steps: extrapolate the start from the last two
               ! preimages.
               call find_preimage(self%spot%solution%shape, z - self%image(k), w, found, 2*last(1) - last(2))
               last = [merge(w, (0.0_dp, 0.0_dp), found), last(1)]
            end associate
            inside = found .and. w%re**2 + w%im**2 <= 1.0_dp
            if (inside) return
         end do
      end subroutine find_preimages

      !> The displacement [Delta] that a spot and all its images cause at a position outside of all, or the pressure
      !> [pi E* Delta/s] that a pool and its images cause.
      real(dp) function sum_over_images(z, centre) result(total)
         complex(dp), intent(in) :: z      !! position from the centre, reduced to the rectangle [s]
         integer, intent(in) :: centre     !! number of the centre, for which find_preimages was called with z

         real(dp) :: exact(stress_field_count), half(2)
         logical :: far(size(self%image))
         integer :: k

         far = .false.
         if (allocated(self%series)) then
            half = self%lattice%rows%half_sides()
            total = dot_product([1.0_dp, z%re], &
                                self%far%at(square_argument(z%re, half(1)), square_argument(z%im, half(2))))
         else
            far = [(self%spot%is_resolved(z - self%image(k)), k=1, size(far))]
            total = coarse_sum(self, z, pack(self%image, .not. far))
         end if
         exact = 0.0_dp
         do k = 1, size(far)
            if (far(k)) cycle
            if (allocated(self%series) .and. abs(self%preimage(1, k, centre)) > 0.0_dp) then
               total = total + self%series%at(self%spot%solution%shape%fold, self%preimage(1, k, centre))
            else
               call self%spot%add_at(z - self%image(k), 0.0_dp, exact)
            end if
         end do
         total = total + exact(1)
      end function sum_over_images

   end subroutine at

   !> The sum over all images except some near ones, by the coarse rule.
   real(dp) function coarse_sum(self, z, near) result(total)
      class(fitted_fields), intent(in) :: self
      complex(dp), intent(in) :: z                           !! position from the centre, reduced to the rectangle [s]
      complex(dp), intent(in) :: near(:)                     !! centres of the images that are left out [s]

      real(dp) :: of_centre(stress_field_count), removed(stress_field_count), value(size(self%sources%x))
      integer :: k

      associate (x => z%re - self%sources%x, y => z%im - self%sources%y)
         call self%lattice%kernel(merge(2, 1, self%answer%pool))%evaluate(size(x), x, y, value)
         if (self%answer%pool) value = -value/(4*pi**2)
      end associate
      ! The smooth part of the kernel has the terms of all images except that of the one at the origin.
      of_centre = 0.0_dp
      removed = 0.0_dp
      if (all(abs(near) > 0.0_dp)) call self%sources%add_at(surface_field, z, 0.0_dp, of_centre)
      do k = 1, size(near)
         if (abs(near(k)) > 0.0_dp) call self%sources%add_at(surface_field, z - near(k), 0.0_dp, removed)
      end do
      total = dot_product(self%sources%strength(:, 1), value) + of_centre(1) - removed(1)
   end function coarse_sum

   !> Prepares the evaluation at many positions. The field of one spot or pool becomes a series, which also serves for
   !> the images that are too near to the cell for a polynomial. The field of all others becomes a polynomial. If there
   !> is no such series, or if the positions are few, nothing is done, and each position is evaluated for itself.
   subroutine prepare_map(self, accuracy, places)
      class(fitted_fields), intent(inout) :: self
      real(dp), intent(in) :: accuracy            !! accuracy of the solution, as of fitted_contact
      integer, intent(in) :: places               !! number of positions, distributed over the cell, >= 0

      !> Error of the series and the polynomial over the accuracy of the solution, and the least relative error.
      real(dp), parameter :: share = 1e-3_dp, least = 1e-11_dp
      !> Largest number of values for a series over the number of positions outside. They are computed along shared
      !> rays, which is much faster.
      real(dp), parameter :: most_terms = 3.0_dp
      !> Number of nodes of the polynomial in the square of either coordinate.
      integer, parameter :: nodes = 13
      type(exterior_series), allocatable :: series
      complex(dp) :: z
      real(dp) :: half(2), other, outside, tolerance, values(nodes, nodes, 2), x(nodes), y(nodes)
      logical :: found
      integer :: i, j

      associate (area => self%answer%value(contact_area))
         outside = places*merge(area, 1.0_dp - area, self%answer%pool)
      end associate
      if (outside < least_map) return
      tolerance = max(share*accuracy, least)
      allocate (series)
      call start_exterior_series(series, self%answer%solution, tolerance, nint(most_terms*outside), found)
      if (.not. found) return
      call move_alloc(series, self%series)
      tolerance = 0.01_dp*tolerance
      ! If the nearest singularity is at the distance c beside a rectangle of the half side a, the terms of a polynomial
      ! in the square of the coordinate along this side fall by the factor exp(-2 asinh(c/a)).
      call find_images(self, self%spot%radius + 0.5_dp*max(self%lattice%rows%spacing, 1.0_dp) &
                       *sinh(-0.5_dp*log(tolerance)/nodes))
      ! Displacements are of order 1, pressures of the order of their peak.
      if (self%answer%pool) tolerance = tolerance*self%answer%value(peak_pressure)
      half = self%lattice%rows%half_sides()
      x = square_nodes(nodes, half(1))
      y = square_nodes(nodes, half(2))
      values(:, :, 2) = 0.0_dp
      do j = 1, nodes
         do i = 1, nodes
            z = cmplx(x(i), y(j), dp)
            values(i, j, 1) = coarse_sum(self, z, self%image)
            if (mod(self%answer%solution%shape%fold, 2) == 0) cycle
            other = coarse_sum(self, -conjg(z), self%image)
            values(i, j, :) = 0.5_dp*[values(i, j, 1) + other, (values(i, j, 1) - other)/x(i)]
         end do
      end do
      call self%far%set(values, tolerance)
   end subroutine prepare_map

   !> The gaps at the trough and at the lattice's saddle [Delta], and the pressure at the saddle [pi E* Delta/s]. If
   !> spots are separate the pressure at the saddle is 0; if pools are separate the gap there is 0.
   function fitted_separations(lattice, answer, accuracy) result(values)
      type(wave_lattice), intent(in) :: lattice    !! the lattice that was solved
      type(fitted_answer), intent(in) :: answer    !! the solution, status <= fitted_less_exact
      real(dp), intent(in), optional :: accuracy   !! as of start_fitted_fields
      real(dp) :: values(3)

      type(fitted_fields) :: fields
      real(dp) :: displacement, pressure

      call start_fitted_fields(fields, lattice, answer, accuracy)
      call fields%at(lattice%trough, pressure, displacement, values(1))
      call fields%at(lattice%saddle, values(3), displacement, values(2))
   end function fitted_separations

   !> The values of `fitted_separations` and estimates of their errors.
   !>
   !> The error of the fitted function is estimated from the values of lower degrees at the same positions. The error of
   !> the integrals over near images is estimated from a second evaluation by finer rules.
   subroutine find_fitted_details(lattice, answer, values, error)
      type(wave_lattice), intent(in) :: lattice    !! the lattice that was solved
      type(fitted_answer), intent(in) :: answer    !! the solution, status <= fitted_less_exact
      real(dp), intent(out) :: values(3)           !! as of fitted_separations: trough gap, saddle gap, saddle pressure
      real(dp), intent(out) :: error(3)            !! estimates of their errors

      !> Accuracy of the second evaluation.
      real(dp), parameter :: finer = 1e-15_dp
      real(dp) :: of_degree(3, 0:size(answer%previous)), decay(2), reference(3)
      type(fitted_answer) :: older
      integer :: i, k

      values = fitted_separations(lattice, answer)
      of_degree(:, 0) = values
      older = answer
      do k = 1, size(answer%previous)
         older%solution = answer%previous(k)
         if (.not. answer%pool) older%value(mean_gap) = 1.0_dp - older%solution%approach
         of_degree(:, k) = fitted_separations(lattice, older)
      end do
      ! All values except the gap inside a pool are differences of numbers of order 1, so that their rounding is
      ! absolute.
      reference = 1.0_dp
      if (answer%pool) reference(1) = of_degree(1, 0)
      ! The errors are estimated separately: the saddle may be nearly closed while the trough is wide open.
      do i = 1, size(values)
         decay = answer%misfit_decay
         ! The gap inside a pool is a value of the fitted function, while the others are integrals of the fitted
         ! function.
         if (answer%pool .and. i == 1) decay = max(decay, fastest_decay_at_point)
         error(i:i) = error_estimate(of_degree(i:i, :), decay, reference(i:i))
      end do
      ! The approach of a spot is part of both gaps, so its error is part of theirs.
      if (.not. answer%pool) error(:2) = max(error(:2), answer%error(mean_gap))
      error = error + abs(fitted_separations(lattice, answer, finer) - values)
      ! A gap in contact and a pressure outside of it are 0 by definition.
      error(merge(2, 3, answer%pool)) = 0.0_dp
   end subroutine find_fitted_details

end module wavycon_fitted_fields
