/* wavycon: elastic contact of wavy and rough surfaces. C interface of the library; README.md beside the source of this
   file has examples.

   Objects are made by wavycon_new_error, wavycon_new_scene, wavycon_read_scene, wavycon_solve, wavycon_solve_load and
   wavycon_new_table. The caller deletes them with wavycon_delete.

   If there is an error, functions that make an object return NULL, functions that copy a text return 0, and functions
   that return an int return the code of the error. The caller's error object, which may be NULL, then has the code and
   the message of the call. If an object could not be made, and later calls get NULL in its place, the message is that
   of the call that failed first, until another object is made or another call fails.

   All lengths are in one unit and all pressures in one unit, those of the deck. Several threads may call the library at
   the same time, each with an error object of its own: loads of different scenes are then solved at the same time, and
   other calls are done one after the other. */
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

/* The number "status_code" of a solution. If it is below 10, the load was solved as requested. */
enum {
    WAVYCON_CONVERGED = 0,
    WAVYCON_CLOSED_FORM = 1,
    WAVYCON_FULL_CONTACT = 2,
    WAVYCON_NO_LOAD = 3,
    WAVYCON_UNRESOLVED = 4,      /* solved on the given grid, but an error is unknown or as large as its value */
    WAVYCON_NOT_ACCURATE = 10,   /* the error estimates exceed the accuracy */
    WAVYCON_NOT_FOUND = 11,      /* the solver has no solution for this load */
    WAVYCON_NO_MEMORY = 12,      /* for the grid that is needed; the numbers are those of a coarser grid */
    WAVYCON_NOT_FINITE = 13,
    WAVYCON_ABOVE_HARDNESS = 14, /* the mean pressure is not below the hardness */
    WAVYCON_INTERRUPTED = 15,    /* the function of wavycon_set_progress has ended the load */
    WAVYCON_OTHER_FAILURE = 20   /* another failure, such as iteration_limit: see the text "status" */
};

/* Makes an error object, without an error. */
wavycon_error wavycon_new_error(void);

/* The code of the last call with this error object; 0 if the call succeeded. */
int wavycon_get_code(wavycon_error error);

/* Copies the message of the last call with this error object, cut to the size of the buffer. The message may have
   several lines; it is empty if the call succeeded. Returns the number of bytes that the whole message needs, with its
   null character. */
size_t wavycon_get_message(wavycon_error error, char *buffer, size_t bytes);

/* Deletes an object of any kind and sets its variable to NULL. The argument is the address of the variable; an object
   that is NULL is ignored. A scene may be deleted before its solutions. */
void wavycon_delete(void *address_of_object);

/* Sets the number of threads that work on large grids, 1 to 1024; the default is 1. Threads that wait use their
   processors, unless the environment has OMP_WAIT_POLICY=passive when the program starts. */
int wavycon_set_threads(wavycon_error error, int number);

/* Reads a deck from its text and starts its solver. The deck may have no group &load. Of &output only the points of
   tables have an effect.
   path: the name of the deck in messages; files that the deck names are looked for beside it.
   keep_fields: nonzero if fields, edges or stresses of solutions will be needed.
   heights: NULL, or an array heights[points_y][points_x] in place of the heights of the file of kind = 'file'. Heights
   are upwards to the other body, in the unit that the key height_scale gives, and NaN where they are missing. For a
   profile points_y or points_x is 1. With NULL both are 0. */
wavycon_scene wavycon_new_scene(wavycon_error error, const char *deck, const char *path, int keep_fields, int points_x,
                                int points_y, const double *heights);

/* Reads a deck from its file and starts its solver.
   settings: keys that replace those of the deck, as the program's option --set does: a line group.key=value for each;
   "" for none. keep_fields: as in wavycon_new_scene. */
wavycon_scene wavycon_read_scene(wavycon_error error, const char *path, const char *settings, int keep_fields);

/* A function that the solver calls: with iterations = 0 before each load that it solves, also those of a search, and in
   each iteration on a grid. Where coarser grids are solved first, iterations begin at 0 on each of them.
   data: the argument of wavycon_set_progress. residual: that of the key and of the summary, root mean square of the
   violated conditions over the mean gap, but at most 1, as before a load. If the function returns nonzero the load ends with the status "interrupted", and the scene can solve the
   next load. The function may call the library, but not with this scene. */
