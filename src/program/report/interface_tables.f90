!> Tables of the properties of the interface. Equations (I..) are those of src/beyond/README.md.
!>
!> <case>.interface.dat: contact stiffness and resistance, and how mean gap and contact area change with the load.
!> <case>.partial_slip.dat: stick area, tangential displacement and energy lost in a cycle, a row for each load and
!> tangential load.
!> <case>.slip_loop.dat: tangential load against displacement, a block for each load and tangential load.
!> <case>.adhesion.dat: the contact with adhesion in three blocks: the curve of load and approach against area;
!> pull-off, jumps and ends of branches; the loads.
module wavycon_interface_tables
   use wavycon_adhesive_contact, only: adhesive_point, at_approach, at_load, closed, not_solved, &
      point_names, separated
   use wavycon_kinds, only: dp, not_a_number
   use wavycon_output_file, only: output_file
   use wavycon_partial_slip, only: cycle_energy, relative_displacement
   use wavycon_plain_text, only: exact_number, integer_text
   use wavycon_quantities, only: area_slope, contact_area, gap_curvature, gap_slope, is_known, or_nan, quantities
   use wavycon_results, only: results_type
   use wavycon_solution_record, only: no_load, status_code, status_name
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: interface_tables

contains

   !> The tables of this file.
   function interface_tables() result(tables)
      type(table_type) :: tables(4)

      tables(1) = table_type('interface', group='interface', needs_fields=.true., needs_slopes=.true., &
         put_load=put_interface, &
         columns='load[#] pbar_over_pstar[-] mean_pressure[pressure] '// &
         'contact_stiffness[pressure/length] contact_stiffness_error[pressure/length] '// &
         'contact_stiffness_normalised[-] contact_stiffness_normalised_error[-] contact_area_slope[-] '// &
         'contact_area_slope_error[-] mean_gap_curvature[-] mean_gap_curvature_error[-] '// &
         'contact_resistance[resistivity*length] contact_resistance_error[resistivity*length] status_code[#] '// &
         'status[word]')
      tables(2) = table_type('partial_slip', group='interface', asked_by=[character(16) :: 'friction', ''], &
         needs_fields=.true., needs_slopes=.true., put_load=put_slip, &
         columns='load[#] tangential[#] mean_pressure[pressure] tangential_load[pressure] '// &
         'tangential_over_limit[-] stick_pbar_over_pstar[-] contact_area_fraction[-] stick_area_fraction[-] '// &
         'stick_area_error[-] displacement[length] displacement_error[length] least_displacement[length] '// &
         'most_displacement[length] tangential_stiffness[pressure/length] cycle_energy[pressure*length] '// &
         'cycle_energy_error[pressure*length] status_code[#] status[word]')
      tables(3) = table_type('slip_loop', 'slip_loop', 'interface', put_load=put_loop, &
         columns='load[#] tangential[#] branch[#] tangential_load[pressure] displacement[length]')
      tables(4) = table_type('adhesion', group='interface', asked_by=[character(16) :: 'work_of_adhesion', &
         ''], needs_fields=.true., blocks=3, put_load=put_adhesion, &
         columns='load[#] contact_area_fraction[-] contact_area_fraction_error[-] contact_area[area] '// &
         'pbar_over_pstar[-] pbar_over_pstar_error[-] mean_pressure[pressure] force[force] '// &
         'mean_gap_over_amplitude[-] mean_gap_over_amplitude_error[-] approach[length] '// &
         'elastic_energy_per_area[pressure*length] elastic_energy_per_area_error[pressure*length] '// &
         'surface_energy_per_area[pressure*length] branch[word] point[word] status_code[#] status[word]')
   end function interface_tables

   !> Writes the row of a load. The contact stiffness is -1/G' [p*/Delta], with the slope G' of the mean gap against the
   !> mean pressure. It is zero without load and infinite in full contact, where the table has NaN. The resistance of a
   !> nominal area follows from G' by (I8).
   subroutine put_interface(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      real(dp) :: resistance(2), stiffness(2)

      associate (solution => results%loads(load), slopes => results%slopes(load), &
                 surface => results%solver%surface, scene => results%scene)
         stiffness = not_a_number()
         resistance = not_a_number()
         if (solution%status == no_load) then
            stiffness = 0.0_dp
         else if (solution%has_numbers()) then
            associate (slope => slopes%value(gap_slope), error => or_nan(slopes%error(gap_slope)))
               if (slope < 0.0_dp) stiffness = [-1.0_dp, error/slope]/slope
               if (scene%interface_setting%resistivity > 0.0_dp .and. is_known(slope)) resistance = &
                  scene%interface_setting%resistivity*(0.5_dp*scene%e_star/scene%p_star*surface%amplitude) &
                  *[abs(slope), error]
            end associate
         end if
         call file%put_row([real(dp) :: load, results%in_p_star(solution%pbar_over_pstar), &
                            results%mean_pressure(load), stiffness*scene%p_star/surface%amplitude, &
                            results%in_p_star([stiffness, or_nan([slopes%value(area_slope), slopes%error(area_slope), &
                                               slopes%value(gap_curvature), slopes%error(gap_curvature)])]), &
                            resistance, status_code(solution%status)], [status_name(solution%status)])
      end associate
   end subroutine put_interface

   !> Writes the rows of a load, one for each tangential load. The tangential stiffness is that of a further increase of
   !> the tangential load.
   subroutine put_slip(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      type(quantities) :: stick_slopes   ! derivatives at the mean pressure P* of the stick contact
      integer :: i
      real(dp) :: displacement(2), energy(2), over_limit, stiffness
      real(dp) :: of_stick(3)   ! stick contact: mean pressure [p*], area fraction and its error

      associate (solution => results%loads(load), setting => results%scene%interface_setting, &
                 p_star => results%scene%p_star, amplitude => results%solver%surface%amplitude)
         do i = 1, size(results%slip, 1)
            associate (slip => results%slip(i, load), stick => results%slip(i, load)%stick)
               stiffness = not_a_number()
               displacement = not_a_number()
               energy = not_a_number()
               of_stick = not_a_number()
               over_limit = not_a_number()
               if (solution%pbar_over_pstar > 0.0_dp) &
                  over_limit = slip%tangential/(setting%friction*solution%pbar_over_pstar)
               if (stick%has_numbers()) then
                  of_stick = [results%in_p_star(stick%pbar_over_pstar), stick%value(contact_area), &
                              or_nan(stick%error(contact_area))]
                  displacement = setting%friction*amplitude*or_nan(relative_displacement(solution, stick))
                  call stick%derivatives(results%solver%surface, stick_slopes)
                  if (results%traits%has_errors) then
                     energy = setting%kappa(1)*setting%friction**2*p_star*amplitude* &
                              or_nan(cycle_energy(solution, stick, [results%slopes(load), stick_slopes]))
                  else
                     of_stick(3) = not_a_number()
                     displacement(2) = not_a_number()
                  end if
                  associate (slope => stick_slopes%value(gap_slope))
                     if (slope < 0.0_dp) stiffness = -p_star/(setting%kappa(1)*amplitude*slope)
                  end associate
               end if
               call file%put_row([real(dp) :: load, i, results%mean_pressure(load), p_star*slip%tangential, &
                                  over_limit, of_stick(1), solution%value(contact_area), of_stick(2:), &
                                  setting%kappa(1)*displacement, setting%kappa(2:)*displacement(1), stiffness, &
                                  energy, status_code(slip%status)], [status_name(slip%status)])
            end associate
         end do
      end associate
   end subroutine put_slip

   !> Writes the blocks of a load, one for each tangential load Q, with three branches. Branch 1 is the loading from 0
   !> to Q, which is solved. Branch 2, from Q to -Q, and branch 3, back to Q, follow from it by Masing's rule: the same
   !> curve at twice the size.
   subroutine put_loop(results, load, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: load
      type(output_file), intent(inout) :: file

      real(dp) :: point(2)   !! tangential load [p*], displacement divided by kappa f [Delta]
      integer :: branch, i, k

      associate (setting => results%scene%interface_setting, p_star => results%scene%p_star, &
                 amplitude => results%solver%surface%amplitude)
         do i = 1, size(results%slip, 1)
            associate (slip => results%slip(i, load))
               call file%begin_block('load '//integer_text(load)//', tangential load '//integer_text(i)//': '// &
                                     exact_number(p_star*slip%tangential))
               if (.not. allocated(slip%approach_change)) cycle
               associate (n => size(slip%approach_change), u => slip%approach_change)
                  do branch = 1, 3
                     do k = 1, n
                        point = [slip%tangential*(k - 1)/(n - 1), u(k)]
                        if (branch == 2) point = [slip%tangential, u(n)] - 2*point
                        if (branch == 3) point = 2*point - [slip%tangential, u(n)]
                        call file%put_row([real(dp) :: load, i, branch, &
                                           point*[p_star, setting%kappa(1)*setting%friction*amplitude]])
                     end do
                  end do
               end associate
            end associate
         end do
      end associate
   end subroutine put_loop

   !> Writes a block of the table of adhesion: 1 is the curve, 2 its critical points, 3 the contacts at the loads.
   subroutine put_adhesion(results, block, file)
      type(results_type), intent(in) :: results
      integer, intent(in) :: block
      type(output_file), intent(inout) :: file

      character(*), parameter :: titles(3) = &
         [character(64) :: 'the curve, by the contact area', 'pull-off, jumps, and where a branch ends', &
          'the loads: stable and unstable contacts']
      type(adhesive_point), allocatable :: points(:)
      character(len(point_names)) :: words(3)
      integer :: i
      real(dp) :: mean_pressure

      call file%begin_block(trim(titles(block)))
      allocate (points, source=results%adhesion%at_loads)
      if (block == 1) points = results%adhesion%points
      if (block == 2) points = results%adhesion%critical
      associate (surface => results%solver%surface, p_star => results%scene%p_star)
         do i = 1, size(points)
            associate (point => points(i))
               mean_pressure = p_star*or_nan(point%value(at_load))
               words = [character(len(words)) :: 'spots', point_names(point%kind), status_name(point%status)]
               if (point%pools) words(1) = 'pools'
               if (any(point%kind == [separated, closed, not_solved])) words(1) = 'none'
               call file%put_row( &
                  [real(dp) :: point%number, point%area, or_nan(point%area_error), surface%nominal_area()*point%area, &
                   results%in_p_star(or_nan([point%value(at_load), point%error(at_load)])), mean_pressure, &
                   mean_pressure*surface%nominal_area(), &
                   results%in_p_star([1.0_dp - or_nan(point%value(at_approach)), or_nan(point%error(at_approach))]), &
                   surface%amplitude*[or_nan(point%value(at_approach)), &
                                      p_star*or_nan([point%energy, point%energy_error]), &
                                      -p_star*results%scene%interface_setting%work*point%area], &
                   status_code(point%status)], &
                  words)
            end associate
         end do
      end associate
   end subroutine put_adhesion

end module wavycon_interface_tables
