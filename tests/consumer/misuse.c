/* Every function of wavycon.h with handles that are NULL or of another kind, with pointers that are NULL, and with
   numbers that are no numbers or out of range: each call must return an error and a message. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <wavycon.h>

#define COUNT(array) (sizeof(array)/sizeof((array)[0]))

static const char wave[] = "&surface kind = 'wave_2d' / &method solver = 'auto', accuracy = 1e-3 /"
                           "&stress nu = 0.3, yield_stress = 2 /";
static wavycon_error error;
static int failures = 0;

static void check(int is_right, const char *call, int line)
{
    if (is_right)
        return;
    failures++;
    printf("misuse.c:%d: %s\n", line, call);
}

static int has_error(void)
{
    char message[200] = "";
    return wavycon_get_message(error, message, sizeof message) > 1 && message[0] != '\0' &&
           wavycon_get_code(error) != 0;
}

/* The call must fail, with a message; a call that makes an object or copies a text returns 0 then. */
#define REFUSED(call) check((call) != 0 && has_error(), #call, __LINE__)
#define NOTHING(call) check((call) == 0 && has_error(), #call, __LINE__)
#define FINE(call) check((call) == 0 && wavycon_get_code(error) == 0, #call, __LINE__)
#define MADE(object) check((object) != NULL && wavycon_get_code(error) == 0, #object, __LINE__)

/* The call must fail with the message that this argument is NULL. */
#define IS_NULL(call, argument) check(((void)(call), has_message(argument " is NULL")), #call, __LINE__)

static int has_message(const char *words)
{
    char message[200] = "";
    wavycon_get_message(error, message, sizeof message);
    return strcmp(message, words) == 0;
}

static double number(const void *object, const char *name)
{
    double value = 0;
    check(wavycon_get(error, object, name, &value) == 0, name, __LINE__);
    return value;
}

/* Whether an object has as many notes, and words in the last one. */
static int has_notes(const void *object, int lines, const char *words)
{
    char notes[2000] = "none";
    char *last = notes;
    wavycon_get_text(error, object, "notes", notes, sizeof notes);
    for (char *end = strchr(notes, '\n'); end != NULL; end = strchr(end + 1, '\n')) {
        lines--;
        if (end[1] != '\0')
            last = end + 1;
    }
    return lines == 0 && strstr(last, words) != NULL;
}

static wavycon_scene scene_of(const char *deck)
{
    return wavycon_new_scene(error, deck, "misuse", 1, 0, 0, NULL);
}

