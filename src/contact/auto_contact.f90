!> solver = 'auto': the closed form where there is one, otherwise fitted expansions where these exist for the surface,
!> with grids for loads at which they are not accurate enough, otherwise grids. The grid alone if its points are given
!> or the pressure is bounded by a hardness.
module wavycon_auto_contact
   use wavycon_closed_form_contact, only: closed_form_contact, closed_form_exists
   use wavycon_contact_solution, only: contact_solution
   use wavycon_contact_solver, only: contact_solver
   use wavycon_contact_status, only: converged
   use wavycon_fitted_contact, only: fitted_contact
   use wavycon_fitted_frame, only: find_frame, fitted_frame
   use wavycon_grid_contact, only: grid_contact
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type
   use wavycon_kinds, only: dp
   use wavycon_problems, only: problem_list_type
   use wavycon_ranks, only: any_rank
   use wavycon_solver_keys, only: accuracy_key, check_grid_points, grid_points_key, points_of_grid, residual_key, &
                                  set_grid_defaults
   use wavycon_solver_progress, only: solver_progress
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: auto_contact

   type, extends(contact_solver) :: auto_contact
      character(:), allocatable, private :: reason             !! why `first` was selected
      class(contact_solver), allocatable, private :: first     !! solves every load
      type(grid_contact), allocatable, private :: second       !! solves the loads that the first one failed to
   contains
      procedure, nopass :: name
      procedure, nopass :: meaning
      procedure, nopass :: keys
      procedure, nopass :: is_default_for
      procedure, nopass :: set_defaults => set_grid_defaults
      procedure, nopass :: check
      procedure :: start_from_keys
      procedure :: describe
      procedure :: start
      procedure :: solve_partial_contact
      procedure :: show_progress
      procedure :: coarser_levels
      procedure :: use_level
      procedure :: starts_from_last_load
      procedure :: forget_last_load
      procedure :: skip_load
      procedure :: new_kept_solution
      procedure :: why_chosen
      procedure :: finest_grid
      procedure :: given_grid
   end type auto_contact

