/* SPDX-License-Identifier: MIT
 * files.c - the robot's folder: pages.bin (motion pages as m512 reads them), journal.bin and eeprom.bin.
 * A file has its full length from the start, and bytes are replaced in place. So a power cut can affect only the bytes being
 * written, as on the chip; the journal and the copies of the settings make them either old or new. */
#include "machine.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pc.h"

enum { EXIT_FILE = 4, PATH_BYTES = 512 };
enum { PAGE_BYTES = 512, BOARD_MOTIONS = 0x10000, WITHOUT_PAGE_0 = BOARD_MOTIONS - PAGE_BYTES };   /* m512: files/image.py */

static const char *const names[MACHINE_MEMORIES] = {"pages.bin", "journal.bin", "eeprom.bin"};
static char folder[PATH_BYTES - 32];
static int files[MACHINE_MEMORIES] = {-1, -1, -1};

static const char *path_of(const char *name)
{
    static char path[PATH_BYTES];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void make_folders(void)
{
    for (char *at = folder + 1; (at = strchr(at, '/')) != NULL; at++) {
        *at = '\0';
        (void)mkdir(folder, 0777);
        *at = '/';
    }
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        pc_fail(EXIT_FILE, "%s: the robot's folder cannot be made: %s. --robot names another", folder, strerror(errno));
    }
}

void files_open(void)
{
    const char *home = getenv("HOME"), *data = getenv("XDG_DATA_HOME");
    int length;
    if (pc_options.robot != NULL) {
        length = snprintf(folder, sizeof folder, "%s", pc_options.robot);
    } else if (data != NULL && data[0] == '/') {
        length = snprintf(folder, sizeof folder, "%s/motion512", data);
    } else if (home != NULL && home[0] == '/') {
        length = snprintf(folder, sizeof folder, "%s/.local/share/motion512", home);
    } else {
        pc_fail(EXIT_FILE, "no home folder (HOME) to keep the robot's pages in: name a folder with --robot");
    }
    if (length < 0 || (size_t)length >= sizeof folder) {
        pc_fail(EXIT_FILE, "the path of the robot's folder is too long: %s... --robot names another", folder);
    }
    make_folders();
    const int lock = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);   /* stays open until the program ends */
    if (lock < 0) {
        pc_fail(EXIT_FILE, "%s: the robot's folder cannot be used: %s. --robot names another", folder,
                errno == ENOTDIR ? "it is a file" : errno == ENOENT ? "it is a link that leads nowhere" : strerror(errno));
    }
    if (flock(lock, LOCK_EX | LOCK_NB) != 0) {
        pc_fail(EXIT_FILE, "%s: %s", folder,
                errno == EWOULDBLOCK ? "in use by another program for this robot: end that first" : strerror(errno));
    }
}

/* ---- making a file ---- */

static bool write_all(int file, const uint8_t *bytes, uint32_t count, off_t at)
{
    while (count > 0) {
        const ssize_t written = pwrite(file, bytes, count, at);
        if (written <= 0) {
            return false;
        }
        bytes += written;
        at += written;
        count -= (uint32_t)written;
    }
    return true;
}

/* Calls fsync or fdatasync. A slow disk takes seconds for those of a save or of a new folder, but that is no hang. */
static bool is_synced(int (*sync)(int), int file)
{
    machine_watch();
    const bool is_done = sync(file) == 0;
    machine_watch();
    return is_done;
}

/* Makes a file of `count` bytes, either complete or not at all. */
static int make_file(const char *name, const uint8_t *bytes, uint32_t count)
{
    char temporary[PATH_BYTES + 8];
    const char *path = path_of(name);
    snprintf(temporary, sizeof temporary, "%s.new", path);
    const int file = open(temporary, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    const int parent = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0 || parent < 0 || !write_all(file, bytes, count, 0) || !is_synced(fsync, file)
        || rename(temporary, path) != 0 || !is_synced(fsync, parent)) {
        const int why = errno;
        (void)unlink(temporary);   /* it would fill a full disk */
        pc_fail(EXIT_FILE, "%s: cannot be written: %s", path, strerror(why));
    }
    close(parent);
    return file;
}