typedef int (*wavycon_progress)(void *data, int iterations, double residual);

/* Sets the function that the scene's solver calls from now on, and its first argument; NULL: no function. */
int wavycon_set_progress(wavycon_error error, wavycon_scene scene, wavycon_progress function, void *data);

/* Solves one load.
   quantity: a key of &load, such as "pbar_over_pstar", "mean_pressure", "mean_gap_over_amplitude", "mean_gap",
   "contact_area_fraction" or, with keep_fields and a yield_stress in &stress, "yield". With keep_fields also
   "percolates=contact" and so on, whose value is not used.
   Loads are solved fastest in the order from high to low. A load that cannot be solved as requested is not an error:
   its "status_code" says so. */
wavycon_solution wavycon_solve(wavycon_error error, wavycon_scene scene, const char *quantity, double value);

/* Solves a load of the deck. load: 0 to the number "loads" of the scene less 1. */
wavycon_solution wavycon_solve_load(wavycon_error error, wavycon_scene scene, int load);

/* Gets a number by its name.
   Of a scene: "e_star", "p_star" (0 for a flat surface), "amplitude" (the mean gap before load), "length_x",
   "length_y", "has_sides" (0 for a height map whose sides neither the deck nor its file gives, otherwise 1),
   "points_x", "points_y" (of a height map, otherwise 0), "dimension" (1 for a profile), "loads" (how many the deck
   has).
   Of a solution: the columns of numbers of the summary table, such as "mean_gap". "own_points_x", "own_points_y",
   "own_offset_x" and "own_offset_y" are the grid on which the solution was computed, as arguments of wavycon_get_grid;
   zeros if there is none. With map_ in place of own_ they are the grid of the table "map".
   Of a table: "rows", "columns". */
int wavycon_get(wavycon_error error, const void *object, const char *name, double *value);

/* Copies a text by its name, cut to the size of the buffer. Returns the number of bytes that the whole text needs, with
   its null character.
   Of a scene: "solver"; "method" (solver and discretisation in words); "why_chosen" (why 'auto' chose its solvers);
   "pressure_unit"; "length_unit"; "resolved_deck"; "order" (the numbers of the deck's loads, from 1, in the order in
   which the program solves them); "tables" (the names of those that the deck asks for).
   Of a solution: "status"; "solver" (of this load, "none" if none was needed).
   Of a table: "columns" (a line name[unit] for each, where a column of words has the unit "word"); "words" (the list of
   words, a line for each).
   Of a scene and of a solution: "notes", as in the program's log, a line for each. Those of a scene are on its surface,
   on the loads that wavycon_solve_load has solved so far, and on tables; those of a solution are on this load. The text
   is empty if there are no notes.
   Of NULL: "version"; "keys" (all groups and keys of decks with type, unit, default, bounds and meaning, as JSON). */
size_t wavycon_get_text(wavycon_error error, const void *object, const char *name, char *buffer, size_t bytes);

/* Copies the known names that may be meant by an unknown one, best first, a line each, cut to the size of the buffer;
   none if none is near. Returns the number of bytes that all of them need, with the null character.
   names: the known names, a line each. meanings: NULL, or what they mean, a line each, in which words of the unknown
   name are looked for if no name is near. */
size_t wavycon_get_near_names(wavycon_error error, const char *name, const char *names, const char *meanings,
                              char *buffer, size_t bytes);

/* Makes a table of a solution.
   name: "summary"; the table of a key of &output, such as "contours", "spots", "map" or "histograms"; or of a key of
   &stress, such as "stress_largest", "stress_line" or "stress_planes".
   The columns are those of the program's files. The deck's keys determine at which points a table has its rows. The
   column "load" is always 1. */
wavycon_table wavycon_new_table(wavycon_error error, wavycon_solution solution, const char *name);

/* Copies a column of a table to an array values[rows], where rows is the table's number of rows. In place of words a
   column has their numbers in the text "words", whose first line is 1. */
int wavycon_get_column(wavycon_error error, wavycon_table table, const char *name, int rows, double *values);

