/* Every function of wavycon.h with handles that are NULL or of another kind, with pointers that are NULL, and with
   numbers that are no numbers or out of range: each call must return an error and a message. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <wavycon.h>

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
    return wavycon_get_error_message(error, message, sizeof message) == 0 && message[0] != '\0' &&
           wavycon_check_error(error) != 0;
}

/* The call must fail, with a message; and without an error object it must fail too. */
#define REFUSED(call) check((call) != 0 && has_error(), #call, __LINE__)
#define NOTHING(call) check((call) == NULL && has_error(), #call, __LINE__)
#define FINE(call) check((call) == 0 && wavycon_check_error(error) == 0, #call, __LINE__)
#define MADE(object) check((object) != NULL && wavycon_check_error(error) == 0, #object, __LINE__)

static const double bad_lengths[] = {NAN, INFINITY, -INFINITY, -1, 0, 1e300, 1e-300};
enum { number_of_bad = sizeof bad_lengths/sizeof bad_lengths[0] };

static void surfaces(void)
{
    const double a[2] = {1, 0.5}, zeros[2] = {0, 0}, nans[2] = {1, NAN};
    const int one[2] = {1, 2}, none[2] = {0, 0}, huge[2] = {1, 2147483647};
    double heights[64], flat[64] = {0};
    for (int i = 0; i < 64; i++)
        heights[i] = sin(i);
    for (int i = 0; i < number_of_bad; i++) {
        double bad = bad_lengths[i];
        NOTHING(wavycon_new_wave_1d(error, 1, bad));
        NOTHING(wavycon_new_wave_2d(error, 1, bad, 1));
        NOTHING(wavycon_new_wave_2d(error, 1, 1, bad));
        NOTHING(wavycon_new_hexagonal(error, 1, bad));
        NOTHING(wavycon_new_crossed_1d(error, 1, bad, 1, 1));
        NOTHING(wavycon_new_crossed_1d(error, 1, 1, 1, bad));
        NOTHING(wavycon_new_wave_sum(error, 2, a, one, none, zeros, bad, 1));
        NOTHING(wavycon_new_wave_sum(error, 2, a, one, none, zeros, 1, bad));
        NOTHING(wavycon_new_heights(error, 8, 8, heights, bad, 1));
        NOTHING(wavycon_new_heights(error, 8, 8, heights, 1, bad));
        if (bad == 0)
            continue; /* an amplitude may be 0 */
        NOTHING(wavycon_new_wave_1d(error, bad, 1));
        NOTHING(wavycon_new_wave_2d(error, bad, 1, 1));
        NOTHING(wavycon_new_hexagonal(error, bad, 1));
        NOTHING(wavycon_new_crossed_1d(error, bad, 1, 1, 1));
        NOTHING(wavycon_new_crossed_1d(error, 1, 1, bad, 1));
    }
    NOTHING(wavycon_new_wave_sum(error, 0, a, one, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, -1, a, one, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2147483647, a, one, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, NULL, one, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, a, NULL, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, a, one, NULL, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, a, one, none, NULL, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, nans, one, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, a, none, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, a, huge, none, zeros, 1, 1));
    NOTHING(wavycon_new_wave_sum(error, 2, a, one, none, nans, 1, 1));
    NOTHING(wavycon_new_heights(error, 8, 8, NULL, 1, 1));
    NOTHING(wavycon_new_measured_heights(error, 8, 8, NULL, 1, 1, ""));
    NOTHING(wavycon_new_measured_heights(error, 8, 8, heights, 1, 1, NULL));
    NOTHING(wavycon_new_measured_heights(error, 8, 8, heights, 1, 1, "detrend = 'cubic'"));
    NOTHING(wavycon_new_measured_heights(error, 8, 8, heights, 1, 1, "kind = 'file'"));
    NOTHING(wavycon_new_measured_heights(error, 8, 8, heights, 1, 1, "length_x = 2"));
    NOTHING(wavycon_new_heights(error, 0, 8, heights, 1, 1));
    NOTHING(wavycon_new_heights(error, 8, -8, heights, 1, 1));
    NOTHING(wavycon_new_heights(error, 2, 2, heights, 1, 1));
    NOTHING(wavycon_new_heights(error, 2147483647, 2147483647, heights, 1, 1));
    for (int i = 0; i < number_of_bad; i++) {
        if (bad_lengths[i] == 0 || bad_lengths[i] == -1 || bad_lengths[i] == 1e-300)
            continue; /* heights may be 0 or negative, and vanish beside others */
        double saved = heights[5];
        heights[5] = bad_lengths[i];
        NOTHING(wavycon_new_heights(error, 8, 8, heights, 1, 1));
        heights[5] = saved;
    }
    NOTHING(wavycon_new_surface(error, NULL));
    NOTHING(wavycon_new_surface(error, ""));
    NOTHING(wavycon_new_surface(error, "kind = 'wave_3d'"));
    NOTHING(wavycon_new_surface(error, "kind = 'wave_1d', amplitude = -1"));
    NOTHING(wavycon_new_surface(error, "kind = 'wave_1d' / &surface kind = 'wave_2d'"));
    NOTHING(wavycon_new_surface(error, "kind = 'file', file = 'there is no such file'"));
    NOTHING(wavycon_new_surface(error, "\x01\xff'"));
    /* A flat map is a surface. */
    wavycon_surface surface = wavycon_new_heights(error, 8, 8, flat, 1, 1);
    MADE(surface);
    wavycon_delete(&surface);
    /* A map with too few points for error estimates; 64 of them are counted. */
    surface = wavycon_new_heights(error, 8, 8, heights, 1, 1);
    wavycon_solver solver = wavycon_new_solver(error, surface, 1, "solver = 'grid'", 0);
    wavycon_solution solution = wavycon_solve(error, solver, "pbar_over_pstar", 0.1);
    wavycon_measures m;
    FINE(wavycon_get_measures(error, solution, &m));
    double counted = 64*m.contact_area_counted_fraction;
    check(m.status_code == WAVYCON_UNRESOLVED && isnan(m.contact_area_fraction_error), "unresolved", __LINE__);
    check(counted >= 1 && counted == floor(counted), "points in contact", __LINE__);
    check(m.contact_area_corrected_fraction < m.contact_area_counted_fraction && m.linear_area_fraction > 0, "areas",
          __LINE__);
    wavycon_delete(&solution);
    wavycon_delete(&solver);
    wavycon_delete(&surface);
}

