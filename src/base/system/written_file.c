/* Files that the program writes, and standard output. A file is written under a temporary name and renamed when it is
   complete, so that it appears whole or not at all. Files that must not be replaced are refused: files that were read,
   directories, disks. If the path names a pipe or another device, the bytes go to that; if it is a symbolic link, the
   file to which the link leads is replaced. */
#define _XOPEN_SOURCE 700
#define _DEFAULT_SOURCE   /* flock */
#define _DARWIN_C_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

/* Defined in system.c. */
void wavycon_remove_when_interrupted(const char *path);
int wavycon_rename(const char *from, const char *to);
void wavycon_remove(const char *path);

/* Reasons to refuse a file for which the system has no errno; wavycon_error_text of system.c has their messages. */
enum { is_input = -1, is_disk = -2, leads_nowhere = -3, is_other = -4 };

struct written_file {
    FILE *stream;                   /* NULL if the file could not be opened */
    int trouble;                    /* the first error, an errno or one of the reasons above; 0 without one */
    char name[PATH_MAX];            /* the path without symbolic links */
    char part[PATH_MAX + NAME_MAX]; /* the temporary path; empty if the file has its name */
};

/* The files that were read. */
static struct input {
    struct stat info;
    char *path; /* the absolute path */
} *inputs;
static size_t input_count;

/* The first errno of writing to standard output; 0 without one. */
static int print_trouble;

/* The errno of a failed write to a stream. None if nobody reads on from standard output, as in `wavycon ... | head`. */
static int trouble_of(const FILE *stream)
{
    return stream == stdout && errno == EPIPE ? 0 : errno;
}

/* Whether two records of stat are those of the same file. */
static int is_same(const struct stat *one, const struct stat *other)
{
    return one->st_dev == other->st_dev && one->st_ino == other->st_ino;
}

/* Whether a file was read. The path is compared too: if a file that was read has been removed since, another file may
   have got its number. */
static int was_read(const struct stat *info)
{
    struct stat now;
    for (size_t i = 0; i < input_count; i++)
        if (is_same(&inputs[i].info, info) && stat(inputs[i].path, &now) == 0 && is_same(&now, info))
            return 1;
    return 0;
}

/* Notes that a file was read: it will not be replaced. */
void wavycon_note_input(const char *path)
{
    struct input input, *grown;
    if (stat(path, &input.info) != 0 || S_ISCHR(input.info.st_mode) || was_read(&input.info) ||
        (input.path = realpath(path, NULL)) == NULL ||
        (grown = realloc(inputs, (input_count + 1)*sizeof input)) == NULL)
        return;
    inputs = grown;
    inputs[input_count++] = input;
}

/* The path that stands for standard output. What is written there follows the other output of the program, also if
   standard output goes to a file, which must not be replaced. */
static const char standard_output[] = "/dev/stdout";

/* The reason why a file cannot be written, as far as the file of its name shows: 0, an errno or one of the reasons
   above. Unless `mark` is empty, a file may be replaced only if it is empty or begins with `mark`. */
int wavycon_refusal(const char *path, const char *mark)
{
    char start[64] = "";
    struct stat info;
    if (strcmp(path, standard_output) == 0)
        return 0;
    if (stat(path, &info) != 0)
        return errno != ENOENT ? errno : lstat(path, &info) == 0 ? leads_nowhere : 0;
    if (S_ISDIR(info.st_mode) || S_ISBLK(info.st_mode))
        return S_ISDIR(info.st_mode) ? EISDIR : is_disk;
    if (was_read(&info))
        return is_input;
    if (!S_ISREG(info.st_mode) || info.st_size == 0)
        return 0;
    FILE *file = fopen(path, "r");
    if (file != NULL && fread(start, 1, sizeof start - 1, file) == 0)
        start[0] = '\0';
    if (file != NULL)
        fclose(file);
    return strncmp(start, mark, strlen(mark)) == 0 ? 0 : is_other;
}

/* The machine's name between points, ".host.", which stands in temporary names before the number of the process. Long
   names are cut. */
static const char *host(void)
{
    static char name[20];
    struct utsname system;
    if (name[0] == '\0' && uname(&system) >= 0)
        snprintf(name, sizeof name, ".%.16s.", system.nodename);
    return name;
}

/* Removes from a directory the temporary files of processes of this machine that were killed: those that are not
   locked, because a file is locked as long as its process lives. Temporary files of other machines stay, as a file
   system may not show their locks. */
