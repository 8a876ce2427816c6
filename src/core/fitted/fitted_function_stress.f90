!> Stresses in the half-space below one fitted function and all its images: README.md, section 13.
!>
!> At depth the stresses are a Fourier series. Near the surface they are the sum of two parts: the spots or pools near
!> the point are integrated one by one, by a rule over the disc or, next to a spot or pool, along rays; the stresses of
!> all others are smooth and are interpolated in a table.
module wavycon_fitted_function_stress
   use wavycon_disc_sources, only: disc_sources, start_disc_sources
   use wavycon_far_stress, only: far_stress, set_far_values, start_far_stress
   use wavycon_fitted_function, only: fitted_function
   use wavycon_fitted_tuning, only: far_top, near_clearance, series_depth
   use wavycon_kinds, only: dp, pi
   use wavycon_lattice_stress_series, only: add_wave, lattice_stress_series, start_lattice_stress_series
   use wavycon_shape_search, only: distance_from_edge, edge_points
   use wavycon_spot_integral, only: spot_integral, start_spot_integral
   use wavycon_stress_kernel, only: all_fields, nu_terms_of, stress_field_count
   use wavycon_wave_lattice, only: wave_lattice
   implicit none (type, external)
   private

   public :: fitted_function_stress, start_fitted_function_stress

   type :: fitted_function_stress
      type(wave_lattice), private :: lattice
      type(spot_integral) :: spot                            !! the integral over one spot or pool
      complex(dp), allocatable, private :: centre(:)         !! centres of the spots or pools near the cell [s]
      real(dp), allocatable, private :: half_turn(:)         !! for each of them 1, or -1 if rotated by half a turn
      complex(dp), allocatable, private :: edge(:)           !! edge_points of the shape [s]
      ! The series at depth and the table near the surface are made when they are first needed.
      type(lattice_stress_series), allocatable, private :: series
      type(far_stress), allocatable, private :: far
   contains
      procedure :: at, distance_from_edges
   end type fitted_function_stress

