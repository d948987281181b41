/* SPDX-License-Identifier: MIT */
#include "cli_console.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define LINE_BPS 57600
#define ENTRIES 4
#define CLEAR_SCREEN 0x1B5B324Au /* ESC [ 2 J */

static const char *listen_tcp(console_t *console, int port)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
    socklen_t length = sizeof address;
    const int yes = 1;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    console->listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (console->listener < 0) {
        return strerror(errno);
    }
    (void)setsockopt(console->listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (bind(console->listener, (struct sockaddr *)&address, sizeof address) != 0
        || listen(console->listener, 1) != 0
        || getsockname(console->listener, (struct sockaddr *)&address, &length) != 0) {
        return strerror(errno);
    }
    console->tcp_port = ntohs(address.sin_port);
    return NULL;
}

const char *console_open(console_t *console, const options_t *options, console_input_fn input, void *context)
{
    memset(console, 0, sizeof *console);
    console->listener = console->client = -1;
    console->input = input;
    console->context = context;
    console->use_stdout = !options->no_stdio;
    console->use_stdin = !options->no_stdio && options->script == NULL;
    const char *error = NULL;
    if (options->use_pty) {
        error = pty_open(&console->pty, options->pty_link, LINE_BPS);
        console->has_pty = error == NULL;
    }
    if (error == NULL && options->use_tcp) {
        error = listen_tcp(console, options->tcp_port);
        console->has_tcp = error == NULL;
    }
    return error;
}

void console_close(console_t *console)
{
    console_flush(console);
    if (console->has_pty) {
        pty_close(&console->pty);
    }
    if (console->client >= 0) {
        close(console->client);
    }
    if (console->listener >= 0) {
        close(console->listener);
    }
    free(console->waiting);
}

static void write_stdout(console_t *console, const uint8_t *bytes, size_t all)
{
    size_t done = 0;
    while (done < all && !console->stdout_ended) {
        const ssize_t count = write(STDOUT_FILENO, bytes + done, all - done);
        if (count > 0) {
            done += (size_t)count;
        } else if (errno == EAGAIN) { /* somebody made the terminal non-blocking */
            struct pollfd entry = {.fd = STDOUT_FILENO, .events = POLLOUT};
            (void)poll(&entry, 1, 100);
        } else if (errno != EINTR) {
            console->stdout_ended = true;
        }
    }
}

/* Without memory for it, it is lost, as on a cable that nobody reads. */
static void keep(console_t *console)
{
    const size_t needed = console->waiting_count + console->out_count;
    if (needed > console->waiting_room) {
        uint8_t *bytes = realloc(console->waiting, 2 * needed);
        if (bytes == NULL) {
            return;
        }
        console->waiting = bytes;
        console->waiting_room = 2 * needed;
    }
    memcpy(console->waiting + console->waiting_count, console->out, console->out_count);
    console->waiting_count = needed;
}

void console_hold(console_t *console, bool held)
{
    console->held = held;
    if (!held) {
        write_stdout(console, console->waiting, console->waiting_count);
        console->waiting_count = 0;
    }
}

void console_flush(console_t *console)
{
    if (console->out_count == 0) {
        return;
    }
    if (console->use_stdout && console->held) {
        keep(console);
    } else if (console->use_stdout) {
        write_stdout(console, console->out, console->out_count);
    }
    if (console->has_pty && write(console->pty.master, console->out, console->out_count) < 0) {
        /* nobody reads: lost */
    }
    if (console->client >= 0 && send(console->client, console->out, console->out_count, MSG_NOSIGNAL) < 0
        && errno != EAGAIN) {
        close(console->client);
        console->client = -1;
    }
    console->out_count = 0;
}

void console_put(console_t *console, uint8_t byte)
{
    if (console->out_count == sizeof console->out) {
        console_flush(console);
    }
    console->out[console->out_count++] = byte;
    console->draws = console->draws || byte == 0x1B;
    console->last_bytes = console->last_bytes << 8 | byte;
    console->cleared = console->cleared || console->last_bytes == CLEAR_SCREEN;
}

/* One client at a time: a second one is told so. */
static void take_client(console_t *console)
{
    static const char busy[] = "Somebody else is connected to this robot.\r\n";
    const int client = accept4(console->listener, NULL, NULL, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (client >= 0 && console->client >= 0) {
        (void)send(client, busy, sizeof busy - 1, MSG_NOSIGNAL);
        close(client);
    } else if (client >= 0) {
        console->client = client;
    }
}

/* Reads what is there. false: this source has ended. */
static bool take_input(console_t *console, int fd, console_source_t source)
{
    uint8_t bytes[1024];
    const ssize_t count = read(fd, bytes, sizeof bytes);
    if (count > 0) {
        console->input(console->context, source, bytes, (size_t)count);
    }
    return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

void console_wait(console_t *console, int64_t nanoseconds)
{
    struct pollfd entries[ENTRIES] = {
        {.fd = console->use_stdin && !console->stdin_ended ? STDIN_FILENO : -1, .events = POLLIN},
        {.fd = console->has_pty ? console->pty.master : -1, .events = POLLIN},
        {.fd = console->client, .events = POLLIN},
        {.fd = console->listener, .events = POLLIN}};
    const int64_t wait = nanoseconds < 0 ? 0 : nanoseconds;
    const struct timespec timeout = {wait / 1000000000, wait % 1000000000};
    if (ppoll(entries, ENTRIES, &timeout, NULL) <= 0) {
        return;
    }
    if (entries[0].revents) {
        console->stdin_ended = !take_input(console, STDIN_FILENO, FROM_STDIN);
    }
    if (entries[1].revents) {
        (void)take_input(console, console->pty.master, FROM_PTY);
    }
    if (entries[2].revents && !take_input(console, console->client, FROM_TCP)) {
        close(console->client);
        console->client = -1;
    }
    if (entries[3].revents) {
        take_client(console);
    }
}
