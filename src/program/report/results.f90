!> The data from which the tables of one scene are written, and the header lines that all tables have.
module wavycon_results
   use wavycon_adhesive_curve, only: adhesive_curve
   use wavycon_contact_measures, only: linear_area_fraction
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver, solver_traits
   use wavycon_contact_spots, only: contact_spots
   use wavycon_contact_tuning, only: largest_stress_error
   use wavycon_head_lines, only: head_lines
   use wavycon_kinds, only: dp, ieee_is_finite, ieee_is_nan, not_a_number
   use wavycon_largest_stress, only: largest_stress
   use wavycon_memory_table, only: column_list, column_type, longest_column, memory_table
   use wavycon_output_file, only: output_file
   use wavycon_partial_slip, only: partial_slip
   use wavycon_plain_text, only: exact_number, integer_text
   use wavycon_quantities, only: approach, area_at_hardness, elastic_energy, find_quantity, is_known, &
      load_at_hardness, number_of_kinds, of_area, of_energy, of_length, of_pressure, or_nan, peak_pressure, quantities
   use wavycon_scene, only: scene_type
   use wavycon_solution_record, only: is_good_status, not_accurate, status_code, status_name, unresolved
   use wavycon_units, only: makes_newton
   use wavycon_work_sharing, only: work_sharing
   implicit none (type, external)
   private

   public :: results_type

   !> The tables of a run whose status says whether a load was solved as requested.
   character(*), parameter, public :: status_tables(4) = [character(14) :: 'summary', 'stress_largest', &
      'partial_slip', 'adhesion']

   type :: results_type
      type(scene_type), allocatable :: scene
      class(contact_solver), allocatable :: solver
      type(solver_traits) :: traits                          !! what the solver can do, and its grids
      character(:), allocatable :: method                    !! the solver and its discretisation in words
      logical :: keeps_fields = .false.                      !! whether solutions have fields, edges and stresses
      !> The solution of each load, in the deck's order. Of a load that another rank solves: its numbers without fields.
      type(contact_solution), allocatable :: loads(:)
      !> Spots and pools of each load, which several tables need; not allocated before `find_spots`.
      type(contact_spots), allocatable :: spots(:)
      !> Derivatives of each load by P, which two tables need; not allocated before `find_slopes`.
      type(quantities), allocatable :: slopes(:)
      !> The largest von Mises stress (1) and the largest shear stress (2), shape (2, bodies, loads); not allocated
      !> unless the deck asks for them.
      type(largest_stress), allocatable :: largest_stresses(:, :, :)
      !> Partial slip, shape (tangential loads, loads), and adhesion; not allocated unless the deck asks for them.
      type(partial_slip), allocatable :: slip(:, :)
      type(adhesive_curve), allocatable :: adhesion
      type(contact_solution), allocatable :: adhesive_loads(:)   !! contact with adhesion at each load
      logical :: with_adhesion = .false.                     !! whether swap_contacts has put these into `loads`
      type(work_sharing) :: sharing                          !! how the ranks share the work
      integer, allocatable :: order(:)                       !! numbers of the loads in the order of their solution
      type(memory_table), pointer :: memory => null()        !! if associated, a table is written to it, not to a file
   contains
      procedure :: find_spots, find_slopes, swap_contacts, open_table, begin_block
      procedure :: unit_in_words, in_p_star, number, mean_pressure, stress_status, is_solved_in, has_infinite_stress
   end type results_type