/* Gets fields at points. All arrays have the size [points]; an array for results may be NULL if it is not wanted. The
   pressure is exactly 0 outside contact, and the gap is exactly 0 in contact. Only the truncated series of the solvers
   'beale' and 'series' differ: they are returned as they are. displacement: the displacement less its mean. Beyond a
   surface with free edges the pressure is 0, and gap and displacement are NaN. */
int wavycon_get_fields(wavycon_error error, wavycon_solution solution, int points, const double *x, const double *y,
                       double *pressure, double *gap, double *displacement);

/* Gets fields, as wavycon_get_fields does, at the points of a grid: x = length_x (i + offset[0])/points_x,
   i = 0 .. points_x - 1, and y = length_y (j + offset[1])/points_y, j = 0 .. points_y - 1. The arrays have the shape
   [points_y][points_x]. For a profile points_y is 1. There may be at most 8192^2 points. offset: NULL for no offset. */
int wavycon_get_grid(wavycon_error error, wavycon_solution solution, int points_x, int points_y, const double *offset,
                     double *pressure, double *gap, double *displacement);

/* Gets guaranteed bounds of the contact of a scene under a mean pressure, from any pressure and gap, also those of
   another program.
   pressure, gap: arrays [points_y][points_x] of the values at the points of a grid, as wavycon_get_grid has them.
   offset: that of this grid, at most 1 in size, NULL for no offset. On a mirrored map it is 0.5, also for NULL.
   Negative pressures count as 0, negative gaps too if there is no hardness, and the pressure is scaled to the mean
   pressure. With a hardness the gap is negative where the bodies overlap.
   bounds: an array [6] for the least and the largest value of the complementary energy, then of the approach and of the
   mean gap; NaN if there is no bound. They are bounds for the surface itself, not for the surface on the grid, and hold
   for any given arrays; they are close if the arrays are those of a solution.
   Further errors: free edges, a flat surface, and a grid that does not have all waves of the surface. */
int wavycon_get_bounds(wavycon_error error, wavycon_scene scene, double mean_pressure, int points_x, int points_y,
                       const double *offset, const double *pressure, const double *gap, double *bounds);

/* Gets stresses at points in one of the two bodies. Tension is positive.
   x, y, depth: arrays [points]; depths are >= 0 and point into the body.
   nu: Poisson's ratio of the body, -1 < nu <= 0.5.
   lateral: the lateral stresses that the mean pressure pbar makes, as the key of &stress: "constrained" for
   -nu pbar/(1 - nu), "free" for 0, "hydrostatic" for -pbar.
   stress: an array [points][6] for the components xx, yy, zz, xy, xz, yz.
   stress_error: NULL, or an array [points] for estimates of the largest error of a component; NaN if the solver does
   not estimate errors. */
int wavycon_get_stresses(wavycon_error error, wavycon_solution solution, int points, const double *x, const double *y,
                         const double *depth, double nu, const char *lateral, double *stress, double *stress_error);

/* Gets stresses, as wavycon_get_stresses does but faster, at the points of wavycon_get_grid at one depth. stress: an
   array [points_y][points_x][6]. stress_error: NULL, or an array [points_y][points_x]. */
int wavycon_get_stress_plane(wavycon_error error, wavycon_solution solution, int points_x, int points_y,
                             const double *offset, double depth, double nu, const char *lateral, double *stress,
                             double *stress_error);

/* Computes invariants of stresses, an array [points][6] of the components as in wavycon_get_stresses: the von Mises
   stress, an array [points]; the largest shear stress of all planes, an array [points]; the principal stresses, an
   array [points][3] with the largest first. An array for results may be NULL if it is not wanted. */
int wavycon_get_invariants(wavycon_error error, int points, const double *stress, double *von_mises, double *shear,
                           double *principal);

/* Runs a deck as the program does: solves its loads and writes its tables.
   directory: where the tables go; "" for the directory that the deck names. quiet: nonzero for no log on standard
   output.
   exit_status: that of the program: 0, or 2 if loads were not solved as requested, which is not an error.
   During the run SIGINT, SIGTERM and SIGHUP remove an unfinished file and end the process, unless the process handles
   the signal itself. */
int wavycon_run_deck(wavycon_error error, const char *path, const char *directory, int quiet, int *exit_status);

#ifdef __cplusplus
}
#endif
#endif
