/* Calls to the operating system for which Fortran has no statement. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

/* What a path names: 0 nothing, 1 a directory, 2 a file, 3 a pipe or a device, 4 unknown because of an error. *size is
   the size of the file in bytes, -1 if there is no file. */
int wavycon_path_kind(const char *path, int64_t *size)
{
    struct stat info;
    *size = -1;
    if (stat(path, &info) != 0)
        return errno == ENOENT || errno == ENOTDIR ? 0 : 4;
    *size = info.st_size;
    if (S_ISDIR(info.st_mode))
        return 1;
    return S_ISREG(info.st_mode) ? 2 : 3;
}

/* Makes one directory, if it does not exist. Returns 0 on success, else errno. */
int wavycon_make_directory(const char *path)
{
    int64_t size;
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && wavycon_path_kind(path, &size) == 1))
        return 0;
    return errno;
}

/* The file to be removed if the program is interrupted; empty if there is none. */
static char unfinished[4096];

/* Words that tell a user, if the program is interrupted, which results are kept; empty: no words. */
static char kept[4096];

/* Writes words to standard error. A handler of signals may call this function. */
static void tell(const char *words)
{
    if (write(STDERR_FILENO, words, strlen(words)) < 0)
        return;
}

/* The handler of signals: removes the unfinished file, tells what is kept, and ends the process by the signal. */
static void remove_unfinished(int number)
{
    if (unfinished[0] != '\0')
        unlink(unfinished);
    if (kept[0] != '\0') {
        tell("\nwavycon: interrupted: ");
        tell(kept);
        tell("; the same command with --resume goes on\n");
    }
    signal(number, SIG_DFL);
    raise(number);
}

/* Sets one of the two texts that the handler of signals reads, while signals are blocked. A text that is too long
   becomes empty. */
static void note(char *text, size_t size, const char *words)
{
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    text[0] = '\0';
    if (strlen(words) < size)
        strcpy(text, words);
    sigprocmask(SIG_SETMASK, &before, NULL);
}

/* Installs the handler for the signals that interrupt the program. Signals that the process ignores (nohup) stay
   ignored. */
void wavycon_handle_signals(void)
{
    static const int numbers[] = {SIGHUP, SIGINT, SIGTERM};
    for (size_t i = 0; i < sizeof numbers/sizeof numbers[0]; i++) {
        struct sigaction action;
        if (sigaction(numbers[i], NULL, &action) != 0 || action.sa_handler != SIG_DFL)
            continue;
        action.sa_handler = remove_unfinished;
        sigaction(numbers[i], &action, NULL);
    }
}

/* Sets the words that tell a user what is kept, from the first file or job on. A rank without either, which is ended
   because another one failed, has nothing to tell. */
void wavycon_note_kept(const char *words)
{
    note(kept, sizeof kept, words);
}

/* From now on a signal that interrupts the program removes this file, until the file is renamed or removed. Only the
   file of the last call is removed. */
void wavycon_remove_when_interrupted(const char *path)
{
    note(unfinished, sizeof unfinished, path);
    wavycon_handle_signals();
}

/* Renames a file. Returns 0 on success, else errno. */
int wavycon_rename(const char *from, const char *to)
{
    if (rename(from, to) != 0)
        return errno;
    if (strcmp(from, unfinished) == 0)
        note(unfinished, sizeof unfinished, "");
    return 0;
}

/* Removes a file, if it exists. */
void wavycon_remove(const char *path)
{
    if (unlink(path) == 0 && strcmp(path, unfinished) == 0)
        note(unfinished, sizeof unfinished, "");
}

/* The limit on the stack of this process [byte], at most the largest int64_t. */
int64_t wavycon_stack_limit(void)
{
    struct rlimit limit;
    return getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur > INT64_MAX ? INT64_MAX : (int64_t)limit.rlim_cur;
}

/* The width in characters of the terminal to which standard output goes. 0 if standard output is no terminal, or one
   that no user looks at: a terminal of another process, such as one that mpirun makes, or a program in the background.
   */
