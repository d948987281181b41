/* SPDX-License-Identifier: MIT
 * cli_session.h - one run of cm5sim: the board and all that is plugged into it, and what a user or a script does to
 * them. */
#ifndef CLI_SESSION_H
#define CLI_SESSION_H

#include "board.h"
#include "board_ports.h"
#include "cli_console.h"
#include "cli_keys.h"
#include "cli_options.h"
#include "cli_overlay.h"
#include "cli_trace.h"

#define RC_KEYS 10
#define RC_REPEAT_CYCLES (100u * BOARD_CYCLES_PER_MS) /* a held remote says so again and again */
#define NEVER_CYCLES UINT64_MAX

typedef struct session {
    const options_t *options;
    board_t *board;
    servo_bus_t *bus;
    console_t console;
    keys_t keys;
    overlay_t overlay;
    trace_t trace;
    bool tracing;
    char trace_path[256]; /* of the file that is plotted */
    bool trace_is_temporary;

    uint64_t button_until[BUTTON_COUNT]; /* cycle at which a held button is let go, NEVER_CYCLES: when told */
    bool button_down[BUTTON_COUNT];
    uint64_t rc_until[RC_KEYS]; /* likewise for the keys of the remote; 0: not held */
    uint64_t rc_next;           /* next repetition while held */
    uint16_t rc_word;           /* as last sent */

    uint32_t pty_bps; /* as the client of the pty has set it */
    uint64_t last_traffic; /* cycle of the newest byte either way */
    struct { bool titled, explained; uint32_t shown_at_start; /* the n-th of the robot, from 1 */ } leave; /* cli_leave.h */
    bool opened; /* only then files are written back */
    bool done;
    int exit_code;
} session_t;

/* Builds the board, loads images, plugs in servos, opens ports and files. On failure a message is printed and the
 * exit code returned; EXIT_GOOD otherwise. session_close() in either case: it writes what is to be kept. */
int session_open(session_t *session, const options_t *options);
void session_close(session_t *session);

/* A message for the user on standard error (unless --quiet), fit for a raw terminal. */
void session_say(const session_t *session, const char *format, ...) __attribute__((format(printf, 2, 3)));
void session_complain(const session_t *session, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same, but over the robot's screen where there is one: for a moment. */
void session_note(session_t *session, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A person looks: keys and words go by a terminal that knows escape sequences. */
bool session_is_on_terminal(const session_t *session);

/* The robot's screen is over: what comes now stands below it. */
void session_leave_screen(session_t *session);

/* A page of text over the robot's screen, or on standard error. */
void session_page(session_t *session, overlay_kind_t kind, const char *text);

/* Ends the run with this exit code; the first code that is not good stays. */
void session_end(session_t *session, int exit_code);

/* Bytes from the PC. */
void session_send(session_t *session, const uint8_t *bytes, size_t count);

/* Presses a button for a while (NEVER_CYCLES: until session_release()). MODE holds the chip in reset. */
void session_press(session_t *session, button_t button, uint64_t cycles);
void session_release(session_t *session, button_t button);

/* Holds keys of the remote for a while; further keys join the chord. session_rc_send() sends one packet only. */
void session_rc_hold(session_t *session, uint16_t keys, uint64_t cycles);
void session_rc_send(session_t *session, uint16_t word);

/* Power switch. */
void session_power(session_t *session, bool on);

/* Lets go what has been held long enough, repeats the remote's packets; returns the next cycle it has to do so. */
uint64_t session_hands(session_t *session);

/* Follows the rate that the pty's client sets: at a wrong one it hears and says garbage, as on a cable. */
void session_follow_rate(session_t *session);

/* The list of servos for Ctrl-T v. */
void session_list_servos(session_t *session);

#endif
