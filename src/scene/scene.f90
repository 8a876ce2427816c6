!> What a deck describes, in the program's own normalisation: pressures in p*, displacements and gaps in Delta.
module wavycon_scene
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
   use wavycon_constraint_points, only: choose_points
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_fourier_terms, only: choose_terms, fourier_terms, symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: by_contact_area, by_mean_gap, by_pressure, given_loads, largest_pbar_over_pstar
   use wavycon_map_statistics, only: map_statistics
   use wavycon_material_group, only: plane_strain_modulus
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: scene_type, make_scene, target_words

   type :: scene_type
      type(surface_type), allocatable :: surface
      type(map_statistics), allocatable :: map      !! of a height map
      real(dp) :: e_star = 1.0_dp                   !! plane-strain modulus [pressure]
      real(dp) :: p_star = 0.0_dp                   !! p*, mean pressure that just closes the gap [pressure]
      integer :: loads_by = by_pressure             !! given quantity: by_pressure, by_mean_gap or by_contact_area
      real(dp), allocatable :: target(:)            !! in the deck's order: P, G or the contact area fraction
      real(dp), allocatable :: mean_pressure(:)     !! [pressure]; allocated where loads are given by pressure
      integer :: symmetry = symmetry_full           !! of the Fourier terms
   end type scene_type

contains

   !> Makes the scene of a deck. Errors: exit_bad_input for loads that the surface cannot have and for a method that it
   !> does not allow.
   subroutine make_scene(deck, scene, error)
      type(deck_type), intent(inout) :: deck   !! its surface and map move into the scene: they may be large
      type(scene_type), intent(out) :: scene
      type(error_type), allocatable, intent(out) :: error

      call move_alloc(deck%surface, scene%surface)
      call move_alloc(deck%map, scene%map)
      scene%e_star = plane_strain_modulus(deck%material)
      scene%p_star = scene%surface%full_contact_pressure(scene%e_star)
      select case (deck%method%text('symmetry'))
      case ('none')
         scene%symmetry = symmetry_none
      case ('diagonal')
         scene%symmetry = symmetry_diagonal
      end select
      call check_method(deck, scene, error)
      if (allocated(error)) return
      call take_loads(deck, scene, error)
   end subroutine make_scene

   !> Takes the loads and converts them to p*, Delta and area fractions. Errors: exit_bad_input for loads that the
   !> surface cannot have.
   subroutine take_loads(deck, scene, error)
      type(deck_type), intent(in) :: deck
      type(scene_type), intent(inout) :: scene
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: key
      real(dp), allocatable :: loads(:)
      real(dp) :: worst

      call given_loads(deck%load, key, scene%loads_by, loads)
      if (scene%loads_by /= by_pressure .and. scene%p_star <= 0.0_dp) then
         call fatal_error(error, exit_bad_input, escaped(deck%path)// &
                          ': the surface is flat: it has neither a gap nor a part in contact to ask for')
         return
      end if
      worst = maxval(loads)
      select case (key)
      case ('pbar_over_pstar')
         scene%mean_pressure = scene%p_star*loads
         if (scene%p_star <= 0.0_dp) loads = in_p_star(scene%mean_pressure, scene%p_star)
      case ('mean_pressure')
         ! Before the division, which may overflow.
         if (scene%p_star > 0.0_dp .and. worst > largest_pbar_over_pstar*scene%p_star) then
            call fatal_error(error, exit_bad_input, escaped(deck%path)//': mean_pressure = '// &
                             short_number(worst)// &
                             ' is more than '//short_number(largest_pbar_over_pstar)//' times p* = '// &
                             short_number(scene%p_star)// &
                             '. Do its unit and that of e_star agree, and those of the lengths?')
            return
         end if
         scene%mean_pressure = loads
         loads = in_p_star(loads, scene%p_star)
      case ('mean_gap')
         if (worst > scene%surface%amplitude) then
            call fatal_error(error, exit_bad_input, escaped(deck%path)//': mean_gap = '//short_number(worst)// &
                             ' is more than the mean gap before load, '//short_number(scene%surface%amplitude)// &
                             '. Do the units of the lengths agree?')
            return
         end if
         loads = loads/scene%surface%amplitude
      end select
      call move_alloc(loads, scene%target)
   end subroutine take_loads

   !> The given quantity as a heading.
   pure function target_words(loads_by) result(words)
      integer, intent(in) :: loads_by   !! by_pressure, by_mean_gap or by_contact_area
      character(:), allocatable :: words

      select case (loads_by)
      case (by_mean_gap)
         words = 'gap/Delta'
      case (by_contact_area)
         words = 'area/A0'
      case default
         words = 'pbar/p*'
      end select
   end function target_words

   !> Refuses a series whose constraint matrix would fill the memory, and a surface that has no fitted expansions.
   !> Errors: exit_bad_input.
   subroutine check_method(deck, scene, error)
      type(deck_type), intent(in) :: deck
      type(scene_type), intent(in) :: scene
      type(error_type), allocatable, intent(out) :: error

      !> Elements of the matrix: 160 MB, of which the solver holds several copies.
      real(dp), parameter :: most_elements = 2.0e7_dp
      type(fourier_terms) :: terms
      type(fitted_frame) :: frame
      integer, allocatable :: k(:), l(:)

      if (deck%method%text('solver') == 'fitted' .and. scene%surface%amplitude > 0.0_dp) then
         call find_frame(scene%surface, frame)
         if (.not. frame%covered) call fatal_error(error, exit_bad_input, escaped(deck%path)// &
            ": solver = 'fitted' knows "// &
            'wave_2d with wavelengths up to 3:1, crossed_1d with waves not too unlike and hexagonal, not this '// &
            deck%surface_values%text('kind')//". Give 'auto' or 'grid'.")
      end if
      if (deck%method%text('solver') /= 'beale') return
      terms = choose_terms(scene%surface%dimension, deck%method%integer('harmonics'), scene%symmetry)
      call choose_points(scene%surface%dimension, deck%method%integer('constraint_points'), scene%symmetry, k, l)
      if (real(terms%count(), dp)*size(k) > most_elements) &
         call fatal_error(error, exit_bad_input, escaped(deck%path)//': harmonics = '// &
                          integer_text(deck%method%integer('harmonics'))//' and constraint_points = '// &
                          integer_text(deck%method%integer('constraint_points'))//' make '// &
                          integer_text(terms%count())//' unknowns and '//integer_text(size(k))// &
                          ' constraints: too many for the memory. '// &
                          'Give fewer constraint_points (harmonics + 1 serve well), or a symmetry.')
   end subroutine check_method

   !> A mean pressure over p*. On a flat surface p* = 0 and any pressure is full contact: zero pressure counts as p*.
   elemental real(dp) function in_p_star(mean_pressure, p_star)
      real(dp), intent(in) :: mean_pressure, p_star   !! both >= 0

      if (p_star > 0.0_dp) then
         in_p_star = mean_pressure/p_star
      else if (mean_pressure > 0.0_dp) then
         in_p_star = ieee_value(1.0_dp, ieee_positive_inf)
      else
         in_p_star = 1.0_dp
      end if
   end function in_p_star

end module wavycon_scene
