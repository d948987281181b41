/* SPDX-License-Identifier: MIT
 * pc.h - the parts of the machine that is a Linux PC, and its options. */
#ifndef PC_H
#define PC_H

#include <poll.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *name;       /* of the program, for its messages */
    const char *bus;        /* the adapter's port */
    uint32_t rate_bps;      /* of the servos, where the board has 1 Mbps */
    const char *robot;      /* folder of what is kept; NULL: the person's own */
    const char *motions;    /* fills a new folder; NULL: empty pages */
    const char *pty_link;   /* console on a pty; "": without a link */
    int tcp_port;           /* console on 127.0.0.1; 0: no */
    bool off;               /* switch torque off at the end */
    bool has_edits;         /* the end may lose what was not saved: on a terminal it takes Ctrl-C twice */
} pc_options_t;

extern pc_options_t pc_options;

/* options.c: reads the command line; ends the program with 0 or 2 if that is all there is to do. */
void pc_read_options(int argc, char **argv);

/* machine.c: opens everything. Ends the program with a sentence, 4 for a file and 6 for a port, if something cannot be
 * used. */
void pc_open(void);
_Noreturn void pc_fail(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* port.c: the serial port of the adapter */
void port_open(void);                          /* at the start: it must be there */
void port_poll(struct pollfd *entry);          /* what to wait for; tries to open a port that went away */
void port_drain(void);                         /* waits until everything has left */

/* terminal.c: the console */
void terminal_open(void);
int terminal_poll(struct pollfd *entries);     /* fills in at most TERMINAL_FDS entries */
void terminal_restore(void);                   /* may be called from a signal handler */
void terminal_drain(void);
#define TERMINAL_FDS 2

/* files.c: the robot's folder */
void files_open(void);

/* machine.c */
void machine_ask_to_end(void);                 /* as Ctrl-C */

#endif
