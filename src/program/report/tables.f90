!> The list of all tables. A new file of tables adds its line to `all_tables`.
module wavycon_tables
   use wavycon_interface_tables, only: interface_tables
   use wavycon_line_tables, only: line_tables
   use wavycon_map_tables, only: map_tables
   use wavycon_spot_tables, only: spot_tables
   use wavycon_stress_tables, only: stress_tables
   use wavycon_summary_tables, only: summary_tables
   use wavycon_surface_tables, only: surface_tables
   use wavycon_table, only: table_type
   use wavycon_theory_tables, only: theory_tables
   implicit none (type, external)
   private

   public :: all_tables

contains

   !> All tables, in the order in which they are written.
   subroutine all_tables(tables)
      type(table_type), allocatable, intent(out) :: tables(:)

      tables = [summary_tables(), line_tables(), map_tables(), spot_tables(), theory_tables(), surface_tables(), &
                stress_tables(), interface_tables()]
   end subroutine all_tables

end module wavycon_tables
