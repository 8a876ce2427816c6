/* The lock that lets one thread at a time into the library: gfortran 12 keeps the lengths of texts that functions return
   in static memory. */
#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

void wavycon_lock(void)
{
    pthread_mutex_lock(&lock);
}

void wavycon_unlock(void)
{
    pthread_mutex_unlock(&lock);
}
