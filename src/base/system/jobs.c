/* The processes of the option --jobs. Each is a copy of this process and runs a deck. Its output goes to files without
   names, so that no file is left if all processes are interrupted. */
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

/* Defined in written_file.c and system.c. */
void wavycon_print(const char *text);
void wavycon_note_kept(const char *words);
void wavycon_handle_signals(void);

/* Elements of the array of jobs, more than most_waiting of run_program.f90: a job has an element until it is shown. And
   the number of output streams of a process. */
enum { places = 128, streams = 2 };

static struct job {
    int number;    /* number of the job */
    pid_t process; /* 0: not started, or ended */
    int status;    /* exit status, or 128 and the number of the signal that ended it */
    FILE *files[streams]; /* files that get standard output and standard error */
} jobs[places];

/* Starts the process of a job. Returns 1 in the new process, 0 in this one, -1 if no process could be made. The buffers
   of standard output and standard error must be empty, as the new process gets a copy of them. */
int wavycon_begin_job(int number)
{
    struct job *job = &jobs[number % places];
    pid_t parent = getpid();
    job->number = number;
    for (int i = 0; i < streams; i++)
        if ((job->files[i] = tmpfile()) == NULL)
            return -1;
    wavycon_handle_signals();
    /* Where this signal is ignored, as under some servers, nobody learns how a process ended. */
    signal(SIGCHLD, SIG_DFL);
    /* Signals wait until a new process has its own output and says nothing of the jobs. */
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    job->process = fork();
    if (job->process != 0) {
        sigprocmask(SIG_SETMASK, &before, NULL);
        return job->process > 0 ? 0 : -1;
    }
    wavycon_note_kept("");
#ifdef __linux__
    /* The job shall end when the process that started it ends, whatever signal ended that process, and also if that
       process ignores SIGTERM. */
    signal(SIGTERM, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
    if (getppid() != parent || dup2(fileno(job->files[0]), STDOUT_FILENO) < 0 ||
        dup2(fileno(job->files[1]), STDERR_FILENO) < 0)
        _exit(3);
    sigprocmask(SIG_SETMASK, &before, NULL);
    return 1;
}

/* Waits until any process ends. Returns the number of its job; 0 if the process is none of a job. */
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

/* Prints the output of a job that has ended. Returns the status of the job. */
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