static void decks(void)
{
    const char *const bad[] = {
        NULL, "", "&", "\x01\xff'", "&surface kind = 'wave_3d' /", "&surface kind = 'wave_1d', amplitude = -1 /",
        "&surface kind = 'wave_1d', amplitude = NaN /", "&surface kind = 'wave_1d', wavelength = 1e300 /",
        "&surface kind = 'wave_1d', wavelength = 0 /", "&surface kind = 'wave_1d' / &surface kind = 'wave_2d' /",
        "&surface kind = 'file', file = 'there is no such file' /",
        "&surface kind = 'sum', amplitudes = 1, waves_x = 2147483647 /",
        "&surface kind = 'wave_2d' / &method solver = 'none' /",
        "&surface kind = 'wave_2d' / &method solver = 'closed_form' /",
        "&surface kind = 'wave_2d' / &method solver = 'grid', grid_points = 7 /",
        "&surface kind = 'wave_2d' / &material e_star = 0 /",
        "&surface kind = 'wave_2d' / &material hardness = 1e300 /",
        "&surface kind = 'wave_2d' / &method solver = 'fitted' / &material hardness = 1 /",
        "&surface kind = 'wave_2d' / &stress nu = 0.6 /", "&surface kind = 'wave_2d' / &load yield = 1 /"};
    for (size_t i = 0; i < COUNT(bad); i++)
        NOTHING(scene_of(bad[i]));
    IS_NULL(wavycon_new_scene(error, NULL, NULL, 1, 0, 0, NULL), "wavycon_new_scene: deck");
    IS_NULL(wavycon_new_scene(error, wave, NULL, 1, 0, 0, NULL), "wavycon_new_scene: path");
    NOTHING(wavycon_new_scene(error, wave, "misuse", 1, 16, 16, NULL));
    int status;
    IS_NULL(wavycon_run_deck(error, NULL, "", 1, &status), "wavycon_run_deck: path");
    IS_NULL(wavycon_run_deck(error, "no.nml", NULL, 1, &status), "wavycon_run_deck: directory");
    IS_NULL(wavycon_run_deck(error, "no.nml", "", 1, NULL), "wavycon_run_deck: exit_status");
    REFUSED(wavycon_run_deck(error, "there is no such deck.nml", "", 1, &status));
    check(status == WAVYCON_FILE_TROUBLE, "a missing deck is file trouble", __LINE__);
    const char loads[] = "&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.2, 0.3 /\n&method solver = 'beale' /\n"
                         "&output directory = '.' /\n";
    FILE *deck = fopen("misuse.nml", "w");
    check(deck != NULL && fputs(loads, deck) >= 0 && fclose(deck) == 0, "the deck can be written", __LINE__);
    FINE(wavycon_run_deck(error, "misuse.nml", "", 1, &status));
    check(status == 0 && remove("misuse.summary.dat") == 0, "the deck was run", __LINE__);
    /* A file for the directory. */
    REFUSED(wavycon_run_deck(error, "misuse.nml", "misuse.nml", 1, &status));
    remove("misuse.resolved.nml");
    /* Quotes are a part of the name of a directory. */
    FINE(wavycon_run_deck(error, "misuse.nml", "'misuse'", 1, &status));
    check(remove("'misuse'/misuse.summary.dat") == 0, "a directory with quotes in its name", __LINE__);
    check(remove("'misuse'/misuse.resolved.nml") == 0 && remove("'misuse'") == 0, "and what it has", __LINE__);
    wavycon_scene scene = wavycon_read_scene(error, "misuse.nml", "load.mean_gap=0.5\nsurface.amplitude=2", 0);
    check(number(scene, "loads") == 1 && number(scene, "amplitude") == 2, "keys that are set", __LINE__);
    wavycon_delete(&scene);
    const char *const bad_settings[] = {NULL, "\n", "amplitude=2", "surface.amplitude=", "surface.height=2"};
    for (size_t i = 0; i < COUNT(bad_settings); i++)
        NOTHING(wavycon_read_scene(error, "misuse.nml", bad_settings[i], 0));
    IS_NULL(wavycon_read_scene(error, NULL, "", 0), "wavycon_read_scene: path");
    IS_NULL(wavycon_read_scene(error, "no.nml", NULL, 0), "wavycon_read_scene: settings");
    NOTHING(wavycon_read_scene(error, "there is no such deck.nml", "", 0));
    remove("misuse.nml");
    scene = scene_of(loads);
    char order[8];
    check(number(scene, "loads") == 2, "the deck has two loads", __LINE__);
    check(wavycon_get_text(error, scene, "order", order, sizeof order) == 4 && strcmp(order, "2 1") == 0,
          "the order of the loads", __LINE__);
    const int bad_loads[] = {-2147483647 - 1, -1, 2, 2147483647};
    for (size_t i = 0; i < COUNT(bad_loads); i++)
        NOTHING(wavycon_solve_load(error, scene, bad_loads[i]));
    check(has_notes(scene, 0, ""), "no notes before a load is solved", __LINE__);
    wavycon_solution solution = wavycon_solve_load(error, scene, 1);
    MADE(solution);
    check(has_notes(scene, 1, "truncated series"), "the notes of the loads", __LINE__);
    wavycon_delete(&scene);
    check(number(solution, "pbar_over_pstar") == 0.3, "the second load, without its scene", __LINE__);
    wavycon_delete(&solution);
}

