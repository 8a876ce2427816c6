!> The stresses below a solution in the user's units, and the keys of &stress in the public interface.
module wavycon_solution_stress
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only: c_double
   use, intrinsic :: iso_fortran_env, only: int64
   use wavycon_constants, only: pi
   use wavycon_deck_text, only: deck_text_type
   use wavycon_elastic_body, only: elastic_body
   use wavycon_error, only: error_type, exit_bad_input, exit_file_trouble, fatal_error
   use wavycon_group_text, only: read_group_text
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: find_largest_stresses, largest_stress
   use wavycon_load_group, only: load_table
   use wavycon_material_group, only: material_table
   use wavycon_plain_text, only: quoted
   use wavycon_problem_report, only: problem_report
   use wavycon_problems, only: problem_list_type
   use wavycon_stress_fields, only: stress_fields
   use wavycon_stress_group, only: check_stress_group, make_stress_setting, stress_table
   use wavycon_stress_setting, only: stress_setting
   use wavycon_stress_tensor, only: largest_shear, von_mises
   use wavycon_system, only: has_memory_for
   use wavycon_wavy_surface, only: number_words
   implicit none (type, external)
   private

   public :: solution_stress, wavy_largest_stress, stress_setting_of_keys

   !> The largest stresses of a load in one body, named as the columns of the table of largest stresses. Errors are
   !> estimates, and NaN if the solver has none. All are NaN for a load without a solution.
   type, bind(c) :: wavy_largest_stress
      real(c_double) :: largest_von_mises_over_pstar = 0.0_dp
      real(c_double) :: largest_von_mises_over_pstar_error = 0.0_dp
      real(c_double) :: largest_shear_over_pstar = 0.0_dp
      real(c_double) :: largest_shear_over_pstar_error = 0.0_dp
      real(c_double) :: largest_von_mises = 0.0_dp    !! [pressure]
      real(c_double) :: von_mises_x = 0.0_dp          !! its place, in the cell [length]
      real(c_double) :: von_mises_y = 0.0_dp
      real(c_double) :: von_mises_depth = 0.0_dp
      real(c_double) :: largest_shear = 0.0_dp        !! [pressure]
      real(c_double) :: shear_x = 0.0_dp              !! its place, in the cell [length]
      real(c_double) :: shear_y = 0.0_dp
      real(c_double) :: shear_depth = 0.0_dp
   end type wavy_largest_stress

   type :: solution_stress
      class(stress_fields), allocatable :: fields    !! not allocated for a flat surface: the stress is uniform
      real(dp) :: length(2) = 1.0_dp                 !! of the cell that repeats [length]
      real(dp) :: p_star = 0.0_dp                    !! [pressure]; 0 for a flat surface
      real(dp) :: mean_pressure = 0.0_dp             !! [pressure]
   contains
      procedure :: at
      procedure :: on_plane
      procedure :: largest
      procedure, private :: exist
      procedure, private :: uniform
   end type solution_stress

