/* wavycon: elastic contact of wavy and rough surfaces. C interface of the library; README.md beside the source of this
   file has examples.

   Objects are made by functions named wavycon_new_... and wavycon_solve..., and deleted by the caller with wavycon_delete.
   Functions that make an object return NULL, functions that return an int its code, and functions that copy a text 0, if
   there is an error. The error object, which may be NULL, has then the code and the message of that call; a call that is
   given NULL for an object that could not be made leaves the message of the call that failed.
   Lengths are in any one unit, pressures in any one unit, those of the deck. Threads may call at the same time, each with
   an error object of its own: loads of different scenes are solved at the same time, other calls one after the other. */
#ifndef WAVYCON_H
#define WAVYCON_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wavycon_error_object *wavycon_error;
typedef struct wavycon_scene_object *wavycon_scene;
typedef struct wavycon_solution_object *wavycon_solution;
typedef struct wavycon_table_object *wavycon_table;

/* Codes of errors. */
enum { WAVYCON_FINE = 0, WAVYCON_BAD_INPUT = 1, WAVYCON_FILE_TROUBLE = 3 };

/* "status_code" of solutions. Below 10 the load is solved as requested. */
enum {
    WAVYCON_CONVERGED = 0,
    WAVYCON_CLOSED_FORM = 1,
    WAVYCON_FULL_CONTACT = 2,
    WAVYCON_NO_LOAD = 3,
    WAVYCON_UNRESOLVED = 4,      /* on the grid given, but an error is unknown or as large as the value */
    WAVYCON_NOT_ACCURATE = 10,   /* the error estimates exceed the accuracy */
    WAVYCON_NOT_FOUND = 11,      /* the solver has no solution for this load */
    WAVYCON_NO_MEMORY = 12,      /* for the grid that is needed; the numbers are those of a coarser one */
    WAVYCON_NOT_FINITE = 13,
    WAVYCON_ABOVE_HARDNESS = 14, /* the mean pressure is not below the hardness */
    WAVYCON_INTERRUPTED = 15,    /* by the callback of wavycon_set_progress */
    WAVYCON_OTHER_FAILURE = 20   /* such as iteration_limit: see the text "status" */
};

/* A new error object, without an error. */
wavycon_error wavycon_new_error(void);

/* The code of the last call that was given this object, 0 if it succeeded. */
int wavycon_get_code(wavycon_error error);

/* Copies the message of that call, which may hold several lines, cut to the size of the buffer; empty if it succeeded.
   Returns the bytes that the whole message needs, with its null character. */
size_t wavycon_get_message(wavycon_error error, char *buffer, size_t bytes);

/* Deletes any object, given the address of its variable, and sets the variable to NULL. NULL is ignored. A scene may be
   deleted before its solutions. */
void wavycon_delete(void *address_of_object);

/* Sets the number of threads for large grids, from 1, the default, to 1024. With OMP_WAIT_POLICY=passive in the
   environment when the program starts, those that wait sleep; by default they spin. */
int wavycon_set_threads(wavycon_error error, int number);

/* Reads a deck from its text and starts its solver. `path` is the name of the deck in messages, and files that it names
   are looked for beside it. &load may be left out; &output has no effect but on the points of tables.
   keep_fields: nonzero if fields, edges or stresses of solutions will be asked for.
   heights: NULL, or heights[points_y][points_x] in place of those of the file of kind = 'file', upwards to the other body,
   in the unit that height_scale says, NaN where they are missing; points_y or points_x is 1 for a profile. */
wavycon_scene wavycon_new_scene(wavycon_error error, const char *deck, const char *path, int keep_fields, int points_x,
                                int points_y, const double *heights);

/* The same of a deck in a file. settings: keys that are set in place of those of the deck, as by the program's --set, a
   line group.key=value for each; "": none. */
wavycon_scene wavycon_read_scene(wavycon_error error, const char *path, const char *settings, int keep_fields);

/* Called before each load that a solver solves, also those of a search, with 0 iterations, and in each iteration on a
   grid. residual: root mean square of the violated conditions over the mean gap before load. To return nonzero ends the
   load, whose status is then "interrupted"; the scene can solve the next one. The function may call the library, but not
   with this scene. */
typedef int (*wavycon_progress)(void *data, int iterations, double residual);

/* Sets the function that is called during the loads to come, and its first argument; NULL: none. */
int wavycon_set_progress(wavycon_error error, wavycon_scene scene, wavycon_progress function, void *data);

/* Solves one load. quantity: a key of &load, "pbar_over_pstar", "mean_pressure", "mean_gap_over_amplitude", "mean_gap",
   "contact_area_fraction", or, with keep_fields and a yield_stress in &stress, "yield". Loads from high to low are solved
   fastest. A load that cannot be solved as requested is no error but has a status. */
wavycon_solution wavycon_solve(wavycon_error error, wavycon_scene scene, const char *quantity, double value);

/* Solves a load of the deck, 0 <= load < the number "loads". */
wavycon_solution wavycon_solve_load(wavycon_error error, wavycon_scene scene, int load);

/* Gets a number by its name.
   Of a scene: "e_star", "p_star" (0 for a flat surface), "amplitude" (the mean gap before load), "length_x", "length_y",
   "points_x", "points_y" (of a height map, otherwise 0), "dimension" (1 for a profile), "loads" (of the deck).
   Of a solution: the columns of numbers of the summary table, such as "mean_gap", and "own_points_x", "own_points_y",
   "own_offset_x", "own_offset_y", the grid that it was computed on, for wavycon_get_grid; zeros if there is none; and
   with map_ in place of own_ the grid of the table "map".
   Of a table: "rows", "columns". */