static void heights(void)
{
    const char deck[] = "&surface kind = 'file', file = 'heights' / &method solver = 'grid' /";
    const struct {
        int points_x, points_y;
    } bad_points[] = {{0, 8}, {8, 0}, {8, -8}, {2, 2}, {2147483647, 2147483647}};
    const char *const bad_keys[] = {"detrend = 'cubic'", "file_format = 'xyz'", "missing_value = 1", "length_x = -1"};
    const double bad_heights[] = {NAN, INFINITY, -INFINITY, 1e300};
    double height[64], flat[64] = {0};
    for (int i = 0; i < 64; i++)
        height[i] = sin(i);
    for (size_t i = 0; i < COUNT(bad_points); i++)
        NOTHING(wavycon_new_scene(error, deck, "d", 1, bad_points[i].points_x, bad_points[i].points_y, height));
    for (size_t i = 0; i < COUNT(bad_keys); i++) {
        char text[200];
        snprintf(text, sizeof text, "&surface kind = 'file', file = 'heights', %s /", bad_keys[i]);
        NOTHING(wavycon_new_scene(error, text, "d", 1, 8, 8, height));
    }
    NOTHING(wavycon_new_scene(error, wave, "d", 1, 8, 8, height));
    for (size_t i = 0; i < COUNT(bad_heights); i++) {
        double all[64];
        memcpy(all, height, sizeof all);
        all[5] = bad_heights[i];
        NOTHING(wavycon_new_scene(error, deck, "d", 1, 8, 8, all));
    }
    wavycon_scene scene = wavycon_new_scene(error, deck, "d", 1, 8, 8, flat);
    MADE(scene); /* a flat map is a surface */
    wavycon_solution solution = wavycon_solve(error, scene, "mean_pressure", 3);
    check(number(scene, "p_star") == 0 && number(solution, "peak_pressure") == 3, "a flat map", __LINE__);
    NOTHING(wavycon_new_table(error, solution, "contours"));
    wavycon_delete(&solution);
    wavycon_delete(&scene);
    /* A map with too few points for error estimates; 64 of them are counted. */
    scene = wavycon_new_scene(error, deck, "d", 0, 8, 8, height);
    solution = wavycon_solve(error, scene, "pbar_over_pstar", 0.1);
    check(number(scene, "points_x") == 8 && number(scene, "length_y") == 1 && number(scene, "has_sides") == 0, "the map",
          __LINE__);
    check(has_notes(scene, 1, "by differences of neighbours only"), "notes of the surface alone", __LINE__);
    check(has_notes(solution, 1, "the errors of 1 of 1 loads are unknown"), "notes of the load", __LINE__);
    double counted = 64*number(solution, "contact_area_counted_fraction");
    check(number(solution, "status_code") == WAVYCON_UNRESOLVED &&
          isnan(number(solution, "contact_area_fraction_error")), "unresolved", __LINE__);
    check(counted >= 1 && counted == floor(counted) && number(solution, "linear_area_fraction") > 0, "areas", __LINE__);
    NOTHING(wavycon_new_table(error, solution, "map")); /* without fields */
    NOTHING(wavycon_solve(error, scene, "yield", 1));
    wavycon_delete(&solution);
    wavycon_delete(&scene);
}

