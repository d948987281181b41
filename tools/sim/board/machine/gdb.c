/* SPDX-License-Identifier: MIT
 * gdb.c - restricts simavr's GDB server to this computer. simavr binds its listening socket to every interface. So it
 * gets any free port (0), and our socket, bound to 127.0.0.1 and the requested port, replaces it under the same
 * descriptor. */

#include "gdb.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <simavr/sim_gdb.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { FDS_MAX = 1024 };

/* Returns a socket that listens on 127.0.0.1:port, or -1. */
static int listen_here(int port)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    const int yes = 1;
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (fd < 0) {
        return -1;
    }
    (void)setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (bind(fd, (const struct sockaddr *)&address, sizeof address) != 0 || listen(fd, 1) != 0) {
        close(fd);
        return -1;
    }
    return fd;
}

static bool is_listening(int fd)
{
    int listening = 0;
    socklen_t size = sizeof listening;
    return getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listening, &size) == 0 && listening != 0;
}

/* Returns the listening socket among the descriptors that were not open before, or -1. */
static int new_listener(const bool was_open[FDS_MAX])
{
    for (int fd = 0; fd < FDS_MAX; fd++) {
        if (!was_open[fd] && is_listening(fd)) {
            return fd;
        }
    }
    return -1;
}

/* Starts simavr's server. Returns the descriptor it listens on, or -1. */
static int start_server(avr_t *avr)
{
    bool was_open[FDS_MAX];
    for (int fd = 0; fd < FDS_MAX; fd++) {
        was_open[fd] = fcntl(fd, F_GETFD) >= 0;
    }
    avr->gdb_port = 0;
    return avr_gdb_init(avr) < 0 || !avr->gdb ? -1 : new_listener(was_open);
}

bool gdb_start(avr_t *avr, int port, bool wait)
{
    const int ours = listen_here(port);
    const int theirs = ours < 0 ? -1 : start_server(avr);
    const bool ready = theirs >= 0 && dup2(ours, theirs) == theirs;
    if (ours >= 0) {
        close(ours);
    }
    if (!ready) {
        if (avr->gdb) {
            avr_deinit_gdb(avr);
        }
        return false;
    }
    avr->gdb_port = port;
    avr->state = wait ? cpu_Stopped : cpu_Running;
    return true;
}
