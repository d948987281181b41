/* SPDX-License-Identifier: MIT
 * cli_console.h - the PC's end of the robot's serial line: standard input and output, a pty, one TCP client, or all
 * of them at once. What the robot says goes to each; what each says goes to the robot. */
#ifndef CLI_CONSOLE_H
#define CLI_CONSOLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cli_options.h"
#include "cli_pty.h"

typedef enum { FROM_STDIN, FROM_PTY, FROM_TCP } console_source_t;
typedef void (*console_input_fn)(void *context, console_source_t source, const uint8_t *bytes, size_t count);

typedef struct {
    bool use_stdin, use_stdout, stdin_ended, stdout_ended;
    bool has_pty, has_tcp;
    pty_t pty;
    int listener, client, tcp_port;
    uint8_t out[4096];
    size_t out_count;
    bool held; /* standard output waits */
    uint8_t *waiting;
    size_t waiting_count, waiting_room;
    bool draws; /* the robot has used an escape sequence: it has a screen */
    bool cleared; /* it has emptied it, and draws it anew */
    uint32_t last_bytes; /* of the robot, the newest lowest */
    console_input_fn input;
    void *context;
} console_t;

/* Opens what the options ask for. NULL, or what went wrong. */
const char *console_open(console_t *console, const options_t *options, console_input_fn input, void *context);
void console_close(console_t *console);

/* One byte from the robot; goes out with the next flush. Where nobody reads, it is lost, as on a cable. */
void console_put(console_t *console, uint8_t byte);
void console_flush(console_t *console);

/* Holds back what goes to standard output, and lets it go. */
void console_hold(console_t *console, bool held);

/* Waits for input, at most so long (0: only looks), and hands it on. Returns early after input. */
void console_wait(console_t *console, int64_t nanoseconds);

#endif
