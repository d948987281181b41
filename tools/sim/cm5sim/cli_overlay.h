/* SPDX-License-Identifier: MIT
 * cli_overlay.h - words for the user over what the robot has drawn on the terminal. They stand on the terminal's other
 * screen, so the robot's is there again, untouched, when they go. What the robot says meanwhile waits (console_hold). */
#ifndef CLI_OVERLAY_H
#define CLI_OVERLAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cli_console.h"

#define OVERLAY_LINE_BYTES 200

typedef enum {
    OVERLAY_NONE,
    OVERLAY_NOTE, /* goes by itself at `until`, or at the next key, which counts */
    OVERLAY_PAGE, /* goes at the next key, which does nothing else (but for Ctrl-T and Ctrl-]) */
    OVERLAY_LINE  /* a line is being typed */
} overlay_kind_t;

typedef struct {
    overlay_kind_t kind;
    uint64_t until; /* cycle */
    char line[OVERLAY_LINE_BYTES];
    size_t length;
    char escape; /* the last byte of an escape sequence that is being skipped, or 0 */
} overlay_t;

/* Shows text, its lines ended by \n, instead of what was shown before; adds more below it. */
void overlay_show(overlay_t *overlay, console_t *console, overlay_kind_t kind, const char *text);
void overlay_add(const char *text);
void overlay_hide(overlay_t *overlay, console_t *console);

/* OVERLAY_LINE: one byte of the keyboard. true: the line is ended, line[] is a string. */
bool overlay_type(overlay_t *overlay, uint8_t byte);

#endif
