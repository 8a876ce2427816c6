/* Makes a test that stops the program a failure: the program then ends with status 1, whatever the test's own was.
   Gives the program a working folder of its own, so that it may run twice at the same time. */
#define _XOPEN_SOURCE 700
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static int exit_is_early = 1;
/* The working folder, in that of the start; removed at the end if it is empty. */
static char folder[32];

static void at_exit(void)
{
    if (chdir("..") == 0)
        rmdir(folder);
    if (exit_is_early) {
        puts("\nFAILED: a test stopped the program");
        fflush(stdout);
        _exit(1);
    }
}

/* Called before the first test. */
void refuse_early_exit(void)
{
    snprintf(folder, sizeof folder, "scratch_%d", (int)getpid());
    if (mkdir(folder, 0700) != 0 || chdir(folder) != 0 || atexit(at_exit) != 0) {
        perror(folder);
        _exit(1);
    }
}

/* Called after the last test. */
void allow_exit(void)
{
    exit_is_early = 0;
}
