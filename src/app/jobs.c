/* The processes of --jobs. Each is a copy of this one that runs a deck; what it prints, and the numbers that it sends,
   go to files without names, so that nothing is left if all are interrupted. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

/* Standard output, standard error, what is sent. */
enum { streams = 3 };

static struct job {
    pid_t process; /* 0: not started, or ended */
    int status;    /* exit status, or 128 and the number of the signal that ended it */
    FILE *files[streams];
} *jobs;
static int number_of_jobs;
static FILE *sent; /* in a process of a job */

/* Makes room for so many jobs, which are numbered from 1. Returns 0 without memory. */
int wavycon_start_jobs(int number)
{
    number_of_jobs = number;
    jobs = calloc((size_t)number + 1, sizeof *jobs);
    return jobs != NULL;
}

/* Starts the process of a job. Returns 1 in it, 0 in this one, -1 if there is none. Buffers must be empty. */
int wavycon_begin_job(int number)
{
    struct job *job = &jobs[number];
    for (int i = 0; i < streams; i++)
        if ((job->files[i] = tmpfile()) == NULL)
            return -1;
    job->process = fork();
    if (job->process != 0)
        return job->process > 0 ? 0 : -1;
    sent = job->files[2];
    if (dup2(fileno(job->files[0]), STDOUT_FILENO) < 0 || dup2(fileno(job->files[1]), STDERR_FILENO) < 0)
        _exit(3);
    return 1;
}

int wavycon_job_has_ended(int number)
{
    return jobs[number].process == 0;
}

/* Waits for any process to end. */
void wavycon_await_job(void)
{
    int how;
    pid_t process;
    do
        process = wait(&how);
    while (process < 0 && errno == EINTR);
    for (int i = 1; i <= number_of_jobs; i++)
        if (process > 0 && jobs[i].process == process) {
            jobs[i].process = 0;
            jobs[i].status = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
        }
}

/* Prints what the process of a job that has ended has printed. Returns its status. What it has sent can be taken. */
int wavycon_show_job(int number)
{
    FILE *const to[] = {stdout, stderr};
    char buffer[4096];
    size_t bytes;
    for (int i = 0; i < 2; i++) {
        FILE *from = jobs[number].files[i];
        rewind(from);
        while ((bytes = fread(buffer, 1, sizeof buffer, from)) > 0)
            fwrite(buffer, 1, bytes, to[i]);
        fflush(to[i]);
        fclose(from);
    }
    rewind(jobs[number].files[2]);
    return jobs[number].status;
}

/* Sends bytes, in the process of a job. Returns 0 if they cannot be written. */
int wavycon_send(const void *bytes, size_t number)
{
    return fwrite(bytes, 1, number, sent) == number && fflush(sent) == 0;
}

/* Takes bytes that a job has sent. Returns 0 if there are fewer. */
int wavycon_take(int job, void *bytes, size_t number)
{
    return fread(bytes, 1, number, jobs[job].files[2]) == number;
}

/* Ends a job: nothing more is taken from it. */
void wavycon_close_job(int job)
{
    fclose(jobs[job].files[2]);
}
