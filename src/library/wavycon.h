/* wavycon: elastic contact of wavy surfaces. The C interface; README.md of src/library has an example.

   Objects are made by wavycon_new_... and wavycon_solve..., which return NULL in case of an error. Each is the caller's
   and is deleted by wavycon_delete(&object); they do not need each other afterwards: a surface may be deleted once its
   solver is made, a solver while its solutions are in use.

   All other functions return 0 on success and otherwise the code of the error: 1 (WAVYCON_BAD_INPUT) for arguments that
   are wrong, NULL or not finite, 3 (WAVYCON_FILE_TROUBLE) for files and memory.
   The first argument of most functions is an error object, which then holds code and message of that call. A call
   that gets NULL because the one before it failed keeps that one's message, so that it is enough to check at the end
   of a chain. The error object may be NULL: then the return value alone tells. A handle that is NULL or of another
   kind is an error and no crash; one that was deleted through another variable is not found out.

   A load that cannot be solved as requested is no error: the solution has a status, see wavycon_measures.status_code.

   Lengths are in any one unit, pressures in any one unit; the same unit comes back. Arrays of maps and heights hold x
   fastest: element [j][i] of double a[points_y][points_x] is at x number i, y number j. In numpy they have the shape
   (points_y, points_x). Texts end in a null character; those that do not fit into `buffer` are cut.

   Threads may share the library and its objects. Loads are solved at the same time, each with a solver of its own; any
   other call, and a second one with the same solver, waits until that of another thread has ended. No thread may delete
   what another uses. To use several processors for one large grid, see wavycon_set_threads. */
#ifndef WAVYCON_H
#define WAVYCON_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wavycon_error_object *wavycon_error;
typedef struct wavycon_surface_object *wavycon_surface;
typedef struct wavycon_solver_object *wavycon_solver;
typedef struct wavycon_solution_object *wavycon_solution;

/* Codes of errors. */
enum { WAVYCON_FINE = 0, WAVYCON_BAD_INPUT = 1, WAVYCON_FILE_TROUBLE = 3 };

/* Statuses of solutions. Below 10 the load is solved as requested. */
enum {
    WAVYCON_CONVERGED = 0,
    WAVYCON_CLOSED_FORM = 1,
    WAVYCON_FULL_CONTACT = 2,
    WAVYCON_NO_LOAD = 3,
    WAVYCON_UNRESOLVED = 4, /* on the grid given, but an error is unknown or as large as the value */
    WAVYCON_NOT_ACCURATE = 10, /* the error estimates exceed the accuracy */
    WAVYCON_NOT_FOUND = 11,    /* the solver has no solution for this load */
    WAVYCON_NO_MEMORY = 12,    /* for the grid that is needed; the numbers are those of a coarser one */
    WAVYCON_NOT_FINITE = 13,
    WAVYCON_ABOVE_HARDNESS = 14, /* the mean pressure is not below the hardness */
    WAVYCON_OTHER_FAILURE = 20 /* such as iteration_limit: see wavycon_get_status */
};

/* The numbers of a load, named as the columns of the summary table. p* is the mean pressure that just closes the gap
   everywhere, the amplitude is the mean gap before load. Errors are estimates, NaN if the solver has none. */
typedef struct wavycon_measures {
    double pbar_over_pstar; /* mean pressure over the nominal area, over p* */
    double mean_gap_over_amplitude;
    double approach_over_amplitude; /* of the mean planes */
    double contact_area_fraction;   /* of the nominal area */
    double peak_pressure_over_pstar;
    double min_pressure_over_pstar; /* negative between the points of solver 'beale' */
    double mean_gap_over_amplitude_error;
    double contact_area_fraction_error;
    double peak_pressure_over_pstar_error;
    double area_at_hardness_fraction; /* of the nominal area; NaN without a hardness */
    double load_at_hardness_fraction; /* of the load; NaN without a hardness */
    double area_at_hardness_fraction_error;
    double load_at_hardness_fraction_error;
    double mean_pressure; /* [pressure] */
    double mean_gap;      /* [length] */
    double approach;      /* [length] */
    double contact_area;  /* of one cell [length^2]; of a profile [length] */
    double peak_pressure; /* [pressure] */
    double residual;      /* relative, as each solver defines it */
    int active_constraints;
    int iterations;
    int status_code;
    double contact_area_counted_fraction;   /* points of the grid in contact over all; NaN without a grid */
    double contact_area_corrected_fraction; /* the same by Yastrebov; NaN without a grid and of profiles */
    double linear_area_fraction;            /* 2 pbar/(E* rms slope); NaN if the surface is no height map */
} wavycon_measures;

