/* SPDX-License-Identifier: MIT
 * rest.c - what must not move: all joints after a break, and all joints in a pause, including those of a layer and
 * those moved by code (motion/LAWS.md 7, motion/SHAPING.md, firmware/play/README.md "Joints moved by code"). After a
 * pause a joint starts from rest: it does not catch up what is left of a step in a tick or two. */
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SLOWED 300u                /* ticks: a joint slows down within a ramp of at most 255 */
#define LINE_BEHIND 32u            /* ticks: the cause of a pause's end may be read before the line that reports it */

#define RESUMED 32u                /* ticks after `resume` */
#define FROM_REST 12               /* units in a tick: twice the mean speed of the fastest page */
enum { ACCEL_AT = 24 };            /* 0: a step has no ramps, so it begins at its mean speed */

static struct {
    enum { NOTHING, BREAK, PAUSE } what;
    uint32_t since;
    uint32_t moved_tick;           /* the last event that may end a pause */
    uint32_t line_tick;            /* when the newest line was typed */
    bool is_layer_asked;           /* by the newest line, in a pause */
    uint32_t resumed_tick;         /* a pause at rest ended by `resume` */
    uint32_t changed_tick[JOINTS]; /* the last goal that was another one */
    bool is_shaped;                /* something may make steps faster */
    unsigned page;                 /* the page that was reported last */
    bool may_hold;                 /* release of the remote may be a stop: the setting `remote` was changed */
} rest;

static bool is_one_of(const char *line, const char *const *words)
{
    char word[16] = "";
    (void)sscanf(line + (*line == '@' ? 1 : 0), "%15[^ ,.:;]", word);
    for (; *words != NULL; words++) {
        if (strcmp(word, *words) == 0) {
            return true;
        }
    }
    return false;
}

void rest_may_end(void)
{
    rest.what = NOTHING;
    rest.moved_tick = session.tick;
}

/* A break was requested. */
void rest_break(void)
{
    rest.what = BREAK;
    rest.since = session.tick;
}

/* Handles a typed line. A break lasts until something may move. In a pause, `aim`, `swing`, `free`, codes and
 * shaping move nothing; `play` and `layer` are refused. */
void rest_typed(const char *line)
{
    static const char *const after_break[] = {"play", "p", "on", "aim", "swing", "layer", "resume", "code", "free",
                                              "move", "torque", "drive", "reset", NULL};
    static const char *const in_pause[] = {"resume", "stop", "s", "break", "b", "on", "off",
                                           "torque", "code", "reset", NULL};
    static const char *const shapes[] = {"rate", "amplitude", "blend", "drive", "settings", "swing", "aim", "layer", NULL};
    rest.is_shaped = strcmp(line, "shape reset") != 0 &&
                     (rest.is_shaped || !session.typed_is_known || is_one_of(line, shapes));
    if (rest.what == PAUSE && strcmp(line, "resume") == 0) {
        rest.resumed_tick = session.tick;
    }
    const bool is_alone = session.tick - rest.line_tick > SECOND;
    rest.line_tick = session.tick;
    rest.may_hold = rest.may_hold || !session.typed_is_known || strstr(line, "remote") != NULL;
    rest.is_layer_asked = rest.what == PAUSE && is_alone && session.tick - rest.since > SECOND && session.typed_is_known &&
                          is_one_of(line, (const char *const[]){"layer", NULL}) && strstr(line, "off") == NULL;
    if (!session.typed_is_known || is_one_of(line, in_pause) || (rest.what == BREAK && is_one_of(line, after_break))) {
        rest_may_end();
    }
    if (strcmp(line, "break") == 0 || strcmp(line, "@break") == 0) {
        rest_break();
    }
}

/* In a pause, codes only come into force. Buttons 5 and 6 end it, as do the first eight buttons together, and
 * release in `hold`. */
void rest_remote(unsigned buttons)
{
    if (rest.what == PAUSE ? rest.may_hold || buttons >= 256 || buttons == 255 : buttons != 0) {
        rest_may_end();
    }
}

void rest_printed(const char *line)
{
    static const char *const ends[] = {"Servo ", "Ended", "Stopped", "Broken", "Nobody", "The computer", "The servo adapter",
                                       "Going to", "Playing", "Moving", NULL};
    unsigned page;
    if (sscanf(line, "Playing page %u", &page) == 1 || sscanf(line, "Page %u step", &page) == 1) {
        rest.page = page;
    }
    if (strncmp(line, "Paused", 6) == 0 && long_ago(rest.moved_tick, LINE_BEHIND)) {
        rest.what = PAUSE;
        rest.since = session.tick;
        reached("pause that comes to rest");
        return;
    }
    if (rest.is_layer_asked && (strcmp(line, " OK") == 0 || strcmp(line, "@layer OK") == 0)) {
        session_fail("a layer wants a page that plays", "one has begun in a pause");
    }
    rest.is_layer_asked = rest.is_layer_asked && strchr(line, ']') == line;
    if (rest.what == PAUSE && begins_with_one_of(line, ends)) {
        rest_may_end();
    }
}

static void look_at_start(unsigned id, int way)
{
    const bool was_at_rest = rest.changed_tick[id] < rest.resumed_tick;
    rest.changed_tick[id] = session.tick;
    if (!was_at_rest || session.tick - rest.resumed_tick > RESUMED || rest.is_shaped || session.has_deaf ||
        page_at(rest.page)[ACCEL_AT] == 0 || !rules_is_well()) {
        return;
    }
    reached("joint starts after a pause");
    if (way > FROM_REST) {
        session_fail("a joint starts from rest after a pause", "servo %u goes %d units in its first tick", id, way);
    }
}

/* Checks a goal of a joint that has had one before. */
void rest_goal(unsigned id, unsigned goal)
{
    const joint_t *joint = &session.joint[id];
    const int way = abs((int)goal - joint->goal);
    if (way != 0 && id < JOINTS && joint->goal_tick > session.boot_tick && rest.resumed_tick > session.boot_tick) {
        look_at_start(id, way);
    }
    if (rest.what == NOTHING || session.tick - rest.since <= SLOWED || !long_ago(session.late_tick, SLOWED) ||
        joint->goal_tick < session.boot_tick || (rest.what == PAUSE && !rules_is_well())) {
        return;
    }
    if (goal != joint->goal) {
        session_fail(rest.what == BREAK ? "a break comes to rest" : "a pause is at rest",
                     "servo %u from %u to %u, %u ticks after it", id, joint->goal, goal, session.tick - rest.since);
    }
}

void rest_boot(void)
{
    rest.what = NOTHING;
    rest.moved_tick = rest.line_tick = session.tick;
    rest.resumed_tick = NEVER_TICK;
    rest.is_shaped = false;
    rest.is_layer_asked = false;
}
