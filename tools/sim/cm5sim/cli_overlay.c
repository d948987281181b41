/* SPDX-License-Identifier: MIT */
#include "cli_overlay.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define OTHER_SCREEN "\x1b[?1049h\x1b[0m\x1b[H\x1b[2J"
#define ROBOTS_SCREEN "\x1b[?1049l"

enum { BACKSPACE = 8, CTRL_U = 21, ESC = 27, DELETE = 127 };

static void put(const char *text, size_t count)
{
    while (count > 0) {
        const ssize_t done = write(STDOUT_FILENO, text, count);
        if (done <= 0) {
            return; /* nobody looks */
        }
        text += done;
        count -= (size_t)done;
    }
}

void overlay_add(const char *text)
{
    for (const char *end; (end = strchr(text, '\n')) != NULL; text = end + 1) {
        put(text, (size_t)(end - text));
        put("\r\n", 2);
    }
    put(text, strlen(text));
}

void overlay_show(overlay_t *overlay, console_t *console, overlay_kind_t kind, const char *text)
{
    console_flush(console);
    console_hold(console, true);
    overlay->kind = kind;
    overlay->length = 0;
    overlay->escape = 0;
    put(OTHER_SCREEN, strlen(OTHER_SCREEN));
    overlay_add(text);
}

void overlay_hide(overlay_t *overlay, console_t *console)
{
    if (overlay->kind != OVERLAY_NONE) {
        overlay->kind = OVERLAY_NONE;
        put(ROBOTS_SCREEN, strlen(ROBOTS_SCREEN));
        console_hold(console, false);
    }
}

/* Cursor keys and their like mean nothing here: ESC, '[' or 'O', then up to a letter or '~'. */
static bool is_skipped(overlay_t *overlay, uint8_t byte)
{
    if (overlay->escape == ESC) {
        overlay->escape = byte == '[' || byte == 'O' ? (char)byte : 0;
        return true;
    }
    if (overlay->escape != 0) {
        overlay->escape = byte >= 0x40 ? 0 : overlay->escape;
        return true;
    }
    overlay->escape = byte == ESC ? ESC : 0;
    return byte == ESC;
}

bool overlay_type(overlay_t *overlay, uint8_t byte)
{
    if (is_skipped(overlay, byte)) {
        return false;
    }
    if (byte == '\r' || byte == '\n') {
        overlay->line[overlay->length] = 0;
        return true;
    }
    const size_t gone = byte == CTRL_U ? overlay->length : (byte == BACKSPACE || byte == DELETE) && overlay->length > 0;
    for (size_t i = 0; i < gone; i++) {
        put("\b \b", 3);
    }
    overlay->length -= gone;
    if (byte >= ' ' && byte < DELETE && overlay->length + 1 < sizeof overlay->line) {
        overlay->line[overlay->length++] = (char)byte;
        put((const char *)&byte, 1);
    }
    return false;
}