/* What the normalised numbers refer to. */
typedef struct wavycon_scales {
    double e_star;    /* plane-strain modulus [pressure] */
    double p_star;    /* p* [pressure]; 0 for a flat surface */
    double amplitude; /* mean gap before load [length] */
    double length_x;  /* sides of the periodic cell [length] */
    double length_y;
    int dimension; /* 1 for a profile, otherwise 2 */
} wavycon_scales;

/* The largest stresses of a load in one body, named as the columns of the table of largest stresses. Errors are
   estimates, NaN if the solver has none. */
typedef struct wavycon_largest_stress {
    double largest_von_mises_over_pstar;
    double largest_von_mises_over_pstar_error;
    double largest_shear_over_pstar;
    double largest_shear_over_pstar_error;
    double largest_von_mises; /* [pressure] */
    double von_mises_x;       /* its place, in the cell, and its depth [length] */
    double von_mises_y;
    double von_mises_depth;
    double largest_shear; /* [pressure] */
    double shear_x;       /* its place, in the cell, and its depth [length] */
    double shear_y;
    double shear_depth;
} wavycon_largest_stress;

/* Errors and the library ------------------------------------------------------------------------------------------ */

/* A new error object, without an error. */
wavycon_error wavycon_new_error(void);

/* The code of the last call that was given this object, 0 if it succeeded. */
int wavycon_check_error(wavycon_error error);

/* Copies the message of that call, empty if it succeeded. It may hold several lines. */
int wavycon_get_error_message(wavycon_error error, char *buffer, size_t bytes);

/* Deletes any object, given the address of its variable, and sets the variable to NULL. NULL is ignored. */
void wavycon_delete(void *address_of_object);

/* Copies the version, such as "0.1.0". */
int wavycon_get_version(char *buffer, size_t bytes);

/* Sets the number of threads for large grids, from 1, the default, to 1024. With OMP_WAIT_POLICY=passive in the
   environment when the program starts, those that wait sleep; by default they spin. */
int wavycon_set_threads(wavycon_error error, int number);

/* Surfaces -------------------------------------------------------------------------------------------------------- */

/* gap = amplitude (1 - cos(2 pi x/wavelength)); amplitude >= 0, wavelength > 0 [length]. */
wavycon_surface wavycon_new_wave_1d(wavycon_error error, double amplitude, double wavelength);

/* gap = amplitude (1 - cos(2 pi x/wavelength_x) cos(2 pi y/wavelength_y)). */
wavycon_surface wavycon_new_wave_2d(wavycon_error error, double amplitude, double wavelength_x, double wavelength_y);

/* Three equal waves at 60 degrees to each other; amplitude is the mean gap before load. */
wavycon_surface wavycon_new_hexagonal(wavycon_error error, double amplitude, double wavelength);

/* A wave along x on one block and a wave along y on the other. */
wavycon_surface wavycon_new_crossed_1d(wavycon_error error, double amplitude1, double wavelength1, double amplitude2,
                                       double wavelength2);

/* The height sum_q amplitudes[q] cos(2 pi (waves_x[q] x/length_x + waves_y[q] y/length_y) - phases[q]), phases in
   degrees, from 1 to 1000 waves. All arrays have `waves` elements. If all waves_y are 0 it is a profile. */
wavycon_surface wavycon_new_wave_sum(wavycon_error error, int waves, const double *amplitudes, const int *waves_x,
                                     const int *waves_y, const double *phases, double length_x, double length_y);