static void loads(wavycon_scene scene, wavycon_solution solution)
{
    const char *const bad[] = {NULL, "", "pressure", "sweep_from", "pbar_over_pstar = 0.1, mean_pressure",
                               "pbar_over_pstar = 0.1,", "sweep_from = 0, sweep_to = 1, sweep_steps", "\x01\xff'"};
    const char *const quantities[] = {"pbar_over_pstar", "mean_pressure", "mean_gap_over_amplitude", "mean_gap",
                                      "contact_area_fraction", "yield"};
    const double bad_values[] = {NAN, INFINITY, -INFINITY, -0.1, 1e300};
    IS_NULL(wavycon_solve(error, scene, NULL, 0.5), "wavycon_solve: quantity");
    NOTHING(wavycon_solve(error, NULL, "pbar_over_pstar", 0.5));
    NOTHING(wavycon_solve(error, (wavycon_scene)solution, "pbar_over_pstar", 0.5));
    NOTHING(wavycon_solve_load(error, NULL, 0));
    NOTHING(wavycon_solve_load(error, (wavycon_scene)error, 0));
    /* A call that could not make an object keeps its message beside NULL, not beside another object. */
    check(has_message("the handle is not one of the kind scene"), "another kind", __LINE__);
    NOTHING(wavycon_get_text(error, scene, "colour", NULL, 0));
    check(has_message("there is no text 'colour'; there are notes, solver, method, why_chosen, pressure_unit, "
                      "length_unit, resolved_deck, order, tables"), "another text", __LINE__);
    NOTHING(wavycon_get_text(error, scene, "lenght_unit", NULL, 0));
    check(has_message("there is no text 'lenght_unit'; did you mean 'length_unit'?"), "the nearest text", __LINE__);
    NOTHING(wavycon_get_text(error, solution, "statsu", NULL, 0));
    check(has_message("there is no text 'statsu'; did you mean 'status'?"), "that of a solution", __LINE__);
    NOTHING(wavycon_get_text(error, NULL, "versions", NULL, 0));
    check(has_message("there is no text 'versions' of NULL; did you mean 'version'?"), "that of NULL", __LINE__);
    double value;
    REFUSED(wavycon_get(error, error, "loads", &value));
    check(has_message("the handle is not one of the kinds scene, solution and table"), "another object",
          __LINE__);
    NOTHING(wavycon_solve_load(error, scene, 0));
    REFUSED(wavycon_set_progress(error, NULL, NULL, NULL));
    REFUSED(wavycon_set_progress(error, (wavycon_scene)solution, NULL, NULL));
    FINE(wavycon_set_progress(error, scene, NULL, NULL));
    for (size_t i = 0; i < COUNT(bad); i++)
        NOTHING(wavycon_solve(error, scene, bad[i], 0.5));
    for (size_t i = 0; i < COUNT(quantities); i++)
        for (size_t j = 0; j < COUNT(bad_values); j++)
            NOTHING(wavycon_solve(error, scene, quantities[i], bad_values[j]));
    /* A tension is a load of a contact with adhesion alone. */
    wavycon_scene adhesive = scene_of("&surface kind = 'wave_1d' / &method solver = 'auto' /"
                                      "&interface work_of_adhesion = .1 /");
    wavycon_solution pulled = wavycon_solve(error, adhesive, "pbar_over_pstar", -0.01);
    check(number(pulled, "status_code") == WAVYCON_NO_LOAD, "a tension", __LINE__);
    wavycon_table curve = wavycon_new_table(error, pulled, "adhesion");
    MADE(curve);
    wavycon_delete(&curve);
    wavycon_delete(&pulled);
    wavycon_delete(&adhesive);
    const int bad_threads[] = {0, -1, 1000000};
    for (size_t i = 0; i < COUNT(bad_threads); i++)
        REFUSED(wavycon_set_threads(error, bad_threads[i]));
}

static void names(wavycon_scene scene, wavycon_solution solution, wavycon_table table)
{
    const struct {
        const void *object;
        const char *number, *text;
    } bad[] = {{NULL, "rows", "solver"},  {error, "rows", "solver"},           {scene, NULL, NULL},
               {scene, "", ""},           {scene, "mean_gap", "status"},       {solution, NULL, NULL},
               {solution, "", ""},        {solution, "status", "mean_gap"},    {solution, "own_points_z", "method"},
               {solution, "map_", "orde"},
               {solution, "p_star", ""},  {table, "row", "column"},            {table, NULL, NULL},
               {table, "", ""},           {scene, "version", "version"},       {solution, "\x01\xff'", "\x01\xff'"}};
    const char *const tables[] = {NULL, "", "contour", "coefficients", "details", "load", "stress", "\x01\xff'"};
    double value, column[10];
    for (size_t i = 0; i < COUNT(bad); i++) {
        REFUSED(wavycon_get(error, bad[i].object, bad[i].number, &value));
        NOTHING(wavycon_get_text(error, bad[i].object, bad[i].text, NULL, 0));
    }
    IS_NULL(wavycon_get(error, scene, NULL, &value), "wavycon_get: name");
    IS_NULL(wavycon_get(error, scene, "p_star", NULL), "wavycon_get: value");
    IS_NULL(wavycon_get_text(error, scene, NULL, NULL, 0), "wavycon_get_text: name");
    IS_NULL(wavycon_new_table(error, solution, NULL), "wavycon_new_table: name");
    NOTHING(wavycon_new_table(error, NULL, "summary"));
    NOTHING(wavycon_new_table(error, (wavycon_solution)scene, "summary"));
    for (size_t i = 0; i < COUNT(tables); i++)
        NOTHING(wavycon_new_table(error, solution, tables[i]));
    REFUSED(wavycon_get_column(error, NULL, "load", 1, column));
    REFUSED(wavycon_get_column(error, (wavycon_table)scene, "load", 1, column));
    IS_NULL(wavycon_get_column(error, table, NULL, 1, column), "wavycon_get_column: name");
    REFUSED(wavycon_get_column(error, table, "stress", 1, column));
    REFUSED(wavycon_get_column(error, table, "perimeters", 1, column));
    check(has_message("the table has no column 'perimeters'; did you mean 'perimeter'?"), "the nearest column", __LINE__);
    REFUSED(wavycon_get(error, solution, "area", &value));
    check(has_message("there is no number 'area'; did you mean 'contact_area'?"), "the nearest number", __LINE__);
    IS_NULL(wavycon_get_column(error, table, "load", 1, NULL), "wavycon_get_column: values");
    const int bad_rows[] = {0, 2, -1, 2147483647};
    for (size_t i = 0; i < COUNT(bad_rows); i++)
        REFUSED(wavycon_get_column(error, table, "load", bad_rows[i], column));
    FINE(wavycon_get_column(error, table, "load", 1, column));
    check(column[0] == 1 && number(table, "rows") == 1, "the table", __LINE__);
    check(number(solution, "pbar_over_pstar") == 0.2 && number(solution, "iterations") > 0 &&
          number(solution, "status_code") == WAVYCON_CONVERGED && number(solution, "own_points_x") == 0 && number(solution, "map_points_x") == 128,
          "numbers of a solution", __LINE__);
    check(number(scene, "e_star") == 1 && number(scene, "dimension") == 2 && number(scene, "loads") == 0,
          "numbers of a scene", __LINE__);
}

