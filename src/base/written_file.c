/* Files that the program writes, and standard output. A file is written under a temporary name and renamed when it is
   complete: it appears whole or not at all. What is no plain file, as a pipe, is written into. */
#define _XOPEN_SOURCE 700
#define _DEFAULT_SOURCE   /* flock */
#define _DARWIN_C_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

/* Of system.c. */
void wavycon_remove_when_interrupted(const char *path);
int wavycon_rename(const char *from, const char *to);
void wavycon_remove(const char *path);

/* Reasons against writing that the system has no number for; their words are in written_file.f90. */
enum { is_input = -1, is_no_file = -2, leads_nowhere = -3, is_other = -4 };

struct written_file {
    FILE *stream;
    int trouble;                             /* the first error */
    char name[PATH_MAX];                     /* final, absolute, without symbolic links */
    char part[PATH_MAX + NAME_MAX];          /* temporary; empty if the file has its name */
};

/* The files that were read and must not be replaced. */
static struct input {
    struct stat info;
    char *path; /* absolute */
} *inputs;
static size_t input_count;

static int is_same(const struct stat *one, const struct stat *other)
{
    return one->st_dev == other->st_dev && one->st_ino == other->st_ino;
}

/* Whether a file was read. One that was removed since may have left its number to another file. */
static int was_read(const struct stat *info)
{
    struct stat now;
    for (size_t i = 0; i < input_count; i++)
        if (is_same(&inputs[i].info, info) && stat(inputs[i].path, &now) == 0 && is_same(&now, info))
            return 1;
    return 0;
}

/* Notes a file that is read: it will not be replaced. */
void wavycon_note_input(const char *path)
{
    struct input input, *grown;
    if (stat(path, &input.info) != 0 || !(S_ISREG(input.info.st_mode) || S_ISFIFO(input.info.st_mode)) ||
        was_read(&input.info) || (input.path = realpath(path, NULL)) == NULL)
        return;
    grown = realloc(inputs, (input_count + 1)*sizeof input);
    if (grown == NULL)
        return;
    inputs = grown;
    inputs[input_count++] = input;
}

/* The absolute path without symbolic links, dots and double slashes, also of what does not exist yet. `full` has room
   for PATH_MAX bytes. Returns 0 if that is too little. */
int wavycon_full_path(const char *path, char *full)
{
    char known[PATH_MAX];
    full[0] = '\0';
    if (path[0] != '/' && getcwd(full, PATH_MAX) == NULL)
        return 0;
    while (*path != '\0') {
        size_t before = strlen(full), length = strcspn(path, "/");
        if (length == 2 && strncmp(path, "..", 2) == 0) {
            char *slash = strrchr(full, '/');
            if (slash != NULL)
                *slash = '\0';
        } else if (length > 0 && !(length == 1 && path[0] == '.')) {
            if (before + length + 2 > PATH_MAX)
                return 0;
            sprintf(full + before, "/%.*s", (int)length, path);
            if (realpath(full, known) != NULL)
                strcpy(full, strcmp(known, "/") == 0 ? "" : known);
        }
        path += length + (path[length] == '/');
    }
    if (full[0] == '\0')
        strcpy(full, "/");
    return 1;
}

/* Standard output or error, if a file is open as it: "/dev/stdout" is a plain file if the output goes to one. That file
   is written to and not replaced with all that is in it. NULL otherwise. */
static FILE *standard_stream(const struct stat *info)
{
    FILE *const streams[] = {stdout, stderr};
    struct stat other;
    for (int i = 0; i < 2; i++)
        if (fstat(fileno(streams[i]), &other) == 0 && is_same(info, &other))
            return streams[i];
    return NULL;
}

/* Why a file cannot be written, as far as what has its name says: 0, an errno or one of the reasons above. Unless `mark`
   is empty, only an empty file and one that begins with it may be replaced. */
int wavycon_refusal(const char *path, const char *mark)
{
    char start[64];
    struct stat info;
    if (stat(path, &info) != 0)
        return errno != ENOENT ? errno : lstat(path, &info) == 0 ? leads_nowhere : 0;
    if (S_ISDIR(info.st_mode))
        return EISDIR;
    if (S_ISBLK(info.st_mode))
        return is_no_file;
    if (was_read(&info))
        return is_input;
    if (mark[0] == '\0' || !S_ISREG(info.st_mode) || info.st_size == 0 || standard_stream(&info) != NULL)
        return 0;
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return errno;
    size_t read = fread(start, 1, sizeof start, file);
    fclose(file);
    return read >= strlen(mark) && strncmp(start, mark, strlen(mark)) == 0 ? 0 : is_other;
}

/* What ends the names of parts of this machine before the number of the process: ".host.". At most 18 bytes, so that
   names do not become too long. */
static const char *host(void)
{
    static char name[20];
    enum { most = 16 };
    struct utsname system;
    if (name[0] == '\0' && uname(&system) >= 0) {
        size_t length = strlen(system.nodename);
        snprintf(name, sizeof name, ".%s.", system.nodename + (length > most ? length - most : 0));
    }
    return name;
}