contains

   !> Reads keys of &stress as those of a deck. Errors: exit_bad_input, with all problems of the keys.
   subroutine stress_setting_of_keys(keys, p_star, setting, error)
      character(*), intent(in) :: keys      !! such as "nu = 0.3, yield_stress = 1e9"; nu is needed
      real(dp), intent(in) :: p_star        !! [pressure]; 0 if the surface is flat: then there are no yield stresses
      type(stress_setting), allocatable, intent(out) :: setting
      type(error_type), allocatable, intent(out) :: error

      type(deck_text_type) :: text
      type(group_values) :: load, material, values
      type(problem_list_type) :: problems

      call material%start(material_table(), '')
      call load%start(load_table(), '')
      call read_group_text(stress_table(), keys, values, text, problems)
      call check_stress_group(values, material, load, problems)
      if (problems%number > 0) then
         call fatal_error(error, exit_bad_input, problem_report(problems, text))
      else
         call make_stress_setting(values, material, p_star, setting)
      end if
   end subroutine stress_setting_of_keys

   !> The stresses at n points. Errors: exit_bad_input for arrays of different sizes, and for arguments that are not
   !> finite or out of range; exit_file_trouble without memory.
   subroutine at(self, x, y, depth, nu, lateral, stress, stress_error, error)
      class(solution_stress), intent(inout) :: self
      real(dp), intent(in) :: x(:), y(:)                      !! shape (n) [length]
      real(dp), intent(in) :: depth(:)                        !! >= 0, shape (n) [length]
      real(dp), intent(in) :: nu                              !! Poisson's ratio of the body, -1 < nu <= 1/2
      character(*), intent(in) :: lateral                     !! a value of the key of &stress
      real(dp), allocatable, intent(out) :: stress(:, :)      !! xx, yy, zz, xy, xz, yz, shape (6, n) [pressure]
      real(dp), allocatable, intent(out) :: stress_error(:)   !! of the component with the largest, shape (n) [pressure]
      type(error_type), allocatable, intent(out) :: error

      type(elastic_body) :: body
      real(dp) :: angles(2), parts(6, 2)
      integer :: i

      call find_body(nu, lateral, body, error)
      if (allocated(error)) return
      if (size(y) /= size(x) .or. size(depth) /= size(x)) then
         call fatal_error(error, exit_bad_input, 'x, y and depth must have the same size')
      else if (.not. has_memory_for(7*size(x, kind=int64))) then
         call fatal_error(error, exit_file_trouble, 'there is not the memory for so many points')
      else if (.not. all(ieee_is_finite(x/self%length(1)) .and. ieee_is_finite(y/self%length(2)))) then
         call fatal_error(error, exit_bad_input, 'places must be finite numbers')
      else
         call check_depths(depth, self%length(1), error)
      end if
      if (allocated(error)) return
      allocate (stress(6, size(x)), stress_error(size(x)))
      do i = 1, size(x)
         if (self%exist()) then
            angles = 2*pi*modulo([x(i), y(i)]/self%length, 1.0_dp)
            call self%fields%at(angles(1), angles(2), 2*pi*depth(i)/self%length(1), parts, stress_error(i))
            stress(:, i) = self%p_star*body%stress(parts, self%fields%pbar_over_pstar)
            stress_error(i) = self%p_star*stress_error(i)
         else
            call self%uniform(body, stress(:, i), stress_error(i))
         end if
      end do
   end subroutine at

   !> The stresses at x = L_x (k + offset(1))/N_x, k = 0 .. N_x - 1, the same in y. Errors: exit_bad_input for arguments
   !> that are not finite or out of range.
   subroutine on_plane(self, points, offset, depth, nu, lateral, stress, stress_error, error)
      class(solution_stress), intent(inout) :: self
      integer, intent(in) :: points(2)                          !! N_x, N_y >= 1; N_y = 1 for a profile
      real(dp), intent(in) :: offset(2)                         !! of the first point, in steps; of a profile 0 along y
      real(dp), intent(in) :: depth                             !! >= 0 [length]
      real(dp), intent(in) :: nu                                !! as of `at`
      character(*), intent(in) :: lateral
      real(dp), allocatable, intent(out) :: stress(:, :, :)     !! as of `at`, shape (6, N_x, N_y)
      real(dp), allocatable, intent(out) :: stress_error(:, :)  !! as of `at`, shape (N_x, N_y)
      type(error_type), allocatable, intent(out) :: error

      type(elastic_body) :: body
      real(dp), allocatable :: over_p_star(:, :, :)
      integer :: i, l

      call find_body(nu, lateral, body, error)
      if (.not. allocated(error)) call check_depths([depth], self%length(1), error)
      if (allocated(error)) return
      allocate (stress(6, points(1), points(2)))
      if (self%exist()) then
         call self%fields%on_plane(points, offset, 2*pi*depth/self%length(1), body, over_p_star, stress_error)
         do l = 1, points(2)
            do i = 1, 6
               stress(i, :, l) = self%p_star*over_p_star(:, l, i)
            end do
         end do
         stress_error = self%p_star*stress_error
      else
         allocate (stress_error(points(1), points(2)))
         do l = 1, points(2)
            do i = 1, points(1)
               call self%uniform(body, stress(:, i, l), stress_error(i, l))
            end do
         end do
      end if
   end subroutine on_plane

   !> The largest von Mises stress and the largest shear stress in a body. Errors: exit_bad_input for arguments out of
   !> range.
   subroutine largest(self, nu, lateral, answer, error)
      class(solution_stress), intent(inout) :: self
      real(dp), intent(in) :: nu                   !! as of `at`
      character(*), intent(in) :: lateral
      type(wavy_largest_stress), intent(out) :: answer
      type(error_type), allocatable, intent(out) :: error

      type(elastic_body) :: body
      real(dp) :: none, stress(6), stress_error
      type(largest_stress) :: shear, yielding

      call find_body(nu, lateral, body, error)
      if (allocated(error)) return
      if (allocated(self%fields)) then
         call find_largest_stresses(self%fields, body, yielding, shear)
         associate (place => [self%length, self%length(1)]*yielding%place_in_cell(self%fields%parts), &
                    shear_place => [self%length, self%length(1)]*shear%place_in_cell(self%fields%parts))
            answer = wavy_largest_stress( &
               yielding%value, yielding%error, shear%value, shear%error, &
               self%p_star*yielding%value, place(1), place(2), place(3), &
               self%p_star*shear%value, shear_place(1), shear_place(2), shear_place(3))
         end associate
      else
         call self%uniform(body, stress, stress_error)
         none = ieee_value(1.0_dp, ieee_quiet_nan)
         answer = wavy_largest_stress(none, none, none, none, largest_von_mises=von_mises(stress), &
                                      largest_shear=largest_shear(stress))
      end if
   end subroutine largest

   !> The body of a Poisson's ratio and lateral stresses. Errors: exit_bad_input, with the messages of decks.
   subroutine find_body(nu, lateral, body, error)
      real(dp), intent(in) :: nu
      character(*), intent(in) :: lateral
      type(elastic_body), intent(out) :: body
      type(error_type), allocatable, intent(out) :: error

      type(stress_setting), allocatable :: setting

      call stress_setting_of_keys('nu = '//number_words(nu)//', lateral = '//quoted(lateral), p_star=0.0_dp, &
                                  setting=setting, error=error)
      if (.not. allocated(error)) body = setting%body(1)
   end subroutine find_body

   !> Errors: exit_bad_input for a depth that is negative or not finite.
   subroutine check_depths(depth, length, error)
      real(dp), intent(in) :: depth(:), length   !! [length]
      type(error_type), allocatable, intent(out) :: error

      if (.not. all(ieee_is_finite(depth/length))) then
         call fatal_error(error, exit_bad_input, 'depths must be finite numbers')
      else if (any(depth < 0.0_dp)) then
         call fatal_error(error, exit_bad_input, 'depths must be 0 or more: z points into the body')
      end if
   end subroutine check_depths

   !> Whether there are fields to be asked: not for a flat surface, and not for a load without a solution.
   pure logical function exist(self)
      class(solution_stress), intent(in) :: self

      exist = allocated(self%fields)
      if (exist) exist = self%fields%exist
   end function exist

   !> The stress where there are no fields: that of the mean pressure for a flat surface, otherwise NaN.
   subroutine uniform(self, body, stress, error)
      class(solution_stress), intent(in) :: self
      type(elastic_body), intent(in) :: body
      real(dp), intent(out) :: stress(6), error   !! as of `at`

      real(dp), parameter :: no_waves(6, 2) = 0.0_dp

      if (allocated(self%fields)) then
         stress = ieee_value(1.0_dp, ieee_quiet_nan)
         error = ieee_value(1.0_dp, ieee_quiet_nan)
      else
         stress = body%stress(no_waves, self%mean_pressure)
         error = 0.0_dp
      end if
   end subroutine uniform

end module wavycon_solution_stress