static void solvers(wavycon_surface surface, wavycon_solver solver, wavycon_solution solution)
{
    char text[100];
    int loads;
    wavycon_scales scales;
    NOTHING(wavycon_new_solver(error, NULL, 1, "", 1));
    NOTHING(wavycon_new_solver(error, (wavycon_surface)solver, 1, "", 1));
    NOTHING(wavycon_new_solver(error, (wavycon_surface)error, 1, "", 1));
    NOTHING(wavycon_new_solver(error, surface, 1, NULL, 1));
    for (int i = 0; i < number_of_bad; i++)
        NOTHING(wavycon_new_solver(error, surface, bad_lengths[i], "", 1));
    NOTHING(wavycon_new_solver(error, surface, 1, "solver = 'none'", 1));
    NOTHING(wavycon_new_solver(error, surface, 1, "solver = 'closed_form'", 1));
    NOTHING(wavycon_new_solver(error, surface, 1, "accuracy = NaN", 1));
    NOTHING(wavycon_new_solver_of_material(error, NULL, "", "", 1));
    NOTHING(wavycon_new_solver_of_material(error, surface, NULL, "", 1));
    NOTHING(wavycon_new_solver_of_material(error, surface, "", NULL, 1));
    NOTHING(wavycon_new_solver_of_material(error, surface, "hardness = -1", "", 1));
    NOTHING(wavycon_new_solver_of_material(error, surface, "hardness = 1e300", "", 1));
    NOTHING(wavycon_new_solver_of_material(error, surface, "e1 = 1", "", 1));
    NOTHING(wavycon_new_solver_of_material(error, surface, "hardness = 1", "solver = 'fitted'", 1));
    NOTHING(wavycon_new_solver(error, surface, 1, "solver = 'grid', grid_points = 7", 1));
    NOTHING(wavycon_new_solver(error, surface, 1, "/", 1));
    NOTHING(wavycon_new_solver(error, surface, 1, "solver = 'grid' &load pbar_over_pstar = 0.2", 1));
    NOTHING(wavycon_new_solver_of_deck(error, NULL, 1));
    NOTHING(wavycon_new_solver_of_deck(error, "", 1));
    NOTHING(wavycon_new_solver_of_deck(error, "there is no such deck.nml", 1));
    check(wavycon_check_error(error) == WAVYCON_FILE_TROUBLE, "a missing deck is file trouble", __LINE__);
    int status;
    REFUSED(wavycon_run_deck(error, NULL, "", 1, &status));
    REFUSED(wavycon_run_deck(error, "there is no such deck.nml", NULL, 1, &status));
    REFUSED(wavycon_run_deck(error, "there is no such deck.nml", "", 1, NULL));
    REFUSED(wavycon_run_deck(error, "there is no such deck.nml", "", 1, &status));
    REFUSED(wavycon_describe_solver(error, NULL, text, sizeof text));
    REFUSED(wavycon_describe_solver(error, (wavycon_solver)surface, text, sizeof text));
    REFUSED(wavycon_describe_solver(error, solver, NULL, sizeof text));
    REFUSED(wavycon_get_scales(error, NULL, &scales));
    REFUSED(wavycon_get_scales(error, (wavycon_solver)solution, &scales));
    REFUSED(wavycon_get_scales(error, solver, NULL));
    FINE(wavycon_get_scales(error, solver, &scales));
    check(scales.e_star == 1 && scales.length_y == 1 && scales.dimension == 2, "the scales", __LINE__);
    REFUSED(wavycon_get_number_of_loads(error, NULL, &loads));
    REFUSED(wavycon_get_number_of_loads(error, solver, NULL));
    FINE(wavycon_get_number_of_loads(error, solver, &loads));
    check(loads == 0, "a solver without a deck has no loads", __LINE__);
    NOTHING(wavycon_solve_load(error, NULL, 0));
    NOTHING(wavycon_solve_load(error, solver, 0));
    NOTHING(wavycon_solve_load(error, solver, -1));
    NOTHING(wavycon_solve_load(error, solver, 2147483647));
    NOTHING(wavycon_solve(error, NULL, "pbar_over_pstar", 0.5));
    NOTHING(wavycon_solve(error, (wavycon_solver)surface, "pbar_over_pstar", 0.5));
    NOTHING(wavycon_solve(error, solver, NULL, 0.5));
    NOTHING(wavycon_solve(error, solver, "", 0.5));
    NOTHING(wavycon_solve(error, solver, "pressure", 0.5));
    NOTHING(wavycon_solve(error, solver, "sweep_from", 0.5));
    NOTHING(wavycon_solve(error, solver, "pbar_over_pstar = 0.1, mean_pressure", 0.5));
    NOTHING(wavycon_solve(error, solver, "pbar_over_pstar = 0.1,", 0.5));
    NOTHING(wavycon_solve(error, solver, "sweep_from = 0, sweep_to = 1, sweep_steps", 5));
    const char *const quantities[] = {"pbar_over_pstar", "mean_pressure", "mean_gap_over_amplitude", "mean_gap",
                                      "contact_area_fraction"};
    const double bad_loads[] = {NAN, INFINITY, -INFINITY, -0.1, 1e80, 1e300};
    for (size_t i = 0; i < sizeof quantities/sizeof quantities[0]; i++)
        for (size_t j = 0; j < sizeof bad_loads/sizeof bad_loads[0]; j++)
            NOTHING(wavycon_solve(error, solver, quantities[i], bad_loads[j]));
    REFUSED(wavycon_set_stress(error, NULL, "nu = 0.3"));
    REFUSED(wavycon_set_stress(error, (wavycon_solver)surface, "nu = 0.3"));
    const char *const bad_keys[] = {NULL, "", "yield_stress = 1", "nu = 0.6", "nu = -1", "nu = NaN",
                                    "nu = 0.3, 0.3, 0.3", "nu = 0.3, yield_stress = -1", "nu = 0.3, yield_stress = 0",
                                    "nu = 0.3, yield_criterion = 'tresca'", "nu = 0.3, yeld = 1",
                                    "nu = 0.3 / &load yield = 1", "\x01\xff'"};
    for (size_t i = 0; i < sizeof bad_keys/sizeof bad_keys[0]; i++)
        REFUSED(wavycon_set_stress(error, solver, bad_keys[i]));
    NOTHING(wavycon_solve(error, solver, "yield", 1));
    FINE(wavycon_set_stress(error, solver, "nu = 0.3"));
    NOTHING(wavycon_solve(error, solver, "yield", 1));
    FINE(wavycon_set_stress(error, solver, "nu = 0.3, yield_stress = 2"));
    const double bad_ratios[] = {NAN, INFINITY, -INFINITY, -1, 0};
    for (size_t i = 0; i < sizeof bad_ratios/sizeof bad_ratios[0]; i++)
        NOTHING(wavycon_solve(error, solver, "yield", bad_ratios[i]));
    REFUSED(wavycon_set_threads(error, 0));
    REFUSED(wavycon_set_threads(error, -1));
    REFUSED(wavycon_set_threads(error, 1000000));
}