static void fields(wavycon_scene scene, wavycon_solution solution, wavycon_solution without_fields)
{
    enum { points = 3 };
    const double x[points] = {0, 0.1, 0.2}, bad[] = {NAN, INFINITY, -INFINITY}, nans[2] = {0, NAN}, far = 1e300;
    const double bad_ratios[] = {NAN, INFINITY, -INFINITY, -1, 0.51, 1e300}, bad_depths[] = {NAN, INFINITY, -1e-3};
    const char *const bad_laterals[] = {NULL, "", "fixed", "free'", "free', nu = 0.2", "\x01\xff"};
    const int bad_points[] = {0, -1, -2147483647 - 1, 2147483647};
    double f[64], stress[16][6], errors[16], other[points], principal[points][3];
    wavycon_solution const bad_solutions[] = {NULL, (wavycon_solution)scene, (wavycon_solution)error, without_fields};
#define FIELDS(s, n, x, y) wavycon_get_fields(error, s, n, x, y, f, f, f)
#define GRID(s, m, n, offset) wavycon_get_grid(error, s, m, n, offset, f, f, f)
#define STRESSES(s, n, x, y, z, nu, lateral) wavycon_get_stresses(error, s, n, x, y, z, nu, lateral, stress[0], errors)
#define PLANE(s, m, n, offset, z, nu, lateral) \
    wavycon_get_stress_plane(error, s, m, n, offset, z, nu, lateral, stress[0], errors)
    for (size_t i = 0; i < COUNT(bad_solutions); i++) {
        wavycon_solution s = bad_solutions[i];
        REFUSED(FIELDS(s, points, x, x));
        REFUSED(GRID(s, 8, 8, NULL));
        REFUSED(STRESSES(s, points, x, x, x, 0.3, "free"));
        REFUSED(PLANE(s, 4, 4, NULL, 0, 0.3, "free"));
    }
    for (size_t i = 0; i < COUNT(bad_ratios); i++) {
        REFUSED(STRESSES(solution, points, x, x, x, bad_ratios[i], "free"));
        REFUSED(PLANE(solution, 4, 4, NULL, 0, bad_ratios[i], "free"));
    }
    for (size_t i = 0; i < COUNT(bad_laterals); i++) {
        REFUSED(STRESSES(solution, points, x, x, x, 0.3, bad_laterals[i]));
        REFUSED(PLANE(solution, 4, 4, NULL, 0, 0.3, bad_laterals[i]));
    }
    for (size_t i = 0; i < COUNT(bad_points); i++) {
        int n = bad_points[i];
        REFUSED(FIELDS(solution, n, x, x));
        REFUSED(GRID(solution, n, 4, NULL));
        REFUSED(GRID(solution, 4, n, NULL));
        REFUSED(GRID(solution, n, n, NULL));
        REFUSED(STRESSES(solution, n, x, x, x, 0.3, "free"));
        REFUSED(PLANE(solution, n, 4, NULL, 0, 0.3, "free"));
        REFUSED(PLANE(solution, n, n, NULL, 0, 0.3, "free"));
        REFUSED(wavycon_get_invariants(error, n, stress[0], other, other, principal[0]));
    }
    for (size_t i = 0; i < COUNT(bad); i++) {
        REFUSED(FIELDS(solution, 1, &bad[i], x));
        REFUSED(FIELDS(solution, 1, x, &bad[i]));
        REFUSED(STRESSES(solution, 1, &bad[i], x, x, 0.3, "free"));
        REFUSED(STRESSES(solution, 1, x, &bad[i], x, 0.3, "free"));
        REFUSED(STRESSES(solution, 1, x, x, &bad_depths[i], 0.3, "free"));
        REFUSED(PLANE(solution, 4, 4, NULL, bad_depths[i], 0.3, "free"));
    }
    REFUSED(GRID(solution, 8, 8, nans));
    REFUSED(PLANE(solution, 4, 4, nans, 0, 0.3, "free"));
    IS_NULL(FIELDS(solution, points, NULL, x), "wavycon_get_fields: x");
    IS_NULL(FIELDS(solution, points, x, NULL), "wavycon_get_fields: y");
    IS_NULL(STRESSES(solution, points, NULL, x, x, 0.3, "free"), "wavycon_get_stresses: x");
    IS_NULL(STRESSES(solution, points, x, NULL, x, 0.3, "free"), "wavycon_get_stresses: y");
    IS_NULL(STRESSES(solution, points, x, x, NULL, 0.3, "free"), "wavycon_get_stresses: depth");
    IS_NULL(STRESSES(solution, points, x, x, x, 0.3, NULL), "wavycon_get_stresses: lateral");
    IS_NULL(wavycon_get_stresses(error, solution, points, x, x, x, 0.3, "free", NULL, errors),
            "wavycon_get_stresses: stress");
    IS_NULL(PLANE(solution, 4, 4, NULL, 0, 0.3, NULL), "wavycon_get_stress_plane: lateral");
    IS_NULL(wavycon_get_stress_plane(error, solution, 4, 4, NULL, 0, 0.3, "free", NULL, errors),
            "wavycon_get_stress_plane: stress");
    IS_NULL(wavycon_get_invariants(error, points, NULL, other, other, principal[0]), "wavycon_get_invariants: stress");
    /* Results that are not wanted. */
    FINE(wavycon_get_fields(error, solution, 1, &far, &far, NULL, NULL, NULL));
    FINE(wavycon_get_grid(error, solution, 8, 8, NULL, NULL, NULL, NULL));
    f[63] = -1;
    FINE(wavycon_get_grid(error, solution, 8, 8, NULL, NULL, f, NULL));
    check(f[63] >= 0, "the gap alone", __LINE__);
    FINE(wavycon_get_stress_plane(error, solution, 4, 4, NULL, 0.1, 0.3, "free", stress[0], NULL));
    FINE(wavycon_get_stresses(error, solution, 1, &far, &far, &far, 0.3, "free", stress[1], NULL));
    double mean = number(solution, "mean_pressure");
    check(fabs(stress[1][2] + mean) <= 1e-14*mean, "far below", __LINE__);
    FINE(STRESSES(solution, points, x, x, x, 0.3, "free"));
    check(errors[0] >= 0 && errors[points - 1] >= 0, "errors of all points", __LINE__);
    FINE(wavycon_get_invariants(error, points, stress[0], NULL, NULL, NULL));
    FINE(wavycon_get_invariants(error, points, stress[0], other, NULL, principal[0]));
    check(other[2] > 0 && principal[2][0] >= principal[2][1] && principal[2][1] >= principal[2][2], "order", __LINE__);
    stress[0][3] = NAN;
    FINE(wavycon_get_invariants(error, points, stress[0], other, errors, principal[0]));
    check(isnan(other[0]) && isnan(errors[0]) && isnan(principal[0][2]) && other[1] > 0, "no number", __LINE__);
}

