!> Reads height maps from files in six formats: .npy, .gsf, and as texts a matrix, an ESRI ASCII grid, points x, y, z
!> and profiles x, z.
module wavycon_map_file
   use, intrinsic :: iso_c_binding, only: c_null_char
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_invalid, ieee_overflow, &
      ieee_set_halting_mode, ieee_set_status, ieee_status_type
   use wavycon_binary_file, only: binary_file
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_file_bytes, only: make_one_byte
   use wavycon_foreign_format, only: remedy_of_content, remedy_of_name
   use wavycon_grid_slab, only: grid_slab
   use wavycon_gwyddion_map, only: blanks, entry_of, gsf_magic, in_english, read_gsf_map, take_esri_head, &
      take_text_head
   use wavycon_kinds, only: dp, ieee_is_nan, sp
   use wavycon_measured_map, only: check_map_size, check_room, laid_along_x, measured_map
   use wavycon_npy_map, only: npy_magic, read_npy_map
   use wavycon_number_table, only: number_table, read_number_table
   use wavycon_plain_text, only: escaped, integer_text, lower_case, newline
   use wavycon_point_map, only: check_matrix, resample_profile, take_points, take_profile
   use wavycon_ranks, only: share_error
   use wavycon_system, only: note_input, path_device, path_kind
   implicit none (type, external)
   private

   public :: read_height_map

   !> The largest number of bytes of a text that is read, near the largest default integer.
   integer, parameter :: most_bytes = 2000000000