contains

   pure function name() result(words)
      character(:), allocatable :: words

      words = 'auto'
   end function name

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = "the closed form where there is one, otherwise 'fitted' where its expansions exist, with 'grid' for "// &
              "loads at which these are not accurate enough, otherwise and with a hardness 'grid'"
   end function meaning

   function keys() result(rows)
      type(key_type), allocatable :: rows(:)

      rows = [accuracy_key(), grid_points_key(), residual_key()]
   end function keys

   !> For every surface: as the last of the list it is the default if no other solver is.
   logical function is_default_for(surface, kind)
      type(surface_type), intent(in) :: surface
      character(*), intent(in) :: kind

      associate (unused => surface, unused_too => kind); end associate
      is_default_for = .true.
   end function is_default_for

   subroutine check(values, surface, problems)
      type(group_values), intent(in) :: values
      type(surface_type), intent(in) :: surface
      type(problem_list_type), intent(inout) :: problems

      call check_grid_points(values, surface, problems)
   end subroutine check

   subroutine start_from_keys(self, surface, values, keep_fields)
      class(auto_contact), intent(inout) :: self
      type(surface_type), intent(in) :: surface
      type(group_values), intent(in) :: values
      logical, intent(in) :: keep_fields

      call self%start(surface, values%real('accuracy'), keep_fields, points_of_grid(values, surface), &
                      values%real('residual'))
   end subroutine start_from_keys

   !> Selects and starts the solvers.
   subroutine start(self, surface, accuracy, keep_fields, points, residual)
      class(auto_contact), intent(out) :: self
      type(surface_type), intent(in) :: surface
      real(dp), intent(in) :: accuracy                 !! of mean gap [Delta], contact area fraction, peak pressure [p*]
      logical, intent(in) :: keep_fields               !! whether solutions keep their fields and edges
      integer, intent(in), optional :: points(2)       !! of the one grid to solve; absent or zeros: to the accuracy
      real(dp), intent(in), optional :: residual       !! of that grid (C9), as for grid_contact

      type(closed_form_contact), allocatable :: closed_form
      type(fitted_contact), allocatable :: fitted
      type(grid_contact), allocatable :: grid
      type(fitted_frame) :: frame
      logical :: by_accuracy

      self%surface = surface
      by_accuracy = .true.
      if (present(points)) by_accuracy = all(points == 0)
      call find_frame(surface, frame)
      if (closed_form_exists(surface) .and. by_accuracy .and. .not. surface%has_hardness()) then
         allocate (closed_form)
         call closed_form%start(surface)
         call move_alloc(closed_form, self%first)
         self%reason = 'the surface is the 1-D wave, which has a closed form'
      else if (frame%is_found() .and. by_accuracy .and. .not. surface%has_hardness()) then
         allocate (fitted, self%second)
         call fitted%start(surface, accuracy, keep_fields)
         call self%second%start(surface, accuracy, keep_fields)
         call move_alloc(fitted, self%first)
         self%reason = 'the surface has expansions; grids solve the loads for which these are not accurate enough'
      else
         allocate (grid)
         call grid%start(surface, accuracy, keep_fields, points, residual)
         call move_alloc(grid, self%first)
         self%reason = 'the surface has neither a closed form nor expansions'
         if (surface%has_hardness()) self%reason = 'neither closed form nor expansions have a hardness'
         if (.not. by_accuracy) then
            self%reason = 'the points of the grid are given'
            if (all(points == surface%points)) &
               self%reason = 'a height map is solved on its own points unless an accuracy is given'
         end if
      end if
   end subroutine start

   !> If the first solution is not good, the load is solved on grids too, and the better of the two solutions is
   !> returned. Ranks on different machines may have first solutions of different digits: they decide together.
   subroutine solve_partial_contact(self, pbar_over_pstar, solution)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar
      class(contact_solution), allocatable, intent(out) :: solution

      class(contact_solution), allocatable :: on_grids

      call self%first%solve(pbar_over_pstar, solution)
      if (.not. allocated(self%second)) return
      if (.not. any_rank(.not. solution%is_good())) return
      call self%second%solve(pbar_over_pstar, on_grids)
      if (any_rank(on_grids%status == converged .or. on_grids%largest_error() <= solution%largest_error())) &
         call move_alloc(on_grids, solution)
   end subroutine solve_partial_contact

   subroutine show_progress(self, progress)
      class(auto_contact), intent(inout) :: self
      class(solver_progress), intent(in), pointer :: progress

      if (allocated(self%first)) call self%first%show_progress(progress)
      if (allocated(self%second)) call self%second%show_progress(progress)
   end subroutine show_progress

   integer function coarser_levels(self)
      class(auto_contact), intent(in) :: self

      coarser_levels = 0
      if (allocated(self%first)) coarser_levels = self%first%coarser_levels()
   end function coarser_levels

   subroutine use_level(self, level)
      class(auto_contact), intent(inout) :: self
      integer, intent(in) :: level

      if (allocated(self%first)) call self%first%use_level(level)
   end subroutine use_level

   pure logical function starts_from_last_load(self)
      class(auto_contact), intent(in) :: self

      starts_from_last_load = .false.
      if (allocated(self%first)) starts_from_last_load = self%first%starts_from_last_load()
   end function starts_from_last_load

   subroutine forget_last_load(self)
      class(auto_contact), intent(inout) :: self

      if (allocated(self%first)) call self%first%forget_last_load()
   end subroutine forget_last_load

   !> The expansion of the next load starts from the expansion of this one. Only loads solved on grids are in
   !> checkpoints, so that the expansion is computed again.
   subroutine skip_load(self, pbar_over_pstar)
      class(auto_contact), intent(inout) :: self
      real(dp), intent(in) :: pbar_over_pstar

      class(contact_solution), allocatable :: unused

      if (allocated(self%second)) call self%first%solve(pbar_over_pstar, unused)
   end subroutine skip_load

   subroutine new_kept_solution(self, solution)
      class(auto_contact), intent(in) :: self
      class(contact_solution), allocatable, intent(out) :: solution

      if (allocated(self%second)) then
         call self%second%new_kept_solution(solution)
      else if (allocated(self%first)) then
         call self%first%new_kept_solution(solution)
      end if
   end subroutine new_kept_solution

   function why_chosen(self) result(words)
      class(auto_contact), intent(in) :: self
      character(:), allocatable :: words

      words = ''
      if (allocated(self%reason)) words = self%reason
   end function why_chosen

   function finest_grid(self) result(points)
      class(auto_contact), intent(in) :: self
      integer :: points(2)

      points = 0
      if (allocated(self%second)) then
         points = self%second%finest_grid()
      else if (allocated(self%first)) then
         points = self%first%finest_grid()
      end if
   end function finest_grid

   function given_grid(self) result(points)
      class(auto_contact), intent(in) :: self
      integer :: points(2)

      points = 0
      if (allocated(self%first)) points = self%first%given_grid()
   end function given_grid

   pure function describe(self) result(words)
      class(auto_contact), intent(in) :: self
      character(:), allocatable :: words

      words = ''
      if (allocated(self%first)) words = self%first%describe()
      if (allocated(self%second)) words = words//', grids where these cannot'
   end function describe

end module wavycon_auto_contact
