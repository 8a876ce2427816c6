!> The tables of the log: the solved loads, and the largest stresses.
module wavycon_result_lines
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: or_nan
   use wavycon_contact_status, only: status_name
   use wavycon_kinds, only: dp
   use wavycon_plain_text, only: short_number
   use wavycon_results, only: results_type
   use wavycon_run_log, only: run_log
   use wavycon_solution_record, only: solver_names
   implicit none (type, external)
   private

   public :: show_loads, show_stresses

   !> A line that grows column by column, together with that of the names.
   type :: log_line
      character(:), allocatable :: names, words
   contains
      procedure :: start
      procedure :: add
   end type log_line

contains

   !> A line for each load: mean gap, area and peak pressure, each followed by its error estimate if the solver has
   !> them; mean and peak pressure in the deck's unit if the deck gives a modulus; solver and status. With free edges
   !> force, approach, area and peak pressure in the deck's units.
   subroutine show_loads(results, log)
      type(results_type), intent(in) :: results   !! with a solution for each load
      type(run_log), intent(inout) :: log

      character(9) :: names(3)
      integer :: i, load, solver_width
      real(dp) :: approach(2), errors(3), unit(3), values(3)
      type(log_line) :: line

      if (log%quiet) return
      ! The longest name of a solver among the loads.
      solver_width = max(len('solver'), maxval(len_trim(solver_names(results%loads%solver))))
      names = [character(9) :: 'gap/Delta', 'area/A0', 'peak/p*']
      unit = 1.0_dp
      associate (surface => results%solver%surface, scene => results%scene)
         if (surface%has_free_edges) then
            names = [character(9) :: 'approach', 'area', 'peak']
            unit = [surface%amplitude, surface%nominal_area(), scene%p_star]
         end if
         do load = 1, size(results%loads)
            associate (measures => results%loads(load)%measures)
               values = [measures%mean_gap_over_amplitude, measures%contact_area_fraction, &
                         measures%peak_pressure_over_pstar]
               errors = or_nan(measures%errors())
            end associate
            if (surface%has_free_edges) then
               approach = results%approach_over_amplitude(load)
               values(1) = approach(1)
               errors(1) = approach(2)
            end if
            call line%start(results, load)
            do i = 1, size(names)
               call line%add(trim(names(i)), unit(i)*values(i))
               if (results%traits%has_errors) call line%add('error', unit(i)*errors(i))
            end do
            if (scene%gives_modulus .and. .not. surface%has_free_edges) &
               call line%add('peak['//scene%pressure_unit//']', results%peak_pressure(load))
            if (load == 1) &
               call log%say(line%names//' solver'//repeat(' ', solver_width - len('solver') + 2)//'status')
            call log%say(line%words//' '//solver_names(results%loads(load)%solver)(:solver_width)//'  '// &
                         trim(status_name(results%loads(load)%status)))
         end do
      end associate
   end subroutine show_loads

   !> A line for each load and body: von Mises stress and shear stress, each followed by its error estimate, and the
   !> depth of the first over the side of the cell along x; with free edges all in the deck's units. The von Mises
   !> stress in the deck's unit too if the deck gives a modulus, and the ratio to the yield stress if it gives one.
   subroutine show_stresses(results, log)
      type(results_type), intent(in) :: results   !! with the largest stresses
      type(run_log), intent(inout) :: log

      character(40) :: names(3)
      character(:), allocatable :: in_unit
      integer :: body, load
      real(dp) :: depth_unit, stress_unit
      type(log_line) :: line

      associate (scene => results%scene, surface => results%solver%surface)
         in_unit = '['//scene%pressure_unit//']'
         stress_unit = 1.0_dp
         depth_unit = 1.0_dp
         names = [character(40) :: 'vMises/p*', 'depth/cell', 'shear/p*']
         if (surface%has_free_edges) then
            stress_unit = scene%p_star
            depth_unit = surface%length(1)
            names = [character(40) :: 'vMises'//in_unit, 'depth['//scene%length_unit//']', 'shear'//in_unit]
         end if
         do load = 1, size(results%loads)
            do body = 1, size(results%von_mises, 1)
               associate (yielding => results%von_mises(body, load), shear => results%shear(body, load))
                  call line%start(results, load)
                  call line%add('body', real(body, dp))
                  call line%add(trim(names(1)), stress_unit*yielding%value)
                  call line%add('error', stress_unit*yielding%error)
                  call line%add(trim(names(2)), depth_unit*yielding%place(3)/(2*pi))
                  call line%add(trim(names(3)), stress_unit*shear%value)
                  call line%add('error', stress_unit*shear%error)
                  if (scene%gives_modulus .and. .not. surface%has_free_edges) &
                     call line%add('vMises'//in_unit, scene%p_star*yielding%value)
                  if (allocated(scene%stress_setting%yield_stress)) call line%add( &
                     'over yield', scene%stress_setting%over_yield_stress(body, yielding%value, shear%value))
               end associate
               if (load == 1 .and. body == 1) call log%say(line%names)
               call log%say(line%words)
            end do
         end do
      end associate
   end subroutine show_stresses

   !> Starts a line with the mean pressure or, with free edges, the force.
   subroutine start(self, results, load)
      class(log_line), intent(out) :: self
      type(results_type), intent(in) :: results
      integer, intent(in) :: load

      self%names = ''
      self%words = ''
      if (results%solver%surface%has_free_edges) then
         call self%add('force', results%solver%surface%nominal_area()*results%mean_pressure(load))
      else
         call self%add('pbar/p*', results%loads(load)%pbar_over_pstar)
         if (results%scene%gives_modulus) &
            call self%add('pbar['//results%scene%pressure_unit//']', results%mean_pressure(load))
      end if
   end subroutine start

   !> Adds a number at the right of a column; of an error estimate two digits, and '-' if it is unknown.
   subroutine add(self, name, number)
      class(log_line), intent(inout) :: self
      character(*), intent(in) :: name
      real(dp), intent(in) :: number

      character(12) :: buffer
      character(:), allocatable :: words
      integer :: width
      real(dp) :: rounded

      width = max(13, len(name) + 2)
      words = short_number(number)
      if (name == 'error') then
         width = 9
         write (buffer, '(es12.1e3)') number
         read (buffer, *) rounded
         words = short_number(rounded)
         if (ieee_is_nan(number)) words = '-'
      end if
      self%names = self%names//repeat(' ', max(0, width - len(name)))//name
      self%words = self%words//repeat(' ', max(0, width - len(words)))//words
   end subroutine add

end module wavycon_result_lines
