/* SPDX-License-Identifier: MIT
 * terminal.c - the console: this terminal (or pipe), a pty, or a socket on 127.0.0.1. On a terminal, Ctrl-T is the prefix
 * for the panel's buttons (an arrow, or s for START), and Ctrl-C or Ctrl-] ends the program; all other keys go to the robot.
 * Edit gets the first Ctrl-C, as on a board, where it leaves a line or breaks a play. The second ends the program. */
#include "machine.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "panel.h"
#include "pc.h"

enum { EXIT_PORT = 6, KEY_END = 0x03, KEY_LEAVE = 0x1D, KEY_PREFIX = 0x14, KEY_ESC = 0x1B };
#define MS 2000u
#define BUTTON_HELD (200u * MS)
#define AGAIN (2000u * MS)         /* time limit of the second Ctrl-C */
#define ANSWERED (100u * MS)       /* Edit's time to draw the effect of a Ctrl-C */
#define READER_GONE (1000u * MS)   /* output is dropped after no reading for this long, as on a cable */

static struct {
    int in, out;              /* -1: none */
    int listener;             /* of the socket; -1: none */
    int pty_other;            /* keeps the pty alive while clients come and go; -1: no pty */
    bool is_terminal;
    bool has_ended;           /* no input will come */
    struct termios before;    /* of the terminal */
    uint8_t escape;           /* characters of Ctrl-T and an arrow so far */
    uint8_t button;
    uint64_t button_until, written_at;
    uint64_t end_until;       /* a Ctrl-C before this time ends the program */
    bool must_warn;
} console = {.in = -1, .out = -1, .listener = -1, .pty_other = -1};

static const char *pty_link;   /* to remove at the end */
static char pty_path[64];      /* what it leads to */

/* ---- opening ---- */

void terminal_take(void)
{
    struct termios raw = console.before;
    if (console.is_terminal) {
        cfmakeraw(&raw);
        tcsetattr(STDIN_FILENO, TCSANOW, &raw);
    }
}

static void open_terminal(void)
{
    console.in = STDIN_FILENO;
    console.out = STDOUT_FILENO;
    console.is_terminal = isatty(STDIN_FILENO) && tcgetattr(STDIN_FILENO, &console.before) == 0;
    if (console.is_terminal) {
        terminal_take();
        machine_tell(pc_options.has_edits ? "Ctrl-C twice ends, Ctrl-T and an arrow or s is a button of the panel"
                                          : "Ctrl-C ends, Ctrl-T and an arrow or s is a button of the panel");
    }
}

/* Reads what the link leads to. false: no link is there. */
static bool read_link(char path[sizeof pty_path])
{
    const ssize_t count = readlink(pc_options.pty_link, path, sizeof pty_path - 1);
    path[count > 0 ? count : 0] = '\0';
    return count > 0;
}

/* Whether a program like this one serves this pty. It holds a lock, which dies with it. The number of a dead program's pty
 * may be that of somebody's terminal now. */
