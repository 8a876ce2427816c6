!> What tests of many subjects build again and again: files, maps and decks that are read, surfaces, values and slopes
!> of solutions, integrals, numbers.
!>
!> What must be possible before a test has a question ends the program, and so the test, if it fails.
module unit_support
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon, only: contact_solution, contact_solver, dp, error_type, surface_type, wave_1d, wave_2d
   use wavycon_scene, only: scene_type
   use wavycon_deck_text, only: deck_text_type
   use wavycon_map_file, only: read_height_map
   use wavycon_measured_map, only: measured_map
   use wavycon_plain_text, only: integer_text
   use wavycon_quantities, only: main_quantities, quantities
   use wavycon_read_deck, only: parse_deck
   use wavycon_roughness, only: roughness_type
   use wavycon_system, only: remove_file
   implicit none (type, external)
   private

   interface
      !> The number of this process, for file names that no other process uses.
      integer(c_int) function process_id() bind(c, name='getpid')
         import :: c_int
      end function process_id
   end interface

   abstract interface
      !> The parameters are an argument so that no internal procedure is passed, which would need an executable stack.
      pure real(dp) function integrand(x, parameters)
         import :: dp
         real(dp), intent(in) :: x
         real(dp), intent(in) :: parameters(:)
      end function integrand
   end interface

   public :: deck_trouble, errors_of, good_deck, integral_of, lines, map_trouble, process_id, read_map, rms_slope_of, &
      slopes_at, spread_number, unit_wave, value_at, values_of, write_file

contains

   !> The wave of the paper, of amplitude and wavelength 1.
   type(surface_type) function unit_wave(dimension, hardness) result(surface)
      integer, intent(in) :: dimension                  !! 1 or 2
      real(dp), intent(in), optional :: hardness        !! over p*; absent: no limit

      if (dimension == 1) surface = wave_1d(1.0_dp, 1.0_dp)
      if (dimension == 2) surface = wave_2d(1.0_dp, 1.0_dp, 1.0_dp)
      if (present(hardness)) surface%hardness = hardness
   end function unit_wave

   !> Mean gap [Delta], contact area over the nominal one and peak pressure [p*].
   pure function values_of(measures) result(values)
      type(quantities), intent(in) :: measures
      real(dp) :: values(3)

      values = measures%value(main_quantities)
   end function values_of

   !> Their error estimates.
   pure function errors_of(measures) result(errors)
      type(quantities), intent(in) :: measures
      real(dp) :: errors(3)

      errors = measures%error(main_quantities)
   end function errors_of

   !> A quantity of the solution of a load.
   real(dp) function value_at(solver, p, quantity) result(value)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: p
      integer, intent(in) :: quantity

      type(contact_solution) :: solution

      call solver%solve(p, solution)
      value = solution%value(quantity)
   end function value_at

   !> How the quantities change with the load.
   type(quantities) function slopes_at(solver, p) result(slopes)
      class(contact_solver), intent(inout) :: solver
      real(dp), intent(in) :: p

      type(contact_solution) :: solution

      call solver%solve(p, solution)
      call solution%derivatives(solver%surface, slopes)
   end function slopes_at

   !> Numbers spread evenly over 0 .. 1.
   elemental real(dp) function spread_number(i, j)
      integer, intent(in) :: i, j

      spread_number = modulo(0.754877666_dp*i + 0.569840291_dp*j, 1.0_dp)
   end function spread_number

   !> The integral of f over a..b to 1e-11, by the double exponential rule of Takahasi & Mori (1974): steps in t with
   !> x = (a + b)/2 + (b - a)/2 tanh(pi/2 sinh t), so that roots and their like at the ends do no harm.
   real(dp) function integral_of(f, parameters, a, b) result(integral)
      procedure(integrand) :: f
      real(dp), intent(in) :: parameters(:), a, b

      integer, parameter :: most = 200
      real(dp), parameter :: half_pi = acos(0.0_dp), step = 3.2_dp/most
      integer :: k
      real(dp) :: t, u

      integral = 0.0_dp
      do k = -most, most
         t = k*step
         u = half_pi*sinh(t)
         integral = integral + step*(b - a)/2*half_pi*cosh(t)/cosh(u)**2*f((a + b)/2 + (b - a)/2*tanh(u), parameters)
      end do
   end function integral_of

   !> A text whose lines have bars between them.
   pure function lines(text)
      character(*), intent(in) :: text
      character(:), allocatable :: lines

      integer :: i

      lines = trim(text)
      do i = 1, len(lines)
         if (lines(i:i) == '|') lines(i:i) = new_line('a')
      end do
   end function lines

   !> A file of these bytes.
   subroutine write_file(path, content)
      character(*), intent(in) :: path, content

      integer :: unit

      open (newunit=unit, file=path, status='replace', access='stream', form='unformatted', action='write')
      write (unit) content
      close (unit)
   end subroutine write_file

   !> A file for contents that a test makes up.
   function made_up_file() result(path)
      character(:), allocatable :: path

      path = 'made_up_'//integer_text(process_id())//'.tmp'
   end function made_up_file

   !> The height map of a file with this content, which must be one.
   subroutine read_map(content, format, map, missing_value)
      character(*), intent(in) :: content, format
      type(measured_map), intent(out) :: map
      real(dp), intent(in), optional :: missing_value

      type(error_type), allocatable :: error

      call write_file(made_up_file(), content)
      call read_height_map(made_up_file(), format, map, error, missing_value)
      call remove_file(made_up_file())
      if (allocated(error)) error stop error%message
   end subroutine read_map

   real(dp) function rms_slope_of(surface)
      type(surface_type), intent(in) :: surface

      type(roughness_type) :: roughness

      roughness = surface%roughness()
      rms_slope_of = roughness%slope
   end function rms_slope_of

   !> What is said of a file with this content, behind the name of the file; '' if it is a height map.
   function map_trouble(content, format) result(words)
      character(*), intent(in) :: content, format
      character(:), allocatable :: words

      type(measured_map) :: map
      type(error_type), allocatable :: error

      call write_file(made_up_file(), content)
      call read_height_map(made_up_file(), format, map, error)
      call remove_file(made_up_file())
      words = ''
      if (.not. allocated(error)) return
      words = error%message
      words = words(len(made_up_file()) + 1:)
   end function map_trouble

   !> The deck of a text, which must be one.
   subroutine good_deck(content, deck)
      character(*), intent(in) :: content
      type(scene_type), intent(out) :: deck

      type(error_type), allocatable :: error

      call parse_deck(deck_text_type('a.nml', content), deck, error)
      if (allocated(error)) error stop error%message
   end subroutine good_deck

   !> What is said of a deck of this text; '' if it is one.
   function deck_trouble(content) result(words)
      character(*), intent(in) :: content
      character(:), allocatable :: words

      type(scene_type) :: deck
      type(error_type), allocatable :: error

      call parse_deck(deck_text_type('a.nml', content), deck, error)
      words = ''
      if (allocated(error)) words = error%message
   end function deck_trouble

end module unit_support
