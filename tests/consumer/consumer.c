/* A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa. */
#include <math.h>
#include <stdio.h>
#include <wavycon.h>

static double pressure[32][48], gap[32][48], plane[32][48][6];

/* Prints numbers in one line. */
static void print(int n, const double *numbers, const char *end)
{
    for (int i = 0; i < n; i++)
        printf("%24.16e ", numbers[i]);
    printf("%s", end);
}

/* Stresses below a crest, on a plane, the largest ones, and the load at which steel yields. */
static void stresses(wavycon_error error, wavycon_surface surface, double e_star, wavycon_solution solution)
{
    const double crest[2] = {0, 0}, depths[2] = {1e-4, 3e-4}, nu = 0.3;
    double stress[2][6], errors[2], von_mises[2], shear[2], principal[2][3];
    char text[100] = "";
    wavycon_largest_stress largest = {0};
    wavycon_measures m = {0};
    wavycon_get_stress(error, solution, 2, crest, crest, depths, nu, "constrained", &stress[0][0], errors);
    if (wavycon_check_error(error) == 0)
        wavycon_get_invariants(error, 2, &stress[0][0], von_mises, shear, &principal[0][0]);
    if (wavycon_check_error(error) == 0)
        wavycon_get_stress_plane(error, solution, 48, 32, NULL, depths[0], nu, "constrained", &plane[0][0][0], NULL);
    if (wavycon_check_error(error) == 0)
        wavycon_get_largest_stress(error, solution, nu, "constrained", &largest);
    if (wavycon_check_error(error) != 0)
        return;
    for (int i = 0; i < 2; i++) {
        print(6, stress[i], "");
        print(1, &errors[i], "");
        print(1, &von_mises[i], "");
        print(1, &shear[i], "");
        print(3, principal[i], "\n");
    }
    print(6, plane[4][7], "\n");
    printf("%24.16e %24.16e %24.16e %24.16e %24.16e %24.16e\n", largest.largest_von_mises, largest.von_mises_x,
           largest.von_mises_y, largest.von_mises_depth, largest.largest_von_mises_over_pstar_error,
           largest.largest_shear);
    wavycon_solver solver = wavycon_new_solver(error, surface, e_star, "solver = 'auto', accuracy = 1e-4", 1);
    wavycon_set_stress(error, solver, "nu = 0.3, yield_stress = 1e9");
    wavycon_solution yielding = wavycon_solve(error, solver, "yield", 1);
    if (wavycon_get_measures(error, yielding, &m) == 0)
        wavycon_get_status(error, yielding, text, sizeof text);
    printf("%24.16e %24.16e %s\n", m.mean_pressure, m.contact_area_fraction, text);
    wavycon_delete(&yielding);
    wavycon_delete(&solver);
}

/* A measured map with a tilt and a hole. */
static void measured(wavycon_error error)
{
    static double heights[12][16];
    char text[100] = "";
    wavycon_measures m = {0};
    for (int j = 0; j < 12; j++)
        for (int i = 0; i < 16; i++)
            heights[j][i] = ((7*i*i + 3*j*j + i*j) % 11 + 0.25*i)/1048576;
    heights[2][5] = NAN;
    wavycon_surface surface = wavycon_new_measured_heights(
        error, 16, 12, &heights[0][0], 4e-3, 3e-3, "detrend = 'plane', fill_missing = 'harmonic', edges = 'mirror'");
    wavycon_solver solver = wavycon_new_solver(error, surface, 1e9, "residual = 1e-10", 1);
    wavycon_solution solution = wavycon_solve(error, solver, "pbar_over_pstar", 0.2);
    if (wavycon_get_measures(error, solution, &m) == 0)
        wavycon_get_status(error, solution, text, sizeof text);
    printf("%24.16e %24.16e %24.16e %s\n", m.mean_gap, m.contact_area, m.mean_pressure, text);
    wavycon_delete(&solution);
    wavycon_delete(&solver);
    wavycon_delete(&surface);
}

int main(void)
{
    const double loads[] = {0.9, 0.5, 0.2}, e_star = 210e9/(1 - 0.3*0.3);
    char text[1000];
    int edges = 0;
    double highest = 0;
    wavycon_measures m;
    wavycon_solution solution = NULL;
    wavycon_error error = wavycon_new_error();
    wavycon_surface surface = wavycon_new_wave_2d(error, 1e-6, 1e-3, 1e-3);
    wavycon_solver solver = wavycon_new_solver(error, surface, e_star, "solver = 'auto', accuracy = 1e-4", 1);
    for (int i = 0; i < 3 && wavycon_check_error(error) == 0; i++) {
        wavycon_delete(&solution);
        solution = wavycon_solve(error, solver, "pbar_over_pstar", loads[i]);
        if (wavycon_get_measures(error, solution, &m) != 0)
            break;
        wavycon_get_status(error, solution, text, sizeof text);
        printf("%24.16e %24.16e %24.16e %24.16e %24.16e %s\n", m.pbar_over_pstar, m.mean_gap, m.contact_area_fraction,
               m.peak_pressure, m.peak_pressure_over_pstar_error, text);
    }
    if (wavycon_check_error(error) == 0)
        wavycon_get_map(error, solution, 48, 32, NULL, &pressure[0][0], &gap[0][0], NULL);
    if (wavycon_check_error(error) == 0)
        wavycon_get_number_of_edges(error, solution, &edges);
    for (int k = 0; k < 32*48; k++)
        highest = pressure[k/48][k%48] > highest ? pressure[k/48][k%48] : highest;
    printf("%24.16e %24.16e %24.16e %d\n", highest, pressure[2][1], gap[2][23], edges);
    if (wavycon_check_error(error) == 0)
        stresses(error, surface, e_star, solution);
    if (wavycon_check_error(error) == 0)
        measured(error);
    int status = wavycon_check_error(error);
    wavycon_get_error_message(error, text, sizeof text);
    if (status != 0)
        fprintf(stderr, "%s\n", text);
    wavycon_delete(&solution);
    wavycon_delete(&solver);
    wavycon_delete(&surface);
    wavycon_delete(&error);
    return status;
}
