!> The data that the tables of one scene are written from, and the header lines that all tables have.
module wavycon_results
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use wavycon_adhesive_curve, only: adhesive_curve
   use wavycon_contact_measures, only: linear_area_fraction
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_status, only: is_good_status, not_accurate, status_code, status_name, unresolved
   use wavycon_contact_tuning, only: largest_stress_error
   use wavycon_head_lines, only: head_lines
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: largest_stress
   use wavycon_memory_table, only: column_list, column_type, memory_table
   use wavycon_output_file, only: output_file
   use wavycon_partial_slip, only: partial_slip
   use wavycon_plain_text, only: exact_number, integer_text
   use wavycon_quantities, only: approach, area_at_hardness, find_quantity, load_at_hardness, mean_gap, &
      number_of_kinds, of_area, of_energy, of_length, of_pressure, or_nan, quantities
   use wavycon_scene, only: scene_type
   use wavycon_work_sharing, only: work_sharing
   implicit none (type, external)
   private

   public :: results_type, not_a_number

   !> Bytes of a unit's label, with '1/' before it or '^2' after it.
   integer, parameter :: longest_unit = 24

   type :: results_type
      type(scene_type), allocatable :: scene
      class(contact_solver), allocatable :: solver
      type(solver_traits) :: traits                          !! of the solver
      character(:), allocatable :: method                    !! the solver and its discretisation in words
      logical :: keeps_fields = .false.                      !! whether solutions have fields, edges and stresses
      type(contact_solution), allocatable :: loads(:)        !! in the deck's order; loads of other ranks: the measures
      !> The largest von Mises stress and the largest shear stress, shape (2, bodies, loads); not allocated unless the
      !> deck asks for them.
      type(largest_stress), allocatable :: largest_stresses(:, :, :)
      !> Partial slip, shape (tangential loads, loads), and adhesion; not allocated unless the deck asks for them.
      type(partial_slip), allocatable :: slip(:, :)
      type(adhesive_curve), allocatable :: adhesion
      type(contact_solution), allocatable :: adhesive_loads(:)   !! of each load the contact with adhesion
      logical :: with_adhesion = .false.                     !! whether these have changed places with `loads`
      type(work_sharing) :: sharing                          !! how the ranks share the work
      integer, allocatable :: order(:)                       !! the loads in the order in which they are solved
      type(memory_table), pointer :: memory => null()        !! tables are written to it in place of files
   contains
      procedure :: swap_contacts
      procedure :: open_table
      procedure :: begin_block
      procedure :: unit_in_words
      procedure :: in_p_star
      procedure :: number
      procedure :: mean_pressure
      procedure :: stress_status
      procedure :: is_solved
   end type results_type