/* A periodic map of heights [length], upwards to the other body: heights[points_y][points_x]. 4 to 1048576 points a
   side, points_y = 1 for a profile. The last row and column are the cell's last, not copies of the first. */
wavycon_surface wavycon_new_heights(wavycon_error error, int points_x, int points_y, const double *heights,
                                    double length_x, double length_y);

/* A measured map: the same, with NaN where a height is missing. keys: of &surface of a deck, how the map is prepared,
   such as "detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror'"; "" for the defaults. With mirror images
   lengths, areas and places are those of the map. */
wavycon_surface wavycon_new_measured_heights(wavycon_error error, int points_x, int points_y, const double *heights,
                                             double length_x, double length_y, const char *keys);

/* Any surface of a deck: the keys of &surface, such as "kind = 'file', file = 'heights.dat', length_x = 2". */
wavycon_surface wavycon_new_surface(wavycon_error error, const char *keys);

/* Solvers --------------------------------------------------------------------------------------------------------- */

/* e_star: plane-strain modulus of the pair, 1/e_star = (1 - nu1^2)/e1 + (1 - nu2^2)/e2 [pressure].
   method: keys of &method of a deck, such as "solver = 'auto', accuracy = 1e-4"; "" for the defaults.
   keep_fields: nonzero if maps, fields, edges or stresses of solutions will be needed. */
wavycon_solver wavycon_new_solver(wavycon_error error, wavycon_surface surface, double e_star, const char *method,
                                  int keep_fields);

/* material: keys of &material of a deck, such as "e_star = 2.31e11, hardness = 2e9" [pressure], the hardness being the
   largest contact pressure. */
wavycon_solver wavycon_new_solver_of_material(wavycon_error error, wavycon_surface surface, const char *material,
                                              const char *method, int keep_fields);

/* The solver of a deck, with its surface and its loads. &output of the deck has no effect. */
wavycon_solver wavycon_new_solver_of_deck(wavycon_error error, const char *path, int keep_fields);

/* Copies the solver's name and discretisation in words. */
int wavycon_describe_solver(wavycon_error error, wavycon_solver solver, char *buffer, size_t bytes);

int wavycon_get_scales(wavycon_error error, wavycon_solver solver, wavycon_scales *scales);

/* The number of loads of the deck; 0 without a deck. */
int wavycon_get_number_of_loads(wavycon_error error, wavycon_solver solver, int *loads);

/* Sets what loads by "yield" need: keys of &stress, such as "nu = 0.3, yield_stress = 1e9"; those of tables have no
   effect. The solver of a deck has those of the deck. */
int wavycon_set_stress(wavycon_error error, wavycon_solver solver, const char *keys);

/* Solves one load. quantity: a key of &load, "pbar_over_pstar", "mean_pressure", "mean_gap_over_amplitude", "mean_gap",
   "contact_area_fraction", or, with keep_fields and after wavycon_set_stress, "yield", the largest equivalent stress
   over the yield stress: 1 for first yield. Loads from high to low are solved fastest. */
wavycon_solution wavycon_solve(wavycon_error error, wavycon_solver solver, const char *quantity, double value);

/* Solves a load of the deck, 0 <= load < the number of its loads. */
wavycon_solution wavycon_solve_load(wavycon_error error, wavycon_solver solver, int load);

/* Runs a deck as the program does: solves its loads and writes its tables to `directory`, "" for that of the deck.
   quiet: nonzero for no log on standard output. exit_status: that of the program, 0 or, if loads were not solved as
   requested, 2, which is no error. While it runs, those of SIGINT, SIGTERM and SIGHUP that the process does not
   handle remove an unfinished file and end the process. */
int wavycon_run_deck(wavycon_error error, const char *path, const char *directory, int quiet, int *exit_status);

/* Solutions ------------------------------------------------------------------------------------------------------- */

int wavycon_get_measures(wavycon_error error, wavycon_solution solution, wavycon_measures *measures);