contains

   !> Prepares the stresses below a solution, and lists the spots or pools near the rectangle to which positions are
   !> reduced.
   subroutine start_fitted_function_stress(stress, lattice, solution, accuracy)
      type(fitted_function_stress), intent(out) :: stress
      type(wave_lattice), intent(in) :: lattice
      type(fitted_function), intent(in) :: solution      !! the solution of the lattice
      real(dp), intent(in) :: accuracy                   !! error of the stresses over the peak pressure

      complex(dp), allocatable :: centre(:)
      complex(dp) :: first
      integer :: k

      stress%lattice = lattice
      call start_spot_integral(stress%spot, solution, accuracy, all_fields)
      stress%edge = edge_points(solution%shape)
      ! A cell may have two pools: the second is the first one rotated by half a turn about a crest.
      first = merge(lattice%trough, (0.0_dp, 0.0_dp), solution%pool)
      allocate (stress%centre(0), stress%half_turn(0))
      do k = 1, merge(lattice%troughs, 1, solution%pool)
         centre = lattice%rows%points_about(near_clearance + stress%spot%radius, merge(first, -first, k == 1))
         stress%centre = [stress%centre, centre]
         stress%half_turn = [stress%half_turn, spread(merge(1.0_dp, -1.0_dp, k == 1), 1, size(centre))]
      end do
   end subroutine start_fitted_function_stress

   !> The stresses at a point, less those of the mean pressure.
   subroutine at(self, place, depth, nu_terms)
      class(fitted_function_stress), intent(inout) :: self
      complex(dp), intent(in) :: place                    !! x + i y of the point from a crest [s]
      real(dp), intent(in) :: depth                       !! depth z >= 0 [s]
      real(dp), intent(out) :: nu_terms(6, 2)             !! as of nu_terms_of [pi E* Delta/s]

      complex(dp) :: z
      real(dp) :: fields(stress_field_count)
      integer :: i

      fields = 0.0_dp
      if (depth >= series_depth) then
         if (.not. allocated(self%series)) call prepare_series(self)
         call self%series%add_at(place, depth, fields)
      else
         if (.not. allocated(self%far)) call prepare_far(self)
         z = self%lattice%rows%reduced(place)
         call self%far%add_at(z%re, z%im, depth, fields)
         do i = 1, size(self%centre)
            fields(7:8) = self%half_turn(i)*fields(7:8)
            call self%spot%add_at(self%half_turn(i)*(z - self%centre(i)), depth, fields)
            fields(7:8) = self%half_turn(i)*fields(7:8)
         end do
      end if
      if (self%spot%solution%pool) then
         do i = 1, size(self%lattice%pressure)
            call add_wave(2*pi*self%lattice%wave(:, i), self%lattice%pressure(i), place, depth, fields)
         end do
      end if
      nu_terms = nu_terms_of(fields)
   end subroutine at

   !> The distance of a position on the surface from the nearest edge of a spot or pool [s].
   pure real(dp) function distance_from_edges(self, place) result(distance)
      class(fitted_function_stress), intent(in) :: self
      complex(dp), intent(in) :: place                    !! x + i y from a crest [s]

      complex(dp) :: z
      integer :: i

      z = self%lattice%rows%reduced(place)
      distance = huge(distance)
      do i = 1, size(self%centre)
         if (abs(z - self%centre(i)) - self%spot%radius > distance) cycle
         distance = min(distance, abs(distance_from_edge(self%spot%solution%shape, self%edge, &
                                                         self%half_turn(i)*(z - self%centre(i)))))
      end do
   end function distance_from_edges

   !> Makes the Fourier series for depths from `series_depth` on.
   subroutine prepare_series(self)
      class(fitted_function_stress), intent(inout) :: self

      type(disc_sources) :: sources
      real(dp) :: waves

      waves = ceiling(self%spot%digits/series_depth*self%spot%radius) + self%spot%digits &
         + self%spot%solution%basis%degree
      call start_disc_sources(sources, self%spot%solution, .false., 10 + ceiling(0.5_dp*waves), ceiling(waves))
      allocate (self%series)
      call start_lattice_stress_series(self%series, self%lattice, sources, series_depth, self%spot%digits)
   end subroutine prepare_series

   !> Makes the table of the far spots or pools. At its nodes their stresses are the Fourier series of all less the sum
   !> of the near ones. Both are those of the same point sources.
   subroutine prepare_far(self)
      class(fitted_function_stress), intent(inout) :: self

      type(disc_sources) :: sources
      type(lattice_stress_series) :: series
      complex(dp) :: position
      real(dp), allocatable :: values(:, :, :, :)
      real(dp) :: fields(stress_field_count)
      integer :: i, j, k, m

      call start_disc_sources(sources, self%spot%solution, .false., self%spot%radii(1), self%spot%angles(1))
      call start_lattice_stress_series(series, self%lattice, sources, far_top, self%spot%digits + 9.0_dp)
      allocate (self%far)
      call start_far_stress(self%far, self%lattice%rows%half_sides(), self%spot%solution%pool, &
                            self%spot%digits - 1.0_dp)
      associate (x => self%far%node_x, y => self%far%node_y, z => self%far%node_z)
         allocate (values(size(x), size(y), size(z), stress_field_count))
         do k = 1, size(z)
            do j = 1, size(y)
               do i = 1, size(x)
                  fields = 0.0_dp
                  do m = 1, size(self%centre)
                     position = self%half_turn(m)*(cmplx(x(i), y(j), dp) - self%centre(m))
                     fields(7:8) = self%half_turn(m)*fields(7:8)
                     call sources%add_at(all_fields, position, z(k), fields)
                     fields(7:8) = self%half_turn(m)*fields(7:8)
                  end do
                  fields = -fields
                  call series%add_at(cmplx(x(i), y(j), dp), z(k), fields)
                  values(i, j, k, :) = fields
               end do
            end do
         end do
         call set_far_values(self%far, values)
      end associate
   end subroutine prepare_far

end module wavycon_fitted_function_stress
