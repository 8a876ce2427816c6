/* Only in the statically linked program: sets environment variables that tell OpenMP and OpenBLAS how their threads
   shall behave. The libraries read them before the program's first statement, hence the constructor. */
#define _XOPEN_SOURCE 700
#include <stdlib.h>

__attribute__((constructor(101))) static void set_environment_of_threads(void)
{
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    if (getenv("GOMP_SPINCOUNT") == NULL)
        setenv("OMP_WAIT_POLICY", "passive", 0);
}