static bool is_served(const char *path)
{
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    const int pty = open(path, O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (pty < 0) {
        return errno == EBUSY;   /* a client has it for itself (TIOCEXCL), so somebody serves it */
    }
    const bool is_locked = fcntl(pty, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    close(pty);
    return is_locked;
}

/* Removes the link if it is left over from an earlier run. Anything but a link to a pty is not ours. */
static void remove_old_link(void)
{
    char path[sizeof pty_path];
    if (!read_link(path) || strncmp(path, "/dev/pts/", 9) != 0) {
        return;
    }
    if (is_served(path)) {
        pc_fail(EXIT_PORT, "%s: in use by another program: end that first, or name another link", pc_options.pty_link);
    }
    (void)unlink(pc_options.pty_link);
}

static void make_link(void)
{
    if (symlink(pty_path, pc_options.pty_link) != 0) {
        pc_fail(EXIT_PORT, "%s: %s", pc_options.pty_link, strerror(errno));
    }
    pty_link = pc_options.pty_link;
}

static void open_pty(void)
{
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    struct termios raw;
    const bool has_link = pc_options.pty_link[0] != '\0';
    if (has_link) {
        remove_old_link();   /* before this program has a pty: it may get the number of the old one */
    }
    const int master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0 || ptsname_r(master, pty_path, sizeof pty_path) != 0) {
        pc_fail(EXIT_PORT, "no pty: %s", strerror(errno));
    }
    console.pty_other = open(pty_path, O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (console.pty_other < 0 || tcgetattr(console.pty_other, &raw) != 0) {
        pc_fail(EXIT_PORT, "%s: %s", pty_path, strerror(errno));
    }
    (void)fcntl(console.pty_other, F_SETLK, &lock);   /* for is_served; clients that lock their port use flock */
    cfmakeraw(&raw);
    tcsetattr(console.pty_other, TCSANOW, &raw);
    console.in = console.out = master;
    if (has_link) {
        make_link();
    }
    fprintf(stderr, "%s: serial port: %s\n", pc_options.name, pty_path);
}

static void open_socket(void)
{
    const struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)pc_options.tcp_port),
                                        .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int yes = 1;
    console.listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    (void)setsockopt(console.listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (bind(console.listener, (const struct sockaddr *)&address, sizeof address) != 0 || listen(console.listener, 1) != 0) {
        pc_fail(EXIT_PORT, "127.0.0.1:%d: %s", pc_options.tcp_port, strerror(errno));
    }
}

void terminal_open(void)
{
    if (pc_options.pty_link != NULL) {
        open_pty();
    } else if (pc_options.tcp_port != 0) {
        open_socket();
    } else {
        open_terminal();
    }
}

/* ---- closing ---- */

void terminal_restore(void)
{
    if (console.is_terminal) {
        tcsetattr(STDIN_FILENO, TCSANOW, &console.before);
    }
    char path[sizeof pty_path];
    if (pty_link != NULL && read_link(path) && strcmp(path, pty_path) == 0) {
        (void)unlink(pty_link);
    }
    pty_link = NULL;
}

void terminal_drain(void)
{
    if (console.is_terminal) {
        (void)tcdrain(STDOUT_FILENO);
    }
}

/* ---- the client of the socket ---- */

/* Whether the client has closed its end. What it sent before may not be read yet. */
static bool has_left(void)
{
    struct pollfd entry = {.fd = console.in, .events = POLLRDHUP};
    return console.in >= 0 && poll(&entry, 1, 0) > 0;
}

/* One at a time. Others are told so at once: left waiting, they would be heard when nobody expects it any more. */
static void take_clients(void)
{
    static const char busy[] = "Somebody else is connected to this robot.\r\n";
    int client;
    while (console.listener >= 0 && !has_left() &&
           (client = accept4(console.listener, NULL, NULL, SOCK_CLOEXEC | SOCK_NONBLOCK)) >= 0) {
        if (console.in < 0) {
            console.in = console.out = client;
            console.written_at = machine_now();
        } else {
            (void)!write(client, busy, sizeof busy - 1);
            close(client);
        }
    }
}

/* Handles the end of input. A terminal that is gone ends the program like Ctrl-C, a pipe when its lines are carried out
 * (machine_is_asked_to_end); a socket waits for the next client. */
static void lose_input(void)
{
    if (console.listener >= 0) {
        close(console.in);
        console.in = console.out = -1;
    } else if (console.pty_other < 0) {
        console.in = -1;
        console.has_ended = true;
        if (console.is_terminal) {
            machine_lose_terminal();
        }
    }
}

bool terminal_has_ended(void)
{
    return console.has_ended;
}

int terminal_poll(struct pollfd *entries)
{
    take_clients();
    entries[0] = (struct pollfd){.fd = console.in, .events = POLLIN};
    entries[1] = (struct pollfd){.fd = console.listener, .events = POLLIN};
    return TERMINAL_FDS;
}

/* ---- keys ---- */

/* Takes Ctrl-T, then s or an arrow: ESC [ A..D. Returns whether the byte is not for the robot. */
static bool take_panel_key(uint8_t byte)
{
    static const uint8_t arrows[] = {PANEL_UP, PANEL_DOWN, PANEL_RIGHT, PANEL_LEFT};
    const uint8_t seen = console.escape;
    console.escape = 0;
    if (seen == 0 || (seen == 1 && byte == KEY_PREFIX)) {
        console.escape = seen == 0 && byte == KEY_PREFIX;
        return seen == 0 && byte == KEY_PREFIX;
    }
    if ((seen == 1 && byte == KEY_ESC) || (seen == 2 && (byte == '[' || byte == 'O'))) {
        console.escape = (uint8_t)(seen + 1u);
        return true;
    }
    console.button = seen == 1 && byte == 's' ? PANEL_START
                     : seen == 3 && byte >= 'A' && byte <= 'D' ? arrows[byte - 'A'] : 0;
    console.button_until = machine_now() + BUTTON_HELD;
    return true;
}

/* Whether this Ctrl-C ends the program. */
static bool is_last_ctrl_c(void)
{
    const uint64_t now = machine_now();
    if (!pc_options.has_edits || machine_is_asked_to_end() || now < console.end_until) {
        return true;
    }
    console.end_until = now + AGAIN;
    console.must_warn = true;
    return false;
}

/* Writes to the last row of the terminal, between two texts of Edit, and restores the cursor. */
static void warn(void)
{
    if (console.must_warn && machine_now() + AGAIN > console.end_until + ANSWERED) {
        console.must_warn = false;
        dprintf(console.out, "\0337\033[999;1H%s\033[K\0338",
                "Ctrl-C again within 2 s ends the program: unsaved edits are lost");
    }
}

static uint16_t take_keys(uint8_t *bytes, uint16_t count)
{
    uint16_t kept = 0;
    for (uint16_t i = 0; i < count; i++) {
        if (take_panel_key(bytes[i])) {
            continue;
        }
        if (bytes[i] == KEY_LEAVE || (bytes[i] == KEY_END && is_last_ctrl_c())) {
            machine_ask_to_end();
        } else {
            bytes[kept++] = bytes[i];
        }
    }
    return kept;
}

uint8_t machine_buttons(void)
{
    return machine_now() < console.button_until ? console.button : 0;
}

/* ---- machine.h ---- */

uint16_t machine_console_read(uint8_t *to, uint16_t room)
{
    struct pollfd entry = {.fd = console.in, .events = POLLIN};
    if (console.in < 0 || room == 0 || poll(&entry, 1, 0) <= 0) {
        return 0;   /* a terminal is not set to O_NONBLOCK, because the shell shares it */
    }
    const ssize_t count = read(console.in, to, room);
    if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR && errno != EIO)) {
        lose_input();
    }
    const uint16_t got = count > 0 ? (uint16_t)count : 0;
    return console.is_terminal ? take_keys(to, got) : got;
}

uint16_t machine_console_write(const uint8_t *bytes, uint16_t count)
{
    const uint64_t now = machine_now();
    if (count == 0) {
        console.written_at = now;
        warn();
        return 0;
    }
    struct pollfd entry = {.fd = console.out, .events = POLLOUT};
    if (console.out < 0) {
        return count;
    }
    if (poll(&entry, 1, 0) > 0) {   /* otherwise a full pipe would block the program */
        const ssize_t written = write(console.out, bytes, count);
        if (written > 0) {
            console.written_at = now;
            return (uint16_t)written;
        }
        if (errno != EAGAIN && errno != EINTR) {
            return count;
        }
    }
    return now - console.written_at > READER_GONE ? count : 0;
}
