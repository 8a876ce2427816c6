!> The list of all tables. A new table adds its line to `all_tables`.
module wavycon_tables
   use wavycon_interface_tables, only: adhesion_table, interface_table, partial_slip_table, slip_loop_table
   use wavycon_line_tables, only: lines_table
   use wavycon_map_tables, only: map_table, slip_map_table
   use wavycon_plain_text, only: listed
   use wavycon_spot_tables, only: contour_table, histogram_table, spot_sizes_table, spots_table
   use wavycon_stress_tables, only: largest_stress_table, stress_line_table, stress_planes_table, stress_section_table
   use wavycon_summary_tables, only: coefficients_table, details_table, summary_table
   use wavycon_surface_tables, only: height_table, spectrum_table
   use wavycon_table, only: table_type
   use wavycon_theory_tables, only: theory_lines_table, theory_table
   implicit none (type, external)
   private

   public :: add_table, all_tables, find_table

contains

   !> All tables, in the order in which they are written. A new table adds its line here.
   subroutine all_tables(tables)
      type(table_type), allocatable, intent(out) :: tables(:)

      allocate (tables(0))
      call add_table(tables, summary_table())
      call add_table(tables, lines_table())
      call add_table(tables, map_table())
      call add_table(tables, contour_table())
      call add_table(tables, spots_table())
      call add_table(tables, spot_sizes_table())
      call add_table(tables, histogram_table())
      call add_table(tables, coefficients_table())
      call add_table(tables, theory_table())
      call add_table(tables, theory_lines_table())
      call add_table(tables, details_table())
      call add_table(tables, spectrum_table())
      call add_table(tables, height_table())
      call add_table(tables, largest_stress_table())
      call add_table(tables, stress_line_table())
      call add_table(tables, stress_section_table())
      call add_table(tables, stress_planes_table())
      call add_table(tables, interface_table())
      call add_table(tables, partial_slip_table())
      call add_table(tables, slip_loop_table())
      call add_table(tables, slip_map_table())
      call add_table(tables, adhesion_table())
   end subroutine all_tables

   !> The table of a name; not allocated if there is none.
   subroutine find_table(name, table, names)
      character(*), intent(in) :: name
      type(table_type), allocatable, intent(out) :: table
      character(:), allocatable, intent(out) :: names   !! of all tables, such as 'summary, lines and map'

      type(table_type), allocatable :: tables(:)
      integer :: i

      call all_tables(tables)
      names = listed(tables%name(), ' and ')
      i = findloc(tables%name() == name, .true., dim=1)
      if (i > 0) allocate (table, source=tables(i))
   end subroutine find_table

   !> Adds a table to a list.
   subroutine add_table(tables, table)
      type(table_type), allocatable, intent(inout) :: tables(:)
      type(table_type), intent(in) :: table

      type(table_type), allocatable :: longer(:)

      allocate (longer(size(tables) + 1))
      longer(:size(tables)) = tables
      longer(size(longer)) = table
      call move_alloc(longer, tables)
   end subroutine add_table

end module wavycon_tables
