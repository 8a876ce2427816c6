/* The processes of --jobs. Each is a copy of this one that runs a deck; what it prints goes to files without names, so
   that nothing is left if all are interrupted. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

/* Of written_file.c. */
void wavycon_print(const char *text);

/* More than most_waiting of run_program.f90: a job has a place until it is shown. */
enum { places = 128, streams = 2 };

static struct job {
    int number;    /* of the job */
    pid_t process; /* 0: not started, or ended */
    int status;    /* exit status, or 128 and the number of the signal that ended it */
    FILE *files[streams]; /* standard output, standard error */
} jobs[places];

/* Starts the process of a job. Returns 1 in it, 0 in this one, -1 if there is none. Buffers must be empty. */
int wavycon_begin_job(int number)
{
    struct job *job = &jobs[number % places];
    pid_t parent = getpid();
    job->number = number;
    for (int i = 0; i < streams; i++)
        if ((job->files[i] = tmpfile()) == NULL)
            return -1;
    job->process = fork();
    if (job->process != 0)
        return job->process > 0 ? 0 : -1;
#ifdef __linux__
    /* The job ends with the process that started it, by whatever signal that ends, and even if it ignores SIGTERM. */
    signal(SIGTERM, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
    if (getppid() != parent || dup2(fileno(job->files[0]), STDOUT_FILENO) < 0 ||
        dup2(fileno(job->files[1]), STDERR_FILENO) < 0)
        _exit(3);
    return 1;
}

/* Waits for any process to end. Returns the number of its job, 0 if it is none. */
int wavycon_await_job(void)
{
    int how;
    pid_t process;
    do
        process = wait(&how);
    while (process < 0 && errno == EINTR);
    for (int i = 0; i < places; i++)
        if (process > 0 && jobs[i].process == process) {
            jobs[i].process = 0;
            jobs[i].status = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
            return jobs[i].number;
        }
    return 0;
}

/* Prints what the process of a job that has ended has printed. Returns its status. */
int wavycon_show_job(int number)
{
    struct job *job = &jobs[number % places];
    char buffer[4096];
    for (int i = 0; i < streams; i++) {
        rewind(job->files[i]);
        while (fgets(buffer, sizeof buffer, job->files[i]) != NULL)
            if (i == 0)
                wavycon_print(buffer);
            else
                fputs(buffer, stderr);
        fclose(job->files[i]);
    }
    return job->status;
}
