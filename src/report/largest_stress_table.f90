!> <case>.stress_largest.dat: the largest von Mises stress and the largest shear stress of each load and body.
module wavycon_largest_stress_table
   use wavycon_contact_status, only: status_code, status_name
   use wavycon_error, only: error_type
   use wavycon_kinds, only: dp
   use wavycon_largest_stress, only: largest_stress
   use wavycon_output_file, only: output_file
   use wavycon_results, only: not_a_number, results_type
   use wavycon_stress_rows, only: number_of_bodies
   use wavycon_stress_table, only: stress_table_type
   implicit none (type, external)
   private

   public :: largest_stress_table

   !> The ratio to the yield stress is that of the criterion in use.
   character(40), parameter :: columns(*) = [character(40) :: &
      'load[-]', 'body[-]', 'nu[-]', 'pbar_over_pstar[-]', &
      'largest_von_mises_over_pstar[-]', 'largest_von_mises_over_pstar_error[-]', &
      'largest_shear_over_pstar[-]', 'largest_shear_over_pstar_error[-]', &
      'stress_over_yield_stress[-]', 'stress_over_yield_stress_error[-]', 'mean_pressure[pressure]', &
      'largest_von_mises[pressure]', 'von_mises_x[length]', 'von_mises_y[length]', 'von_mises_depth[length]', &
      'largest_shear[pressure]', 'shear_x[length]', 'shear_y[length]', 'shear_depth[length]', &
      'status_code[-]', 'status[-]']

   type, extends(stress_table_type) :: largest_stress_table
   contains
      procedure, nopass :: key
      procedure, nopass :: meaning
      procedure :: needs_fields
      procedure, nopass :: write => write_largest_stress_table
   end type largest_stress_table

contains

   pure function key() result(words)
      character(:), allocatable :: words

      words = 'largest'
   end function key

   pure function meaning() result(words)
      character(:), allocatable :: words

      words = 'The largest von Mises stress and the largest shear stress of each load.'
   end function meaning

   !> The largest stresses are found before the tables are written.
   pure logical function needs_fields(self)
      class(largest_stress_table), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .false.
   end function needs_fields

   !> Errors: exit_file_trouble.
   subroutine write_largest_stress_table(results, error)
      type(results_type), intent(in) :: results
      type(error_type), allocatable, intent(out) :: error

      type(output_file) :: file
      integer :: body, load
      real(dp) :: ratio(2)

      call results%open_table('stress_largest', columns, file, in_blocks=.false.)
      do load = 1, size(results%loads)
         do body = 1, number_of_bodies(results)
            associate (scene => results%scene, setting => results%scene%stress_setting, &
                       solution => results%loads(load), yielding => results%von_mises(body, load), &
                       shear => results%shear(body, load))
               ratio = not_a_number()
               if (allocated(setting%yield_stress)) &
                  ratio = setting%over_yield_stress(body, [yielding%value, yielding%error], [shear%value, shear%error])
               call file%add(load)
               call file%add(body)
               call file%add([setting%body(body)%nu, solution%pbar_over_pstar, yielding%value, yielding%error, &
                              shear%value, shear%error, ratio, results%mean_pressure(load)])
               call put_largest(yielding)
               call put_largest(shear)
               call file%add(status_code(solution%status))
               call file%add(trim(status_name(solution%status)))
               call file%end_row()
            end associate
         end do
      end do
      call file%finish(error)

   contains

      !> Value and place in the deck's units.
      subroutine put_largest(largest)
         type(largest_stress), intent(in) :: largest

         associate (scene => results%scene, length => results%solver%surface%length, &
                    parts => results%solver%surface%parts())
            call file%add([scene%p_star*largest%value, [length, length(1)]*largest%place_in_cell(parts)])
         end associate
      end subroutine put_largest

   end subroutine write_largest_stress_table

end module wavycon_largest_stress_table
