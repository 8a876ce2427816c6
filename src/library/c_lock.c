/* The lock that lets one thread at a time into the library: gfortran 12 keeps the lengths of texts that functions
   return in static memory. The solvers have no such functions, so other threads come in while a load is solved, but not
   with the same scene. A Fortran program that calls the module has no lock. */
#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t load_solved = PTHREAD_COND_INITIALIZER;
static _Thread_local int has_lock = 0;
/* Solves that this thread is in: a callback may call the library, which solves another load. */
static _Thread_local int solves = 0;

/* A process that forks waits until no other thread is in the library, so that all is whole in the child, whose lock is
   free. Python deletes objects of other threads in the child before its own hooks run. */
static void before_fork(void)
{
    pthread_mutex_lock(&lock);
}

static void in_parent(void)
{
    pthread_mutex_unlock(&lock);
}

static void in_child(void)
{
    pthread_mutex_init(&lock, NULL);
    pthread_cond_init(&load_solved, NULL);
}

static void note_forks(void)
{
    pthread_atfork(before_fork, in_parent, in_child);
}

void wavycon_lock(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, note_forks);
    pthread_mutex_lock(&lock);
    has_lock = 1;
}

void wavycon_unlock(void)
{
    has_lock = 0;
    pthread_mutex_unlock(&lock);
}

/* Waits until no other thread solves with the scene to which `is_solving` belongs, then lets other threads in. */
void wavycon_begin_solve(int *is_solving)
{
    if (!has_lock)
        return;
    while (*is_solving)
        pthread_cond_wait(&load_solved, &lock);
    *is_solving = 1;
    solves++;
    wavycon_unlock();
}

/* Waits until no other thread is in the library. */
void wavycon_end_solve(int *is_solving)
{
    if (solves == 0)
        return;
    wavycon_lock();
    solves--;
    *is_solving = 0;
    pthread_cond_broadcast(&load_solved);
}