/* A deck in this directory: its solver, its loads, and a run of it. */
static void decks(void)
{
    int loads = 0, status = -1;
    wavycon_measures measures;
    FILE *deck = fopen("misuse.nml", "w");
    check(deck != NULL, "the deck can be written", __LINE__);
    if (deck == NULL)
        return;
    fputs("&surface kind = 'wave_1d' /\n&load pbar_over_pstar = 0.2, 0.3 /\n&output directory = '.' /\n", deck);
    fclose(deck);
    wavycon_solver solver = wavycon_new_solver_of_deck(error, "misuse.nml", 0);
    MADE(solver);
    FINE(wavycon_get_number_of_loads(error, solver, &loads));
    check(loads == 2, "the deck has two loads", __LINE__);
    NOTHING(wavycon_solve_load(error, solver, 2));
    wavycon_solution solution = wavycon_solve_load(error, solver, 1);
    MADE(solution);
    FINE(wavycon_get_measures(error, solution, &measures));
    check(measures.pbar_over_pstar == 0.3, "the second load", __LINE__);
    FINE(wavycon_run_deck(error, "misuse.nml", "", 1, &status));
    check(status == 0 && remove("misuse.summary.dat") == 0, "the deck was run", __LINE__);
    /* A file for the directory. */
    REFUSED(wavycon_run_deck(error, "misuse.nml", "misuse.nml", 1, &status));
    check(status == WAVYCON_FILE_TROUBLE, "the program's exit status", __LINE__);
    remove("misuse.resolved.nml");
    remove("misuse.nml");
    wavycon_delete(&solution);
    wavycon_delete(&solver);
}