/* Copies the status in a word, such as "converged", and the name of the solver that was used, "none" if none was
   needed. */
int wavycon_get_status(wavycon_error error, wavycon_solution solution, char *buffer, size_t bytes);
int wavycon_get_solver_name(wavycon_error error, wavycon_solution solution, char *buffer, size_t bytes);

/* Fields at x = length_x (i + offset[0])/points_x, i = 0 .. points_x - 1, and y = length_y (j + offset[1])/points_y:
   arrays [points_y][points_x] of the caller; points_y = 1 for a profile; at most 8192^2 points. offset may be NULL: no
   offset; an array may be NULL: not wanted. Pressure is exactly 0 outside contact and the gap exactly 0 in contact, but
   for solver 'beale', whose series is shown as it is. displacement is u - mean u. */
int wavycon_get_map(wavycon_error error, wavycon_solution solution, int points_x, int points_y, const double *offset,
                    double *pressure, double *gap, double *displacement);

/* The grid that the solution was computed on, for wavycon_get_map: points[2], offset[2]. Zeros if there is none. */
int wavycon_get_own_points(wavycon_error error, wavycon_solution solution, int *points, double *offset);

/* Fields at one point. Pointers may be NULL. */
int wavycon_get_fields_at(wavycon_error error, wavycon_solution solution, double x, double y, double *pressure,
                          double *gap, double *displacement);

/* The edge of contact in one cell: closed polygons with the contact on their left, whose last point is the first again
   (one period on, if the curve runs through the whole plane); of a profile the two ends of each strip. Points are not
   reduced to one cell, so that curves do not jump. There are none for full contact and no load.
   Edges are counted from 0; wavycon_get_edge needs the number of points of that edge and arrays of this size. */
int wavycon_get_number_of_edges(wavycon_error error, wavycon_solution solution, int *edges);
int wavycon_get_edge_points(wavycon_error error, wavycon_solution solution, int edge, int *points);
int wavycon_get_edge(wavycon_error error, wavycon_solution solution, int edge, int points, double *x, double *y);

/* Stresses -------------------------------------------------------------------------------------------------------- */

/* All stresses are tension positive, in one of the two bodies, whose Poisson's ratio is nu, -1 < nu <= 0.5, and z, the
   depth, points into that body. The six components of a point stand together: xx, yy, zz, xy, xz, yz.
   lateral: the lateral stresses of the mean pressure pbar, as the key of &stress: "constrained", -nu pbar/(1 - nu),
   "free", 0, or "hydrostatic", -pbar. Loads without a solution have NaN. The solver must keep the fields. */

/* Stresses at points: x, y and depth >= 0 are arrays [points], stress is an array [points][6] of the caller.
   stress_error: an array [points] for estimates of the largest error of a component, NaN if the solver has none; may
   be NULL. Many points at one depth are found faster by wavycon_get_stress_plane. */
int wavycon_get_stress(wavycon_error error, wavycon_solution solution, int points, const double *x, const double *y,
                       const double *depth, double nu, const char *lateral, double *stress, double *stress_error);

/* Stresses at the points of wavycon_get_map at one depth: stress is an array [points_y][points_x][6], stress_error an
   array [points_y][points_x] or NULL. */
int wavycon_get_stress_plane(wavycon_error error, wavycon_solution solution, int points_x, int points_y,
                             const double *offset, double depth, double nu, const char *lateral, double *stress,
                             double *stress_error);

/* The largest von Mises stress and the largest shear stress, and where they are, found by search. */
int wavycon_get_largest_stress(wavycon_error error, wavycon_solution solution, double nu, const char *lateral,
                               wavycon_largest_stress *largest);

/* Of stresses, an array [points][6]: von_mises[points], the largest shear stress of all planes shear[points], the
   principal stresses principal[points][3], largest first. An array may be NULL: not wanted. */
int wavycon_get_invariants(wavycon_error error, int points, const double *stress, double *von_mises, double *shear,
                           double *principal);

#ifdef __cplusplus
}
#endif
#endif
