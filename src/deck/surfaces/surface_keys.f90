!> Keys of &surface that several kinds of surface read.
module wavycon_surface_keys
   use wavycon_group_values, only: group_values
   use wavycon_key_table, only: key_type, real_key
   use wavycon_kinds, only: dp
   implicit none (type, external)
   private

   public :: form_radius_keys, length_x_key, length_y_key, radii_of, radius_keys

contains

   pure type(key_type) function length_x_key() result(key)
      key = real_key('length_x', '1.0', 'length', 'side of the periodic cell along x.', above=0.0_dp)
   end function length_x_key

   pure type(key_type) function length_y_key(meaning) result(key)
      character(*), intent(in), optional :: meaning   !! if it is not only the side of the cell

      key = real_key('length_y', 'length_x', 'length', 'side of the periodic cell along y.', above=0.0_dp)
      if (present(meaning)) key%meaning = meaning
   end function length_y_key

   !> The radii of a ball, by the name of the first key.
   pure function radius_keys(name, of_what, tens, needs, required) result(keys)
      character(*), intent(in) :: name, of_what
      integer, intent(in) :: tens               !! of their ways
      character(*), intent(in) :: needs         !! of each
      logical, intent(in) :: required           !! whether one or two must be given
      type(key_type) :: keys(3)

      keys(1) = real_key(name, '', 'length', 'radius of '//of_what//'.', above=0.0_dp, required=required, &
                         way=tens, needs=needs)
      keys(2) = real_key(name//'_x', '', 'length', 'radius of curvature along x of '//of_what//'.', above=0.0_dp, &
                         way=tens + 1, needs=trim(name//'_y '//needs))
      keys(3) = real_key(name//'_y', '', 'length', 'radius of curvature along y.', above=0.0_dp, way=tens + 1, &
                         needs=trim(name//'_x '//needs))
   end function radius_keys

   !> Those of the ball that a map with free edges lies on.
   pure function form_radius_keys(what) result(keys)
      character(*), intent(in) :: what   !! lies on it
      type(key_type) :: keys(3)

      keys = radius_keys('form_radius', 'a ball that '//what//" lies on, with edges = 'free'", 30, "edges='free'", &
                         required=.false.)
   end function form_radius_keys

   !> The radii along x and y that these keys give [length]; huge where they give none.
   pure function radii_of(values, name) result(radii)
      type(group_values), intent(in) :: values
      character(*), intent(in) :: name
      real(dp) :: radii(2)

      radii = huge(radii)
      if (values%has(name)) radii = values%real(name)
      if (values%has(name//'_x')) radii(1) = values%real(name//'_x')
      if (values%has(name//'_y')) radii(2) = values%real(name//'_y')
   end function radii_of

end module wavycon_surface_keys