static void solutions(wavycon_surface surface, wavycon_solution solution, wavycon_solution without_fields)
{
    const double nans[2] = {0, NAN};
    char text[100];
    double field[64], x[1000], y[1000], number, offset[2];
    int edges, points, two[2];
    wavycon_measures measures;
    wavycon_solution const bad[] = {NULL, (wavycon_solution)surface, (wavycon_solution)error};
    for (int i = 0; i < 3; i++) {
        REFUSED(wavycon_get_measures(error, bad[i], &measures));
        REFUSED(wavycon_get_status(error, bad[i], text, sizeof text));
        REFUSED(wavycon_get_solver_name(error, bad[i], text, sizeof text));
        REFUSED(wavycon_get_map(error, bad[i], 8, 8, NULL, field, field, field));
        REFUSED(wavycon_get_own_points(error, bad[i], two, offset));
        REFUSED(wavycon_get_fields_at(error, bad[i], 0, 0, &number, &number, &number));
        REFUSED(wavycon_get_number_of_edges(error, bad[i], &edges));
        REFUSED(wavycon_get_edge_points(error, bad[i], 0, &points));
        REFUSED(wavycon_get_edge(error, bad[i], 0, 1000, x, y));
    }
    FINE(wavycon_get_measures(error, solution, &measures));
    check(measures.pbar_over_pstar == 0.2 && measures.iterations > 0 && measures.status_code == WAVYCON_CONVERGED,
          "first and last numbers", __LINE__);
    check(isnan(measures.contact_area_counted_fraction) == isnan(measures.contact_area_corrected_fraction) &&
          isnan(measures.linear_area_fraction), "areas of a wave", __LINE__);
    REFUSED(wavycon_get_measures(error, solution, NULL));
    REFUSED(wavycon_get_status(error, solution, NULL, 100));
    REFUSED(wavycon_get_solver_name(error, solution, NULL, 100));
    const int bad_points[] = {0, -1, 100000, 2147483647};
    for (size_t i = 0; i < sizeof bad_points/sizeof bad_points[0]; i++) {
        REFUSED(wavycon_get_map(error, solution, bad_points[i], bad_points[i], NULL, field, field, field));
        REFUSED(wavycon_get_map(error, solution, bad_points[i], 1000000, NULL, field, field, field));
    }
    REFUSED(wavycon_get_map(error, solution, 8, 8, nans, field, field, field));
    FINE(wavycon_get_map(error, solution, 8, 8, NULL, NULL, NULL, NULL));
    REFUSED(wavycon_get_own_points(error, solution, NULL, offset));
    REFUSED(wavycon_get_own_points(error, solution, two, NULL));
    REFUSED(wavycon_get_fields_at(error, solution, NAN, 0, &number, NULL, NULL));
    REFUSED(wavycon_get_fields_at(error, solution, 0, INFINITY, &number, NULL, NULL));
    FINE(wavycon_get_fields_at(error, solution, 1e300, -1e300, NULL, NULL, NULL));
    REFUSED(wavycon_get_number_of_edges(error, solution, NULL));
    FINE(wavycon_get_number_of_edges(error, solution, &edges));
    check(edges == 2, "two spots in the cell", __LINE__);
    REFUSED(wavycon_get_edge_points(error, solution, -1, &points));
    REFUSED(wavycon_get_edge_points(error, solution, edges, &points));
    REFUSED(wavycon_get_edge_points(error, solution, 0, NULL));
    FINE(wavycon_get_edge_points(error, solution, 0, &points));
    REFUSED(wavycon_get_edge(error, solution, 2147483647, points, x, y));
    REFUSED(wavycon_get_edge(error, solution, 0, points - 1, x, y));
    REFUSED(wavycon_get_edge(error, solution, 0, points, NULL, y));
    REFUSED(wavycon_get_edge(error, solution, 0, points, x, NULL));
    check(points <= 1000, "the arrays are large enough", __LINE__);
    FINE(wavycon_get_edge(error, solution, 0, points, x, y));
    check(x[0] == x[points - 1] && y[0] == y[points - 1], "the edge is closed", __LINE__);
    REFUSED(wavycon_get_map(error, without_fields, 8, 8, NULL, field, field, field));
    REFUSED(wavycon_get_own_points(error, without_fields, two, offset));
    REFUSED(wavycon_get_fields_at(error, without_fields, 0, 0, &number, NULL, NULL));
    REFUSED(wavycon_get_number_of_edges(error, without_fields, &edges));
}

