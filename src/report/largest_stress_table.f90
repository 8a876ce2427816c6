!> <case>.stress_largest.dat: the largest von Mises stress and the largest shear stress of each load and body.
module wavycon_largest_stress_table
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: largest_stress
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_stress_rows, only: number_of_bodies
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: largest_stress_table

   !> The ratio to the yield stress is that of the criterion in use.
   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'body[-]', 'nu[-]', 'pbar_over_pstar[-]', &
      'largest_von_mises_over_pstar[-]', 'largest_von_mises_over_pstar_error[-]', &
      'largest_shear_over_pstar[-]', 'largest_shear_over_pstar_error[-]', &
      'stress_over_yield_stress[-]', 'stress_over_yield_stress_error[-]', 'mean_pressure[pressure]', &
      'largest_von_mises[pressure]', 'largest_von_mises_error[pressure]', 'von_mises_x[length]', &
      'von_mises_y[length]', 'von_mises_depth[length]', &
      'largest_shear[pressure]', 'largest_shear_error[pressure]', 'shear_x[length]', 'shear_y[length]', &
      'shear_depth[length]', &
      'status_code[-]', 'status[-]']

contains

   type(table_type) function largest_stress_table() result(table)
      table%file = 'stress_largest'
      table%key = 'largest'
      table%meaning = 'The largest von Mises stress and the largest shear stress of each load.'
      call table%set_columns(columns)
      table%group = 'stress'
      table%put_load => put_largest_stresses
   end function largest_stress_table

   !> The largest stresses are found before the tables are written.
   subroutine put_largest_stresses(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      integer :: body
      real(dp) :: ratio(2)

      do body = 1, number_of_bodies(results)
         associate (setting => results%scene%stress_setting, yielding => results%von_mises(body, load), &
                    shear => results%shear(body, load))
            ratio = not_a_number()
            if (allocated(setting%yield_stress)) &
               ratio = setting%over_yield_stress(body, [yielding%value, yielding%error], [shear%value, shear%error])
            call file%add([load, body])
            call file%add([setting%body(body)%nu, results%in_p_star([results%loads(load)%pbar_over_pstar, &
                           yielding%value, yielding%error, shear%value, shear%error]), ratio, &
                           results%mean_pressure(load)])
            call put_largest(yielding)
            call put_largest(shear)
            call results%end_row(file, load)
         end associate
      end do

   contains

      !> Value and place in the deck's units.
      subroutine put_largest(largest)
         type(largest_stress), intent(in) :: largest

         associate (scene => results%scene, length => results%solver%surface%length, &
                    parts => results%solver%surface%parts())
            call file%add([scene%p_star*[largest%value, largest%error], &
                           [length, length(1)]*largest%place_in_cell(parts)])
         end associate
      end subroutine put_largest

   end subroutine put_largest_stresses

end module wavycon_largest_stress_table
