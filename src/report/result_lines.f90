!> The lines of the log that show the solved loads and the largest stresses. No line is longer than 120 characters.
module wavycon_result_lines
   use wavycon_constants, only: pi
   use wavycon_contact_measures, only: or_nan
   use wavycon_contact_status, only: status_name
   use wavycon_kinds, only: dp
   use wavycon_log_columns, only: log_line
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: solver_names
   implicit none (type, external)
   private

   public :: line_of_load, line_of_stress

   integer, parameter :: body_width = 5

contains

   !> One load: mean gap, area and peak pressure, each followed by its error estimate if the solver has them; mean and
   !> peak pressure in the deck's unit if the deck gives a modulus; solver and status. With free edges approach, area
   !> and peak pressure in the deck's units.
   subroutine line_of_load(results, load, line)
      type(results_type), intent(in) :: results   !! with a solution for each load
      integer, intent(in) :: load                 !! number in the deck's order
      type(log_line), intent(out) :: line

      integer :: solver_width
      real(dp) :: approach(2)

      ! The longest name of a solver among the loads.
      solver_width = max(len('solver'), maxval(len_trim(solver_names(results%loads%solver))))
      associate (solution => results%loads(load), measures => results%loads(load)%measures)
         call start_line(results, load, line)
         if (results%solver%surface%has_free_edges) then
            approach = results%approach_over_amplitude(load)
            call add('approach', results%solver%surface%amplitude, approach(1), approach(2))
            call add('area', results%solver%surface%nominal_area(), measures%contact_area_fraction, &
                     measures%contact_area_error)
            call add('peak', results%scene%p_star, measures%peak_pressure_over_pstar, measures%peak_pressure_error)
         else
            call add('gap/Delta', 1.0_dp, measures%mean_gap_over_amplitude, measures%mean_gap_error)
            call add('area/A0', 1.0_dp, measures%contact_area_fraction, measures%contact_area_error)
            call add('peak/p*', 1.0_dp, measures%peak_pressure_over_pstar, measures%peak_pressure_error)
            if (results%scene%gives_modulus) &
               call line%add_number('peak', results%peak_pressure(load), results%scene%pressure_unit)
         end if
         line%names = line%names//' solver'//repeat(' ', solver_width - len('solver') + 2)//'status'
         line%words = line%words//' '//solver_names(solution%solver)(:solver_width)//'  '// &
                      trim(status_name(solution%status))
      end associate

   contains

      subroutine add(name, unit, number, error)
         character(*), intent(in) :: name
         real(dp), intent(in) :: unit, number, error

         call line%add_number(name, unit*number)
         if (results%traits%has_errors) call line%add_error(unit*or_nan(error))
      end subroutine add

   end subroutine line_of_load

   !> One load and body: von Mises stress and shear stress, each followed by its error estimate, and the depth of the
   !> first over the side of the cell along x; in the deck's units if it gives a modulus, with free edges in these
   !> alone; if the deck gives a yield stress the ratio to it.
   subroutine line_of_stress(results, load, body, line)
      type(results_type), intent(in) :: results   !! with the largest stresses
      integer, intent(in) :: load                 !! number in the deck's order
      integer, intent(in) :: body
      type(log_line), intent(out) :: line

      associate (yielding => results%von_mises(body, load), shear => results%shear(body, load), scene => results%scene)
         call start_line(results, load, line)
         call line%add_word('body', achar(iachar('0') + body), body_width)
         if (results%solver%surface%has_free_edges) then
            call line%add_number('vMises', scene%p_star*yielding%value, scene%pressure_unit)
            call line%add_error(scene%p_star*yielding%error)
            call line%add_number('depth', results%solver%surface%length(1)*yielding%place(3)/(2*pi), scene%length_unit)
            call line%add_number('shear', scene%p_star*shear%value, scene%pressure_unit)
            call line%add_error(scene%p_star*shear%error)
         else
            call line%add_number('vMises/p*', yielding%value)
            call line%add_error(yielding%error)
            call line%add_number('depth/cell', yielding%place(3)/(2*pi))
            call line%add_number('shear/p*', shear%value)
            call line%add_error(shear%error)
            if (scene%gives_modulus) call line%add_number('vMises', scene%p_star*yielding%value, scene%pressure_unit)
         end if
         if (allocated(scene%stress_setting%yield_stress)) call line%add_number( &
            'over yield', scene%stress_setting%over_yield_stress(body, yielding%value, shear%value))
      end associate
   end subroutine line_of_stress

   !> The mean pressure or, with free edges, the force.
   subroutine start_line(results, load, line)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(log_line), intent(out) :: line

      if (results%solver%surface%has_free_edges) then
         call line%start('force', results%solver%surface%nominal_area()*results%mean_pressure(load))
         return
      end if
      call line%start('pbar/p*', results%loads(load)%pbar_over_pstar)
      if (results%scene%gives_modulus) &
         call line%add_number('pbar', results%mean_pressure(load), results%scene%pressure_unit)
   end subroutine start_line

end module wavycon_result_lines
