/* What the program has besides if it is linked statically. */
#define _XOPEN_SOURCE 700
#include <stdlib.h>

void *__wrap_dlopen(const char *name, int flags);

/* The linker puts it in place of dlopen: OpenMP and system.c look for shared libraries, and there are none. */
void *__wrap_dlopen(const char *name, int flags)
{
    (void)name, (void)flags;
    return NULL;
}

/* Called before OpenBLAS and OpenMP start and read the environment, which shared ones do before the program: OpenBLAS
   starts no threads, and threads of OpenMP sleep while they wait, as in system.c. */
__attribute__((constructor(101))) static void prepare_threads(void)
{
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    if (getenv("GOMP_SPINCOUNT") == NULL)
        setenv("OMP_WAIT_POLICY", "passive", 0);
}
