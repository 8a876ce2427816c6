!> The groups of a deck as records, in which each key is a component. The directory `program/deck` describes the keys in
!> tables and sets the components from the deck. Afterwards other code reads the components by their names.
module wavycon_scene_groups
   use wavycon_key_group, only: key_group, key_value
   implicit none (type, external)
   private

   !> Most tables that have a key in &output.
   integer, parameter, public :: most_tables = 40

   type, extends(key_group), public :: scene_group
      type(key_value) :: title, case, pressure_unit, length_unit
   end type scene_group

   type, extends(key_group), public :: material_group
      type(key_value) :: e_star, e1, nu1, e2, nu2, hardness, layer_thickness, layer_base, layer_nu, base_e, base_nu
   end type material_group

   type, extends(key_group), public :: surface_group
      !> The deck's label of the unit of lengths; empty if the deck gives none.
      character(:), allocatable :: deck_unit
      type(key_value) :: kind, amplitude, wavelength, wavelength_y, amplitude1, wavelength1, amplitude2, wavelength2
      type(key_value) :: length_x, length_y, amplitudes, waves_x, waves_y, phases
      type(key_value) :: file2, file2_scale, file2_flip, file2_missing_value, file2_detrend
      type(key_value) :: file, file_format, missing_value, height_scale, crop_missing, despike, detrend, fill_missing
      type(key_value) :: edges, window_width, short_wavelength, filter, form_radius, form_radius_x, form_radius_y
      type(key_value) :: hurst, anisotropy, rms_height, rms_slope, spectral_density, long_wavelength, rolloff_wavelength
      type(key_value) :: spectrum, seed, points, radius, radius_x, radius_y
   end type surface_group

   type, extends(key_group), public :: load_group
      type(key_value) :: pbar_over_pstar, mean_pressure, mean_gap_over_amplitude, mean_gap, contact_area_fraction
      type(key_value) :: yield, force, approach, contact_area, percolates, sweep_from, sweep_to, sweep_steps
   end type load_group

   type, extends(key_group), public :: stress_group
      type(key_value) :: largest, line, section, planes, depths, depths_over_cell_x, depth_from, depth_to, depth_steps
      type(key_value) :: nu, lateral, yield_stress, yield_criterion
   end type stress_group

   type, extends(key_group), public :: interface_group
      type(key_value) :: resistivity1, resistivity2, friction, tangential_load, tangential_over_normal
      type(key_value) :: shear_direction, nu, slip_loop, slip_map, work_of_adhesion
   end type interface_group

   type, extends(key_group), public :: method_group
      type(key_value) :: solver, harmonics, constraint_points, symmetry, edge_level, accuracy, grid_points, residual
   end type method_group

   type, extends(key_group), public :: output_group
      type(key_value) :: directory, csv, line_points, map_points, map_format, histogram_bins
      type(key_value) :: tables(most_tables)   !! the key of each table in the order of `all_tables`, if it has one
   end type output_group

end module wavycon_scene_groups
