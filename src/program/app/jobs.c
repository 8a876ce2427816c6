/* The processes of --jobs. Each is a copy of this one that runs a deck; what it prints goes to files without names, so
   that nothing is left if all are interrupted. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

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

/* A pipe to which nobody writes: its end is that of the process that started the jobs. */
static int life[2] = {-1, -1};

/* Ends this process when the one that started it has ended, by whatever signal. */
static void *end_with_parent(void *unused)
{
    char byte;
    while (read(life[0], &byte, 1) < 0 && errno == EINTR)
        ;
    raise(SIGTERM);
    _exit(128 + SIGTERM); /* where the signal is ignored */
    return unused;
}

/* Starts the process of a job. Returns 1 in it, 0 in this one, -1 if there is none. Buffers must be empty. */
int wavycon_begin_job(int number)
{
    struct job *job = &jobs[number % places];
    job->number = number;
    for (int i = 0; i < streams; i++)
        if ((job->files[i] = tmpfile()) == NULL)
            return -1;
    if (life[0] < 0 && pipe(life) != 0)
        return -1;
    job->process = fork();
    if (job->process != 0)
        return job->process > 0 ? 0 : -1;
    if (dup2(fileno(job->files[0]), STDOUT_FILENO) < 0 || dup2(fileno(job->files[1]), STDERR_FILENO) < 0)
        _exit(3);
    pthread_t watch;
    close(life[1]);
    return pthread_create(&watch, NULL, end_with_parent, NULL) == 0 ? 1 : -1;
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
    char buffer[4096];
    size_t bytes;
    for (int i = 0; i < streams; i++) {
        FILE *from = jobs[number % places].files[i];
        rewind(from);
        while ((bytes = fread(buffer, 1, sizeof buffer - 1, from)) > 0) {
            buffer[bytes] = '\0';
            if (i == 0)
                wavycon_print(buffer);
            else
                fputs(buffer, stderr);
        }
        fclose(from);
    }
    return jobs[number % places].status;
}
