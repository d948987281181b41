/* SPDX-License-Identifier: MIT
 * stops.c - which stops are a break, by firmware/common/REMOTE.md: only a second stop of the same play, within a
 * second, and the first one on the way to the first pose. Judges plays that began at rest with a typed line, and got
 * nothing but typed stops since. */
#include "session.h"

#include <string.h>

static struct {
    bool is_alone;                 /* nothing but stops came since a play was typed at rest */
    bool has_begun;                /* the program has reported its first step */
    unsigned stops;                /* typed since then */
} stops;

void stops_typed(const char *line)
{
    if (session.typed_is_known && strncmp(line, "play ", 5) == 0 && presses_are_at_rest()) {
        stops.is_alone = true;
        stops.has_begun = false;
        stops.stops = 0;
    } else if (session.typed_is_known && (strcmp(line, "stop") == 0 || strcmp(line, "@stop") == 0)) {
        stops.stops++;
    } else {
        stops.is_alone = false;
    }
}

/* The remote or the panel is used. */
void stops_pressed(void)
{
    stops.is_alone = false;
}

void stops_printed(const char *line)
{
    stops.has_begun = stops.has_begun || strncmp(line, "Playing", 7) == 0;
    if (!stops.is_alone || !stops.has_begun || stops.stops != 1) {
        return;
    }
    if (strncmp(line, "Broken off in ", 14) == 0 && rules_is_well()) {
        session_fail("one stop is no break", "\"%s\"", line);
    } else if (strncmp(line, "Stopped after ", 14) == 0) {
        reached("one stop of a play");
    }
}

void stops_boot(void)
{
    memset(&stops, 0, sizeof stops);
}
