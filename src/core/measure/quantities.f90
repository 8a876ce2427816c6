!> The quantities of a solution: the one list of them, and the record of their values and errors that solvers fill and
!> that tables, log, searches and checkpoints read.
!>
!> A further quantity is a number and a row of the list here, and an assignment in a solver: src/README.md.
module wavycon_quantities
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use wavycon_assertion, only: assert
   use wavycon_kinds, only: dp
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: find_quantity, is_known, known_errors, listed_columns, or_nan, scaled

   !> Stands for a number that is not known, and exceeds every accuracy. Not NaN, whose comparisons Debug builds trap:
   !> `or_nan` makes it NaN for the user. Its powers in estimates of errors are finite.
   real(dp), parameter, public :: unknown = 1e30_dp

   !> Mean gap G [Delta]: eqs. (19), (28). Approach of the mean planes of the elastic bodies, delta'/Delta: 1 - G, plus
   !> the mean residual indentation (C22) if there is a hardness; its error is that of the mean gap, which with free
   !> edges is that of the approach. Contact area over the nominal area: 1 by definition from P = 1 on. Largest pressure
   !> [p*], `unknown` where it is infinite, and smallest pressure, which is negative between the points of a series.
   integer, parameter, public :: mean_gap = 1, approach = 2, contact_area = 3, peak_pressure = 4, min_pressure = 5
   !> Where the pressure is the hardness: fractions of the nominal area and of the load.
   integer, parameter, public :: area_at_hardness = 6, load_at_hardness = 7
   !> On a grid: the points in contact over all points, and this area corrected by (C26) of src/core/contact/README.md,
   !> which is for surfaces alone.
   integer, parameter, public :: contact_area_counted = 8, contact_area_corrected = 9
   !> Elastic energy per nominal area, the mean of p u/2 [p* Delta].
   integer, parameter, public :: elastic_energy = 10
   !> Gap at a trough [Delta]; gap and pressure at the saddle between nearest crests, where spots merge first; length of
   !> the edge of one contact spot or, once the spots have merged, of one closed pool [length]; degree of the
   !> polynomials. Collocation has them, if it keeps its fields.
   integer, parameter, public :: trough_gap = 11, saddle_gap = 12, saddle_pressure = 13, perimeter = 14, &
      polynomial_degree = 15
   !> load_concentration of wavycon_grid_area, of a light contact on a height map, and with free edges the part of the
   !> load that lies within `border` sides of the border; otherwise 0.
   integer, parameter, public :: concentrated_load = 16, border_load = 17
   !> How a solution changes with the load, of `contact_solution%derivatives`: G'(P) <= 0 [Delta/p*], A'(P) of the area
   !> fraction [1/p*], G''(P) >= 0 [Delta/p*^2]. src/beyond/README.md derives what follows from them.
   integer, parameter, public :: gap_slope = 18, area_slope = 19, gap_curvature = 20
   integer, parameter, public :: number_of_quantities = 20

   !> Kinds of quantities: a column of tables has the quantity's name and what is below, and no unit, or its name alone,
   !> and the unit.
   integer, parameter, public :: of_length = 1, of_pressure = 2, of_area = 3, of_energy = 4, of_load = 5, &
      in_length = 6, of_count = 7, number_of_kinds = 7
   character(*), parameter :: behind_name(number_of_kinds) = [character(21) :: '_over_amplitude', '_over_pstar', &
      '_fraction', '_over_pstar_amplitude', '_fraction', '', '']
   character(*), parameter :: units(number_of_kinds) = [character(12) :: 'length', 'pressure', 'area', 'force*length', &
      '-', 'length', '#']

   type :: quantity_type
      integer :: number                  !! one of the names above
      character(22) :: name              !! in tables
      integer :: kind                    !! one of the kinds above
      character(16) :: listed_in = ''    !! tables in which its columns have no place but that in the list
   end type quantity_type

   !> Those that tables have.
   type(quantity_type), parameter, public :: quantity_list(*) = [ &
      quantity_type(mean_gap, 'mean_gap', of_length, 'details'), &
      quantity_type(approach, 'approach', of_length), &
      quantity_type(contact_area, 'contact_area', of_area, 'details'), &
      quantity_type(peak_pressure, 'peak_pressure', of_pressure, 'details'), &
      quantity_type(min_pressure, 'min_pressure', of_pressure), &
      quantity_type(area_at_hardness, 'area_at_hardness', of_area), &
      quantity_type(load_at_hardness, 'load_at_hardness', of_load), &
      quantity_type(contact_area_counted, 'contact_area_counted', of_area), &
      quantity_type(contact_area_corrected, 'contact_area_corrected', of_area), &
      quantity_type(trough_gap, 'trough_gap', of_length, 'details'), &
      quantity_type(saddle_gap, 'saddle_gap', of_length, 'details'), &
      quantity_type(saddle_pressure, 'saddle_pressure', of_pressure, 'details'), &
      quantity_type(elastic_energy, 'elastic_energy', of_energy, 'summary details'), &
      quantity_type(perimeter, 'perimeter', in_length, 'details'), &
      quantity_type(polynomial_degree, 'degree', of_count, 'details')]

   !> The three that every solver computes, to its accuracy.
   integer, parameter, public :: main_quantities(3) = [mean_gap, contact_area, peak_pressure]
   !> Those that are known without load: zeros, but for the gap.
   integer, parameter :: without_load(*) = [main_quantities, approach, min_pressure, area_at_hardness, &
      load_at_hardness, concentrated_load, border_load, polynomial_degree]
   integer :: i
   real(dp), parameter :: &
      initial_error(*) = [(merge(0.0_dp, unknown, any(i == without_load)), i=1, number_of_quantities)], &
      initial_value(*) = [(merge(1.0_dp, initial_error(i), i == mean_gap), i=1, number_of_quantities)]

   !> The record. Without a solver it is that of no load.
   type, public :: quantities
      real(dp) :: value(number_of_quantities) = initial_value   !! by the numbers above, or `unknown`
      real(dp) :: error(number_of_quantities) = initial_error   !! their error estimates, or `unknown`
   contains
      procedure :: main_values
      procedure :: are_resolved
   end type quantities