static void bounds(wavycon_scene scene, wavycon_solution solution)
{
    enum { n = 8 };
    const double bad_loads[] = {NAN, INFINITY, -INFINITY, 0, -1};
    const int bad_points[] = {0, 1, -1, -2147483647 - 1, 2147483647};
    const double bad_offsets[] = {NAN, INFINITY, 1.01, -1.01};
    double p[n*n], gap[n*n], b[6] = {0};
    wavycon_scene free = scene_of("&surface kind = 'ball', radius = 1, length_x = 1 / &method solver = 'auto' /");
    MADE(free);
    FINE(wavycon_get_grid(error, solution, n, n, NULL, p, gap, NULL));
    double pbar = number(solution, "mean_pressure");
    for (size_t i = 0; i < COUNT(bad_loads); i++)
        REFUSED(wavycon_get_bounds(error, scene, bad_loads[i], n, n, NULL, p, gap, b));
    for (size_t i = 0; i < COUNT(bad_points); i++) {
        REFUSED(wavycon_get_bounds(error, scene, pbar, bad_points[i], n, NULL, p, gap, b));
        REFUSED(wavycon_get_bounds(error, scene, pbar, n, bad_points[i], NULL, p, gap, b));
    }
    REFUSED(wavycon_get_bounds(error, NULL, pbar, n, n, NULL, p, gap, b));
    REFUSED(wavycon_get_bounds(error, (wavycon_scene)solution, pbar, n, n, NULL, p, gap, b));
    IS_NULL(wavycon_get_bounds(error, scene, pbar, n, n, NULL, NULL, gap, b), "wavycon_get_bounds: pressure");
    IS_NULL(wavycon_get_bounds(error, scene, pbar, n, n, NULL, p, NULL, b), "wavycon_get_bounds: gap");
    IS_NULL(wavycon_get_bounds(error, scene, pbar, n, n, NULL, p, gap, NULL), "wavycon_get_bounds: bounds");
    REFUSED(wavycon_get_bounds(error, free, pbar, n, n, NULL, p, gap, b));
    check(b[0] == 0 && b[5] == 0, "no bounds are written", __LINE__);
    FINE(wavycon_get_bounds(error, scene, pbar, n, n, NULL, p, gap, b));
    check(b[0] < b[1] && b[2] < number(solution, "approach") && number(solution, "approach") < b[3] &&
          b[4] < number(solution, "mean_gap") && number(solution, "mean_gap") < b[5], "the bounds", __LINE__);
    for (size_t i = 0; i < COUNT(bad_offsets); i++)
        REFUSED(wavycon_get_bounds(error, scene, pbar, n, n, (double[2]){0, bad_offsets[i]}, p, gap, b));
    FINE(wavycon_get_bounds(error, scene, pbar, n, n, (double[2]){1, -1}, p, gap, b));
    p[3] = NAN;
    REFUSED(wavycon_get_bounds(error, scene, pbar, n, n, NULL, p, gap, b));
    p[3] = 0;
    gap[3] = INFINITY;
    REFUSED(wavycon_get_bounds(error, scene, pbar, n, n, NULL, p, gap, b));
    gap[3] = 0;
    for (int i = 0; i < n*n; i++)
        p[i] = -1;
    REFUSED(wavycon_get_bounds(error, scene, pbar, n, n, NULL, p, gap, b));
    wavycon_delete(&free);
}

