!> A random self-affine surface, made from its spectrum.
module wavycon_self_affine
   use wavycon_constants, only: largest_number, smallest_number
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_grid_slab, only: grid_slab
   use wavycon_kinds, only: dp
   use wavycon_map_size, only: check_room
   use wavycon_map_statistics, only: map_statistics, statistics_of
   use wavycon_plain_text, only: short_number
   use wavycon_self_affine_heights, only: make_heights, self_affine_spectrum
   use wavycon_surface, only: surface_of_points, surface_type
   implicit none (type, external)
   private

   public :: self_affine_surface

contains

   !> Makes the surface. Errors: exit_file_trouble without enough memory, exit_bad_input for heights out of range.
   subroutine self_affine_surface(source, spectrum, points, surface, map, error, has_free_edges, radii)
      character(*), intent(in) :: source                   !! of the spectrum, for messages
      type(self_affine_spectrum), intent(in) :: spectrum   !! has_waves
      integer, intent(in) :: points(2)                     !! of the cell along x and y, not below least_points_of
      type(surface_type), intent(out) :: surface
      type(map_statistics), allocatable, intent(out) :: map
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: has_free_edges      !! these as of surface_of_points
      real(dp), intent(in), optional :: radii(2)

      type(grid_slab) :: slab
      real(dp), allocatable :: height(:, :)
      real(dp) :: largest(1)
      logical :: is_made

      call slab%start(points)
      call check_room(source, points, error, slab)
      call slab%share_error(error)
      if (allocated(error)) return
      allocate (height(points(1), slab%columns()))
      call make_heights(spectrum, height, is_made, points)
      if (.not. is_made) then
         call fatal_error(error, exit_file_trouble, source//': there is not the memory for random numbers')
         return
      end if
      largest = maxval(abs(height))
      call slab%largest(largest)
      if (largest(1) > largest_number .or. largest(1) < smallest_number) then
         call fatal_error(error, exit_bad_input, source//': heights are up to '//short_number(largest(1))// &
                          ' [length]: lengths may be from '//short_number(smallest_number)//' to '// &
                          short_number(largest_number))
         return
      end if
      map = statistics_of(height, 'made', '', points, spectrum%length/points)
      surface = surface_of_points(spectrum%length, height, points=points, has_free_edges=has_free_edges, radii=radii)
   end subroutine self_affine_surface

end module wavycon_self_affine
