!> Fields at many places, such as those of a map.
!>
!> Outside of spots and islands they come from a table, which is made at a few hundred places: README.md, section 12.
!> For few places, and where no table gets to its tolerance, each place is evaluated for itself.
module wavycon_fitted_map
   use wavycon_cell_sector, only: cell_sector, start_cell_sector
   use wavycon_constants, only: pi
   use wavycon_exterior_map, only: find_exterior
   use wavycon_fitted_fields, only: fitted_fields
   use wavycon_fitted_tuning, only: least_map, least_table_tolerance, table_share, table_share_of_accuracy
   use wavycon_kinds, only: dp
   use wavycon_outside_table, only: outside_table, start_outside_table
   use wavycon_shape_search, only: find_preimage
   implicit none (type, external)
   private

   public :: fitted_map, start_fitted_map

   type :: fitted_map
      logical :: has_table = .false.
      type(fitted_fields), private :: fields
      type(cell_sector), private :: sector
      type(outside_table), private :: table
      logical, private :: was_outside = .false.           !! where the last place was, and its preimage
      complex(dp), private :: last = 0.0_dp
   contains
      procedure :: at
      procedure :: places_of_table
   end type fitted_map

contains

   !> Prepares for a number of places.
   subroutine start_fitted_map(map, fields, accuracy, places)
      type(fitted_map), intent(out) :: map
      type(fitted_fields), intent(in) :: fields
      real(dp), intent(in) :: accuracy            !! that the solution was asked for, relative
      integer, intent(in) :: places               !! spread over the cell, >= 0

      real(dp) :: outside, tolerance

      map%fields = fields
      associate (answer => map%fields%answer)
         outside = places*merge(answer%area_fraction, 1.0_dp - answer%area_fraction, answer%island)
         if (outside < least_map) return
         ! Displacements are of order 1, pressures of the order of their peak.
         if (answer%island) then
            tolerance = 4*pi**2*max(table_share*answer%peak_error, &
                                    answer%peak_pressure*max(table_share_of_accuracy*accuracy, least_table_tolerance))
         else
            tolerance = max(table_share*answer%mean_gap_error, table_share_of_accuracy*accuracy, least_table_tolerance)
         end if
         call start_cell_sector(map%sector, fields%lattice, answer%island, answer%solution%shape)
      end associate
      call start_outside_table(map%table, map%fields, map%sector, tolerance, outside, map%has_table)
   end subroutine start_fitted_map

   !> The fields at a place. It is quickest where the last place was a neighbour.
   subroutine at(self, place, pressure, displacement, gap)
      class(fitted_map), intent(inout) :: self
      complex(dp), intent(in) :: place             !! x + i y from a crest [s]
      real(dp), intent(out) :: pressure            !! [p* of the lattice], 0 where the gap is open
      real(dp), intent(out) :: displacement        !! u less its mean [Delta]
      real(dp), intent(out) :: gap                 !! [Delta], 0 in contact

      complex(dp) :: v, z
      logical :: found

      if (.not. self%has_table) then
         call self%fields%at(place, pressure, displacement, gap)
         return
      end if
      z = self%sector%folded(place)
      associate (shape => self%fields%answer%solution%shape)
         if (self%was_outside) then
            call find_exterior(shape, z, v, found, near=self%last)
         else
            call find_preimage(shape, z, v, found, near=self%last)
            found = found .and. abs(v) <= 1.0_dp
         end if
         if (.not. found) then
            call find_preimage(shape, z, v, found)
            found = found .and. abs(v) <= 1.0_dp
            self%was_outside = .not. found
            if (.not. found) call find_exterior(shape, z, v, found)
         end if
      end associate
      if (.not. found) then
         self%was_outside = .false.
         self%last = 0.0_dp
         call self%fields%at(place, pressure, displacement, gap)
         return
      end if
      self%last = v
      if (self%was_outside) then
         call self%fields%fields_outside(place, self%table%at(v), pressure, displacement, gap)
      else
         call self%fields%fields_inside(place, v, pressure, displacement, gap)
      end if
   end subroutine at

   !> The number of places at which the integrals outside were taken for the table.
   pure integer function places_of_table(self)
      class(fitted_map), intent(in) :: self

      places_of_table = self%table%places
   end function places_of_table

end module wavycon_fitted_map
