/* The few calls to the operating system that Fortran has no word for. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

/* 0 nothing there, 1 a directory, 2 a file, 3 a pipe or a device, 4 the system does not say. */
int wavycon_path_kind(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return errno == ENOENT || errno == ENOTDIR ? 0 : 4;
    if (S_ISDIR(info.st_mode))
        return 1;
    return S_ISREG(info.st_mode) ? 2 : 3;
}

/* Bytes of a file, as the system sees it; -1 if there is none. */
long long wavycon_file_size(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 ? (long long)info.st_size : -1;
}

/* Makes one directory; one that is there already is fine. Returns errno, 0 if all is well. */
int wavycon_make_directory(const char *path)
{
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && wavycon_path_kind(path) == 1))
        return 0;
    return errno;
}

/* The file that an interruption removes; empty if there is none. */
static char unfinished[4096];

static void remove_unfinished(int number)
{
    if (unfinished[0] != '\0')
        unlink(unfinished);
    signal(number, SIG_DFL);
    raise(number);
}

/* Takes note of a file, or of none, without being interrupted half way. */
static void note_unfinished(const char *path)
{
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    unfinished[0] = '\0';
    if (strlen(path) < sizeof unfinished)
        strcpy(unfinished, path);
    sigprocmask(SIG_SETMASK, &before, NULL);
}

/* Removes a file should the program be interrupted, until it is renamed or removed: one file at a time. What is
   ignored (nohup) stays so. */
void wavycon_remove_when_interrupted(const char *path)
{
    static const int numbers[] = {SIGHUP, SIGINT, SIGTERM};
    note_unfinished(path);
    for (size_t i = 0; i < sizeof numbers/sizeof numbers[0]; i++) {
        struct sigaction action;
        if (sigaction(numbers[i], NULL, &action) != 0 || action.sa_handler != SIG_DFL)
            continue;
        action.sa_handler = remove_unfinished;
        sigaction(numbers[i], &action, NULL);
    }
}

int wavycon_rename(const char *from, const char *to)
{
    if (rename(from, to) != 0)
        return errno;
    if (strcmp(from, unfinished) == 0)
        note_unfinished("");
    return 0;
}

int wavycon_remove(const char *path)
{
    if (unlink(path) != 0)
        return errno;
    if (strcmp(path, unfinished) == 0)
        note_unfinished("");
    return 0;
}

/* A file that grows beyond the limit set for it is then an error of the write, as on a full disk, not the end. */
void wavycon_outlive_file_size_limit(void)
{
    signal(SIGXFSZ, SIG_IGN);
}

int wavycon_process_id(void)
{
    return (int)getpid();
}

int wavycon_stdout_is_terminal(void)
{
    return isatty(STDOUT_FILENO);
}

/* The words for an errno, cut to fit. */
void wavycon_error_text(int number, char *text, size_t length)
{
    snprintf(text, length, "%s", strerror(number));
}

/* The full name of a file that is there; empty if it has none or it is too long. */
void wavycon_full_path(const char *path, char *full, size_t length)
{
    char *found = realpath(path, NULL);
    full[0] = '\0';
    if (found != NULL && strlen(found) < length)
        strcpy(full, found);
    free(found);
}

/* A number of bytes from /proc/meminfo, which gives kB after a name such as "MemAvailable:"; -1 if it is not there. */
static long long memory_info(const char *name)
{
    char line[256];
    long long kilobytes, bytes = -1;
    FILE *file = fopen("/proc/meminfo", "r");
    if (file == NULL)
        return -1;
    while (bytes < 0 && fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, name, strlen(name)) == 0 && sscanf(line + strlen(name), "%lld", &kilobytes) == 1)
            bytes = 1024*kilobytes;
    fclose(file);
    return bytes;
}

/* Bytes of this process's address space; -1 where the system does not say. */
static long long address_space_in_use(void)
{
    long long pages;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL)
        return -1;
    if (fscanf(file, "%lld", &pages) != 1)
        pages = -1;
    fclose(file);
    return pages < 0 ? -1 : pages*sysconf(_SC_PAGESIZE);
}

/* Bytes that the process may still allocate and use without swapping: what is free of the machine's memory or can be
   freed, and at most what the limit on the address space (ulimit -v) leaves. -1 where the system does not say. */
long long wavycon_available_memory(void)
{
    struct rlimit limit;
    long long available = memory_info("MemAvailable:");
#ifdef _SC_AVPHYS_PAGES
    if (available < 0 && sysconf(_SC_AVPHYS_PAGES) > 0)
        available = (long long)sysconf(_SC_AVPHYS_PAGES)*sysconf(_SC_PAGESIZE);
#endif
    if (available < 0 || getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return available;
    long long used = address_space_in_use();
    if (used < 0)
        return -1;
    long long left = (long long)limit.rlim_cur - used;
    if (left < 0)
        left = 0;
    return left < available ? left : available;
}

/* The number that a text begins with. Returns how many bytes it takes, 0 if it is none. */
size_t wavycon_parse_number(const char *text, double *value)
{
    char *end;
    *value = strtod(text, &end);
    return (size_t)(end - text);
}