contains

   !> Exchanges the contacts without adhesion and with it, so that procedures for tables of the one serve the other.
   subroutine swap_contacts(self)
      class(results_type), intent(inout) :: self   !! with adhesion

      type(contact_solution), allocatable :: others(:)

      call move_alloc(self%adhesive_loads, others)
      call move_alloc(self%loads, self%adhesive_loads)
      call move_alloc(others, self%loads)
      self%with_adhesion = .not. self%with_adhesion
   end subroutine swap_contacts

   !> Opens a table <case>.<kind>.dat, writes the header lines that all tables have and sets the columns. Errors show in
   !> file%finish. Or opens the table in memory, if there is one, and sets its columns.
   subroutine open_table(self, kind, columns, file)
      class(results_type), intent(in) :: self
      character(*), intent(in) :: kind         !! name of the table, such as 'summary'
      character(*), intent(in) :: columns      !! name[unit] of each; the units of `unit_in_words` are replaced
      type(output_file), intent(out) :: file

      type(column_type), allocatable :: list(:)

      if (associated(self%memory)) then
         file%memory => self%memory
      else
         call file%open(self%scene%directory, self%scene%case//'.'//kind//'.dat')
         call file%put(head_lines(self%scene, self%solver%surface, self%method, '# ', 'all'))
         if (self%with_adhesion) then
            call file%put('# adhesion: the contacts are those with it; of each load the stable one of the largest area')
         else if (allocated(self%adhesion) .and. kind /= 'adhesion') then
            call file%put('# adhesion: the contacts are those without it; with it they are in '//self%scene%case// &
                          '.adhesion.dat')
         end if
      end if
      list = column_list(columns)
      list%unit = self%unit_in_words(list%unit)
      call file%put_columns(list)
   end subroutine open_table

   !> The label of a unit: in it 'length', 'pressure', 'area', which in 1-D is a length, and 'force', as the deck names
   !> them; others as they are.
   elemental recursive function unit_in_words(self, unit) result(words)
      class(results_type), intent(in) :: self
      character(*), intent(in) :: unit
      character(longest_unit) :: words

      character(8), parameter :: names(*) = [character(8) :: 'length', 'pressure', 'area', 'force']
      character(:), allocatable :: label
      integer :: first, k

      words = unit
      do k = 1, size(names)
         first = index(unit, trim(names(k)))
         if (first == 0) cycle
         label = self%scene%length_unit
         if (names(k) == 'pressure') label = self%scene%pressure_unit
         if (k > 2 .and. self%solver%surface%dimension == 2) label = label//'^2'
         if (names(k) == 'force') label = self%scene%pressure_unit//'*'//label
         words = trim(self%unit_in_words(unit(:first - 1)))//label// &
                 self%unit_in_words(unit(first + len_trim(names(k)):))
         return
      end do
   end function unit_in_words

   !> The status of the largest stresses of a load in a body: that of the load or, where an error is more than half of
   !> its stress, `unresolved` on a given grid and `not_accurate` otherwise.
   pure integer function stress_status(self, load, body) result(status)
      class(results_type), intent(in) :: self      !! with largest stresses
      integer, intent(in) :: load, body            !! numbers in the deck's order

      status = self%loads(load)%status
      if (.not. is_good_status(status)) return
      if (.not. any(is_doubtful(self%largest_stresses(:, body, load)))) return
      status = not_accurate
      if (all(self%traits%given_grid > 0)) status = unresolved
   end function stress_status

   !> Whether a largest stress is hardly known.
   elemental logical function is_doubtful(largest)
      type(largest_stress), intent(in) :: largest

      is_doubtful = .false.
      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      if (.not. ieee_is_nan(largest%error)) is_doubtful = largest%error > largest_stress_error*largest%value
   end function is_doubtful

   !> Whether a load, its largest stresses and its partial slip were solved as requested, as far as the deck asks for
   !> them.
   pure logical function is_solved(self, load)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load    !! number in the deck's order

      integer :: body

      is_solved = is_good_status(self%loads(load)%status)
      if (allocated(self%largest_stresses)) is_solved = is_solved .and. &
         all([(is_good_status(self%stress_status(load, body)), body=1, size(self%largest_stresses, 2))])
      if (allocated(self%slip)) is_solved = is_solved .and. &
         all(self%slip(:, load)%slides .or. is_good_status(self%slip(:, load)%status))
   end function is_solved

   !> Begins the block of a load with a comment and the names of the columns.
   subroutine begin_block(self, file, load)
      class(results_type), intent(in) :: self
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load    !! number in the deck's order

      character(:), allocatable :: words

      associate (solution => self%loads(load))
         words = 'pbar/p* = '//exact_number(solution%pbar_over_pstar)
         if (self%solver%surface%has_free_edges) words = 'mean pressure = '//exact_number(self%mean_pressure(load))
         call file%begin_block('load '//integer_text(load)//': '//words//', '//trim(status_name(solution%status)))
      end associate
   end subroutine begin_block

   !> A number in units of p*: NaN on a surface with free edges, which has no p*.
   elemental real(dp) function in_p_star(self, number)
      class(results_type), intent(in) :: self
      real(dp), intent(in) :: number

      in_p_star = number
      if (self%solver%surface%has_free_edges) in_p_star = not_a_number()
   end function in_p_star

   !> The number of a load in a column of tables: NaN if it is unknown or does not exist. With free edges there are no
   !> numbers in p*, and a profile has no approach. Without a hardness nothing is at it; the linear law is of maps.
   pure real(dp) function number(self, load, column, quantities_of_load)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load
      character(*), intent(in) :: column   !! its name
      !> With details; absent: those that the solver has computed.
      type(quantities), intent(in), optional :: quantities_of_load

      logical :: exists, in_unit, is_error
      integer :: kind, quantity
      real(dp) :: unit(number_of_kinds)   !! of the core's numbers, in those of the deck
      type(quantities) :: q

      associate (surface => self%solver%surface, solution => self%loads(load), scene => self%scene)
         q = solution%quantities
         if (present(quantities_of_load)) q = quantities_of_load
         select case (column)
         case ('load')
            number = load
         case ('pbar_over_pstar')
            number = self%in_p_star(solution%pbar_over_pstar)
         case ('linear_area_fraction')
            number = or_nan(linear_area_fraction(surface, scene%roughness%slope, solution%pbar_over_pstar))
         case ('mean_pressure')
            number = self%mean_pressure(load)
         case ('force')
            number = surface%nominal_area()*self%mean_pressure(load)
         case ('active_constraints')
            number = real(solution%active_constraints, dp)
         case ('iterations')
            number = solution%iterations
         case ('residual')
            number = solution%residual
         case ('status_code')
            number = status_code(solution%status)
         case default
            call find_quantity(column, quantity, kind, is_error, in_unit)
            number = q%value(quantity)
            ! Pressures over the p* of a flat surface are infinite.
            if (.not. number > huge(number)) number = or_nan(number)
            if (is_error) number = or_nan(q%error(merge(mean_gap, quantity, quantity == approach)))
            exists = self%traits%has_errors .or. .not. is_error
            if (quantity == approach) exists = exists .and. .not. (surface%has_free_edges .and. surface%dimension == 1)
            if (any(quantity == [area_at_hardness, load_at_hardness])) exists = exists .and. surface%has_hardness()
            if (.not. exists) number = not_a_number()
            if (in_unit) then
               unit = 1.0_dp
               unit(of_length) = surface%amplitude
               unit(of_pressure) = scene%p_star
               unit(of_area) = surface%nominal_area()
               unit(of_energy) = scene%p_star*surface%amplitude*surface%nominal_area()
               number = unit(kind)*number
               ! On a flat surface, whose p* is zero, it is the mean pressure.
               if (column == 'peak_pressure' .and. .not. scene%p_star > 0.0_dp) number = self%mean_pressure(load)
            else if (any(kind == [of_pressure, of_energy])) then
               number = self%in_p_star(number)
            end if
         end select
      end associate
   end function number

   !> The mean pressure of a load [pressure]. If the deck gives it, exactly that number.
   pure real(dp) function mean_pressure(self, load)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load

      mean_pressure = self%scene%p_star*self%loads(load)%pbar_over_pstar
      if (allocated(self%scene%mean_pressure)) mean_pressure = self%scene%mean_pressure(load)
   end function mean_pressure

   !> The entry of a table for a number that does not exist.
   pure real(dp) function not_a_number()
      not_a_number = ieee_value(1.0_dp, ieee_quiet_nan)
   end function not_a_number

end module wavycon_results