int wavycon_terminal_columns(void)
{
    struct winsize size;
    if (!isatty(STDOUT_FILENO) || tcgetpgrp(STDOUT_FILENO) != getpgrp())
        return 0;
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/* The message of an errno or of a negative reason of written_file.c, cut to the length of `text`. */
void wavycon_error_text(int number, char *text, size_t length)
{
    static const char *const reasons[] = {
        "it is read by this run and is not replaced", "it is a disk, not a file", "it is a symbolic link to nothing",
        "a file is there that is no table, perhaps a deck; it is not replaced"};
    snprintf(text, length, "%s", number < 0 ? reasons[-number - 1] : strerror(number));
}

/* The number behind a name, such as "MemAvailable:", that starts a line of a file. With an empty name it is the number
   at the start of the file. -1 if the file does not have the number. */
static long long number_in_file(const char *directory, const char *file, const char *name)
{
    char line[256], path[3*PATH_MAX];
    long long number = -1;
    snprintf(path, sizeof path, "%s/%s", directory, file);
    FILE *lines = fopen(path, "r");
    if (lines == NULL)
        return -1;
    while (number < 0 && fgets(line, sizeof line, lines) != NULL)
        if (strncmp(line, name, strlen(name)) == 0 && sscanf(line + strlen(name), "%lld", &number) != 1)
            number = -1;
    fclose(lines);
    return number;
}

/* Memory in bytes that a control group of Linux leaves to its processes: its limit less the memory in use, where files
   that the system can drop from memory count as free. -1 if the group has no limit. `directory` is that of the group.
   */
long long wavycon_memory_of_group(const char *directory)
{
    long long limit = number_in_file(directory, "memory.max", "");
    long long used = number_in_file(directory, "memory.current", "");
    long long files = number_in_file(directory, "memory.stat", "inactive_file ");
    if (limit < 0 || used < 0)
        return -1;
    long long left = limit - used + (files > 0 ? files : 0);
    return left > 0 ? left : 0;
}

/* The least memory in bytes that the control groups of this process, its own and all above, leave to the process. -1 if
   none has a limit. */
static long long memory_of_groups(void)
{
    static const char top[] = "/sys/fs/cgroup", mark[] = "0::";
    char line[PATH_MAX] = "", directory[2*PATH_MAX];
    long long least = -1;
    FILE *file = fopen("/proc/self/cgroup", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL && strncmp(line, mark, strlen(mark)) != 0)
        ;
    if (file != NULL)
        fclose(file);
    if (strncmp(line, mark, strlen(mark)) != 0)
        return -1;
    line[strcspn(line, "\n")] = '\0';
    snprintf(directory, sizeof directory, "%s%s", top, line + strlen(mark));
    /* Go up to the top directory, whose path is empty. In a container the path of the process's own group may be that
       of the host, which does not exist there; but the top directory is then the container's group. */
    while (strlen(directory) >= strlen(top)) {
        long long left = wavycon_memory_of_group(directory);
        if (left >= 0 && (least < 0 || left < least))
            least = left;
        *strrchr(directory, '/') = '\0';
    }
    return least;
}

/* Memory in bytes that the process may still allocate and use without swapping; -1 if the system does not say. It is
   the memory of the machine that is free or can be freed, but at most the rest of the limits of a container or a batch
   job (control groups) and of the limit on the address space (ulimit -v). */
int64_t wavycon_available_memory(void)
{
    struct rlimit limit;
    long long kilobytes = number_in_file("/proc", "meminfo", "MemAvailable:");
    long long available = kilobytes < 0 ? -1 : 1024*kilobytes;
#ifdef _SC_AVPHYS_PAGES
    if (available < 0 && sysconf(_SC_AVPHYS_PAGES) > 0)
        available = (long long)sysconf(_SC_AVPHYS_PAGES)*sysconf(_SC_PAGESIZE);
#endif
    long long group = memory_of_groups();
    if (group >= 0 && group < available)
        available = group;
    if (available < 0 || getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return available;
    /* Number of pages of the process's address space; -1 if the system does not say. */
    long long pages = number_in_file("/proc/self", "statm", "");
    if (pages < 0)
        return -1;
    long long left = (long long)limit.rlim_cur - pages*sysconf(_SC_PAGESIZE);
    if (left < 0)
        left = 0;
    return left < available ? left : available;
}

#ifdef WAVYCON_OPENBLAS
void openblas_set_num_threads(int number);
int blas_thread_shutdown_(void);
#endif

/* Defined in kept_memory.c. */
void wavycon_keep_memory(void);

/* Prepares the process. A write beyond the limit on file sizes, or to a pipe from which nobody reads on, then fails as
   on a full disk, while by default a signal ends the program. Deallocated memory is kept. OpenBLAS uses one thread, and
   the threads that it started when it was loaded end: without work each would occupy a processor for a tenth of a
   second while it waits. */
void wavycon_prepare_process(void)
{
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGPIPE, SIG_IGN);
    wavycon_keep_memory();
#ifdef WAVYCON_OPENBLAS
    openblas_set_num_threads(1);
    blas_thread_shutdown_();
#endif
}
