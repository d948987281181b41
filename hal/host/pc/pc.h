/* SPDX-License-Identifier: MIT
 * pc.h - the parts of the Linux PC machine, and its options. */
#ifndef PC_H
#define PC_H

#include <poll.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *name;       /* of the program, for its messages */
    const char *bus;        /* the adapter's port */
    uint32_t rate_bps;      /* of the servos, in place of the board's 1 Mbps */
    const char *robot;      /* folder of pages and settings; NULL: in the user's home */
    const char *motions;    /* fills a new folder; NULL: empty pages */
    const char *pty_link;   /* console on a pty; "": without a link; NULL: no pty */
    int tcp_port;           /* console on 127.0.0.1; 0: no */
    bool off;               /* switch torque off at the end */
    bool has_edits;         /* ending may lose unsaved edits: on a terminal it takes Ctrl-C twice */
} pc_options_t;

extern pc_options_t pc_options;

/* options.c: reads the command line; ends the program with 0 after the help, with 2 on a usage error. */
void pc_read_options(int argc, char **argv);

/* machine.c: opens everything. If something cannot be used, ends the program with a message and 4 for a file or 6 for a
 * port. */
void pc_open(void);
_Noreturn void pc_fail(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* port.c: the serial port of the adapter */
void port_open(void);                          /* at the start: the port must exist */
void port_poll(struct pollfd *entry);          /* what to wait for; tries to reopen a lost port */
/* Waits until all output has left. false: it has not, or bytes written since the last call were lost. */
bool port_drain(void);

/* terminal.c: the console */
void terminal_open(void);
int terminal_poll(struct pollfd *entries);     /* fills in at most TERMINAL_FDS entries */
void terminal_take(void);                      /* keys come at once, without echo; for a signal handler, too */
void terminal_restore(void);                   /* for a signal handler, too */
void terminal_drain(void);
bool terminal_has_ended(void);                 /* no input will come: the pipe is at its end */
#define TERMINAL_FDS 2

/* files.c: the robot's folder */
void files_open(void);

/* machine.c */
void machine_ask_to_end(void);                 /* like Ctrl-C: again, 0.1 s later or more, ends at once */
void machine_lose_terminal(void);              /* asks too, but never as a second wish: nobody pressed anything */

#endif
