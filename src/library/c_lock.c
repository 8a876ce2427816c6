/* The lock that lets one thread at a time into the library. It is needed because gfortran 12 keeps the lengths of texts
   that functions return in static memory. The solvers have no such functions, so that other threads may enter while a
   load is solved, but not with the same scene. A Fortran program that uses the module `wavycon` has no lock. */
#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t load_solved = PTHREAD_COND_INITIALIZER;
/* Whether this thread has the lock. */
static _Thread_local int has_lock = 0;
/* Number of loads that this thread is solving: a callback may call the library, which then solves another load. */
static _Thread_local int solves = 0;
/* Number of threads that have solved loads, and the number of this one, from 1; 0 before its first load. */
static int threads = 0;
static _Thread_local int this_thread = 0;

/* A process that forks first waits until no other thread is in the library, so that the child has no half-changed data;
   the child's lock is free. The lock is made anew in the child at once: Python deletes objects of other threads there
   before its own hooks run. */
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

/* Waits until no other thread has the lock, and takes it. */
void wavycon_lock(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, note_forks);
    pthread_mutex_lock(&lock);
    has_lock = 1;
}

/* Releases the lock. */
void wavycon_unlock(void)
{
    has_lock = 0;
    pthread_mutex_unlock(&lock);
}

/* Waits until no other thread solves with the scene to which `is_solving` belongs. Returns 0, or 1 if this thread
   itself solves with the scene: a callback must not wait for the load that called it. */
int wavycon_await_solve(const int *is_solving)
{
    if (!has_lock)
        return 0;
    if (this_thread == 0)
        this_thread = ++threads;
    while (*is_solving && *is_solving != this_thread)
        pthread_cond_wait(&load_solved, &lock);
    return *is_solving != 0;
}

/* Called before a load is solved. Waits as wavycon_await_solve does and returns the same; if that is 0, releases the
   lock, so that other threads may enter the library. */
int wavycon_begin_solve(int *is_solving)
{
    if (wavycon_await_solve(is_solving))
        return 1;
    if (!has_lock)
        return 0;
    *is_solving = this_thread;
    solves++;
    wavycon_unlock();
    return 0;
}

/* Called after a load was solved: takes the lock again, and lets other threads solve with the scene. */
void wavycon_end_solve(int *is_solving)
{
    if (solves == 0)
        return;
    wavycon_lock();
    solves--;
    *is_solving = 0;
    pthread_cond_broadcast(&load_solved);
}