/* The message is that of the call that failed, not of those that then got NULL. */
static void chains(void)
{
    char message[1000];
    double value;
    wavycon_scene scene = scene_of("&surface kind = 'wave_1d', amplitude = -5 /");
    wavycon_set_progress(error, scene, NULL, NULL);
    wavycon_solution solution = wavycon_solve(error, scene, "yield", 1);
    wavycon_table table = wavycon_new_table(error, solution, "summary");
    REFUSED(wavycon_get(error, table, "rows", &value));
    NOTHING(wavycon_get_text(error, solution, "status", message, sizeof message));
    wavycon_get_message(error, message, sizeof message);
    check(strstr(message, "'-5'") != NULL, "the message of the first call of a chain", __LINE__);
    /* Calls that are right in between change nothing. */
    wavycon_scene other = scene_of("&surface kind = 'wave_1d' /");
    solution = wavycon_solve(error, other, "mean_presure", 1);
    FINE(wavycon_get(error, other, "p_star", &value));
    REFUSED(wavycon_get(error, solution, "mean_gap", &value));
    wavycon_get_message(error, message, sizeof message);
    check(strstr(message, "'mean_presure'") != NULL, "the message of a chain with a right call", __LINE__);
    wavycon_delete(&other);
    /* A failed call that makes no object begins no chain. */
    REFUSED(wavycon_set_threads(error, 0));
    REFUSED(wavycon_set_progress(error, NULL, NULL, NULL));
    check(has_message("the handle is NULL"), "NULL behind a call that makes no object", __LINE__);
    REFUSED(wavycon_set_threads(error, 0));
    REFUSED(wavycon_get(error, NULL, "mean_gap", &value));
    check(has_message("the handle is NULL"), "a number of NULL", __LINE__);
    REFUSED(wavycon_set_threads(error, 0));
    NOTHING(wavycon_new_table(error, NULL, "summary"));
    check(has_message("the handle is NULL"), "a table of NULL", __LINE__);
}

