/* Several threads at the same time: each must find the digits that one thread finds. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <wavycon.h>

enum { number_of_threads = 8, points = 16, repeats = 2 };
static double heights[points][points];

typedef struct results {
    int failures;
    double numbers[2*repeats];
    double map[points][points];
    double stress[points][points][6];
    double below[2*repeats];
} results;

static void *work(void *answer)
{
    results *r = answer;
    wavycon_error error = wavycon_new_error();
    for (int i = 0; i < repeats; i++) {
        wavycon_surface wave = wavycon_new_wave_2d(error, 1, 1, 1 + 0.5*i);
        wavycon_surface rough = wavycon_new_heights(error, points, points, &heights[0][0], 1, 1);
        wavycon_solver fitted = wavycon_new_solver(error, wave, 1, "solver = 'fitted', accuracy = 1e-6", 1);
        wavycon_solver grid = wavycon_new_solver(error, rough, 1, "solver = 'grid'", 1);
        wavycon_solution one = wavycon_solve(error, fitted, "contact_area_fraction", 0.2);
        wavycon_solution other = wavycon_solve(error, grid, "pbar_over_pstar", 0.1);
        wavycon_measures m = {0}, n = {0};
        wavycon_largest_stress below_one = {0}, below_other = {0};
        r->failures += wavycon_get_measures(error, one, &m) != 0;
        r->failures += wavycon_get_measures(error, other, &n) != 0;
        r->failures += wavycon_get_map(error, other, points, points, NULL, &r->map[0][0], NULL, NULL) != 0;
        r->failures += wavycon_get_stress_plane(error, other, points, points, NULL, 0.05, 0.3, "free",
                                                &r->stress[0][0][0], NULL) != 0;
        r->failures += wavycon_get_largest_stress(error, one, 0.3, "free", &below_one) != 0;
        r->failures += wavycon_get_largest_stress(error, other, 0.3, "free", &below_other) != 0;
        r->below[2*i] = below_one.largest_von_mises;
        r->below[2*i + 1] = below_other.largest_shear;
        r->numbers[2*i] = m.pbar_over_pstar;
        r->numbers[2*i + 1] = n.contact_area_fraction;
        wavycon_delete(&other);
        wavycon_delete(&one);
        wavycon_delete(&grid);
        wavycon_delete(&fitted);
        wavycon_delete(&rough);
        wavycon_delete(&wave);
    }
    wavycon_delete(&error);
    return NULL;
}

/* The lock of the library. */
void wavycon_lock(void);
void wavycon_unlock(void);
void wavycon_begin_solve(int *is_solving);
void wavycon_end_solve(int *is_solving);

static void *call(void *unused)
{
    wavycon_delete(&(wavycon_error){wavycon_new_error()});
    return unused;
}

/* Hangs unless a thread gets into the library while another one solves. */
static void calls_go_on_while_a_load_is_solved(void)
{
    pthread_t other;
    int is_solving = 0;
    wavycon_lock();
    wavycon_begin_solve(&is_solving);
    pthread_create(&other, NULL, call, NULL);
    pthread_join(other, NULL);
    wavycon_end_solve(&is_solving);
    wavycon_unlock();
}

int main(void)
{
    static results all[number_of_threads + 1];
    pthread_t threads[number_of_threads];
    unsigned state = 1;
    int failures = 0;
    for (int k = 0; k < points*points; k++) {
        state = 1664525u*state + 1013904223u;
        heights[k/points][k%points] = state/4294967296.0;
    }
    calls_go_on_while_a_load_is_solved();
    for (int i = 0; i < number_of_threads; i++)
        pthread_create(&threads[i], NULL, work, &all[i]);
    for (int i = 0; i < number_of_threads; i++)
        pthread_join(threads[i], NULL);
    work(&all[number_of_threads]);
    for (int i = 0; i < number_of_threads; i++)
        failures += memcmp(&all[i], &all[number_of_threads], sizeof all[i]) != 0;
    failures += all[number_of_threads].failures;
    for (int i = 0; i < 2*repeats; i++)
        failures += !(all[number_of_threads].numbers[i] > 0 && all[number_of_threads].below[i] > 0);
    printf("%d failures\n", failures);
    return failures != 0;
}
