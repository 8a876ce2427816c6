!> The quantities of a solution: the only list of them, and the record of their values and errors. Solvers fill the
!> record; tables, log, searches and checkpoints read it.
!>
!> A new quantity takes a number and a row of the list here, and an assignment in a solver: src/README.md, "A quantity".
module wavycon_quantities
   use wavycon_assertion, only: assert
   use wavycon_kinds, only: dp, not_a_number
   use wavycon_surface, only: surface_type
   implicit none (type, external)
   private

   public :: find_quantity, is_known, known_errors, listed_columns, or_nan, scaled

   !> This number stands for a value that is not known. It is larger than every accuracy. It is not NaN, because Debug
   !> builds trap comparisons with NaN: `or_nan` makes NaN of it for the user. Its powers in estimates of errors are
   !> finite.
   real(dp), parameter, public :: unknown = 1e30_dp

   !> `mean_gap`: G [Delta], eqs. (19), (28). `approach`: approach of the mean planes of the elastic bodies,
   !> delta'/Delta = 1 - G, plus the mean residual indentation (C22) if there is a hardness, whose error adds to that of
   !> the mean gap. Otherwise the errors of both are equal; with free edges in 2-D they are that of the approach, else
   !> that of the mean gap. `contact_area`: over the nominal area; by definition 1 for P >= 1. `peak_pressure`: largest
   !> pressure [p*], `unknown` where it is infinite. `min_pressure`: smallest pressure [p*]; that of a series is
   !> negative between its points.
   integer, parameter, public :: mean_gap = 1, approach = 2, contact_area = 3, peak_pressure = 4, min_pressure = 5
   !> Of the area where the pressure is the hardness: its fraction of the nominal area, and its fraction of the load.
   integer, parameter, public :: area_at_hardness = 6, load_at_hardness = 7
   !> On a grid: the number of points in contact over the number of points; the same corrected by (C26) of
   !> src/core/contact/README.md, in 2-D only.
   integer, parameter, public :: contact_area_counted = 8, contact_area_corrected = 9
   !> Elastic energy per nominal area, the mean of p u/2 [p* Delta].
   integer, parameter, public :: elastic_energy = 10
   !> Gap at a trough [Delta]; gap [Delta] and pressure [p*] at the saddle between nearest crests, where spots merge
   !> first; length of the edge of one contact spot or, once the spots have merged, of one closed pool [length]; degree
   !> of the polynomials. Only collocation fitted to the edge sets these, and only if it keeps its fields.
   integer, parameter, public :: trough_gap = 11, saddle_gap = 12, saddle_pressure = 13, perimeter = 14, &
      polynomial_degree = 15
   !> `load_concentration` of wavycon_grid_area, for a light contact on a height map; with free edges, the part of the
   !> load that lies within `border` sides of the border of the map. Otherwise both are 0.
   integer, parameter, public :: concentrated_load = 16, border_load = 17
   !> Derivatives by the load, from `contact_solution%derivatives`: G'(P) <= 0 [Delta/p*], A'(P) of the area fraction
   !> [1/p*], G''(P) >= 0 [Delta/p*^2]. src/beyond/README.md derives what follows from them.
   integer, parameter, public :: gap_slope = 18, area_slope = 19, gap_curvature = 20
   !> Of a load that was found by percolation: the load itself, whose error estimate is that of the load, and the
   !> largest lower load at which the contact did not percolate yet or the gap still did [p*].
   integer, parameter, public :: percolation = 21, last_before = 22
   integer, parameter, public :: number_of_quantities = 22

   !> Kinds of quantities. Tables have a quantity without unit in a column of its name with the ending `behind_name`, or
   !> in the deck's units in a column of its name alone.
   integer, parameter, public :: of_length = 1, of_pressure = 2, of_area = 3, of_energy = 4, of_load = 5, &
      in_length = 6, of_count = 7, number_of_kinds = 7
   character(*), parameter :: behind_name(number_of_kinds) = [character(21) :: '_over_amplitude', '_over_pstar', &
      '_fraction', '_over_pstar_amplitude', '_fraction', '', '']
   character(*), parameter :: units(number_of_kinds) = [character(12) :: 'length', 'pressure', 'area', 'force*length', &
      '-', 'length', '#']

   type :: quantity_type
      integer :: number                  !! one of the numbers above
      character(22) :: name              !! name in tables
      integer :: kind                    !! one of the kinds above
      character(16) :: listed_in = ''    !! tables that take its columns, by `listed_columns`, in the order of the list
   end type quantity_type

   !> The quantities that tables have.
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
      quantity_type(polynomial_degree, 'degree', of_count, 'details'), &
      quantity_type(percolation, 'percolation', of_pressure), &
      quantity_type(last_before, 'last_before', of_pressure)]

   !> The three quantities that every solver computes to the requested accuracy.
   integer, parameter, public :: main_quantities(3) = [mean_gap, contact_area, peak_pressure]
   !> The quantities that are known without load: zeros, except for the mean gap, which is 1.
   integer, parameter :: without_load(*) = [main_quantities, approach, min_pressure, area_at_hardness, &
      load_at_hardness, concentrated_load, border_load, polynomial_degree]
   integer :: i
   real(dp), parameter :: &
      initial_error(*) = [(merge(0.0_dp, unknown, any(i == without_load)), i=1, number_of_quantities)], &
      initial_value(*) = [(merge(1.0_dp, initial_error(i), i == mean_gap), i=1, number_of_quantities)]

   !> The record of a solution's quantities. Before a solver fills it, it is that of no load.
   type, public :: quantities
      real(dp) :: value(number_of_quantities) = initial_value   !! value of each quantity, or `unknown`
      real(dp) :: error(number_of_quantities) = initial_error   !! error estimate of each quantity, or `unknown`
   contains
      procedure :: main_values, are_resolved
   end type quantities

