!> A session: a deck whose loads are solved one at a time, with tables in memory. The steps are those of the program.
module wavycon_deck_session
   use, intrinsic :: iso_c_binding, only: c_int
   use wavycon_contact_fields, only: contact_fields
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_spots, only: contact_spots
   use wavycon_deck_groups, only: unknown_key
   use wavycon_deck_text, only: deck_text_type, read_deck_text
   use wavycon_error, only: error_type, exit_bad_input, fatal_error
   use wavycon_key_group, only: key_list
   use wavycon_key_table, only: choice_value, key_index
   use wavycon_kinds, only: dp
   use wavycon_load_group, only: check_load_group, list_load_keys
   use wavycon_memory_table, only: longest_column, memory_table, of_words
   use wavycon_methods, only: why_chosen, without_errors
   use wavycon_nearest_name, only: did_you_mean
   use wavycon_notes, only: note_loads, note_scene
   use wavycon_plain_text, only: integer_text, lines_of, listed
   use wavycon_quantities, only: quantities
   use wavycon_read_deck, only: parse_deck
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_run_scene, only: start_results
   use wavycon_scene, only: by_percolation, by_pressure, by_yield, scene_type
   use wavycon_scene_groups, only: load_group
   use wavycon_settings, only: read_setting, setting_type
   use wavycon_solution_record, only: solution_record
   use wavycon_solve_loads, only: find_interface, find_stresses, note_interface, order_loads, solve_target
   use wavycon_stress_fields, only: stress_fields
   use wavycon_table, only: table_type
   use wavycon_tables, only: all_tables, requested_tables, summary_table
   use wavycon_unit_scale, only: scale_of, unit_scale
   implicit none (type, external)
   private

   public :: await_solve, check_ready, deck_session, no_name, pick_number, solved_load

   integer, parameter :: few = 12   ! names that a message lists

   !> In C programs other threads may call the library while one solves a load, but not with the same session: c_lock.c.
   interface
      !> Waits until no other thread solves with the session. Returns 0, or 1 if this thread itself solves with it, and
      !> is in the session's progress callback.
      integer(c_int) function await_solve(is_solving) bind(c, name='wavycon_await_solve')
         import :: c_int
         integer(c_int), intent(in) :: is_solving
      end function await_solve

      !> The same, and lets other threads into the library if it returns 0.
      integer(c_int) function begin_solve(is_solving) bind(c, name='wavycon_begin_solve')
         import :: c_int
         integer(c_int), intent(inout) :: is_solving
      end function begin_solve

      !> Keeps other threads out again.
      subroutine end_solve(is_solving) bind(c, name='wavycon_end_solve')
         import :: c_int
         integer(c_int), intent(inout) :: is_solving
      end subroutine end_solve
   end interface

   character(*), parameter :: in_callback = 'this scene solves a load: its progress callback cannot use the scene'

   !> A deck with its solver started.
   type :: deck_session
      !> Scene and solver. `loads` has one element, for the solution of which a table is made, and so have the loads of
      !> the scene.
      type(results_type) :: results
      type(unit_scale) :: scale                           !! the program's units in the deck's units
      integer, private :: loads_by = by_pressure          !! how the deck gives its loads, as in scene_type
      real(dp), allocatable, private :: target(:)         !! these loads, as in scene_type
      real(dp), allocatable, private :: mean_pressure(:)  !! the same [pressure], if the deck gives them by pressure
      type(solution_record), allocatable, private :: records(:)   !! records of the deck's loads; status < 0: not solved
      type(run_log), private :: log                       !! writes nothing, but keeps notes on surface and tables
      integer(c_int) :: is_solving = 0                    !! number of the thread that solves a load; else 0
      !> Whether it solves for a table, from the one element of `results%loads`: other threads then must not use the
      !> session.
      logical, private :: is_for_table = .false.
      integer, private :: identity = 0                    !! number of the session, from 1; its loads have it too
   contains
      procedure :: open => open_session
      procedure :: open_file, solve, solve_load, make_table, number, text
      procedure, private :: solve_one
   end type deck_session

   !> A load that a session has solved, with data that further calls may need again.
   type :: solved_load
      integer, private :: of_session = 0              !! identity of this session: another one may have other units
      type(contact_solution), allocatable :: solution
      real(dp) :: mean_pressure = 0.0_dp              !! [pressure]
      integer :: loads_by = by_pressure               !! how the load was given: by_pressure or another of the scene
      real(dp) :: target = 0.0_dp                     !! the value that was given, as in scene_type
      type(memory_table) :: summary                   !! the summary, with one row
      type(contact_spots), allocatable :: spots(:)    !! one element, made at its first use
      type(quantities), allocatable :: slopes(:)      !! the same, of the derivatives by P
      class(contact_fields), allocatable :: fields    !! made at their first use
      class(stress_fields), allocatable :: stresses   !! made at their first use
   end type solved_load

   integer :: sessions = 0   ! that were opened so far

