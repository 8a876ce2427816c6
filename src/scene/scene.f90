!> What a deck describes, in the program's own normalisation: pressures in p*, displacements and gaps in Delta.
module wavycon_scene
   use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
   use wavycon_constraint_points, only: choose_points
   use wavycon_deck, only: deck_type
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_fourier_terms, only: choose_terms, fourier_terms, symmetry_diagonal, symmetry_full, symmetry_none
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: largest_pbar_over_pstar
   use wavycon_plain_text, only: escaped, integer_text, short_number
   use wavycon_surface, only: crossed_1d, surface_type, wave_1d, wave_2d
   implicit none (type, external)
   private

   public :: scene_type, make_scene

   type :: scene_type
      type(surface_type) :: surface
      real(dp) :: e_star = 1.0_dp                   !! plane-strain modulus [pressure]
      real(dp) :: p_star = 0.0_dp                   !! p*, mean pressure that just closes the gap [pressure]
      real(dp), allocatable :: pbar_over_pstar(:)   !! loads in the deck's order
      real(dp), allocatable :: mean_pressure(:)     !! the same [pressure]
      integer :: symmetry = symmetry_full           !! of the Fourier terms
   end type scene_type

contains

   !> Makes the scene of a deck. Errors: exit_bad_input for a mean pressure absurdly above p*.
   subroutine make_scene(deck, scene, error)
      type(deck_type), intent(in) :: deck
      type(scene_type), intent(out) :: scene
      type(error_type), allocatable, intent(out) :: error

      real(dp) :: worst

      associate (surface => deck%surface)
         select case (surface%kind)
         case ('wave_1d')
            scene%surface = wave_1d(surface%amplitude, surface%wavelength)
         case ('wave_2d')
            scene%surface = wave_2d(surface%amplitude, surface%wavelength)
         case ('crossed_1d')
            scene%surface = crossed_1d(surface%amplitude1, surface%wavelength1)
         end select
      end associate
      scene%e_star = deck%material%e_star
      scene%p_star = scene%surface%full_contact_pressure(scene%e_star)
      select case (deck%method%symmetry)
      case ('none')
         scene%symmetry = symmetry_none
      case ('diagonal')
         scene%symmetry = symmetry_diagonal
      end select

      call check_size(deck, scene, error)
      if (allocated(error)) return

      if (allocated(deck%load%mean_pressure)) then
         allocate (scene%mean_pressure, source=deck%load%mean_pressure)
         worst = maxval(scene%mean_pressure)
         ! Before the division, which may overflow.
         if (scene%p_star > 0.0_dp .and. worst > largest_pbar_over_pstar*scene%p_star) then
            call fatal_error(error, exit_bad_input, escaped(deck%path)//': mean_pressure = '//short_number(worst)// &
                             ' is more than '//short_number(largest_pbar_over_pstar)//' times p* = '// &
                             short_number(scene%p_star)// &
                             '. Do its unit and that of e_star agree, and those of the lengths?')
            return
         end if
         allocate (scene%pbar_over_pstar, source=in_p_star(scene%mean_pressure, scene%p_star))
      else
         allocate (scene%mean_pressure, source=scene%p_star*deck%load%pbar_over_pstar)
         allocate (scene%pbar_over_pstar, source=deck%load%pbar_over_pstar)
         if (scene%p_star <= 0.0_dp) scene%pbar_over_pstar = in_p_star(scene%mean_pressure, scene%p_star)
      end if
   end subroutine make_scene

   !> Refuses a series whose constraint matrix would fill the memory. Errors: exit_bad_input.
   subroutine check_size(deck, scene, error)
      type(deck_type), intent(in) :: deck
      type(scene_type), intent(in) :: scene
      type(error_type), allocatable, intent(out) :: error

      !> Elements of the matrix, of which a handful of copies are held: 160 MB each.
      real(dp), parameter :: most_elements = 2.0e7_dp
      type(fourier_terms) :: terms
      integer, allocatable :: k(:), l(:)

      if (deck%method%solver /= 'beale') return
      terms = choose_terms(scene%surface%dimension, deck%method%harmonics, scene%symmetry)
      call choose_points(scene%surface%dimension, deck%method%constraint_points, scene%symmetry, k, l)
      if (real(terms%count(), dp)*size(k) > most_elements) &
         call fatal_error(error, exit_bad_input, escaped(deck%path)//': harmonics = '// &
                          integer_text(deck%method%harmonics)//' and constraint_points = '// &
                          integer_text(deck%method%constraint_points)//' make '//integer_text(terms%count())// &
                          ' unknowns and '//integer_text(size(k))//' constraints: too many for the memory. '// &
                          'Give fewer constraint_points (harmonics + 1 serve well), or a symmetry.')
   end subroutine check_size

   !> A mean pressure over p*. On a flat surface p* = 0 and any pressure is full contact: none at all is p* itself.
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
