/* SPDX-License-Identifier: MIT */
#include "cli_pty.h"

#include <asm/termbits.h> /* termios2: any rate; must not meet <termios.h> */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *make_link(const char *path, const char *link)
{
    struct stat status;
    if (lstat(link, &status) == 0 && S_ISLNK(status.st_mode)) {
        unlink(link);
    }
    return symlink(path, link) == 0 ? NULL : strerror(errno);
}

static bool make_raw(int fd, uint32_t rate_bps)
{
    struct termios2 settings;
    if (ioctl(fd, TCGETS2, &settings) != 0) {
        return false;
    }
    settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
    settings.c_cflag &= ~(unsigned)(CBAUD | CSIZE | PARENB | CSTOPB);
    settings.c_cflag |= CS8 | CREAD | CLOCAL | BOTHER;
    settings.c_ispeed = settings.c_ospeed = rate_bps;
    return ioctl(fd, TCSETS2, &settings) == 0;
}

const char *pty_open(pty_t *pty, const char *link, uint32_t rate_bps)
{
    memset(pty, 0, sizeof *pty);
    pty->slave = -1;
    pty->master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (pty->master < 0 || grantpt(pty->master) != 0 || unlockpt(pty->master) != 0
        || ptsname_r(pty->master, pty->path, sizeof pty->path) != 0) {
        return strerror(errno);
    }
    pty->slave = open(pty->path, O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (pty->slave < 0 || !make_raw(pty->slave, rate_bps)) {
        return strerror(errno);
    }
    if (link) {
        const char *error = make_link(pty->path, link);
        if (error) {
            return error;
        }
        pty->link = link;
    }
    return NULL;
}

void pty_close(pty_t *pty)
{
    if (pty->link) {
        unlink(pty->link);
    }
    close(pty->slave);
    close(pty->master);
}

uint32_t pty_rate(const pty_t *pty)
{
    struct termios2 settings;
    return ioctl(pty->slave, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}