contains

   !> Reads a deck and starts its solver. A group &load may be left out. Errors: those of the program for a bad deck or
   !> height map.
   subroutine open_session(self, text, path, keep_fields, error, heights, settings)
      class(deck_session), intent(out) :: self
      character(*), intent(in) :: text      !! text of the deck
      character(*), intent(in) :: path      !! its path for messages; files that it names are looked for beside it
      logical, intent(in) :: keep_fields    !! whether fields, edges or stresses will be needed
      type(error_type), allocatable, intent(out) :: error
      !> Heights in place of those of the file of kind = 'file', shape (points along x, points along y); upwards to the
      !> other body, NaN where a height is missing. A profile has one column or one row.
      real(dp), intent(in), optional :: heights(:, :)
      type(setting_type), intent(in), optional :: settings(:)   !! keys set in place of those of the deck

      type(scene_type), allocatable :: scene

      allocate (scene)
      call parse_deck(deck_text_type(path, text), scene, error, settings, heights, in_memory=.true.)
      if (allocated(error)) return
      call start_results(scene, self%results, with_fields=keep_fields)
      associate (scene => self%results%scene)
         call scene%output%map_format%set(text='text')
         call order_loads(self%results)
         self%loads_by = scene%loads_by
         call move_alloc(scene%target, self%target)
         if (allocated(scene%mean_pressure)) call move_alloc(scene%mean_pressure, self%mean_pressure)
         allocate (scene%target(1), scene%mean_pressure(1), self%results%loads(1), self%records(size(self%target)))
         self%records%status = -1
         call self%log%start(quiet=.true.)
         call note_scene(scene, self%log)
         if (scene%interface%work_of_adhesion%is_given) call self%log%note('numbers, fields and stresses of a load '// &
            'are those without adhesion; the table adhesion has the contacts with it')
         self%scale = scale_of(self%results%solver%surface, scene%e_star)
      end associate
      sessions = sessions + 1
      self%identity = sessions
   end subroutine open_session

   !> Reads a deck from its file, with keys set in place of its own. Errors: those of the program.
   subroutine open_file(self, path, settings, keep_fields, error)
      class(deck_session), intent(out) :: self
      character(*), intent(in) :: path       !! path of the deck
      character(*), intent(in) :: settings   !! lines 'group.key=value', as behind the option --set; empty: none
      logical, intent(in) :: keep_fields     !! whether fields, edges or stresses will be needed
      type(error_type), allocatable, intent(out) :: error

      type(deck_text_type) :: text
      type(setting_type), allocatable :: setting(:)

      call take_settings(lines_of(settings))
      if (.not. allocated(error)) call read_deck_text(path, text, error)
      if (.not. allocated(error)) call self%open(text%content, path, keep_fields, error, settings=setting)

   contains

      !> Reads the settings, a line for each.
      subroutine take_settings(lines)
         character(*), intent(in) :: lines(:)

         character(:), allocatable :: trouble
         integer :: i

         allocate (setting(size(lines)))
         do i = 1, size(setting)
            call read_setting(trim(lines(i)), setting(i), trouble)
            if (.not. allocated(trouble)) cycle
            call fatal_error(error, exit_bad_input, trouble)
            return
         end do
      end subroutine take_settings

   end subroutine open_file

   !> Solves one load. A load that cannot be solved as requested is not an error; the status of the solution says so.
   !> Errors: exit_bad_input for a quantity that does not exist, or a value that the quantity cannot have.
   subroutine solve(self, quantity, value, answer, error)
      class(deck_session), intent(inout) :: self
      !> A key of &load, such as pbar_over_pstar, mean_pressure, mean_gap, yield; a key that takes a word with '=' and
      !> the word, such as percolates=gap.
      character(*), intent(in) :: quantity
      real(dp), intent(in) :: value          !! value of the quantity, in the unit of that key; unused for a word
      type(solved_load), intent(out) :: answer
      type(error_type), allocatable, intent(out) :: error

      integer :: equals, k, loads_by
      real(dp), allocatable :: mean_pressure(:), target(:)
      type(key_list) :: keys(1)
      type(load_group), target :: values

      call check_ready(self, error)
      if (allocated(error)) return
      call list_load_keys(values, keys(1))
      call keys(1)%close()
      call keys(1)%start('')
      equals = index(quantity//'=', '=')
      k = key_index(keys(1)%rows, quantity(:equals - 1))
      if (k == 0) then
         call fatal_error(error, exit_bad_input, '&load: '//unknown_key(quantity(:equals - 1), keys(1), keys))
      else if (equals <= len(quantity) .and. keys(1)%rows(k)%kind /= choice_value) then
         call fatal_error(error, exit_bad_input, '&load: '//trim(quantity(:equals - 1))//" needs a number, got '"// &
                          trim(adjustl(quantity(equals + 1:)))//"'")
      else if (equals > len(quantity) .and. keys(1)%rows(k)%kind == choice_value) then
         call fatal_error(error, exit_bad_input, '&load: '//quantity//" needs a word, such as '"//quantity//'='// &
                          keys(1)%rows(k)%choices(:index(keys(1)%rows(k)%choices, ' ') - 1)//"'")
      end if
      if (allocated(error)) return
      ! The checks skip a group that the deck does not have: mark the group as given.
      values%position = 1
      if (keys(1)%rows(k)%kind == choice_value) then
         call keys(1)%take_value(k, text=trim(adjustl(quantity(equals + 1:))))
      else
         call keys(1)%take_value(k, number=value)
      end if
      call keys(1)%check_relations()
      call check_load_group(values, self%results%solver%surface, self%scale%e_star, &
                            self%results%scene%interface%work_of_adhesion%is_given, &
                            self%results%scene%interface%friction%is_given, loads_by, target, mean_pressure)
      if (values%problems%number > 0) then
         call fatal_error(error, exit_bad_input, '&load: '//values%problems%items(1)%words)
      else
         call self%solve_one(loads_by, 1, target, mean_pressure, answer, error)
      end if
   end subroutine solve

   !> Solves a load of the deck. Errors: exit_bad_input for a load that the deck does not have.
   subroutine solve_load(self, load, answer, error)
      class(deck_session), intent(inout) :: self
      integer, intent(in) :: load            !! number of the load in the deck's order, from 1
      type(solved_load), intent(out) :: answer
      type(error_type), allocatable, intent(out) :: error

      call check_ready(self, error)
      if (allocated(error)) return
      if (load < 1 .or. load > size(self%target)) then
         call fatal_error(error, exit_bad_input, 'there is no such load: the deck gives '// &
                          integer_text(size(self%target))//', which C counts from 0, Fortran from 1')
      else
         call self%solve_one(self%loads_by, load, self%target, self%mean_pressure, answer, error)
      end if
      if (.not. allocated(error)) self%records(load) = answer%solution%solution_record
   end subroutine solve_load

   !> Solves one load of a list, and makes its summary. Errors: exit_bad_input if the load is given by yield or
   !> percolation and the session has no fields or, for yield, no yield stress, for percolation, no error estimates.
   subroutine solve_one(self, loads_by, load, target, mean_pressure, answer, error)
      class(deck_session), intent(inout) :: self
      integer, intent(in) :: loads_by                             !! by_pressure or another name of wavycon_scene
      integer, intent(in) :: load                                 !! number of the load in the list
      real(dp), intent(in) :: target(:)                           !! the list, as in scene_type
      real(dp), intent(in), allocatable :: mean_pressure(:)       !! the list [pressure], if given by pressure
      type(solved_load), intent(out) :: answer
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: words
      type(memory_table) :: summary

      words = ''
      if (loads_by == by_percolation) &
         words = without_errors(self%results%scene%method%solver%text, self%results%solver%surface)
      if (loads_by == by_yield .and. .not. self%results%scene%stress%yield_stress%is_given) then
         call fatal_error(error, exit_bad_input, 'yield needs yield_stress in the group &stress of the deck')
      else if (words /= '') then
         call fatal_error(error, exit_bad_input, words)
      else if (any(loads_by == [by_yield, by_percolation]) .and. .not. self%results%keeps_fields) then
         call fatal_error(error, exit_bad_input, 'loads by yield and by percolation need fields, and keep_fields '// &
                          'is not set')
      end if
      if (allocated(error)) return
      allocate (answer%solution)
      answer%of_session = self%identity
      answer%loads_by = loads_by
      answer%target = target(load)
      if (begin_solve(self%is_solving) /= 0) call fatal_error(error, exit_bad_input, in_callback)
      if (allocated(error)) return
      call solve_target(self%results%solver, loads_by, target(load), answer%solution, self%results%scene%stress_setting)
      call end_solve(self%is_solving)
      answer%mean_pressure = self%scale%p_star*answer%solution%pbar_over_pstar
      if (allocated(mean_pressure)) answer%mean_pressure = mean_pressure(load)
      call self%make_table('summary', answer, summary, error)
      answer%summary = summary
   end subroutine solve_one

   !> Makes a table of a solved load. Errors: exit_bad_input for a table that does not exist, or that needs what the
   !> session does not have; exit_file_trouble if there is not enough memory.
   subroutine make_table(self, name, solved, table, error)
      class(deck_session), intent(inout) :: self
      !> Name of the table: its key in &output; its key in &stress with 'stress_' before it; 'summary', 'spot_sizes',
      !> 'theory_lines', and the tables of &interface.
      character(*), intent(in) :: name
      type(solved_load), intent(inout) :: solved   !! a load that this session has solved; unchanged on return
      type(memory_table), intent(out), target :: table
      type(error_type), allocatable, intent(out) :: error

      integer(c_int) :: is_busy   ! 0: no thread solves with the session
      type(table_type), allocatable :: writer

      call find_writer(self, name, solved, writer, error)
      if (allocated(error)) return
      if (writer%group == 'interface') then
         if (await_solve(self%is_solving) /= 0) call fatal_error(error, exit_bad_input, in_callback)
         if (allocated(error)) return
      end if
      associate (results => self%results)
         call solved%solution%move_to(results%loads(1))
         call move_alloc(solved%spots, results%spots)
         call move_alloc(solved%slopes, results%slopes)
         results%scene%loads_by = solved%loads_by
         results%scene%target = solved%target
         results%scene%mean_pressure = solved%mean_pressure
         if (name == 'stress_largest') then
            if (allocated(results%largest_stresses)) deallocate (results%largest_stresses)
            call find_stresses(results, self%log)
         else if (writer%group == 'interface') then
            if (allocated(results%slip)) deallocate (results%slip)
            self%is_for_table = .true.
            is_busy = begin_solve(self%is_solving)
            call find_interface(results, self%log, name)
            call end_solve(self%is_solving)
            self%is_for_table = .false.
            call note_interface(results, self%log, name)
         end if
         results%memory => table
         call writer%write(results, error)
         nullify (results%memory)
         call results%loads(1)%move_to(solved%solution)
         call move_alloc(results%spots, solved%spots)
         call move_alloc(results%slopes, solved%slopes)
      end associate
   end subroutine make_table

   !> Finds the table of a name. Errors: exit_bad_input, as in make_table.
   subroutine find_writer(self, name, solved, writer, error)
      class(deck_session), intent(in) :: self
      character(*), intent(in) :: name
      type(solved_load), intent(in) :: solved
      type(table_type), allocatable, intent(out) :: writer
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: trouble
      integer :: i
      type(table_type), allocatable :: tables(:)

      call check_ready(self, error, solved)
      if (allocated(error)) return
      if (name == 'summary') then
         ! Every load has this table: to list all tables for it takes longer than to write it.
         allocate (writer, source=summary_table())
         return
      end if
      call all_tables(tables)
      i = findloc(tables%name() == name, .true., dim=1)
      if (i == 0) then
         call fatal_error(error, exit_bad_input, "there is no table '"//name//"'"// &
                          did_you_mean(name, tables%name(), "'", "'", '.')//' The tables are '// &
                          listed(tables%name(), ' and '))
         return
      end if
      writer = tables(i)
      ! Here a table needs no key of &output that requests it.
      if (writer%of_adhesion) writer%asked_by(2) = ''
      if (index(writer%file, 'stress_') > 0 .and. .not. allocated(self%results%scene%stress_setting)) then
         trouble = 'it needs a group &stress in the deck'
      else if (writer%group == 'interface' .and. .not. writer%is_requested(self%results%scene)) then
         trouble = 'it needs a group &interface in the deck'
         if (writer%key//writer%asked_by(1) /= '') &
            trouble = trouble//' with '//trim(writer%key)//trim(writer%asked_by(1))
      else if (writer%group == 'load' .and. solved%loads_by /= by_percolation) then
         trouble = "it needs a load that percolates finds, such as percolates = 'gap'"
      else if ((writer%group == 'stress' .or. writer%needs_fields) .and. .not. self%results%keeps_fields) then
         trouble = 'it needs fields, and keep_fields is not set'
      else if (self%scale%p_star <= 0.0_dp .and. writer%needs_surface) then
         trouble = 'the surface is flat'
      else
         trouble = writer%refusal(self%results%traits, self%results%solver%surface)
      end if
      if (trouble /= '') call fatal_error(error, exit_bad_input, "the table '"//name//"' cannot be made: "//trouble)
   end subroutine find_writer

   !> A number by its name, of a solved load or of the session. Errors: exit_bad_input for a name that does not exist.
   subroutine number(self, name, value, error, solved)
      class(deck_session), intent(in) :: self
      !> Of a load: a column of the summary. Of the session: a name of the list below.
      character(*), intent(in) :: name
      real(dp), intent(out) :: value   !! in units of the deck
      type(error_type), allocatable, intent(out) :: error
      type(solved_load), intent(in), optional :: solved   !! the load; absent: the number is one of the session

      real(dp) :: has_sides

      value = 0.0_dp
      call check_ready(self, error, solved)
      if (allocated(error)) return
      if (present(solved)) then
         associate (summary => solved%summary)
            call pick_number(pack(summary%columns%name, summary%columns%kind /= of_words), &
                             pack(summary%values(:, 1), summary%columns%kind /= of_words), name, value, error)
         end associate
      else
         has_sides = 1.0_dp
         if (allocated(self%results%scene%map)) has_sides = merge(1.0_dp, 0.0_dp, self%results%scene%map%has_sides)
         associate (surface => self%results%solver%surface, units => self%scale)
            call pick_number([character(9) :: 'e_star', 'p_star', 'amplitude', 'length_x', 'length_y', 'has_sides', &
                              'points_x', 'points_y', 'dimension', 'loads'], &
                             [units%e_star, units%p_star, units%amplitude, units%sides, has_sides, &
                              real([surface%points/surface%maps_in_cell(), surface%dimension, &
                                    size(self%results%order)], dp)], name, value, error)
         end associate
      end if
   end subroutine number

   !> Picks the number of a name from a list. Errors: exit_bad_input if the list does not have the name.
   subroutine pick_number(names, numbers, name, number, error)
      character(*), intent(in) :: names(:), name   !! names of the list; the name to find
      real(dp), intent(in) :: numbers(:)           !! numbers of the list
      real(dp), intent(inout) :: number            !! unchanged in case of an error
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      i = findloc(names == name, .true., dim=1)
      if (i > 0) number = numbers(i)
      if (i == 0) call no_name("number '"//name//"'", name, names, error)
   end subroutine pick_number

   !> Reports a name that does not exist, with the nearest one that does, or with those of a short list.
   subroutine no_name(what, name, names, error)
      character(*), intent(in) :: what             !! what does not exist, such as "number 'p_stra'"
      character(*), intent(in) :: name, names(:)   !! its name; those that exist
      type(error_type), allocatable, intent(out) :: error

      character(:), allocatable :: there

      there = ''
      if (size(names) <= few) there = '; there are '//listed(names)
      call fatal_error(error, exit_bad_input, 'there is no '//what//did_you_mean(name, names, "'", "'", there))
   end subroutine no_name

   !> A text by its name, of a solved load or of the session. Errors: exit_bad_input for a name that does not exist.
   subroutine text(self, name, words, error, solved)
      class(deck_session), intent(in) :: self
      !> Of a load: a column of words of the summary, or 'notes', what the log would note of the load. Of the session: a
      !> name of the list below, or 'notes' on the surface, and on the deck's loads and the tables so far.
      character(*), intent(in) :: name
      character(:), allocatable, intent(out) :: words
      type(error_type), allocatable, intent(out) :: error
      type(solved_load), intent(in), optional :: solved   !! the load; absent: the text is one of the session

      integer :: i
      type(run_log) :: logger
      type(table_type), allocatable :: tables(:)

      call check_ready(self, error, solved)
      if (allocated(error)) return
      associate (scene => self%results%scene)
         if (name == 'notes') then
            logger = self%log
            if (present(solved)) then
               call logger%start(quiet=.true.)
               call note_loads(self%results, solved%loads_by, [solved%solution%solution_record], logger)
            else
               call note_loads(self%results, self%loads_by, pack(self%records, self%records%status >= 0), logger)
            end if
            words = logger%notes
         else if (present(solved)) then
            associate (summary => solved%summary)
               i = findloc(summary%columns%name == name .and. summary%columns%kind == of_words, .true., dim=1)
               if (i > 0) words = trim(summary%words(nint(summary%values(i, 1))))
            end associate
         else if (name == 'solver') then
            words = scene%method%solver%text
         else if (name == 'method') then
            words = self%results%method
         else if (name == 'why_chosen') then
            words = why_chosen(self%results%traits)
         else if (name == 'pressure_unit') then
            words = scene%pressure_unit
         else if (name == 'length_unit') then
            words = scene%length_unit
         else if (name == 'resolved_deck') then
            words = scene%resolved_deck
         else if (name == 'order') then
            allocate (character(12*size(self%results%order)) :: words)
            write (words, '(*(i0, :, 1x))') self%results%order
            words = trim(words)
         else if (name == 'tables') then
            call requested_tables(scene, self%results%traits, self%results%solver%surface, tables)
            words = ''
            do i = 1, size(tables)
               words = words//' '//trim(tables(i)%name())
            end do
            words = trim(adjustl(words))
         end if
      end associate
      if (allocated(words)) return
      if (present(solved)) then
         associate (columns => solved%summary%columns)
            call no_name("text '"//name//"'", name, &
                         [character(longest_column) :: 'notes', pack(columns%name, columns%kind == of_words)], error)
         end associate
      else
         call no_name("text '"//name//"'", name, [character(13) :: 'notes', 'solver', 'method', 'why_chosen', &
                      'pressure_unit', 'length_unit', 'resolved_deck', 'order', 'tables'], error)
      end if
   end subroutine text

   !> Checks that a session is open and, if a load is needed, that it has solved it. Waits until no other thread makes a
   !> table from solutions of its own. Errors: exit_bad_input, also in a callback of such a table.
   subroutine check_ready(self, error, solved)
      class(deck_session), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      type(solved_load), intent(in), optional :: solved   !! the load, if the call needs one

      if (.not. allocated(self%results%solver)) then
         call fatal_error(error, exit_bad_input, 'the session is not open')
      else if (present(solved)) then
         if (.not. allocated(solved%solution)) then
            call fatal_error(error, exit_bad_input, 'there is no solution: no load has been solved')
         else if (solved%of_session /= self%identity) then
            call fatal_error(error, exit_bad_input, 'another session has solved this load: ask that one')
         end if
      end if
      if (allocated(error) .or. .not. self%is_for_table) return
      if (await_solve(self%is_solving) /= 0) call fatal_error(error, exit_bad_input, in_callback)
   end subroutine check_ready

end module wavycon_deck_session
