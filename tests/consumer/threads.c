/* Several threads at the same time: each must find the digits that one thread finds. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <wavycon.h>

enum { number_of_threads = 8, points = 16, repeats = 2 };
static double heights[points][points];

typedef struct results {
    int failures;
    double numbers[2*repeats], below[2*repeats], map[points][points], stress[points][points][6];
} results;

/* A number of the table of largest stresses. */
static double largest(wavycon_error error, wavycon_solution solution, const char *name)
{
    double value = 0;
    wavycon_table table = wavycon_new_table(error, solution, "stress_largest");
    wavycon_get_column(error, table, name, 1, &value);
    wavycon_delete(&table);
    return value;
}

static void *work(void *answer)
{
    results *r = answer;
    wavycon_error error = wavycon_new_error();
    for (int i = 0; i < repeats; i++) {
        char wave[300];
        snprintf(wave, sizeof wave, "&surface kind = 'wave_2d', wavelength_y = %g / "
                 "&stress nu = 0.3, lateral = 'free' / &method solver = 'fitted', accuracy = 1e-6 /", 1 + 0.5*i);
        wavycon_scene fitted = wavycon_new_scene(error, wave, "wave", 1, 0, 0, NULL);
        wavycon_scene grid = wavycon_new_scene(
            error, "&surface kind = 'file', file = 'h' / &stress nu = 0.3 / &method solver = 'grid' /", "rough", 1,
            points, points, &heights[0][0]);
        wavycon_solution one = wavycon_solve(error, fitted, "contact_area_fraction", 0.2);
        wavycon_solution other = wavycon_solve(error, grid, "pbar_over_pstar", 0.1);
        r->failures += wavycon_get(error, one, "pbar_over_pstar", &r->numbers[2*i]) != 0;
        r->failures += wavycon_get(error, other, "contact_area_fraction", &r->numbers[2*i + 1]) != 0;
        r->failures += wavycon_get_grid(error, other, points, points, NULL, &r->map[0][0], NULL, NULL) != 0;
        r->failures += wavycon_get_stress_plane(error, other, points, points, NULL, 0.05, 0.3, "free",
                                                &r->stress[0][0][0], NULL) != 0;
        r->below[2*i] = largest(error, one, "largest_von_mises");
        r->below[2*i + 1] = largest(error, other, "largest_shear");
        wavycon_delete(&other);
        wavycon_delete(&one);
        wavycon_delete(&grid);
        wavycon_delete(&fitted);
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

/* A callback that itself calls the library and solves loads of another scene. */
static int solve_another(void *data, int iterations, double residual)
{
    void **all = data;
    if (iterations > 0 || residual < 1)
        return 0;
    wavycon_solution solution = wavycon_solve(all[0], all[1], "pbar_over_pstar", 0.5);
    int is_solved = solution != NULL;
    wavycon_delete(&solution);
    return !is_solved;
}

/* A callback that solves with the scene that is being solved: it would hang if it waited. Ends the load unless this is
   an error. */
static int solve_own(void *data, int iterations, double residual)
{
    (void)iterations, (void)residual;
    void **all = data;
    wavycon_solution solution = wavycon_solve(all[0], all[1], "pbar_over_pstar", 0.5);
    ++*(int *)all[2];
    return solution != NULL || wavycon_get_code(all[0]) != 1;
}

/* Ends the load in the tenth call or a later one. */
static int stop(void *calls, int iterations, double residual)
{
    return ++*(int *)calls >= 10 && iterations > 0 && residual <= 1;
}

/* The digits do not depend on what the callback does, also if it stopped the load before, nor does the lock: others
   come in afterwards. */
static int calls_in_a_callback(void)
{
    const char deck[] = "&surface kind = 'wave_2d' / &method solver = 'grid', accuracy = 1e-2 /\n"
                        "&interface friction = 0.3, nu = 0.3, tangential_over_normal = 0.1 /";
    double one = 0, other = 1, refused = 1, status = 0, after_stop = 1;
    int calls = 0, refusals = 0, of_loads;
    wavycon_error error = wavycon_new_error(), inner = wavycon_new_error();
    wavycon_scene scene = wavycon_new_scene(error, deck, "d", 1, 0, 0, NULL);
    wavycon_scene second = wavycon_new_scene(error, deck, "d", 0, 0, 0, NULL);
    void *data[2] = {inner, second};
    wavycon_solution plain = wavycon_solve(error, scene, "contact_area_fraction", 0.3);
    wavycon_set_progress(error, scene, solve_another, data);
    wavycon_solution disturbed = wavycon_solve(error, scene, "contact_area_fraction", 0.3);
    void *own[3] = {inner, scene, &refusals};
    wavycon_set_progress(error, scene, solve_own, own);
    wavycon_solution undisturbed = wavycon_solve(error, scene, "contact_area_fraction", 0.3);
    of_loads = refusals;
    wavycon_table slip = wavycon_new_table(error, undisturbed, "partial_slip");   /* solves, too */
    int is_made = slip != NULL && refusals > of_loads;
    wavycon_delete(&slip);
    wavycon_set_progress(error, scene, stop, &calls);
    wavycon_solution stopped = wavycon_solve(error, scene, "contact_area_fraction", 0.3);
    wavycon_set_progress(error, scene, NULL, NULL);
    wavycon_solution next = wavycon_solve(error, scene, "contact_area_fraction", 0.3);
    wavycon_get(error, plain, "pbar_over_pstar", &one);
    wavycon_get(error, disturbed, "pbar_over_pstar", &other);
    wavycon_get(error, undisturbed, "pbar_over_pstar", &refused);
    wavycon_get(error, stopped, "status_code", &status);
    wavycon_get(error, next, "pbar_over_pstar", &after_stop);
    wavycon_delete(&next);
    wavycon_delete(&stopped);
    wavycon_delete(&undisturbed);
    wavycon_delete(&disturbed);
    wavycon_delete(&plain);
    wavycon_delete(&second);
    wavycon_delete(&scene);
    wavycon_delete(&inner);
    wavycon_delete(&error);
    calls_go_on_while_a_load_is_solved();
    return one != other || one != refused || of_loads == 0 || !is_made || status != WAVYCON_INTERRUPTED ||
           one != after_stop;
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
    failures += calls_in_a_callback();
    printf("%d failures\n", failures);
    return failures != 0;
}