/* Removes from a directory the parts of processes of this machine that were killed. A part is locked as long as its
   process lives. Parts of other machines stay: a file system may not tell of their locks. */
void wavycon_remove_leftovers(const char *directory)
{
    static const char ending[] = ".part";
    static char last[PATH_MAX];
    struct dirent *entry;
    struct stat info;
    DIR *list = strcmp(directory, last) == 0 ? NULL : opendir(directory);
    if (list == NULL)
        return;
    snprintf(last, sizeof last, "%s", directory);
    while ((entry = readdir(list)) != NULL) {
        char name[sizeof entry->d_name];
        strcpy(name, entry->d_name);
        size_t length = strlen(name), tail = strlen(host());
        if (name[0] != '.' || length < sizeof ending || strcmp(name + length - strlen(ending), ending) != 0)
            continue;
        length -= strlen(ending);
        while (length > 0 && name[length - 1] >= '0' && name[length - 1] <= '9')
            length--;
        if (length <= tail || strncmp(name + length - tail, host(), tail) != 0)
            continue;
        int file = openat(dirfd(list), name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (file < 0)
            continue;
        if (fstat(file, &info) == 0 && S_ISREG(info.st_mode) && flock(file, LOCK_EX | LOCK_NB) == 0)
            unlinkat(dirfd(list), name, 0);
        close(file);
    }
    closedir(list);
}

/* Opens the part of a file, locked, with a name that no other process uses. A part that another process takes for left
   behind, before it is locked, is made again. */
static int open_part(const char *part)
{
    struct stat info;
    for (;;) {
        int file = open(part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 || flock(file, LOCK_EX) != 0 || fstat(file, &info) != 0 || info.st_nlink > 0)
            return file;
        close(file);
    }
}

/* Opens a file to be written. Returns NULL and what is in the way of it: an errno or one of the reasons above. */
struct written_file *wavycon_open_written(const char *path, int *trouble)
{
    struct stat there;
    struct written_file *file = calloc(1, sizeof *file);
    *trouble = file == NULL ? ENOMEM : wavycon_refusal(path, "");
    if (*trouble == 0 && !wavycon_full_path(path, file->name))
        *trouble = ENAMETOOLONG;
    int exists = *trouble == 0 && stat(path, &there) == 0;
    if (exists)
        file->stream = standard_stream(&there);
    if (*trouble == 0 && file->stream == NULL) {
        if (exists && !S_ISREG(there.st_mode)) {
            file->stream = fopen(path, "w");
        } else {
            char *base = strrchr(file->name, '/') + 1;
            snprintf(file->part, sizeof file->part, "%.*s.%s%s%ld.part", (int)(base - file->name), file->name, base,
                     host(), (long)getpid());
            int number = open_part(file->part);
            if (number >= 0) {
                wavycon_remove_when_interrupted(file->part);
                file->stream = fdopen(number, "w");
            }
        }
        if (file->stream == NULL)
            *trouble = errno;
    }
    if (*trouble == 0)
        return file;
    free(file);
    return NULL;
}

/* Writes bytes to a file. Returns the errno of the first failure, 0 without one. */
int wavycon_put_bytes(struct written_file *file, const void *bytes, size_t number)
{
    if (file->trouble == 0 && fwrite(bytes, 1, number, file->stream) < number)
        file->trouble = errno;
    return file->trouble;
}

/* Writes what is in the buffer and gives a complete file its name; one that is not complete, or had trouble, is removed.
   Then closes it, unless it stays open for more bytes. Returns the errno of the first failure, 0 without one. */
int wavycon_end_written(struct written_file *file, int is_complete, int stays_open)
{
    int trouble, is_closed = !stays_open && file->stream != stdout && file->stream != stderr;
    /* Keeps the file locked until it is renamed. A file system of a network tells of a full disk when it is closed. */
    int lock = is_closed ? dup(fileno(file->stream)) : -1;
    if ((is_closed ? fclose(file->stream) : fflush(file->stream)) != 0 && file->trouble == 0)
        file->trouble = errno;
    if (file->part[0] != '\0') {
        if (file->trouble == 0 && is_complete)
            file->trouble = wavycon_rename(file->part, file->name);
        if (file->trouble != 0 || !is_complete)
            wavycon_remove(file->part);
        file->part[0] = '\0';
    }
    if (lock >= 0)
        close(lock);
    trouble = file->trouble;
    if (!stays_open)
        free(file);
    return trouble;
}

static int print_trouble;

/* Writes to standard output, at once: the buffers of Fortran do not tell of a full disk. */
void wavycon_print(const char *text, size_t length)
{
    if ((fwrite(text, 1, length, stdout) < length || fflush(stdout) != 0) && print_trouble == 0)
        print_trouble = errno;
}

/* The errno of the first failure to write to standard output; 0 without one, and if it is closed: nobody wants it. */
int wavycon_print_trouble(void)
{
    return print_trouble == EBADF ? 0 : print_trouble;
}
