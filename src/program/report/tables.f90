!> The list of all tables, and the tables with the numbers of each load. A new file of tables adds its line to
!> `all_tables`.
!>
!> <case>.summary.dat: mean gap, contact area, pressures, iterations, residual and status, a row for each load.
!> <case>.details.dat: numbers that the summary does not have, with error estimates, from solvers that compute them, a
!> row for each load. A load without details (no load, full contact, no solution) has NaN for these numbers and 0 for
!> the degree of the polynomials.
!> <case>.percolation.dat: the load that the key percolates of &load asks for, its error, and the last load before it.
!> <case>.coefficients.dat: the Fourier coefficients of the pressure, A_i of eq. (12) or A_ij of eq. (25), a block for
!> each load; j = 0 in 1-D.
module wavycon_tables
   use wavycon_bounds_tables, only: bounds_tables
   use wavycon_contact_solver, only: solver_traits
   use wavycon_fourier_series, only: fourier_series
   use wavycon_interface_tables, only: interface_tables
   use wavycon_kinds, only: dp
   use wavycon_line_tables, only: line_tables
   use wavycon_map_tables, only: map_tables
   use wavycon_output_file, only: output_file
   use wavycon_quantities, only: listed_columns
   use wavycon_results, only: results_type
   use wavycon_scene, only: scene_type
   use wavycon_spot_tables, only: spot_tables
   use wavycon_stress_tables, only: stress_tables
   use wavycon_surface, only: surface_type
   use wavycon_surface_tables, only: surface_tables
   use wavycon_table, only: table_type
   use wavycon_theory_tables, only: theory_tables
   implicit none (type, external)
   private

   public :: all_tables, requested_tables, summary_columns, summary_table

contains

   !> All tables, in the order in which they are written.
   subroutine all_tables(tables)
      type(table_type), allocatable, intent(out) :: tables(:)

      type(table_type), allocatable :: of_adhesion(:)
      integer :: i

      tables = [summary_tables(), line_tables(), map_tables(), spot_tables(), theory_tables(), surface_tables(), &
                stress_tables(), interface_tables(), bounds_tables()]
      ! The fields of the contact with adhesion get tables of their own, without keys, beside those without adhesion.
      ! Largest stresses are not among them: they are infinite at the edge.
      of_adhesion = pack(tables, tables%key == 'lines' .or. tables%key == 'map' .or. tables%key == 'contours' .or. &
                         (tables%group == 'stress' .and. tables%key /= 'largest'))
      do i = 1, size(of_adhesion)
         associate (table => of_adhesion(i))
            table%of_adhesion = .true.
            table%asked_by = [character(len(table%asked_by)) :: 'work_of_adhesion', &
                              trim(table%group)//'.'//trim(table%key)]
            table%group = 'interface'
            table%key = ''
            table%file = 'adhesion_'//trim(table%file)
            table%written_by_all => null()
         end associate
      end do
      tables = [tables, of_adhesion]
   end subroutine all_tables

   !> The tables that a scene asks for and that its solver and surface can have. A table with `asked_by` is left out
   !> silently if they cannot. A table with a key of its own that cannot be written was reported with the deck.
   subroutine requested_tables(scene, traits, surface, tables)
      type(scene_type), intent(in) :: scene
      type(solver_traits), intent(in) :: traits     !! of the solver
      type(surface_type), intent(in) :: surface
      type(table_type), allocatable, intent(out) :: tables(:)

      integer :: i

      call all_tables(tables)
      ! p* and Delta of a flat surface are zero.
      tables = pack(tables, (scene%p_star > 0.0_dp .or. .not. tables%needs_surface) .and. &
                    [(tables(i)%is_requested(scene), i=1, size(tables))])
      tables = pack(tables, [(tables(i)%refusal(traits, surface) == '', i=1, size(tables))])
   end subroutine requested_tables

   !> The tables with the numbers of each load.
   function summary_tables() result(tables)
      type(table_type) :: tables(4)

      tables(1) = summary_table()
      ! The energy is per nominal area. The perimeter is that of one contact spot or, once the spots have merged, of one
      ! open pool; the paper's cell has two of each.
      tables(2) = table_type('details', 'details', needs_fields=.true., &
         columns='load[#] pbar_over_pstar[-] '//listed_columns('details')//'status_code[#] status[word]', &
         meaning='Gaps at trough and saddle, strain energy, perimeter and the numbers of the '// &
         'summary, each with its error estimate.')
      tables(3) = table_type('coefficients', 'coefficients', put_load=put_coefficients, &
         columns='load[#] i[#] j[#] pressure_over_pstar[-]', &
         meaning='The Fourier coefficients of the pressure.')
      tables(4) = table_type('percolation', asked_by=[character(16) :: 'percolates', ''], group='load', &
         columns='load[#] last_before_over_pstar[-] percolation_over_pstar[-] percolation_over_pstar_error[-] '// &
         'last_before[pressure] percolation[pressure] percolation_error[pressure] contact_area_fraction[-] '// &
         'contact_area_fraction_error[-] status_code[#] status[word]')
   end function summary_tables

   !> The table <case>.summary.dat.
   type(table_type) function summary_table() result(table)
      table = table_type('summary', needs_surface=.false., columns=summary_columns())
   end function summary_table

   !> The columns of the summary. `results%number` gives the number of each column.
   pure function summary_columns() result(columns)
      character(:), allocatable :: columns

      columns = 'load[#] pbar_over_pstar[-] mean_gap_over_amplitude[-] approach_over_amplitude[-] '// &
         'contact_area_fraction[-] peak_pressure_over_pstar[-] min_pressure_over_pstar[-] '// &
         'mean_gap_over_amplitude_error[-] contact_area_fraction_error[-] peak_pressure_over_pstar_error[-] '// &
         'percolation_over_pstar_error[-] area_at_hardness_fraction[-] load_at_hardness_fraction[-] '// &
         'area_at_hardness_fraction_error[-] load_at_hardness_fraction_error[-] contact_area_counted_fraction[-] '// &
         'contact_area_corrected_fraction[-] linear_area_fraction[-] mean_pressure[pressure] force[force] '// &
         'mean_gap[length] mean_gap_error[length] approach[length] approach_error[length] contact_area[area] '// &
         'contact_area_error[area] peak_pressure[pressure] peak_pressure_error[pressure] '// &
         listed_columns('summary')//'active_constraints[#] iterations[#] residual[-] solver[word] '// &
         'status_code[#] status[word]'
   end function summary_columns

   !> Writes the block of a load: the Fourier coefficients of its pressure.
   subroutine put_coefficients(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(fourier_series) :: pressure
      integer :: i, j

      call results%begin_block(file, load)
      call results%loads(load)%coefficients(results%solver%surface, pressure)
      if (.not. allocated(pressure%c)) return
      do i = 0, ubound(pressure%c, 1)
         do j = 0, ubound(pressure%c, 2)
            if (i + j == 0) cycle
            call file%put_row([real(dp) :: load, i, j, pressure%c(i, j)])
         end do
      end do
   end subroutine put_coefficients

end module wavycon_tables
