!> The type that all tables of stresses extend: the group &stress requests them, and they need the fields of solutions.
module wavycon_stress_table
   use wavycon_table, only: table_type
   implicit none (type, external)
   private

   public :: stress_table_type

   type, abstract, extends(table_type) :: stress_table_type
   contains
      procedure, nopass :: group
      procedure :: needs_fields
   end type stress_table_type

contains

   pure function group() result(words)
      character(:), allocatable :: words

      words = 'stress'
   end function group

   pure logical function needs_fields(self)
      class(stress_table_type), intent(in) :: self

      associate (unused => self); end associate
      needs_fields = .true.
   end function needs_fields

end module wavycon_stress_table
