!> The columns of tables are declared as name[unit].
module wavycon_column_text
   implicit none (type, external)
   private

   public :: column_name, column_unit

contains

   !> The name in name[unit].
   elemental function column_name(column) result(name)
      character(*), intent(in) :: column
      character(len(column)) :: name

      name = column(:index(column, '[') - 1)
   end function column_name

   !> The unit in name[unit].
   elemental function column_unit(column) result(unit)
      character(*), intent(in) :: column
      character(len(column)) :: unit

      unit = column(index(column, '[') + 1:index(column, ']') - 1)
   end function column_unit

end module wavycon_column_text
