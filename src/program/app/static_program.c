/* What the program has besides if it is linked statically. */
#define _XOPEN_SOURCE 700
#include <stdlib.h>

/* Stands for dlopen, which system.c and OpenMP call: there are no shared libraries. */
void *__wrap_dlopen(const char *name, int flags)
{
    return NULL;
}

/* Keeps OpenBLAS, which starts after it, from starting threads. */
__attribute__((constructor(101))) static void use_one_thread_for_matrices(void)
{
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
}
