/* A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa. */
#include <math.h>
#include <stdio.h>
#include <wavycon.h>

static const char wave[] = "&surface kind = 'wave_2d', amplitude = 1e-6, wavelength = 1e-3 /\n"
                           "&material e1 = 210e9, nu1 = 0.3 /\n"
                           "&method solver = 'auto', accuracy = 1e-4 /\n"
                           "&stress yield_stress = 1e9 /\n";
static const char rough[] = "&surface kind = 'file', file = 'heights', length_x = 4e-3, length_y = 3e-3,\n"
                            "   detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror' /\n"
                            "&material e_star = 1e9 /\n&method residual = 1e-10 /\n";
static wavycon_error error;

/* Prints numbers in one line. */
static void print(int n, const double *numbers, const char *end)
{
    for (int i = 0; i < n; i++)
        printf("%24.16e ", numbers[i]);
    printf("%s", end);
}

/* Prints numbers of an object by their names, and the status of a solution. */
static void print_named(wavycon_solution solution, int n, const char *const *names)
{
    char status[40] = "";
    for (int i = 0; i < n; i++) {
        double number = 0;
        wavycon_get(error, solution, names[i], &number);
        print(1, &number, "");
    }
    wavycon_get_text(error, solution, "status", status, sizeof status);
    printf("%s\n", status);
}

/* The largest number of a column. */
static double largest(wavycon_table table, const char *name)
{
    static double values[10000];
    double rows = 0, most = 0;
    wavycon_get(error, table, "rows", &rows);
    if (rows > 10000 || wavycon_get_column(error, table, name, (int)rows, values) != 0)
        return 0;
    for (int i = 0; i < rows; i++)
        most = i == 0 || values[i] > most ? values[i] : most;
    return most;
}

/* Fields, edges and stresses of a load. */
static void below(wavycon_solution solution)
{
    static double pressure[32][48], gap[32][48], plane[32][48][6];
    const char *const columns[] = {"largest_von_mises", "von_mises_x", "von_mises_y", "von_mises_depth",
                                   "largest_von_mises_over_pstar_error", "largest_shear"};
    const double crest[2] = {0, 0}, depths[2] = {1e-4, 3e-4}, nu = 0.3;
    double errors[2], highest = 0, principal[2][3], shear[2], stress[2][6], von_mises[2];
    wavycon_table contours = wavycon_new_table(error, solution, "contours");
    wavycon_table of_stress = wavycon_new_table(error, solution, "stress_largest");
    if (wavycon_get_grid(error, solution, 48, 32, NULL, &pressure[0][0], &gap[0][0], NULL) != 0)
        return;
    for (int k = 0; k < 32*48; k++)
        highest = pressure[k/48][k%48] > highest ? pressure[k/48][k%48] : highest;
    printf("%24.16e %24.16e %24.16e %d\n", highest, pressure[2][1], gap[2][23], (int)largest(contours, "curve"));
    if (wavycon_get_stresses(error, solution, 2, crest, crest, depths, nu, "constrained", &stress[0][0], errors) != 0 ||
        wavycon_get_invariants(error, 2, &stress[0][0], von_mises, shear, &principal[0][0]) != 0)
        return;
    for (int i = 0; i < 2; i++) {
        print(6, stress[i], "");
        print(1, &errors[i], "");
        print(1, &von_mises[i], "");
        print(1, &shear[i], "");
        print(3, principal[i], "\n");
    }
    wavycon_get_stress_plane(error, solution, 48, 32, NULL, depths[0], nu, "constrained", &plane[0][0][0], NULL);
    print(6, plane[4][7], "\n");
    for (int i = 0; i < 6; i++) {
        double number = largest(of_stress, columns[i]);
        print(1, &number, i == 5 ? "\n" : "");
    }
    wavycon_delete(&of_stress);
    wavycon_delete(&contours);
}

int main(void)
{
    const char *const of_load[] = {"pbar_over_pstar", "mean_gap", "contact_area_fraction", "peak_pressure",
                                   "peak_pressure_over_pstar_error"};
    const char *const of_yield[] = {"mean_pressure", "contact_area_fraction"};
    const char *const of_map[] = {"mean_gap", "contact_area", "mean_pressure"};
    const double loads[] = {0.9, 0.5, 0.2};
    static double heights[12][16];
    char message[1000];
    error = wavycon_new_error();
    wavycon_scene scene = wavycon_new_scene(error, wave, "wave", 1, 0, 0, NULL);
    for (int i = 0; i < 3; i++) {
        wavycon_solution solution = wavycon_solve(error, scene, "pbar_over_pstar", loads[i]);
        print_named(solution, 5, of_load);
        if (i == 2)
            below(solution);
        wavycon_delete(&solution);
    }
    wavycon_delete(&scene);

    /* The load at which steel yields, of a scene of its own, whose digits do not depend on other loads. */
    scene = wavycon_new_scene(error, wave, "wave", 1, 0, 0, NULL);
    wavycon_solution solution = wavycon_solve(error, scene, "yield", 1);
    print_named(solution, 2, of_yield);
    wavycon_delete(&solution);
    wavycon_delete(&scene);

    /* A measured map with a tilt and a hole. A scene may be deleted before its solutions. */
    for (int j = 0; j < 12; j++)
        for (int i = 0; i < 16; i++)
            heights[j][i] = ((7*i*i + 3*j*j + i*j) % 11 + 0.25*i)/1048576;
    heights[2][5] = NAN;
    scene = wavycon_new_scene(error, rough, "rough", 1, 16, 12, &heights[0][0]);
    solution = wavycon_solve(error, scene, "pbar_over_pstar", 0.2);
    wavycon_delete(&scene);
    print_named(solution, 3, of_map);
    wavycon_delete(&solution);

    int status = wavycon_get_code(error);
    wavycon_get_message(error, message, sizeof message);
    if (status != 0)
        fprintf(stderr, "%s\n", message);
    wavycon_delete(&error);
    return status;
}