contains

   !> Reads a map. All processes of the parallel program call this together, and an error of one is reported to all.
   !> Errors: exit_file_trouble if the file cannot be read, exit_bad_input if the file is not a map.
   subroutine read_height_map(path, given_format, map, error, missing_value, in_slabs)
      character(*), intent(in) :: path
      !> 'matrix', 'xyz' or 'xz' for a text, 'npy', 'gsf', or 'auto': the format follows from the content and the name.
      character(*), intent(in) :: given_format
      type(measured_map), intent(out) :: map
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(in), optional :: missing_value   !! a number of the file that stands for a missing height

      !> Whether each process reads only its own columns of a large map, if the format allows this; .false. if absent.
      logical, intent(in), optional :: in_slabs

      type(binary_file) :: file
      character(:), allocatable :: ending
      type(grid_slab) :: slab
      type(ieee_status_type) :: floating_point

      ! Overflow and invalid operations must not stop builds that trap them: 1e999 is reported as bad input, and a
      ! signalling NaN is a missing height.
      call ieee_get_status(floating_point)
      call ieee_set_halting_mode([ieee_invalid, ieee_overflow], .false.)
      ! A pipe may block, and a device may never end. A run of the resolved deck could read neither of them again.
      if (path_kind(path) == path_device) then
         call fatal_error(error, exit_file_trouble, escaped(path)//': this is a pipe or a device, not a file')
      else
         call file%open(path, error)
         call note_input(path//c_null_char)
      end if
      if (present(in_slabs)) file%in_slabs = in_slabs
      if (file%bytes == 0 .and. .not. allocated(error)) call file%refuse('the file is empty', error)
      call share_error(error)
      if (.not. allocated(error)) then
         map%format = given_format
         if (given_format == 'auto') then
            ! Recognise the format by the first bytes or, if these are those of no format, by the ending of the name.
            ending = lower_case(path(index(path, '.', back=.true.) + 1:))
            if (index(file%head, gsf_magic) == 1 .or. ending == 'gsf') map%format = 'gsf'
            if (index(file%head, npy_magic) == 1 .or. ending == 'npy') map%format = 'npy'
         end if
         select case (map%format)
         case ('npy')
            call read_npy_map(file, map, error)
         case ('gsf')
            call read_gsf_map(file, map, error)
         case default
            ! Close the file first: reading the text opens it a second time, which gfortran refuses in a process whose
            ! main program is in C or Python.
            call file%close()
            call read_text(file, map, error)
         end select
      end if
      call file%close()
      if (.not. allocated(error)) call mark_missing(file, map, error, missing_value)
      if (allocated(map%no_data) .and. .not. allocated(error)) call mark_missing(file, map, error, map%no_data)
      call ieee_set_status(floating_point)
      if (allocated(map%x) .and. .not. allocated(error)) call resample_profile(path, map, error)
      call share_error(error)
      if (allocated(error)) return
      slab = map%columns()
      map%has_missing_value = slab%any(map%has_missing_value)
   end subroutine read_height_map

   !> Reads a map from a text of numbers. Errors: as of read_height_map.
   subroutine read_text(file, map, error)
      type(binary_file), intent(inout) :: file
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error

      type(number_table) :: table
      character(:), allocatable :: remedy

      call make_one_byte(file%head)
      remedy = remedy_of_content(file%head, file%path)
      if (index(file%head, npy_magic) == 1) remedy = "this is a file of numpy: file_format = 'npy' reads it"
      if (index(file%head, gsf_magic) == 1) remedy = "this is a file of Gwyddion: file_format = 'gsf' reads it"
      if (remedy /= '') call file%refuse(remedy, error)
      if (allocated(error)) return
      call read_number_table(file%path, most_bytes, table, error)
      if (allocated(error)) then
         ! The name is considered only now, because a text of numbers is read whatever its name is.
         if (error%status == exit_bad_input) remedy = remedy_of_name(file%path)
         if (remedy /= '') error%message = error%message//' ('//remedy//')'
         return
      end if
      map%head_lines = table%words
      if (map%format == 'auto') then
         map%format = 'matrix'
         ! Texts of Gwyddion with the sides of a map and grids of ESRI are matrices, also if they have two or three
         ! columns.
         if (entry_of(in_english(file%head), 'Width', ':') == '' .and. &
             entry_of(newline//lower_case(file%head), 'ncols', blanks) == '') then
            if (size(table%values, 1) == 3 .and. size(table%line) > 3) map%format = 'xyz'
            if (size(table%values, 1) == 2 .and. size(table%line) > 2) map%format = 'xz'
            if (map%format == 'matrix') call check_matrix(table, error)
            if (allocated(error)) return
         end if
      end if
      call check_room(file%path, [size(table%values)/merge(3, 1, map%format == 'xyz'), 1], error)
      if (allocated(error)) return
      select case (map%format)
      case ('xyz')
         call take_points(table, map, error)
      case ('xz')
         call take_profile(table, map, error)
      case default
         call move_alloc(table%values, map%height)
         call take_esri_head(file, map, error)
         if (.not. allocated(error)) call check_map_size(file%path, laid_along_x(shape(map%height)), error)
      end select
      if (.not. allocated(error)) call take_text_head(file, map, error)
      if (allocated(error)) return
      if (size(map%height, 1) > 1) return
      map%height = transpose(map%height)
      map%step = map%step(2:1:-1)
   end subroutine read_text

   !> Marks the missing heights, and sets them to 0: those that are NaN, and those that equal a given value or this
   !> value rounded to single precision. Errors: exit_bad_input for an infinite height, which texts cannot have.
   subroutine mark_missing(file, map, error, missing_value)
      type(binary_file), intent(in) :: file
      type(measured_map), intent(inout) :: map
      type(error_type), allocatable, intent(out) :: error
      real(dp), intent(in), optional :: missing_value   !! a height that stands for a missing one

      real(dp) :: rounded   ! to single precision
      integer :: i, j
      type(grid_slab) :: slab

      slab = map%columns()
      if (present(missing_value)) then
         rounded = missing_value
         if (abs(missing_value) < huge(1.0_sp)) rounded = real(real(missing_value, sp), dp)
      end if
      do j = 1, size(map%height, 2)
         do i = 1, size(map%height, 1)
            if (.not. ieee_is_nan(map%height(i, j))) then
               if (abs(map%height(i, j)) > huge(rounded)) then
                  call file%refuse('the height in row '//integer_text(slab%first - 1 + j)//', column '// &
                                   integer_text(i)//' is infinite: make it nan if it is missing', error)
                  return
               end if
               if (.not. present(missing_value)) cycle
               if (abs(map%height(i, j) - missing_value) > 0.0_dp .and. abs(map%height(i, j) - rounded) > 0.0_dp) cycle
               map%has_missing_value = .true.
            end if
            if (.not. allocated(map%missing)) allocate (map%missing(size(map%height, 1), size(map%height, 2)), &
                                                        source=.false.)
            map%missing(i, j) = .true.
            map%height(i, j) = 0.0_dp
         end do
      end do
   end subroutine mark_missing

end module wavycon_map_file