void wavycon_remove_leftovers(const char *directory)
{
    static char last[PATH_MAX], pattern[64];
    struct dirent *entry;
    DIR *list = strcmp(directory, last) == 0 ? NULL : opendir(directory);
    if (list == NULL)
        return;
    snprintf(last, sizeof last, "%s", directory);
    snprintf(pattern, sizeof pattern, ".*%s[0-9]*.part", host());
    while ((entry = readdir(list)) != NULL) {
        int file = fnmatch(pattern, entry->d_name, 0) != 0 ? -1 :
            openat(dirfd(list), entry->d_name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0)
            unlinkat(dirfd(list), entry->d_name, 0);
        if (file >= 0)
            close(file);
    }
    closedir(list);
}

/* Opens the temporary file of a file, and locks it. Before it is locked another process may remove it as left behind:
   then it is made again. */
static FILE *open_part(struct written_file *file, const char *path)
{
    struct stat info;
    int number;
    if (realpath(path, file->name) == NULL)
        snprintf(file->name, sizeof file->name, "%s", path);
    const char *slash = strrchr(file->name, '/'), *base = slash == NULL ? file->name : slash + 1;
    snprintf(file->part, sizeof file->part, "%.*s.%s%s%ld.part", (int)(base - file->name), file->name, base, host(),
             (long)getpid());
    wavycon_remove_when_interrupted(file->part); /* first, as the signal may come as soon as the file is there */
    do
        number = open(file->part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    while (number >= 0 && flock(number, LOCK_EX) == 0 && fstat(number, &info) == 0 && info.st_nlink == 0 &&
           close(number) == 0);
    if (number < 0)
        file->part[0] = '\0';
    return number < 0 ? NULL : fdopen(number, "w");
}

/* Opens a file for writing. If that fails, the next call with the file returns the error. */
struct written_file *wavycon_open_written(const char *path)
{
    struct stat info;
    struct written_file *file = calloc(1, sizeof *file);
    if (file == NULL || (file->trouble = wavycon_refusal(path, "")) != 0)
        return file;
    if (strcmp(path, standard_output) == 0)
        file->stream = stdout;
    else
        file->stream = stat(path, &info) == 0 && !S_ISREG(info.st_mode) ? fopen(path, "w") : open_part(file, path);
    file->trouble = file->stream == NULL ? errno : 0;
    return file;
}

/* Writes bytes to a file. Returns the first error, 0 without one. */
int wavycon_put_bytes(struct written_file *file, const void *bytes, size_t number)
{
    if (file != NULL && file->trouble == 0 && fwrite(bytes, 1, number, file->stream) < number)
        file->trouble = trouble_of(file->stream);
    return file == NULL ? ENOMEM : file->trouble;
}

/* Writes the buffer of a file, and gives a complete file its name; a file that is not complete, or had an error, is
   removed. Then the file is closed, unless it stays open for more bytes. Returns the first error, 0 without one. */
int wavycon_end_written(struct written_file *file, int is_complete, int stays_open)
{
    int trouble = wavycon_put_bytes(file, "", 0);
    if (file != NULL && file->stream != NULL) {
        int is_closed = !stays_open && file->stream != stdout;
        /* The copy of the descriptor keeps the file locked until it is renamed. The file is closed before, because a
           network's file system reports a full disk only then. */
        int lock = dup(fileno(file->stream));
        if ((is_closed ? fclose(file->stream) : fflush(file->stream)) != 0 && trouble == 0)
            trouble = is_closed ? errno : trouble_of(file->stream);
        if (file->part[0] != '\0' && trouble == 0 && is_complete)
            trouble = wavycon_rename(file->part, file->name);
        if (file->part[0] != '\0' && (trouble != 0 || !is_complete))
            wavycon_remove(file->part);
        file->part[0] = '\0';
        file->trouble = trouble;
        close(lock);
    }
    if (!stays_open)
        free(file);
    return trouble;
}

/* Writes to standard output and flushes its buffer. Fortran's output would not report a full disk. */
void wavycon_print(const char *text)
{
    if ((fputs(text, stdout) < 0 || fflush(stdout) != 0) && print_trouble == 0)
        print_trouble = trouble_of(stdout);
}

/* The first errno of writing to standard output; 0 without one, and if standard output is closed, as nobody wants it.
   */
int wavycon_print_trouble(void)
{
    return print_trouble == EBADF ? 0 : print_trouble;
}