int wavycon_get(wavycon_error error, const void *object, const char *name, double *value);

/* Copies a text by its name, cut to the size of the buffer. Returns the bytes that the whole text needs, with its null
   character.
   Of a scene: "solver", "method" (solver and discretisation in words), "why_chosen" (of solver 'auto'), "pressure_unit",
   "length_unit", "resolved_deck", "order", the numbers, from 1, of the deck's loads in the order in which the program
   solves them. Of a solution: "status", "solver" (of this load, "none" if none was needed).
   Of a table: "columns", a line name[unit] for each, the unit of a column of words being "word"; "words", a line for each.
   Also "notes", as the program's log has them, a line for each: of a scene those on its surface, on the loads that
   wavycon_solve_load has solved so far and on tables; of a solution those on this load. Empty if there are none.
   Of NULL: "version"; "keys", all groups and keys of decks with type, unit, default, bounds and meaning as JSON. */
size_t wavycon_get_text(wavycon_error error, const void *object, const char *name, char *buffer, size_t bytes);

/* Makes a table of a solution: "summary", or the table of a key of &output, such as "contours", "spots", "map" or
   "histograms", or of a key of &stress, such as "stress_largest", "stress_line" or "stress_planes". The columns are those
   of the program's files, the keys that say which points they have those of the deck; "load" is always 1. */
wavycon_table wavycon_new_table(wavycon_error error, wavycon_solution solution, const char *name);

/* Copies a column to an array [rows]; rows is the table's number of rows. A column of words has their numbers: 1 is the
   first line of the text "words". */
int wavycon_get_column(wavycon_error error, wavycon_table table, const char *name, int rows, double *values);

/* Fields at points: all arrays are [points]. An array for results may be NULL: not wanted. Pressure is exactly 0 outside
   contact and the gap exactly 0 in contact, but for the solvers 'beale' and 'series', whose series is shown as it is.
   displacement is u - mean u. */
int wavycon_get_fields(wavycon_error error, wavycon_solution solution, int points, const double *x, const double *y,
                       double *pressure, double *gap, double *displacement);

/* The same at x = length_x (i + offset[0])/points_x, i = 0 .. points_x - 1, and y = length_y (j + offset[1])/points_y:
   arrays [points_y][points_x]; points_y = 1 for a profile; at most 8192^2 points. offset may be NULL: no offset. */
int wavycon_get_grid(wavycon_error error, wavycon_solution solution, int points_x, int points_y, const double *offset,
                     double *pressure, double *gap, double *displacement);

/* Guaranteed bounds of the contact of a scene under a mean pressure, from any pressure and gap, also those of another
   program, at x = length_x i/points_x, i = 0 .. points_x - 1, and y = length_y j/points_y; of a mirrored map half a
   step further: arrays [points_y][points_x]; points_y = 1 for a profile. bounds: an array [6] for the least and the
   largest value of the complementary energy, of the approach and of the mean gap, NaN where there is no bound. They are
   of the surface itself, not of the grid, and hold whatever is given; a solution makes them close. Negative pressures
   count as 0, as do negative gaps without a hardness, and the pressure is scaled to the mean. With a hardness the gap is
   negative where the bodies overlap. Errors: also free edges, a flat surface, and a grid that lacks waves of the
   surface. */
int wavycon_get_bounds(wavycon_error error, wavycon_scene scene, double mean_pressure, int points_x, int points_y,
                       const double *pressure, const double *gap, double *bounds);

/* Stresses at points in one of the two bodies, tension positive. x, y and depth >= 0, which points into the body, are
   arrays [points], stress is an array [points][6]: xx, yy, zz, xy, xz, yz. nu: Poisson's ratio of the body,
   -1 < nu <= 0.5. lateral: the lateral stresses of the mean pressure pbar, as the key of &stress: "constrained",
   -nu pbar/(1 - nu), "free", 0, or "hydrostatic", -pbar. stress_error: an array [points] for estimates of the largest
   error of a component, NaN if the solver has none; may be NULL. */
int wavycon_get_stresses(wavycon_error error, wavycon_solution solution, int points, const double *x, const double *y,
                         const double *depth, double nu, const char *lateral, double *stress, double *stress_error);

/* The same at the points of wavycon_get_grid at one depth, which is faster: stress is an array [points_y][points_x][6],
   stress_error an array [points_y][points_x] or NULL. */
int wavycon_get_stress_plane(wavycon_error error, wavycon_solution solution, int points_x, int points_y,
                             const double *offset, double depth, double nu, const char *lateral, double *stress,
                             double *stress_error);

/* Of stresses, an array [points][6]: von_mises[points], the largest shear stress of all planes shear[points], the
   principal stresses principal[points][3], largest first. An array may be NULL: not wanted. */
int wavycon_get_invariants(wavycon_error error, int points, const double *stress, double *von_mises, double *shear,
                           double *principal);

/* Runs a deck as the program does: solves its loads and writes its tables to `directory`, "" for that of the deck.
   quiet: nonzero for no log on standard output. exit_status: that of the program, 0 or, if loads were not solved as
   requested, 2, which is no error. While it runs, those of SIGINT, SIGTERM and SIGHUP that the process does not
   handle remove an unfinished file and end the process. */
int wavycon_run_deck(wavycon_error error, const char *path, const char *directory, int quiet, int *exit_status);

#ifdef __cplusplus
}
#endif
#endif