static void stresses(wavycon_surface surface, wavycon_solution solution, wavycon_solution without_fields)
{
    enum { points = 3 };
    const double x[points] = {0, 0.1, 0.2}, bad[] = {NAN, INFINITY, -INFINITY}, nans[2] = {0, NAN};
    const double bad_ratios[] = {NAN, INFINITY, -INFINITY, -1, 0.51, 1e300};
    const char *const bad_laterals[] = {NULL, "", "fixed", "free'", "free', nu = 0.2", "\x01\xff"};
    const int bad_points[] = {0, -1, -2147483647};
    double stress[16][6], errors[16], other[points], principal[points][3];
    wavycon_largest_stress largest;
    wavycon_solution const bad_solutions[] = {NULL, (wavycon_solution)surface, (wavycon_solution)error, without_fields};
    for (int i = 0; i < 4; i++) {
        REFUSED(wavycon_get_stress(error, bad_solutions[i], points, x, x, x, 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_stress_plane(error, bad_solutions[i], 4, 4, NULL, 0, 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_largest_stress(error, bad_solutions[i], 0.3, "free", &largest));
    }
    for (size_t i = 0; i < sizeof bad_ratios/sizeof bad_ratios[0]; i++) {
        REFUSED(wavycon_get_stress(error, solution, points, x, x, x, bad_ratios[i], "free", stress[0], errors));
        REFUSED(wavycon_get_stress_plane(error, solution, 4, 4, NULL, 0, bad_ratios[i], "free", stress[0], errors));
        REFUSED(wavycon_get_largest_stress(error, solution, bad_ratios[i], "free", &largest));
    }
    for (size_t i = 0; i < sizeof bad_laterals/sizeof bad_laterals[0]; i++) {
        REFUSED(wavycon_get_stress(error, solution, points, x, x, x, 0.3, bad_laterals[i], stress[0], errors));
        REFUSED(wavycon_get_stress_plane(error, solution, 4, 4, NULL, 0, 0.3, bad_laterals[i], stress[0], errors));
        REFUSED(wavycon_get_largest_stress(error, solution, 0.3, bad_laterals[i], &largest));
    }
    for (int i = 0; i < 3; i++) {
        REFUSED(wavycon_get_stress(error, solution, bad_points[i], x, x, x, 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_stress_plane(error, solution, bad_points[i], 4, NULL, 0, 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_stress_plane(error, solution, 4, bad_points[i], NULL, 0, 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_invariants(error, bad_points[i], stress[0], other, other, principal[0]));
        REFUSED(wavycon_get_stress(error, solution, 1, &bad[i], x, x, 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_stress(error, solution, 1, x, &bad[i], x, 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_stress(error, solution, 1, x, x, &bad[i], 0.3, "free", stress[0], errors));
        REFUSED(wavycon_get_stress_plane(error, solution, 4, 4, NULL, bad[i], 0.3, "free", stress[0], errors));
    }
    const double negative = -1e-3, far = 1e300;
    REFUSED(wavycon_get_stress(error, solution, 1, x, x, &negative, 0.3, "free", stress[0], errors));
    REFUSED(wavycon_get_stress_plane(error, solution, 4, 4, NULL, negative, 0.3, "free", stress[0], errors));
    REFUSED(wavycon_get_stress_plane(error, solution, 2147483647, 2147483647, NULL, 0, 0.3, "free", stress[0], errors));
    REFUSED(wavycon_get_stress_plane(error, solution, 4, 4, nans, 0, 0.3, "free", stress[0], errors));
    REFUSED(wavycon_get_stress(error, solution, points, NULL, x, x, 0.3, "free", stress[0], errors));
    REFUSED(wavycon_get_stress(error, solution, points, x, NULL, x, 0.3, "free", stress[0], errors));
    REFUSED(wavycon_get_stress(error, solution, points, x, x, NULL, 0.3, "free", stress[0], errors));
    REFUSED(wavycon_get_stress(error, solution, points, x, x, x, 0.3, "free", NULL, errors));
    REFUSED(wavycon_get_stress_plane(error, solution, 4, 4, NULL, 0, 0.3, "free", NULL, errors));
    REFUSED(wavycon_get_largest_stress(error, solution, 0.3, "free", NULL));
    REFUSED(wavycon_get_invariants(error, points, NULL, other, other, principal[0]));
    FINE(wavycon_get_stress_plane(error, solution, 4, 4, NULL, 0.1, 0.3, "free", stress[0], NULL));
    FINE(wavycon_get_stress_plane(error, solution, 4, 4, NULL, 0.1, 0.3, "free", stress[0], errors));
    FINE(wavycon_get_stress(error, solution, 1, &far, &far, &far, 0.3, "free", stress[1], NULL));
    wavycon_measures measures;
    FINE(wavycon_get_measures(error, solution, &measures));
    check(fabs(stress[1][2] + measures.mean_pressure) <= 1e-14*measures.mean_pressure, "far below", __LINE__);
    FINE(wavycon_get_stress(error, solution, points, x, x, x, 0.3, "free", stress[0], NULL));
    FINE(wavycon_get_stress(error, solution, points, x, x, x, 0.3, "free", stress[0], errors));
    check(errors[0] >= 0 && errors[points - 1] >= 0, "errors of all points", __LINE__);
    FINE(wavycon_get_invariants(error, points, stress[0], NULL, NULL, NULL));
    FINE(wavycon_get_invariants(error, points, stress[0], other, NULL, principal[0]));
    check(other[2] > 0 && principal[2][0] >= principal[2][1] && principal[2][1] >= principal[2][2], "order", __LINE__);
    stress[0][3] = NAN;
    FINE(wavycon_get_invariants(error, points, stress[0], other, errors, principal[0]));
    check(isnan(other[0]) && isnan(errors[0]) && isnan(principal[0][2]) && other[1] > 0, "no number", __LINE__);
    FINE(wavycon_get_largest_stress(error, solution, 0.3, "free", &largest));
    check(largest.largest_von_mises > 0 && largest.shear_depth >= 0, "first and last numbers", __LINE__);
}

/* The message is that of the call that failed, not of those that then got NULL. */
static void chains(void)
{
    char message[1000];
    wavycon_measures measures;
    wavycon_surface surface = wavycon_new_wave_1d(error, -5, 1);
    wavycon_solver solver = wavycon_new_solver(error, surface, 1, "", 0);
    wavycon_set_stress(error, solver, "nu = 0.3, yield_stress = 1");
    wavycon_solution solution = wavycon_solve(error, solver, "yield", 1);
    REFUSED(wavycon_get_measures(error, solution, &measures));
    wavycon_get_error_message(error, message, sizeof message);
    check(strstr(message, "'-5'") != NULL, "the message of the first call of a chain", __LINE__);
}

/* Without an error object the return value alone tells; buffers that are NULL or small are no danger. */
static void errors_and_texts(wavycon_surface surface, wavycon_solution solution)
{
    char text[8] = "unused!", version[20];
    wavycon_error none = NULL;
    check(wavycon_check_error(NULL) != 0, "NULL is no error object", __LINE__);
    check(wavycon_check_error((wavycon_error)surface) != 0, "a surface is no error object", __LINE__);
    check(wavycon_get_error_message(NULL, text, sizeof text) != 0, "NULL has no message", __LINE__);
    check(strlen(text) == 7, "a text is cut", __LINE__);
    check(wavycon_get_error_message(error, NULL, 10) == 0, "no buffer", __LINE__);
    check(wavycon_new_wave_1d(NULL, -1, 1) == NULL, "no error object", __LINE__);
    check(wavycon_new_wave_1d((wavycon_error)surface, -1, 1) == NULL, "a surface for the error object", __LINE__);
    check(wavycon_get_measures(NULL, NULL, NULL) == WAVYCON_BAD_INPUT, "no error object", __LINE__);
    FINE(wavycon_get_status(error, solution, text, 0));
    FINE(wavycon_get_status(error, solution, text, 1));
    check(text[0] == '\0', "a buffer of one byte", __LINE__);
    FINE(wavycon_get_status(error, solution, text, 5));
    check(strcmp(text, "conv") == 0, "a text is cut", __LINE__);
    check(wavycon_get_version(NULL, 10) != 0, "no buffer", __LINE__);
    check(wavycon_get_version(version, sizeof version) == 0 && strchr(version, '.') != NULL, "the version", __LINE__);
    wavycon_delete(NULL);
    wavycon_delete(&none);
    check(none == NULL, "NULL stays NULL", __LINE__);
}

int main(void)
{
    error = wavycon_new_error();
    check(wavycon_check_error(error) == 0, "a new error object has no error", __LINE__);
    wavycon_surface surface = wavycon_new_wave_2d(error, 1, 1, 1);
    MADE(surface);
    wavycon_solver solver = wavycon_new_solver(error, surface, 1, "solver = 'auto', accuracy = 1e-3", 1);
    MADE(solver);
    wavycon_solver bare = wavycon_new_solver(error, surface, 1, "solver = 'auto', accuracy = 1e-3", 0);
    MADE(bare);
    wavycon_solution solution = wavycon_solve(error, solver, "pbar_over_pstar", 0.2);
    MADE(solution);
    wavycon_solution without_fields = wavycon_solve(error, bare, "contact_area_fraction", 0.3);
    MADE(without_fields);
    surfaces();
    solvers(surface, solver, solution);
    decks();
    wavycon_delete(&solver);
    wavycon_delete(&bare);
    solutions(surface, solution, without_fields);
    stresses(surface, solution, without_fields);
    chains();
    errors_and_texts(surface, solution);
    wavycon_delete(&without_fields);
    wavycon_delete(&solution);
    wavycon_delete(&surface);
    check(solver == NULL && surface == NULL, "what is deleted is NULL", __LINE__);
    wavycon_delete(&surface);
    wavycon_delete(&error);
    printf("%d failures\n", failures);
    return failures != 0;
}
