!> The list of all tables. A new table adds its line to `all_tables`.
module wavycon_tables
   use wavycon_coefficients_table, only: coefficients_table
   use wavycon_contour_table, only: contour_table
   use wavycon_details_table, only: details_table
   use wavycon_lines_table, only: lines_table
   use wavycon_map_table, only: map_table
   use wavycon_summary_table, only: summary_table
   use wavycon_table, only: table_type
   use wavycon_theory_table, only: theory_table
   implicit none (type, external)
   private

   public :: all_tables, table_item

   type :: table_item
      class(table_type), allocatable :: table
   end type table_item

contains

   !> All tables, in the order in which they are written.
   subroutine all_tables(tables)
      type(table_item), allocatable, intent(out) :: tables(:)

      allocate (tables(7))
      allocate (summary_table :: tables(1)%table)
      allocate (lines_table :: tables(2)%table)
      allocate (map_table :: tables(3)%table)
      allocate (contour_table :: tables(4)%table)
      allocate (coefficients_table :: tables(5)%table)
      allocate (theory_table :: tables(6)%table)
      allocate (details_table :: tables(7)%table)
   end subroutine all_tables

end module wavycon_tables
