!> What --check writes about a deck, without a run.
module wavycon_check_scene
   use wavycon_auto_contact, only: has_lattice
   use wavycon_grid_plan, only: bytes_of_grid
   use wavycon_fourier_series, only: fourier_series
   use wavycon_grid_slab, only: grid_slab
   use wavycon_grid_transform, only: grid_transform
   use wavycon_kinds, only: dp, int64
   use wavycon_methods, only: why_chosen
   use wavycon_notes, only: show_scene
   use wavycon_plain_text, only: clauses, escaped, integer_text, listed
   use wavycon_results, only: results_type
   use wavycon_run_log, only: duration, run_log
   use wavycon_run_scene, only: start_results
   use wavycon_scene, only: by_percolation, by_pressure, by_yield, scene_type
   use wavycon_table, only: table_type
   use wavycon_work_sharing, only: distributed_grids, distributed_loads
   implicit none (type, external)
   private

   public :: check_scene

   !> A load that is not given by pressure is searched for. On maps of 512 x 512 and 1024 x 1024 points searches for
   !> yield and for percolation took the time of so many solutions or more.
   integer, parameter :: solutions_for_yield = 4, solutions_for_percolation = 8

contains

   !> Writes what a run would do: the scene as at the start of a run, why solver = 'auto' chooses its solvers, memory,
   !> time and tables.
   subroutine check_scene(scene, quiet)
      type(scene_type), allocatable, intent(inout) :: scene   !! not allocated afterwards
      logical, intent(in) :: quiet                            !! whether to write nothing

      character(:), allocatable :: alone, least, most, reason, words
      integer :: solutions   ! of a load
      type(results_type) :: results
      type(run_log) :: logger
      type(table_type), allocatable :: tables(:)

      call logger%start(quiet)
      call start_results(scene, results, tables)
      call show_scene(results, logger)
      reason = why_chosen(results%traits)
      ! The default solver is 'auto', for which `reason` is not empty.
      associate (solver => results%scene%method%solver)
         if (.not. solver%is_given) reason = clauses("'"//solver%text//"' is the default", reason)
      end associate
      if (reason /= '') call logger%say('because: '//reason)
      if (results%traits%lacks_waves) call logger%note('the grid leaves out waves of the surface, those of less '// &
         'than two points: the errors of all loads that it solves will be unknown. Give more grid_points, or an '// &
         'accuracy')
      if (all(results%traits%finest_grid > 0)) then
         call logger%say('memory: '//memory(results))
         words = 'at least '
         solutions = 1
         if (results%scene%loads_by == by_yield) solutions = solutions_for_yield
         if (results%scene%loads_by == by_percolation) solutions = solutions_for_percolation
         ! With a lattice a search solves few loads on grids or none.
         if (results%traits%choice == has_lattice) solutions = 1
         if (results%scene%loads_by == by_pressure .or. results%traits%choice == has_lattice) words = 'some '
         least = time_on(results%traits%coarsest_grid)
         most = least
         if (any(results%traits%coarsest_grid < results%traits%finest_grid)) most = time_on(results%traits%finest_grid)
         if (most /= least) words = words//least//' on coarse grids, '
         alone = ''
         if (allocated(results%scene%stress_setting) .or. allocated(results%scene%interface_setting)) &
            alone = ', without stresses and what &interface asks for'
         call logger%say('time: '//words//most//' if all loads need that grid, by its transforms as measured now'// &
                         alone)
      end if
      words = ''
      if (results%scene%output%csv%is_true) words = ', also with commas,'
      call logger%say('tables: '//listed(tables%name())//words//' in '//escaped(results%scene%directory))
      call logger%say(escaped(results%scene%deck_path)//': the deck is fine')

   contains

      !> The time of all loads on one grid, in words.
      function time_on(points) result(words)
         integer, intent(in) :: points(2)
         character(:), allocatable :: words

         words = duration(max(1.0_dp, seconds_of_load(points)*solutions*size(results%scene%target)))
      end function time_on

   end subroutine check_scene

   !> The memory that the finest grid takes and the memory that is available, in words.
   function memory(results) result(words)
      type(results_type), intent(in) :: results
      character(:), allocatable :: words

      integer, parameter :: bytes_of_point = 2*storage_size(1.0_dp)/8
      integer(int64) :: available, bytes
      integer :: loads, own(2), points(2)
      type(grid_slab) :: slab

      points = results%traits%finest_grid
      own = points
      loads = size(results%scene%target)
      associate (sharing => results%sharing)
         if (sharing%kind == distributed_grids) then
            call slab%start(points)
            own(2) = slab%width
         else if (sharing%kind == distributed_loads) then
            loads = (loads - 1)/sharing%ranks + 1
         end if
         bytes = bytes_of_grid(own)
         if (results%keeps_fields) bytes = bytes + bytes_of_point*product(int(own, int64))*loads
         words = 'at most '//megabytes(bytes)
         if (sharing%is_shared) words = words//' on each rank'
      end associate
      words = words//' for grids of up to '//integer_text(points(1))
      if (results%solver%surface%dimension == 2) words = words//' x '//integer_text(points(2))
      words = words//' points in the part of the cell that is solved'
      available = results%sharing%memory_of_each()
      if (available < 0) return
      words = words//'; '//megabytes(available)//' available'
      if (results%sharing%is_shared) words = words//' to each'
   end function memory

   !> An estimate of the time that a load takes on a grid [s]. A pair of transforms, on a grid of at most `most` points
   !> along each side, is timed three times; the shortest time, in which no other program ran, is taken as proportional
   !> to the number of points.
   real(dp) function seconds_of_load(points) result(seconds)
      integer, intent(in) :: points(2)   !! numbers of points along x and y of the part of the cell that is solved

      !> Number of pairs of transforms of a load. Loads of self-affine surfaces take 15 to 60 pairs on 512 x 512 points.
      real(dp), parameter :: pairs = 40.0_dp
      integer, parameter :: most = 512
      integer(int64) :: begun, ended, rate
      integer :: part(2), trial
      real(dp), allocatable :: field(:, :)
      type(fourier_series) :: series
      type(grid_transform) :: transform

      part = min(points, most)
      call transform%start(part, even=.false.)
      allocate (field(part(1), transform%slab%columns()), source=0.0_dp)
      call transform%series(field, series)   ! not timed: the first call plans the transforms
      seconds = huge(seconds)
      do trial = 1, 3
         call system_clock(begun, rate)
         call transform%series(field, series)
         call transform%sample(series, field)
         call system_clock(ended)
         seconds = min(seconds, real(ended - begun, dp)/rate)
      end do
      seconds = pairs*seconds*product(real(points, dp)/part)
   end function seconds_of_load

   !> A number of bytes in MB, rounded up, in words.
   function megabytes(bytes) result(words)
      integer(int64), intent(in) :: bytes
      character(:), allocatable :: words

      words = integer_text((bytes - 1)/1000000 + 1)//' MB'
   end function megabytes

end module wavycon_check_scene