contains

   !> Whether a number is not `unknown`.
   elemental logical function is_known(number)
      real(dp), intent(in) :: number

      is_known = number < unknown
   end function is_known

   !> A number times a factor, which is unknown if the number is: a product with a small factor would pass for known.
   elemental real(dp) function scaled(number, factor)
      real(dp), intent(in) :: number, factor

      scaled = unknown
      if (is_known(number)) scaled = factor*number
   end function scaled

   !> A number for the user: NaN if it is unknown.
   elemental real(dp) function or_nan(number)
      real(dp), intent(in) :: number

      or_nan = number
      if (.not. is_known(number)) or_nan = ieee_value(1.0_dp, ieee_quiet_nan)
   end function or_nan

   !> Error estimates of mean gap [Delta], contact area fraction and peak pressure [p*], unknown where an estimate is
   !> no smaller than the largest error that the value can have, and so says nothing: gap and area lie between zero and
   !> one, the peak is below that of just full contact.
   pure function known_errors(estimates, largest) result(errors)
      real(dp), intent(in) :: estimates(3)
      real(dp), intent(in) :: largest   !! p - P in full contact [p*], of the waves of the paper 1
      real(dp) :: errors(3)

      errors = merge(estimates, unknown, estimates < [1.0_dp, 1.0_dp, 1.0_dp + largest])
   end function known_errors

   !> What the errors of the main quantities are of: mean gap, with free edges in 2-D the approach, contact area and
   !> peak pressure.
   pure function main_values(self, surface) result(values)
      class(quantities), intent(in) :: self
      type(surface_type), intent(in) :: surface   !! that was solved
      real(dp) :: values(3)

      values = self%value(main_quantities)
      if (surface%has_free_edges .and. surface%dimension == 2) values(1) = self%value(approach)
   end function main_values

   !> Whether these values are exact, larger than their error estimates, or do not exist.
   pure function are_resolved(self, surface)
      class(quantities), intent(in) :: self
      type(surface_type), intent(in) :: surface   !! that was solved
      logical :: are_resolved(3)

      associate (errors => self%error(main_quantities), values => self%main_values(surface))
         are_resolved = errors < values .or. errors <= 0.0_dp .or. .not. is_known(values)
      end associate
   end function are_resolved

   !> The quantity that a column of tables has.
   pure subroutine find_quantity(name, quantity, kind, is_error, in_unit)
      character(*), intent(in) :: name        !! of the column, which has a quantity
      integer, intent(out) :: quantity        !! one of the names above
      integer, intent(out) :: kind            !! of it, one of the kinds above
      logical, intent(out) :: is_error        !! whether the column is that of its error
      logical, intent(out) :: in_unit         !! whether it is in the deck's units

      character(len(name)) :: of_value
      integer :: i, length
      type(quantity_type) :: listed

      of_value = name
      is_error = index(name//' ', '_error ') > 0
      if (is_error) of_value = name(:index(name, '_error', back=.true.) - 1)
      quantity = 0
      do i = 1, size(quantity_list)
         listed = quantity_list(i)
         length = len_trim(listed%name)
         if (index(of_value, listed%name(:length)) /= 1) cycle
         in_unit = of_value(length + 1:) == ''
         if (.not. in_unit .and. of_value(length + 1:) /= behind_name(listed%kind)) cycle
         quantity = listed%number
         kind = listed%kind
         exit
      end do
      call assert(quantity > 0, 'a column of the list: '//name)
   end subroutine find_quantity

   !> The columns that a table has of its quantities at the place that the list gives them, as name[unit] with a blank
   !> behind each: value and error without a unit and, in the summary, in the deck's units.
   pure function listed_columns(table) result(columns)
      character(*), intent(in) :: table
      character(:), allocatable :: columns

      character(:), allocatable :: name, unit
      integer :: i
      type(quantity_type) :: listed

      columns = ''
      do i = 1, size(quantity_list)
         listed = quantity_list(i)
         if (index(listed%listed_in, table) == 0) cycle
         name = trim(listed%name)//trim(behind_name(listed%kind))
         unit = '['//trim(units(listed%kind))//'] '
         if (name /= listed%name) columns = columns//name//'[-] '//name//'_error[-] '
         if (name /= listed%name .and. (table == 'details' .or. unit == '[-] ')) cycle
         columns = columns//trim(listed%name)//unit
         if (listed%kind /= of_count) columns = columns//trim(listed%name)//'_error'//unit
      end do
   end function listed_columns

end module wavycon_quantities
