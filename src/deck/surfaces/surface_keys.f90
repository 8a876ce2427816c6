!> Keys that several kinds of surface read.
module wavycon_surface_keys
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: length_x_key, length_y_key

contains

   pure type(key_type) function length_x_key() result(key)
      key = real_key('length_x', '1.0', 'length', 'side of the periodic cell along x.', above=0.0_dp)
   end function length_x_key

   pure type(key_type) function length_y_key(meaning) result(key)
      character(*), intent(in), optional :: meaning   !! if it is not only the side of the cell

      key = real_key('length_y', 'length_x', 'length', 'side of the periodic cell along y.', above=0.0_dp)
      if (present(meaning)) key%meaning = meaning
   end function length_y_key

end module wavycon_surface_keys
