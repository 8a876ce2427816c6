!> The list of all tables. A new table adds its line to `all_tables`.
module wavycon_tables
   use wavycon_coefficients_table, only: coefficients_table
   use wavycon_contour_table, only: contour_table
   use wavycon_details_table, only: details_table
   use wavycon_height_table, only: height_table
   use wavycon_histogram_table, only: histogram_table
   use wavycon_largest_stress_table, only: largest_stress_table
   use wavycon_lines_table, only: lines_table
   use wavycon_map_table, only: map_table
   use wavycon_spectrum_table, only: spectrum_table
   use wavycon_spot_sizes_table, only: spot_sizes_table
   use wavycon_spots_table, only: spots_table
   use wavycon_stress_line_table, only: stress_line_table
   use wavycon_stress_planes_table, only: stress_planes_table
   use wavycon_stress_section_table, only: stress_section_table
   use wavycon_summary_table, only: summary_table
   use wavycon_table, only: table_type
   use wavycon_theory_lines_table, only: theory_lines_table
   use wavycon_theory_table, only: theory_table
   implicit none (type, external)
   private

   public :: all_tables, find_table, table_item

   type :: table_item
      class(table_type), allocatable :: table
   end type table_item

contains

   !> All tables, in the order in which they are written. A new table adds its line here.
   subroutine all_tables(tables)
      type(table_item), allocatable, intent(out) :: tables(:)

      allocate (tables(0))
      call add(tables, summary_table())
      call add(tables, lines_table())
      call add(tables, map_table())
      call add(tables, contour_table())
      call add(tables, spots_table())
      call add(tables, spot_sizes_table())
      call add(tables, histogram_table())
      call add(tables, coefficients_table())
      call add(tables, theory_table())
      call add(tables, theory_lines_table())
      call add(tables, details_table())
      call add(tables, spectrum_table())
      call add(tables, height_table())
      call add(tables, largest_stress_table())
      call add(tables, stress_line_table())
      call add(tables, stress_section_table())
      call add(tables, stress_planes_table())
   end subroutine all_tables

   !> The table of a name; not allocated if there is none.
   subroutine find_table(name, table, names)
      character(*), intent(in) :: name
      class(table_type), allocatable, intent(out) :: table
      character(:), allocatable, intent(out) :: names   !! of all tables, such as 'summary, lines and map'

      type(table_item), allocatable :: tables(:)
      integer :: i

      call all_tables(tables)
      names = ''
      do i = 1, size(tables)
         if (i > 1) names = names//trim(merge(' and', ',   ', i == size(tables)))//' '
         names = names//tables(i)%table%name()
         if (tables(i)%table%name() == name) allocate (table, source=tables(i)%table)
      end do
   end subroutine find_table

   subroutine add(tables, table)
      type(table_item), allocatable, intent(inout) :: tables(:)
      class(table_type), intent(in) :: table

      type(table_item), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(tables) + 1))
      do i = 1, size(tables)
         call move_alloc(tables(i)%table, longer(i)%table)
      end do
      allocate (longer(size(longer))%table, source=table)
      call move_alloc(longer, tables)
   end subroutine add

end module wavycon_tables
