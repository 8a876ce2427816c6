!> The list of all tables. A new file of tables adds its line to `all_tables`.
module wavycon_tables
   use wavycon_interface_tables, only: add_interface_tables
   use wavycon_line_tables, only: add_line_tables
   use wavycon_map_tables, only: add_map_tables
   use wavycon_plain_text, only: listed
   use wavycon_spot_tables, only: add_spot_tables
   use wavycon_stress_tables, only: add_stress_tables
   use wavycon_summary_tables, only: add_summary_tables
   use wavycon_surface_tables, only: add_surface_tables
   use wavycon_table, only: table_type
   use wavycon_theory_tables, only: add_theory_tables
   implicit none (type, external)
   private

   public :: all_tables, find_table

contains

   !> All tables, in the order in which they are written.
   subroutine all_tables(tables)
      type(table_type), allocatable, intent(out) :: tables(:)

      allocate (tables(0))
      call add_summary_tables(tables)
      call add_line_tables(tables)
      call add_map_tables(tables)
      call add_spot_tables(tables)
      call add_theory_tables(tables)
      call add_surface_tables(tables)
      call add_stress_tables(tables)
      call add_interface_tables(tables)
   end subroutine all_tables

   !> The table of a name; not allocated if there is none.
   subroutine find_table(name, table, names)
      character(*), intent(in) :: name
      type(table_type), allocatable, intent(out) :: table
      character(:), allocatable, intent(out) :: names   !! of all tables, such as 'summary, details and lines'

      type(table_type), allocatable :: tables(:)
      integer :: i

      call all_tables(tables)
      names = listed(tables%name(), ' and ')
      i = findloc(tables%name() == name, .true., dim=1)
      if (i > 0) allocate (table, source=tables(i))
   end subroutine find_table

end module wavycon_tables
