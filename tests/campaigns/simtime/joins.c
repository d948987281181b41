/* SPDX-License-Identifier: MIT
 * joins.c - how fast a joint goes over to a layer, by motion/mux.h: toward the goals of the layer at the speed of the
 * approach at most, until it meets them. Judges joints that stood still and that the layer's first step leads far away
 * while it is looked at. */
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STOOD 64u                  /* ticks with the same goal */
#define FAR 100                    /* units: not met while it is looked at */
#define LOOKED 30u                 /* ticks after the line */
#define ANSWERED 10u               /* ticks until the layer's answer */
#define BEFORE (4u * SECOND)       /* a setting or a code has its effect by then */
enum { COUNT_AT = 15, SCHEDULE_AT = 16, STEPS_AT = 20, SPEED_AT = 22, TIME_BASE = 10 };

static struct {
    bool is_shaped;                /* something else may change the speed */
    uint32_t changed_tick;         /* the last change of goal, of any setting or code */
    uint32_t still_since[JOINTS];
    uint32_t typed_tick;           /* of the layer; NEVER_TICK: none */
    bool is_on;                    /* it has been answered */
    uint32_t joints;               /* that are judged */
    int most;                      /* units a tick */
} joins;

static bool is_led_away(unsigned page, unsigned id)
{
    const uint8_t *at = page_at(page), *word = at + STEP_BYTES + 2 * id;
    const int to = word[0] | word[1] << 8;
    const unsigned ticks = (unsigned)at[2 * STEP_BYTES - 1] * at[SPEED_AT] / 32;   /* motion/LAWS.md, time base */
    const bool plays = page_is_good(page) && at[COUNT_AT] != 0 && at[STEPS_AT] != 0 && at[SCHEDULE_AT] == TIME_BASE &&
                       ticks > LOOKED;
    return plays && to < 1024 && abs(to + trim_of(id) - session.joint[id].goal) > FAR;
}

static void layer_typed(unsigned page, const char *words)
{
    joins.joints = 0;
    joins.most = kept_value("approach") * 1024 / 300 / (int)SECOND + 1;
    const uint32_t named = joints_named(words);
    for (unsigned id = 0; id < JOINTS; id++) {
        const bool stood = session.joint[id].servo != NULL && session.tick - joins.still_since[id] > STOOD;
        if ((named >> id & 1u) != 0 && stood && is_led_away(page, id)) {
            joins.joints |= 1u << id;
        }
    }
    joins.typed_tick = session.tick;
}

void joins_typed(const char *line)
{
    static const char *const shapes[] = {"rate", "amplitude", "blend", "drive", "aim", "swing", NULL};
    unsigned page;
    int at = 0;
    joins.typed_tick = NEVER_TICK;
    joins.is_on = false;
    line += *line == '@' ? 1 : 0;
    joins.is_shaped = strcmp(line, "shape reset") != 0 &&
                      (joins.is_shaped || !session.typed_is_known || begins_with_one_of(line, shapes));
    if (strncmp(line, "settings", 8) == 0) {
        joins.changed_tick = session.tick;
    } else if (sscanf(line, "layer %u%n", &page, &at) == 1 && page < PAGES && long_ago(joins.changed_tick, BEFORE)) {
        layer_typed(page, line + at);
    }
}

void joins_pressed(void)
{
    joins.changed_tick = session.tick;
}

void joins_printed(const char *line)
{
    if (joins.typed_tick == NEVER_TICK || joins.is_on || line[0] == ']') {
        return;
    }
    joins.is_on = strcmp(line, " OK") == 0 && session.tick - joins.typed_tick <= ANSWERED;
    joins.typed_tick = joins.is_on ? joins.typed_tick : NEVER_TICK;
}

/* Handles a goal of a joint before it is noted. */
void joins_goal(unsigned id, unsigned goal)
{
    const joint_t *joint = &session.joint[id];
    const int way = abs((int)goal - joint->goal);
    if (way == 0 || id >= JOINTS) {
        return;
    }
    joins.still_since[id] = session.tick;
    if (!joins.is_on || (joins.joints >> id & 1u) == 0 || session.tick - joins.typed_tick > LOOKED || joins.is_shaped ||
        session.has_deaf || !rules_is_well() || !long_ago(session.late_tick, BEFORE)) {
        return;
    }
    reached("joint on its way to a layer");
    if (way > joins.most * (int)(session.tick - joint->goal_tick)) {
        session_fail("a joint goes over to a layer slowly", "servo %u from %u to %u, and %d units a tick are right", id,
                     joint->goal, goal, joins.most);
    }
}

void joins_boot(void)
{
    memset(&joins, 0, sizeof joins);
    joins.changed_tick = session.tick;
}
