!> Solvers of the public interface: a surface, a modulus and a method, or all of a deck.
module wavycon_wavy_solver
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use wavycon_contact_solution, only: contact_solution
   use wavycon_auto_method, only: reason_of_choice => why_chosen
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_deck, only: deck_type
   use wavycon_deck_text, only: deck_text_type
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_group_text, only: read_group_text
   use wavycon_group_values, only: group_values
   use wavycon_kinds, only: dp
   use wavycon_method_list, only: start_solver
   use wavycon_load_group, only: check_load_group, check_loads_of_surface, load_table
   use wavycon_make_scene, only: make_scene, take_loads
   use wavycon_material_group, only: check_material_group, material_table
   use wavycon_method_group, only: check_method_group, method_table
   use wavycon_plain_text, only: integer_text
   use wavycon_problem_report, only: problem_report
   use wavycon_problems, only: problem_list_type
   use wavycon_read_deck, only: read_deck
   use wavycon_scene, only: by_pressure, by_yield, scene_type
   use wavycon_solution_stress, only: stress_setting_of_keys
   use wavycon_solve_target, only: solve_target
   use wavycon_stress_setting, only: stress_setting
   use wavycon_wavy_solution, only: start_solution, wavy_solution
   use wavycon_wavy_surface, only: copy_surface, number_words, wavy_surface
   implicit none (type, external)
   private

   public :: wavy_solver, wavy_scales, make_solver, make_solver_of_deck, make_solver_of_material

   !> What the normalised numbers refer to.
   type, bind(c) :: wavy_scales
      real(c_double) :: e_star = 0.0_dp        !! plane-strain modulus [pressure]
      real(c_double) :: p_star = 0.0_dp        !! p*, mean pressure that just closes the gap [pressure]; 0 if flat
      real(c_double) :: amplitude = 0.0_dp     !! Delta, mean gap before load [length]
      real(c_double) :: length_x = 0.0_dp      !! sides of the periodic cell [length]
      real(c_double) :: length_y = 0.0_dp
      integer(c_int) :: dimension = 0          !! 1 for a profile, otherwise 2
   end type wavy_scales

   !> In C a thread that solves a load lets others into the library meanwhile, but not into this solver: c_lock.c.
   interface
      subroutine begin_solve(is_solving) bind(c, name='wavycon_begin_solve')
         import :: c_int
         integer(c_int), intent(inout) :: is_solving
      end subroutine begin_solve

      subroutine end_solve(is_solving) bind(c, name='wavycon_end_solve')
         import :: c_int
         integer(c_int), intent(inout) :: is_solving
      end subroutine end_solve
   end interface

   !> A solver of one surface. It may start a load from the one solved before, which is fastest from high to low loads.
   type :: wavy_solver
      private
      class(contact_solver), allocatable :: solver
      type(solver_traits) :: traits                   !! of the solver
      character(:), allocatable :: description
      !> Of the deck or, without one, modulus, p* and &method; stress_setting is that of the deck or of set_stress.
      type(scene_type) :: scene
      logical :: keep_fields = .true.                 !! in the solutions that the caller gets
      logical :: has_fields = .true.                  !! whether the solver has them, which loads by the key yield need
      character(:), allocatable :: trouble            !! why it could not be made
      integer(c_int) :: is_solving = 0                !! 1: a thread of a C program solves a load
   contains
      procedure :: is_made
      procedure :: name => get_name
      procedure :: describe
      procedure :: why_chosen
      procedure :: scales
      procedure :: number_of_loads
      procedure :: set_stress
      procedure :: solve
      procedure :: solve_load
      procedure, private :: solve_one
   end type wavy_solver

