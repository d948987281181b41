/* SPDX-License-Identifier: MIT
 * cli_keys.h - the user's terminal: raw mode, and which key means what. A terminal sends presses only, so a button
 * of the remote or the panel counts as held for KEY_HELD_MS after its key was last seen. */
#ifndef CLI_KEYS_H
#define CLI_KEYS_H

#include <stdbool.h>
#include <stdint.h>

#include "board_ports.h"

#define KEY_HELD_MS 600 /* longer than a keyboard's first repeat delay */
#define KEY_LEAVE 0x1D  /* Ctrl-] */
#define KEY_PREFIX 0x14 /* Ctrl-T */

typedef enum {
    KEY_NONE,
    KEY_BYTE,   /* value: for the robot */
    KEY_EXIT,
    KEY_HELP,
    KEY_RC_MODE,
    KEY_RC,     /* value: one bit of the remote's word */
    KEY_BUTTON, /* value: button_t */
    KEY_POWER,
    KEY_SERVOS, /* list them */
    KEY_LINE    /* a line for the robot's knobs comes */
} key_kind_t;

typedef struct {
    key_kind_t kind;
    uint16_t value;
} key_press_t;

typedef struct {
    bool rc_mode;
    bool prefixed;
    uint8_t escape; /* bytes of an arrow key's sequence seen so far */
} keys_t;

/* Feeds one byte of the terminal. */
key_press_t keys_take(keys_t *keys, uint8_t byte);

/* What Ctrl-T ? shows. */
const char *keys_help(void);

/* Terminal on standard input into raw mode and back; leaving at exit is arranged. false: not a terminal. */
bool keys_raw(void);
void keys_restore(void);
bool keys_are_raw(void);

#endif