contains

   !> Whether a number is known, which means less than `unknown`.
   elemental logical function is_known(number)
      real(dp), intent(in) :: number

      is_known = number < unknown
   end function is_known

   !> A number times a factor, or `unknown` if the number is unknown. The plain product of `unknown` and a small factor
   !> would be taken for a known number.
   elemental real(dp) function scaled(number, factor)
      real(dp), intent(in) :: number, factor

      scaled = unknown
      if (is_known(number)) scaled = factor*number
   end function scaled

   !> A number as the user sees it: NaN if the number is unknown.
   elemental real(dp) function or_nan(number)
      real(dp), intent(in) :: number

      or_nan = number
      if (.not. is_known(number)) or_nan = not_a_number()
   end function or_nan

   !> Error estimates of the main quantities, made `unknown` where they say nothing: where an estimate is as large as
   !> the largest error that the value can have. Mean gap [Delta] and area fraction lie between 0 and 1. The peak
   !> pressure [p*] is less than that of just full contact.
   pure function known_errors(estimates, largest) result(errors)
      real(dp), intent(in) :: estimates(3)   !! of mean gap [Delta], area fraction and peak pressure [p*]
      real(dp), intent(in) :: largest        !! largest p - P in full contact [p*]; 1 for the waves of the paper
      real(dp) :: errors(3)

      errors = estimates
      where (.not. estimates < [1.0_dp, 1.0_dp, 1.0_dp + largest]) errors = unknown
   end function known_errors

   !> The values whose errors are those of the main quantities: mean gap (with free edges in 2-D the approach in its
   !> place), contact area and peak pressure.
   pure function main_values(self, surface) result(values)
      class(quantities), intent(in) :: self
      type(surface_type), intent(in) :: surface   !! the surface that was solved
      real(dp) :: values(3)

      values = self%value(main_quantities)
      if (surface%has_free_edges .and. surface%dimension == 2) values(1) = self%value(approach)
   end function main_values

   !> For each of `main_values` whether it is larger than its error estimate, exact, or does not exist.
   pure function are_resolved(self, surface)
      class(quantities), intent(in) :: self
      type(surface_type), intent(in) :: surface   !! the surface that was solved
      logical :: are_resolved(3)

      associate (errors => self%error(main_quantities), values => self%main_values(surface))
         are_resolved = errors < values .or. errors <= 0.0_dp .or. .not. is_known(values)
      end associate
   end function are_resolved

   !> Finds the quantity that stands in a column of tables.
   pure subroutine find_quantity(name, quantity, quantity_kind, is_error, in_unit)
      character(*), intent(in) :: name        !! name of the column, which must be that of a quantity or of its error
      integer, intent(out) :: quantity        !! one of the numbers above
      integer, intent(out) :: quantity_kind   !! kind of the quantity, one of the kinds above
      logical, intent(out) :: is_error        !! whether the column has the error of the quantity
      logical, intent(out) :: in_unit         !! whether the column is in the deck's units

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
         quantity_kind = listed%kind
         exit
      end do
      call assert(quantity > 0, 'a column of the list: '//name)
   end subroutine find_quantity

   !> The columns of all quantities that are listed in a table, in the order of the list, as name[unit] and a blank
   !> each: value and error without unit and, in the summary, in the deck's units.
   pure function listed_columns(table) result(columns)
      character(*), intent(in) :: table   !! 'summary' or 'details'
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