contains

   !> Finds the spots and pools of all loads, unless they are known.
   subroutine find_spots(self)
      class(results_type), intent(inout) :: self   !! with a solution for each load; gets `spots`

      integer :: load

      if (allocated(self%spots)) return
      allocate (self%spots(size(self%loads)))
      do load = 1, size(self%loads)
         call self%loads(load)%spots(self%solver%surface, self%spots(load))
      end do
   end subroutine find_spots

   !> Finds the derivatives with respect to the load of all loads, unless they are known.
   subroutine find_slopes(self)
      class(results_type), intent(inout) :: self   !! with a solution for each load; gets `slopes`

      integer :: load

      if (allocated(self%slopes)) return
      allocate (self%slopes(size(self%loads)))
      do load = 1, size(self%loads)
         call self%loads(load)%derivatives(self%solver%surface, self%slopes(load))
      end do
   end subroutine find_slopes

   !> Exchanges the contacts without adhesion, `loads`, and those with adhesion, `adhesive_loads`. Procedures that write
   !> tables from `loads` then write those of the contact with adhesion. A second call restores the contacts.
   subroutine swap_contacts(self)
      class(results_type), intent(inout) :: self   !! with `adhesive_loads`

      type(contact_solution), allocatable :: held(:)

      call move_alloc(self%adhesive_loads, held)
      call move_alloc(self%loads, self%adhesive_loads)
      call move_alloc(held, self%loads)
      self%with_adhesion = .not. self%with_adhesion
   end subroutine swap_contacts

   !> Opens a table <case>.<table_file>.dat, writes the header lines that all tables have and sets the columns. If there
   !> is a table in memory, its columns are set instead, without a file. The key `csv` asks for <case>.<table_file>.csv
   !> beside it; without the key `file%finish` removes such a file of an earlier run. `file%finish` reports errors.
   subroutine open_table(self, table_file, columns, file)
      class(results_type), intent(in) :: self
      character(*), intent(in) :: table_file   !! name of the table, such as 'summary'
      character(*), intent(in) :: columns      !! name[unit] of each column; `unit_in_words` makes labels of the units
      type(output_file), intent(out) :: file

      character(:), allocatable :: path
      type(column_type), allocatable :: list(:)

      if (associated(self%memory)) then
         file%memory => self%memory
      else
         path = self%scene%directory//'/'//self%scene%case//'.'//table_file
         if (self%scene%output%csv%is_true) then
            call file%open(path//'.dat', comma_path=path//'.csv')
         else
            call file%open(path//'.dat')
            call file%replace('.csv', columns(:index(columns, '[') - 1))
         end if
         call file%put(head_lines(self%scene, self%solver%surface, self%method, '# '))
         if (self%with_adhesion) then
            call file%put('# adhesion: the contacts are those with it; of each load the stable one of the largest area')
         else if (allocated(self%adhesion) .and. table_file /= 'adhesion') then
            call file%put('# adhesion: the contacts are those without it; with it they are in '//self%scene%case// &
                          '.adhesion.dat')
         end if
      end if
      list = column_list(columns)
      list%unit = self%unit_in_words(list%unit)
      call file%put_columns(list)
   end subroutine open_table

   !> The label of a unit in the deck's words: 'length' and 'pressure' become the deck's labels; 'area' becomes the
   !> label of a length squared, in 1-D of a length; 'force' becomes pressure times area, N
   !> for Pa and m and for MPa and mm. All other text stays.
   elemental recursive function unit_in_words(self, unit) result(words)
      class(results_type), intent(in) :: self
      character(*), intent(in) :: unit   !! such as '1/length'
      character(longest_column) :: words

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
         if (names(k) == 'force' .and. self%solver%surface%dimension == 2 .and. &
             makes_newton(self%scene%pressure_unit, self%scene%length_unit)) label = 'N'
         words = trim(self%unit_in_words(unit(:first - 1)))//label// &
                 self%unit_in_words(unit(first + len_trim(names(k)):))
         return
      end do
   end function unit_in_words

   !> The status of the largest stresses of a load in a body: the status of the load or, where a stress is infinite or
   !> its error estimate exceeds `largest_stress_error` of it, `unresolved` if the deck gives the grid, else
   !> `not_accurate`.
   pure integer function stress_status(self, load, body) result(status)
      class(results_type), intent(in) :: self      !! with `largest_stresses`
      integer, intent(in) :: load, body            !! numbers of the load and of the body in the deck's order

      status = self%loads(load)%status
      if (.not. is_good_status(status)) return
      if (.not. (any(is_doubtful(self%largest_stresses(:, body, load))) .or. self%has_infinite_stress(load))) return
      status = not_accurate
      if (all(self%traits%given_grid > 0)) status = unresolved
   end function stress_status

   !> Whether the largest stress of a load is infinite, as its peak pressure is: where contact ends at a border or step.
   pure logical function has_infinite_stress(self, load)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load    !! number of the load in the deck's order

      has_infinite_stress = self%solver%surface%has_free_edges .and. self%loads(load)%is_good() .and. &
                            .not. is_known(self%loads(load)%value(peak_pressure))
   end function has_infinite_stress

   !> Whether the error estimate of a largest stress exceeds `largest_stress_error` of the stress.
   elemental logical function is_doubtful(largest)
      type(largest_stress), intent(in) :: largest

      is_doubtful = .false.
      ! Comparisons with a NaN raise an exception, which Debug builds trap.
      if (.not. ieee_is_nan(largest%error)) is_doubtful = largest%error > largest_stress_error*largest%value
   end function is_doubtful

   !> Whether a load was solved as requested, by its status in each of `status_tables`. Full slip and separated bodies
   !> count as solved, and so does a table that the deck does not ask for.
   pure function is_solved_in(self, load) result(answer)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load    !! number of the load in the deck's order
      logical :: answer(size(status_tables))

      integer :: body

      answer = .true.
      answer(1) = is_good_status(self%loads(load)%status)
      if (allocated(self%largest_stresses)) &
         answer(2) = all([(is_good_status(self%stress_status(load, body)), body=1, size(self%largest_stresses, 2))])
      if (allocated(self%slip)) &
         answer(3) = all(self%slip(:, load)%slides .or. is_good_status(self%slip(:, load)%status))
      if (allocated(self%adhesion)) &
         answer(4) = all(self%adhesion%at_loads%number /= load .or. is_good_status(self%adhesion%at_loads%status))
   end function is_solved_in

   !> Begins the block of a load with a comment (number, mean pressure, status) and the names of the columns.
   subroutine begin_block(self, file, load)
      class(results_type), intent(in) :: self
      type(output_file), intent(inout) :: file
      integer, intent(in) :: load    !! number of the load in the deck's order

      character(:), allocatable :: words

      words = 'pbar/p* = '//exact_number(self%loads(load)%pbar_over_pstar)
      if (self%solver%surface%has_free_edges) words = 'mean pressure = '//exact_number(self%mean_pressure(load))
      call file%begin_block('load '//integer_text(load)//': '//words//', '//trim(status_name(self%loads(load)%status)))
   end subroutine begin_block

   !> A number that is in units of p*, for a table: unchanged, but NaN on a surface with free edges, which has no p*,
   !> and on a flat one, whose p* is 0, unless it is infinite.
   elemental real(dp) function in_p_star(self, number)
      class(results_type), intent(in) :: self
      real(dp), intent(in) :: number

      in_p_star = number
      if (self%solver%surface%has_free_edges .or. (self%scene%p_star <= 0.0_dp .and. ieee_is_finite(number))) &
         in_p_star = not_a_number()
   end function in_p_star

   !> The number of a load in a column of tables; NaN if the number is unknown or does not exist. With free edges there
   !> are no numbers in p*, and a profile with free edges has no approach and no energy. Areas and loads at the hardness
   !> exist only if there is a hardness.
   pure real(dp) function number(self, load, column, quantities_of_load)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load          !! number of the load in the deck's order
      character(*), intent(in) :: column   !! name of the column
      !> The quantities of the load with its details; absent: the quantities that the solver has computed.
      type(quantities), intent(in), optional :: quantities_of_load

      logical :: exists, in_unit, is_error
      integer :: quantity_kind, quantity
      real(dp) :: unit(number_of_kinds)   !! the program's unit of each kind of quantity, in the deck's units
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
            call find_quantity(column, quantity, quantity_kind, is_error, in_unit)
            number = q%value(quantity)
            ! The pressure of a flat surface, whose p* is 0, is infinite in units of p*.
            if (.not. number > huge(number)) number = or_nan(number)
            if (is_error) number = or_nan(q%error(quantity))
            exists = self%traits%has_errors .or. .not. is_error
            if (any(quantity == [approach, elastic_energy])) &
               exists = exists .and. .not. (surface%has_free_edges .and. surface%dimension == 1)
            if (any(quantity == [area_at_hardness, load_at_hardness])) exists = exists .and. surface%has_hardness()
            if (.not. exists) number = not_a_number()
            if (in_unit) then
               unit = 1.0_dp
               unit(of_length) = surface%amplitude
               unit(of_pressure) = scene%p_star
               unit(of_area) = surface%nominal_area()
               unit(of_energy) = scene%p_star*surface%amplitude*surface%nominal_area()
               number = unit(quantity_kind)*number
               ! The pressure on a flat surface is uniform, so that the peak pressure is the mean pressure.
               if (column == 'peak_pressure' .and. .not. scene%p_star > 0.0_dp) number = self%mean_pressure(load)
            else if (any(quantity_kind == [of_pressure, of_energy])) then
               number = self%in_p_star(number)
            end if
         end select
      end associate
   end function number

   !> The mean pressure of a load [pressure]. If the deck gives the mean pressure, the result is exactly that number.
   pure real(dp) function mean_pressure(self, load)
      class(results_type), intent(in) :: self
      integer, intent(in) :: load    !! number of the load in the deck's order

      mean_pressure = self%scene%p_star*self%loads(load)%pbar_over_pstar
      if (allocated(self%scene%mean_pressure)) mean_pressure = self%scene%mean_pressure(load)
   end function mean_pressure

end module wavycon_results
