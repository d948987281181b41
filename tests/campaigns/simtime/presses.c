/* SPDX-License-Identifier: MIT
 * presses.c - what a press is, by firmware/common/REMOTE.md: a code that differs from the last one, or one after 500
 * ms of silence, with a button that was not down during a play or a stop. calls.c gets each press and checks every
 * start of a play against them. A remote's button is released when a packet is without it and for 100 ms none has it;
 * while button 6 is held no other one is a press. A button counts as spent or held only if that is certain. So a press
 * that this file rejects is none. */
#include "session.h"

#include <string.h>

#define SILENT 60u                 /* ticks without a packet; 500 ms are 64 ticks */
#define LINE_BEHIND 32u            /* ticks: a play may be over before its report */
#define SURELY_SILENT SECOND
#define SURELY_HELD 11u            /* ticks since a packet with the button; 100 ms are 13 ticks */
#define SURELY_RELEASED 16u
#define BUTTONS 0xFFu              /* buttons that make codes */
#define ANSWERED (4u * SECOND)     /* by then the result of a press, or the reason for none, is reported */
#define QUICK 8000u                /* half microseconds; adapters up to this latency keep to ANSWERED */
enum { STOP = 256, HELD = 9, BUTTON_PAUSE = 256, CODE_STOP = 255, NO_CODE = 256, ARROWS = 15, START = 16 };

typedef struct {
    unsigned down, code;           /* by the newest packet */
    unsigned spent;                /* buttons that are down and were down during a play or a stop */
    uint32_t tick;
    uint32_t press_tick;           /* the last press while nothing was playing */
} hand_t;

static struct {
    hand_t remote, panel;
    uint32_t held_tick[HELD];      /* the newest packet of a remote with this button, and with a stop */
    bool has_start;                /* Start is down */
    bool is_playing;               /* by the console's reports */
    uint32_t over_tick, line_tick;
    uint32_t press_tick;           /* a press that needs an answer; NEVER_TICK: none */
} presses;

/* The buttons, and STOP, that a packet of the last `ticks` has had. */
static unsigned held_within(uint32_t ticks)
{
    unsigned held = 0;
    for (unsigned i = 0; i < HELD; i++) {
        held |= long_ago(presses.held_tick[i], ticks) ? 0 : 1u << i;
    }
    return held;
}

/* A computer that is late takes packets later. */
static unsigned surely_held(void)
{
    return long_ago(session.late_tick, TROUBLE) ? held_within(SURELY_HELD) : 0;
}

static bool must_be_answered(const hand_t *hand, uint32_t silence)
{
    const bool was_free = hand->code == 0 && (hand->tick > session.boot_tick || silence > SURELY_SILENT);
    return was_free && !presses.is_playing && rules_is_well() && !rules_is_searching() &&
           session.tick - session.boot_tick > TROUBLE && long_ago(presses.over_tick, SECOND) &&
           long_ago(presses.line_tick, ANSWERED) && long_ago(session.late_tick, TROUBLE) &&
           session.latency <= QUICK && calls_are_said() && held_within(SURELY_RELEASED) == 0;
}

/* Called when a play is over. A button pressed just before may have come after its end. */
static void forgive(hand_t *hand)
{
    if (session.tick - hand->press_tick <= LINE_BEHIND) {
        hand->spent = 0;
    }
}

/* Handles the buttons that are down now, by a packet or at the panel. */
static void holds(hand_t *hand, unsigned buttons)
{
    const unsigned down = buttons & BUTTONS;
    const bool is_stop = is_stop_of(buttons);
    const unsigned code = is_stop ? CODE_STOP : buttons == BUTTON_PAUSE ? NO_CODE : down;
    const unsigned held = surely_held();
    const unsigned recent = hand == &presses.remote ? held : 0;   /* down, although this packet is without them */
    const unsigned still = down | recent;
    hand->spent &= still & (hand->down | recent);   /* not if it was released since the last packet */
    if (code != 0 && code < CODE_STOP && code != hand->code && (down & ~hand->spent) != 0 && (held & STOP) == 0) {
        calls_pressed(code);
        hand->press_tick = session.tick;
        if (must_be_answered(hand, session.tick - hand->tick)) {
            presses.press_tick = session.tick;
        }
    }
    if (presses.is_playing || is_stop || (held & STOP) != 0) {
        hand->spent = still;
    }
    hand->down = down;
    hand->code = code;
    hand->tick = session.tick;
}

void presses_remote(unsigned buttons)
{
    if (session.tick - presses.remote.tick > SILENT) {
        presses.remote.code = presses.remote.spent = 0;
    }
    holds(&presses.remote, buttons);
    for (unsigned i = 0; i < HELD; i++) {
        const bool is_held = i < HELD - 1 ? (buttons >> i & 1u) != 0 : is_stop_of(buttons);
        presses.held_tick[i] = is_held ? session.tick : presses.held_tick[i];
    }
}

/* The arrows are codes. Start stops when it is pressed, and is not part of a code. */
void presses_panel(unsigned buttons)
{
    const unsigned arrows = buttons & ARROWS, start = buttons & START;
    holds(&presses.panel, arrows);
    if (start != 0 && !presses.has_start) {
        presses.panel.spent = arrows;
    }
    presses.has_start = start != 0;
}

void presses_typed(void)
{
    presses.line_tick = session.tick;
}

void presses_printed(const char *line)
{
    static const char *const over[] = {"Ended", "Stopped", "Broken", "The pose", "The servo adapter", NULL};
    static const char *const begun[] = {"Going to", "Playing", NULL};
    const bool is_over = begins_with_one_of(line, over) || strstr(line, "dropped") != NULL;   /* possibly */
    const bool begins = begins_with_one_of(line, begun);
    presses.is_playing = (presses.is_playing || begins) && !is_over;
    presses.over_tick = is_over ? session.tick : presses.over_tick;
    if (presses.press_tick != NEVER_TICK && strncmp(line, "Page ", 5) == 0 && strstr(line, " step ") == NULL) {
        session_fail("a press starts a play or is refused", "\"%s\": a code calls no such page", line);
    }
    presses.press_tick = NEVER_TICK;
    if (is_over) {
        forgive(&presses.remote);
        forgive(&presses.panel);
    }
}

void presses_tick(void)
{
    if (presses.press_tick != NEVER_TICK && session.tick - presses.press_tick > ANSWERED) {
        if (rules_is_well() && session.printed_tick < presses.press_tick) {
            session_fail("a press starts a play or is refused", "nothing was said for %u ticks", ANSWERED);
        }
        presses.press_tick = NEVER_TICK;
    }
}

bool presses_are_at_rest(void)
{
    return !presses.is_playing && calls_are_said();
}

/* Every button counts as down until a packet or the panel shows otherwise. */
void presses_boot(void)
{
    const unsigned down = presses.panel.down;
    const bool has_start = presses.has_start;
    memset(&presses, 0, sizeof presses);
    presses.remote.spent = presses.remote.down = BUTTONS;
    for (unsigned i = 0; i < HELD; i++) {
        presses.held_tick[i] = NEVER_TICK;
    }
    presses.has_start = has_start;
    presses.panel.spent = presses.panel.down = down;
    presses.remote.tick = presses.panel.tick = session.tick;
    presses.line_tick = presses.over_tick = session.tick;
    presses.press_tick = NEVER_TICK;
}
