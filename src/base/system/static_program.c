/* What the program has besides if it is linked statically: it says how the threads of OpenMP and OpenBLAS are to behave
   before these read their environment, which is done before the program's first statement. */
#define _XOPEN_SOURCE 700
#include <stdlib.h>

__attribute__((constructor(101))) static void set_environment_of_threads(void)
{
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    if (getenv("GOMP_SPINCOUNT") == NULL)
        setenv("OMP_WAIT_POLICY", "passive", 0);
}