/* Without an error object the return value alone tells; buffers that are NULL or small are no danger. */
static void errors_and_texts(wavycon_scene scene, wavycon_solution solution)
{
    char text[8] = "unused!", version[20];
    double value;
    wavycon_error none = NULL;
    check(wavycon_get_code(NULL) != 0, "NULL is no error object", __LINE__);
    check(wavycon_get_code((wavycon_error)scene) != 0, "a scene is no error object", __LINE__);
    check(wavycon_get_message(NULL, text, sizeof text) > 8, "NULL has no message", __LINE__);
    check(strlen(text) == 7, "a text is cut", __LINE__);
    check(wavycon_new_scene(NULL, "", "", 0, 0, 0, NULL) == NULL, "no error object", __LINE__);
    check(wavycon_new_scene((wavycon_error)scene, "", "", 0, 0, 0, NULL) == NULL, "a scene for the error", __LINE__);
    check(wavycon_get(NULL, NULL, NULL, &value) == WAVYCON_BAD_INPUT, "no error object", __LINE__);
    check(wavycon_get_text(error, solution, "status", text, 0) == 10, "a buffer without bytes", __LINE__);
    check(wavycon_get_text(error, solution, "status", text, 1) == 10 && text[0] == '\0', "of one byte", __LINE__);
    check(wavycon_get_text(error, solution, "status", text, 5) == 10 && strcmp(text, "conv") == 0, "cut", __LINE__);
    check(wavycon_get_text(error, solution, "status", NULL, 5) == 10, "no buffer", __LINE__);
    check(wavycon_get_text(error, NULL, "version", version, sizeof version) > 5 && strchr(version, '.') != NULL,
          "the version", __LINE__);
    wavycon_delete(NULL);
    wavycon_delete(&none);
    check(none == NULL, "NULL stays NULL", __LINE__);
}

int main(void)
{
    error = wavycon_new_error();
    check(wavycon_get_code(error) == 0, "a new error object has no error", __LINE__);
    wavycon_scene scene = scene_of(wave);
    wavycon_scene bare = wavycon_new_scene(error, wave, "bare", 0, 0, 0, NULL);
    wavycon_solution solution = wavycon_solve(error, scene, "pbar_over_pstar", 0.2);
    MADE(solution);
    wavycon_solution without_fields = wavycon_solve(error, bare, "contact_area_fraction", 0.3);
    MADE(without_fields);
    wavycon_table table = wavycon_new_table(error, solution, "spots");
    MADE(table);
    decks();
    heights();
    loads(scene, solution);
    names(scene, solution, table);
    fields(scene, solution, without_fields);
    bounds(scene, solution);
    chains();
    errors_and_texts(scene, solution);
    wavycon_delete(&scene);
    wavycon_delete(&bare);
    wavycon_delete(&without_fields);
    wavycon_delete(&solution);
    wavycon_delete(&table);
    check(scene == NULL && table == NULL, "what is deleted is NULL", __LINE__);
    wavycon_delete(&scene);
    wavycon_delete(&error);
    printf("%d failures\n", failures);
    return failures != 0;
}
