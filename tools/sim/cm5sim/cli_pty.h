/* SPDX-License-Identifier: MIT
 * cli_pty.h - a pseudo terminal as a serial port for other programs. */
#ifndef CLI_PTY_H
#define CLI_PTY_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    int master; /* ours, non-blocking */
    int slave;  /* kept open, so that clients may come and go */
    char path[64];
    const char *link; /* NULL: none */
} pty_t;

/* Opens a raw pty at this rate; link (or NULL) becomes a symbolic link to it, replacing an older link but nothing
 * else. NULL, or what went wrong. */
const char *pty_open(pty_t *pty, const char *link, uint32_t rate_bps);
void pty_close(pty_t *pty);

/* The rate that the client has set. */
uint32_t pty_rate(const pty_t *pty);

#endif