contains

   !> Makes a solver of elastic bodies. Errors: exit_bad_input, with all problems of `method`.
   subroutine make_solver(surface, e_star, method, keep_fields, solver, error)
      type(wavy_surface), intent(in) :: surface
      real(dp), intent(in) :: e_star        !! plane-strain modulus, > 0 [pressure]; 1/e_star = (1 - nu1^2)/e1 + ...
      character(*), intent(in) :: method    !! keys of &method, such as "solver = 'auto', accuracy = 1e-4"; may be empty
      logical, intent(in) :: keep_fields    !! whether maps, fields, edges, details or stresses will be needed
      type(wavy_solver), intent(out) :: solver
      type(error_type), allocatable, intent(out) :: error

      call make_solver_of_material(surface, 'e_star = '//number_words(e_star), method, keep_fields, solver, error)
   end subroutine make_solver

   !> Makes a solver from the keys of groups. Errors: exit_bad_input, with all problems of `material` and `method`.
   subroutine make_solver_of_material(surface, material, method, keep_fields, solver, error)
      type(wavy_surface), intent(in) :: surface
      character(*), intent(in) :: material  !! keys of &material, such as 'e_star = 2.31e11, hardness = 2e9'
      character(*), intent(in) :: method    !! keys of &method; may be empty
      logical, intent(in) :: keep_fields    !! whether maps, fields, edges or details of solutions will be needed
      type(wavy_solver), intent(out) :: solver
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: kind
      type(deck_text_type) :: text
      type(group_values) :: values
      type(problem_list_type) :: problems

      call copy_surface(surface, solver%scene%surface, kind, error)
      if (allocated(error)) then
         solver%trouble = error%message
         return
      end if
      call read_group_text(material_table(), material, values, text, problems)
      associate (scene => solver%scene)
         if (problems%number == 0) &
            call check_material_group(values, scene%surface, scene%e_star, scene%p_star, problems)
         if (problems%number == 0) then
            call read_group_text(method_table(), method, scene%method, text, problems)
            call check_method_group(scene%method, kind, scene%surface, problems)
         end if
      end associate
      if (problems%number > 0) then
         call fatal_error(error, exit_bad_input, problem_report(problems, text))
         solver%trouble = error%message
         return
      end if
      call start(solver, keep_fields)
   end subroutine make_solver_of_material

   !> Makes the solver that a deck describes, with its loads, see number_of_loads and solve_load; &output has no effect.
   !> Errors: those of the program for a bad deck or height map.
   subroutine make_solver_of_deck(path, keep_fields, solver, error)
      character(*), intent(in) :: path
      logical, intent(in) :: keep_fields    !! as of make_solver
      type(wavy_solver), intent(out) :: solver
      type(error_type), allocatable, intent(out) :: error

      type(deck_type) :: deck

      call read_deck(path, deck, error)
      if (allocated(error)) then
         solver%trouble = error%message
         return
      end if
      call make_scene(deck, solver%scene)
      call start(solver, keep_fields)
   end subroutine make_solver_of_deck

   !> Starts the solver of its scene.
   subroutine start(self, keep_fields)
      type(wavy_solver), intent(inout) :: self
      logical, intent(in) :: keep_fields

      self%keep_fields = keep_fields
      self%has_fields = keep_fields .or. self%scene%loads_by == by_yield
      call start_solver(self%scene%surface, self%scene%method, self%has_fields, self%solver, self%description)
      deallocate (self%scene%surface)
      self%traits = self%solver%traits()
   end subroutine start

   !> Whether the solver has been made.
   pure logical function is_made(self)
      class(wavy_solver), intent(in) :: self

      is_made = allocated(self%solver)
   end function is_made

   !> The name of the solver, as the key `solver` has it; empty before it is made.
   function get_name(self) result(name)
      class(wavy_solver), intent(in) :: self
      character(:), allocatable :: name

      name = ''
      if (self%is_made()) name = self%scene%method%text('solver')
   end function get_name

   !> The discretisation in words.
   function describe(self) result(words)
      class(wavy_solver), intent(in) :: self
      character(:), allocatable :: words

      words = ''
      if (self%is_made()) words = self%description
   end function describe

   !> Why 'auto' solves this surface as it does; empty for the other solvers.
   function why_chosen(self) result(words)
      class(wavy_solver), intent(in) :: self
      character(:), allocatable :: words

      words = reason_of_choice(self%traits)
   end function why_chosen

   !> Modulus, p*, Delta and the cell. Zeros before the solver is made.
   pure type(wavy_scales) function scales(self)
      class(wavy_solver), intent(in) :: self

      real(dp) :: side(2)

      if (.not. self%is_made()) return
      associate (surface => self%solver%surface)
         side = surface%sides()
         scales = wavy_scales(self%scene%e_star, self%scene%p_star, surface%amplitude, side(1), side(2), &
                              int(surface%dimension, c_int))
      end associate
   end function scales

   !> The number of loads that the deck gives; 0 without a deck.
   pure integer function number_of_loads(self)
      class(wavy_solver), intent(in) :: self

      number_of_loads = 0
      if (allocated(self%scene%target)) number_of_loads = size(self%scene%target)
   end function number_of_loads

   !> Sets what loads by the key yield need. Errors: exit_bad_input if the solver has not been made, and with all
   !> problems of `keys`.
   subroutine set_stress(self, keys, error)
      class(wavy_solver), intent(inout) :: self
      !> Keys of &stress, such as "nu = 0.3, yield_stress = 1e9"; those of tables have no effect.
      character(*), intent(in) :: keys
      type(error_type), allocatable, intent(out) :: error

      type(stress_setting), allocatable :: setting

      call check_made(self, error)
      if (.not. allocated(error)) call stress_setting_of_keys(keys, self%scene%p_star, setting, error)
      if (.not. allocated(error)) call move_alloc(setting, self%scene%stress_setting)
   end subroutine set_stress

   !> Solves one load. A load that cannot be solved as requested is no error, but the status of the solution. Errors:
   !> exit_bad_input for a quantity that is none or a value that it cannot have.
   subroutine solve(self, quantity, value, solution, error)
      class(wavy_solver), intent(inout) :: self
      character(*), intent(in) :: quantity   !! a key of &load, such as pbar_over_pstar, mean_pressure, mean_gap, yield
      real(dp), intent(in) :: value          !! in the unit of that key
      type(wavy_solution), intent(out) :: solution
      type(error_type), allocatable, intent(out) :: error

      integer :: loads_by
      real(dp), allocatable :: mean_pressure(:), target(:)
      type(deck_text_type) :: text
      type(group_values) :: values
      type(problem_list_type) :: problems

      call check_made(self, error)
      if (allocated(error)) return
      call read_group_text(load_table(), quantity//' = '//number_words(value), values, text, problems)
      call check_load_group(values, problems)
      if (problems%number == 0) &
         call check_loads_of_surface(values, self%solver%surface%amplitude, self%scene%p_star, problems)
      if (problems%number > 0) then
         call fatal_error(error, exit_bad_input, problem_report(problems, text))
         return
      end if
      call take_loads(values, self%solver%surface%amplitude, self%scene%p_star, loads_by, target, mean_pressure)
      if (size(target) /= 1) then
         call fatal_error(error, exit_bad_input, text%path//': this is not one load but '//integer_text(size(target)))
         return
      end if
      if (loads_by == by_pressure) then
         call self%solve_one(loads_by, target(1), mean_pressure(1), solution, error)
      else
         call self%solve_one(loads_by, target(1), solution=solution, error=error)
      end if
   end subroutine solve

   !> Solves a load of the deck. Errors: exit_bad_input for a load that the deck does not have.
   subroutine solve_load(self, load, solution, error)
      class(wavy_solver), intent(inout) :: self
      integer, intent(in) :: load            !! 1 .. number_of_loads()
      type(wavy_solution), intent(out) :: solution
      type(error_type), allocatable, intent(out) :: error

      call check_made(self, error)
      if (allocated(error)) return
      if (load < 1 .or. load > self%number_of_loads()) then
         call fatal_error(error, exit_bad_input, 'there is no load '//integer_text(load)//': the deck gives '// &
                          integer_text(self%number_of_loads()))
         return
      end if
      associate (scene => self%scene)
         if (allocated(scene%mean_pressure)) then
            call self%solve_one(scene%loads_by, scene%target(load), scene%mean_pressure(load), solution, error)
         else
            call self%solve_one(scene%loads_by, scene%target(load), solution=solution, error=error)
         end if
      end associate
   end subroutine solve_load

   !> Errors: as of start_solution and check_yield.
   subroutine solve_one(self, loads_by, target, mean_pressure, solution, error)
      class(wavy_solver), intent(inout) :: self
      integer, intent(in) :: loads_by                     !! a name of wavycon_scene
      real(dp), intent(in) :: target                      !! as of scene_type
      real(dp), intent(in), optional :: mean_pressure     !! [pressure], if it is given
      type(wavy_solution), intent(out) :: solution
      type(error_type), allocatable, intent(out) :: error

      type(contact_solution), allocatable :: found
      real(dp) :: pressure

      if (loads_by == by_yield) call check_yield(self, error)
      if (allocated(error)) return
      allocate (found)
      call begin_solve(self%is_solving)
      call solve_target(self%solver, loads_by, target, found, self%scene%stress_setting)
      call end_solve(self%is_solving)
      if (present(mean_pressure)) then
         pressure = mean_pressure
      else
         pressure = self%scene%p_star*found%pbar_over_pstar
      end if
      call start_solution(found, self%solver%surface, self%scene%p_star, pressure, self%keep_fields, &
                          self%traits%has_errors, solution, error)
   end subroutine solve_one

   !> Errors: exit_bad_input if the solver cannot find loads by the key yield.
   subroutine check_yield(self, error)
      class(wavy_solver), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error

      logical :: has_yield_stress

      has_yield_stress = allocated(self%scene%stress_setting)
      if (has_yield_stress) has_yield_stress = allocated(self%scene%stress_setting%yield_stress)
      if (.not. has_yield_stress) then
         call fatal_error(error, exit_bad_input, 'yield needs yield_stress, which set_stress sets')
      else if (.not. self%has_fields) then
         call fatal_error(error, exit_bad_input, 'yield needs a solver that keeps the fields')
      end if
   end subroutine check_yield

   !> Errors: exit_bad_input if the solver has not been made, with the reason.
   subroutine check_made(self, error)
      class(wavy_solver), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error

      if (self%is_made()) return
      if (allocated(self%trouble)) then
         call fatal_error(error, exit_bad_input, self%trouble)
      else
         call fatal_error(error, exit_bad_input, 'the solver has not been made')
      end if
   end subroutine check_made

end module wavycon_wavy_solver
