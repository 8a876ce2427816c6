!> The surfaces of the C interface. wavycon.h documents each procedure.
module wavycon_c_surfaces
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_ptr
   use wavycon_c_handles, only: begin_call, close_new, handle_type, text_at
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_wavy_surface, only: make_crossed_1d, make_heights, make_hexagonal, make_surface_of_keys, make_wave_1d, &
      make_wave_2d, make_wave_sum
   implicit none (type, external)
   private

   !> Most waves of a sum and points of a side of a height map: above what is accepted, so that sizes do not overflow.
   integer, parameter :: most_waves = 2000, most_points = 30000

contains

   type(c_ptr) function new_wave_1d(error, amplitude, wavelength) result(handle) bind(c, name='wavycon_new_wave_1d')
      type(c_ptr), value :: error
      real(c_double), value :: amplitude, wavelength

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made

      call begin_call()
      allocate (made)
      allocate (made%surface)
      call make_wave_1d(amplitude, wavelength, made%surface, trouble)
      handle = close_new(error, made, trouble)
   end function new_wave_1d

   type(c_ptr) function new_wave_2d(error, amplitude, wavelength_x, wavelength_y) result(handle) &
      bind(c, name='wavycon_new_wave_2d')
      type(c_ptr), value :: error
      real(c_double), value :: amplitude, wavelength_x, wavelength_y

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made

      call begin_call()
      allocate (made)
      allocate (made%surface)
      call make_wave_2d(amplitude, wavelength_x, wavelength_y, made%surface, trouble)
      handle = close_new(error, made, trouble)
   end function new_wave_2d

   type(c_ptr) function new_hexagonal(error, amplitude, wavelength) result(handle) bind(c, name='wavycon_new_hexagonal')
      type(c_ptr), value :: error
      real(c_double), value :: amplitude, wavelength

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made

      call begin_call()
      allocate (made)
      allocate (made%surface)
      call make_hexagonal(amplitude, wavelength, made%surface, trouble)
      handle = close_new(error, made, trouble)
   end function new_hexagonal

   type(c_ptr) function new_crossed_1d(error, amplitude1, wavelength1, amplitude2, wavelength2) result(handle) &
      bind(c, name='wavycon_new_crossed_1d')
      type(c_ptr), value :: error
      real(c_double), value :: amplitude1, wavelength1, amplitude2, wavelength2

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made

      call begin_call()
      allocate (made)
      allocate (made%surface)
      call make_crossed_1d(amplitude1, wavelength1, amplitude2, wavelength2, made%surface, trouble)
      handle = close_new(error, made, trouble)
   end function new_crossed_1d

   type(c_ptr) function new_wave_sum(error, waves, amplitudes, waves_x, waves_y, phases, length_x, length_y) &
      result(handle) bind(c, name='wavycon_new_wave_sum')
      type(c_ptr), value :: error, amplitudes, waves_x, waves_y, phases
      integer(c_int), value :: waves
      real(c_double), value :: length_x, length_y

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made
      real(c_double), pointer :: a(:), turn(:)
      integer(c_int), pointer :: m(:), n(:)

      call begin_call()
      allocate (made)
      allocate (made%surface)
      if (waves < 1 .or. waves > most_waves) then
         call fatal_error(trouble, exit_bad_input, 'the number of waves is out of range')
      else if (.not. (c_associated(amplitudes) .and. c_associated(waves_x) .and. c_associated(waves_y) .and. &
                      c_associated(phases))) then
         call fatal_error(trouble, exit_bad_input, 'an array of the waves is NULL')
      else
         call c_f_pointer(amplitudes, a, [waves])
         call c_f_pointer(waves_x, m, [waves])
         call c_f_pointer(waves_y, n, [waves])
         call c_f_pointer(phases, turn, [waves])
         call make_wave_sum(a, int(m), int(n), turn, length_x, length_y, made%surface, trouble)
      end if
      handle = close_new(error, made, trouble)
   end function new_wave_sum

   type(c_ptr) function new_heights(error, points_x, points_y, heights, length_x, length_y) result(handle) &
      bind(c, name='wavycon_new_heights')
      type(c_ptr), value :: error, heights
      integer(c_int), value :: points_x, points_y
      real(c_double), value :: length_x, length_y

      character(:), allocatable :: no_keys

      no_keys = ''
      handle = surface_of_heights(error, points_x, points_y, heights, length_x, length_y, no_keys)
   end function new_heights

   type(c_ptr) function new_measured_heights(error, points_x, points_y, heights, length_x, length_y, keys) &
      result(handle) bind(c, name='wavycon_new_measured_heights')
      type(c_ptr), value :: error, heights, keys
      integer(c_int), value :: points_x, points_y
      real(c_double), value :: length_x, length_y

      character(:), allocatable :: text

      call text_at(keys, text)
      handle = surface_of_heights(error, points_x, points_y, heights, length_x, length_y, text)
   end function new_measured_heights

   !> The surface of a map in memory.
   type(c_ptr) function surface_of_heights(error, points_x, points_y, heights, length_x, length_y, keys) result(handle)
      type(c_ptr), value :: error, heights
      integer(c_int), intent(in) :: points_x, points_y
      real(c_double), intent(in) :: length_x, length_y
      character(:), intent(in), allocatable :: keys   !! of &surface; not allocated for a null pointer

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made
      real(c_double), pointer :: height(:, :)

      call begin_call()
      allocate (made)
      allocate (made%surface)
      if (min(points_x, points_y) < 1 .or. max(points_x, points_y) > most_points) then
         call fatal_error(trouble, exit_bad_input, 'the number of points is out of range')
      else if (.not. c_associated(heights)) then
         call fatal_error(trouble, exit_bad_input, 'heights is NULL')
      else if (.not. allocated(keys)) then
         call fatal_error(trouble, exit_bad_input, 'keys is NULL')
      else
         call c_f_pointer(heights, height, [points_x, points_y])
         call make_heights(height, length_x, length_y, made%surface, trouble, keys)
      end if
      handle = close_new(error, made, trouble)
   end function surface_of_heights

   type(c_ptr) function new_surface(error, keys) result(handle) bind(c, name='wavycon_new_surface')
      type(c_ptr), value :: error, keys

      type(error_type), allocatable :: trouble
      type(handle_type), pointer :: made
      character(:), allocatable :: text

      call begin_call()
      allocate (made)
      allocate (made%surface)
      call text_at(keys, text)
      if (allocated(text)) then
         call make_surface_of_keys(text, made%surface, trouble)
      else
         call fatal_error(trouble, exit_bad_input, 'keys is NULL')
      end if
      handle = close_new(error, made, trouble)
   end function new_surface

end module wavycon_c_surfaces
