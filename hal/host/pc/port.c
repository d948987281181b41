/* SPDX-License-Identifier: MIT
 * port.c - the adapter's serial port: any rate, raw, exclusive, with the lowest latency that the driver grants. */
#include "machine.h"

#include <asm/termbits.h> /* termios2: any rate; must not meet <termios.h> */
#include <errno.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "bus.h"
#include "pc.h"

enum { EXIT_PORT = 6 };
#define MS 2000u
#define TRY_AGAIN (1000u * MS)
#define PATIENCE_LEAST (20u * MS)  /* a busy computer may check this late */
#define PATIENCE_FAST (30u * MS)   /* an adapter that passes bytes on at once, and a computer that checks late */
#define PATIENCE_SLOW (80u * MS)   /* FTDI's 16 ms, twice, with a margin */

static struct {
    int fd;              /* -1: lost */
    bool is_fast;
    bool has_lost;       /* bytes that were written, since port_drain() */
    uint32_t rate_bps;
    uint64_t try_at;     /* when to try to reopen it */
} port = {.fd = -1};

static bool set_line(int fd)
{
    struct termios2 settings;
    if (ioctl(fd, TCGETS2, &settings) != 0) {
        return false;
    }
    settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
    settings.c_cflag &= ~(unsigned)(CBAUD | CSIZE | PARENB | CSTOPB | CRTSCTS);
    settings.c_cflag |= CS8 | CREAD | CLOCAL | BOTHER;
    settings.c_ispeed = settings.c_ospeed = port.rate_bps;
    settings.c_cc[VMIN] = 1;   /* otherwise a silent port reads like a lost one */
    settings.c_cc[VTIME] = 0;
    return ioctl(fd, TCSETS2, &settings) == 0;
}

/* Asks the driver to pass bytes on at once. A CDC adapter (ttyACM) always does so and has no such option. */
static bool make_fast(int fd)
{
    struct serial_struct settings;
    char real[256] = "";
    char *found = realpath(pc_options.bus, NULL);
    if (found != NULL) {
        snprintf(real, sizeof real, "%s", found);
        free(found);
    }
    if (strstr(real, "/ttyACM") != NULL) {
        return true;
    }
    if (ioctl(fd, TIOCGSERIAL, &settings) != 0) {
        return false;
    }
    settings.flags |= (int)ASYNC_LOW_LATENCY;
    return ioctl(fd, TIOCSSERIAL, &settings) == 0 && ioctl(fd, TIOCGSERIAL, &settings) == 0 &&
           (settings.flags & (int)ASYNC_LOW_LATENCY) != 0;
}

/* Returns NULL, or why the port cannot be used. */
static const char *try_to_open(void)
{
    const int fd = open(pc_options.bus, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    const char *why = NULL;
    if (fd < 0) {
        return errno == EACCES ? "no permission: join the group dialout (sudo adduser $USER dialout) and log in again"
               : errno == EBUSY ? "in use by another program: end that first"
               : errno == ENOENT ? "no such port: is the adapter plugged in? `m512 doctor` lists the ports"
                                 : strerror(errno);
    }
    if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
        why = "in use by another program: end that first";
    } else if (!isatty(fd)) {
        why = "not a serial port";
    } else if (!set_line(fd)) {
        why = "the adapter refuses this rate";
    }
    if (why != NULL) {
        close(fd);
        return why;
    }
    (void)ioctl(fd, TIOCEXCL);   /* excludes programs that do not check the lock */
    (void)ioctl(fd, TCFLSH, TCIOFLUSH);
    port.is_fast = make_fast(fd);
    port.fd = fd;
    return NULL;
}

void port_open(void)
{
    port.rate_bps = pc_options.rate_bps;
    const char *why = try_to_open();
    if (why != NULL) {
        pc_fail(EXIT_PORT, "%s: %s", pc_options.bus, why);
    }
    if (!port.is_fast) {
        machine_tell("the driver of the port grants no low latency: servos are asked less often. Goals are not delayed");
    }
}

static void lose(void)
{
    char sentence[256];
    close(port.fd);
    port.fd = -1;
    port.try_at = machine_now() + TRY_AGAIN;
    snprintf(sentence, sizeof sentence, "the servo adapter %s is gone. Nothing plays any more. Plug it in, then say `on`",
             pc_options.bus);
    machine_tell(sentence);
}

void port_poll(struct pollfd *entry)
{
    const uint64_t now = machine_now();
    if (port.fd < 0 && now >= port.try_at) {
        port.try_at = now + TRY_AGAIN;
        if (try_to_open() == NULL) {
            machine_tell("the servo adapter is back. `on` switches torque on");
        }
    }
    *entry = (struct pollfd){.fd = port.fd, .events = POLLIN};
}

bool port_drain(void)
{
    int failed;
    do {
        failed = ioctl(port.fd, TCSBRK, 1);
    } while (failed && errno == EINTR);   /* the watchdog's alarm, which ends a wait of seconds */
    const bool has_left = !failed && !port.has_lost;
    port.has_lost = false;
    return has_left;
}

bool machine_bus_is_there(void)
{
    return port.fd >= 0;
}

uint32_t machine_bus_first_patience(void)
{
    return port.is_fast ? PATIENCE_FAST : PATIENCE_SLOW;
}

uint32_t machine_bus_least_patience(void)
{
    return PATIENCE_LEAST;
}

uint32_t machine_bus_rate(uint8_t divisor)
{
    const uint32_t wanted = divisor == BUS_RATE_1M ? pc_options.rate_bps : 2000000u / (divisor + 1u);
    if (port.rate_bps != wanted) {
        (void)port_drain();
        port.rate_bps = wanted;
        if (port.fd >= 0) {
            (void)set_line(port.fd);
        }
    }
    return wanted;
}

void machine_bus_write(const uint8_t *bytes, uint16_t count)
{
    const ssize_t written = port.fd >= 0 ? write(port.fd, bytes, count) : 0;
    port.has_lost |= written != (ssize_t)count;
    if (written < 0 && errno != EAGAIN && errno != EINTR) {
        lose();
    }
}

uint16_t machine_bus_read(uint8_t *to, uint16_t room)
{
    if (port.fd < 0) {
        return 0;
    }
    const ssize_t count = read(port.fd, to, room);
    if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
        lose();
    }
    return count > 0 ? (uint16_t)count : 0;
}