/* Reads the initial motions of a new robot. */
static void read_motions(uint8_t *bytes, uint32_t count)
{
    FILE *file = fopen(pc_options.motions, "rb");
    const size_t got = file != NULL ? fread(bytes, 1, count, file) : 0;
    const bool is_read = file != NULL && ferror(file) == 0;
    const int why = errno;
    const bool is_whole = is_read && fgetc(file) == EOF;
    if (file != NULL) {
        fclose(file);
    }
    if (!is_read) {
        pc_fail(EXIT_FILE, "%s: cannot be read: %s", pc_options.motions, strerror(why));
    }
    if ((got != WITHOUT_PAGE_0 && got != BOARD_MOTIONS && got != count) || !is_whole) {
        pc_fail(EXIT_FILE, "%s: not a raw motion area of %u, %u or %u bytes (m512 convert makes one)", pc_options.motions,
                WITHOUT_PAGE_0, BOARD_MOTIONS, (unsigned)count);
    }
    if (got == WITHOUT_PAGE_0) {
        memmove(bytes + PAGE_BYTES, bytes, got);
        memset(bytes, 0xFF, PAGE_BYTES);
    }
}

static bool are_erased(const uint8_t *bytes, uint32_t count)
{
    while (count > 0 && bytes[count - 1] == 0xFF) {
        count--;
    }
    return count == 0;
}

/* `--motions` for a robot whose folder was there. `bytes` are its pages. */
static void offer_motions(uint8_t *bytes, uint32_t count)
{
    char sentence[2 * PATH_BYTES];
    if (are_erased(bytes, count)) {
        read_motions(bytes, count);
        if (!write_all(files[MACHINE_PAGES], bytes, count, 0) || !is_synced(fsync, files[MACHINE_PAGES])) {
            pc_fail(EXIT_FILE, "%s: cannot be written: %s", path_of(names[MACHINE_PAGES]), strerror(errno));
        }
        return;
    }
    snprintf(sentence, sizeof sentence, "%s has its own motions: %s is not read. m512 changes them", folder,
             pc_options.motions);
    machine_tell(sentence);
}

/* ---- machine.h ---- */

bool machine_recall(machine_memory_t memory, uint8_t *bytes, uint32_t count)
{
    const char *path = path_of(names[memory]);
    struct stat link;
    const int file = open(path, O_RDWR | O_CLOEXEC);
    if (file < 0 && errno != ENOENT) {
        pc_fail(EXIT_FILE, "%s: %s", path, strerror(errno));
    }
    if (file < 0 && lstat(path, &link) == 0) {
        pc_fail(EXIT_FILE, "%s: it is a link that leads nowhere. Is its disk there?", path);
    }
    if (file < 0) {
        if (memory == MACHINE_PAGES && pc_options.motions != NULL) {
            read_motions(bytes, count);
        }
        files[memory] = make_file(names[memory], bytes, count);
        return false;
    }
    if (lseek(file, 0, SEEK_END) != (off_t)count || pread(file, bytes, count, 0) != (ssize_t)count) {
        pc_fail(EXIT_FILE, "%s: not a file of %u bytes. Move it away, and a new one is made", path, (unsigned)count);
    }
    files[memory] = file;
    if (memory == MACHINE_PAGES && pc_options.motions != NULL) {
        offer_motions(bytes, count);
    }
    return true;
}

/* Whether the name leads to this file still. A program that replaces a file leaves the old one without a name. */
static bool is_there(machine_memory_t memory)
{
    struct stat here, named;
    return fstat(files[memory], &here) == 0 && stat(path_of(names[memory]), &named) == 0 && here.st_ino == named.st_ino &&
           here.st_dev == named.st_dev;
}

bool machine_keep(machine_memory_t memory, uint32_t at, const uint8_t *bytes, uint32_t count, bool now)
{
    char sentence[PATH_BYTES + 128];
    if (!is_there(memory)) {
        snprintf(sentence, sizeof sentence, "%s: not saved: another program has replaced or removed the file. "
                 "End this program and start it again", path_of(names[memory]));
    } else if (write_all(files[memory], bytes, count, (off_t)at) && (!now || is_synced(fdatasync, files[memory]))) {
        return true;
    } else {
        snprintf(sentence, sizeof sentence, "%s: not saved: %s", path_of(names[memory]), strerror(errno));
    }
    machine_tell(sentence);
    return false;
}

void machine_settle(machine_memory_t memory)
{
    (void)is_synced(fdatasync, files[memory]);
}
