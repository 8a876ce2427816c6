/* A steel surface with waves 1 mm long and 1 um in amplitude against a rigid flat: lengths in m, pressures in Pa. */
#include <stdio.h>
#include <wavycon.h>

static double pressure[32][48], gap[32][48];

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
    int status = wavycon_check_error(error);
    wavycon_get_error_message(error, text, sizeof text);
    if (status != 0)
        fprintf(stderr, "%s\n", text);
    for (int k = 0; k < 32*48; k++)
        highest = pressure[k/48][k%48] > highest ? pressure[k/48][k%48] : highest;
    printf("%24.16e %24.16e %24.16e %d\n", highest, pressure[2][1], gap[2][23], edges);
    wavycon_delete(&solution);
    wavycon_delete(&solver);
    wavycon_delete(&surface);
    wavycon_delete(&error);
    return status;
}
