/* SPDX-License-Identifier: MIT
 * views.c - Play's lists of pages and servos, and the `@list` and `@now` of firmware/common/PROTOCOL.md. */
#include "session.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STILL SECOND
#define NOW_LATER 4u               /* ticks: the goals of this moment have been sent */
#define YIELDS 3                   /* units: a joint that holds may stand beside its goal */
#define TURNED 16u                 /* ticks after a line; before a play the servos are asked, and goals wait */
#define NOW_AGE 32u                /* ticks since they were sent, including the time on the line */
enum { STEPS_AT = 20, COUNT_AT = 15, CODE_AT = 21, NEXT_AT = 25, LINK1_AT = 27, LINK2_AT = 29 };

static struct {
    bool is_list, is_servos;       /* the requested list, until it is answered */
    unsigned listed;               /* last listed page */
    int goal_now[JOINTS];          /* by the newest @now */
    uint32_t now_tick;
} views;

/* ---- pages ---- */

static bool is_erased(unsigned page)
{
    const uint8_t *at = page_at(page);
    for (unsigned i = 0; i < PAGE_BYTES; i++) {
        if (at[i] != 0xFF) {
            return false;
        }
    }
    return true;
}

/* A page without name and steps counts as empty. */
static bool is_empty(unsigned page)
{
    return is_erased(page) || (page_is_good(page) && page_at(page)[0] == '\0' && page_at(page)[STEPS_AT] == 0);
}

static void wrong(const char *line, const char *right)
{
    session_fail("lists show what is so", "\"%.70s\", right is \"%.70s\"", line, right);
}

static void look_at_page(const char *line, unsigned page)
{
    char right[128];
    const uint8_t *at = page_at(page);
    for (unsigned passed = views.listed + 1; passed < page; passed++) {
        if (!is_empty(passed)) {
            snprintf(right, sizeof right, "page %u before it", passed);
            wrong(line, right);
        }
    }
    views.listed = page;
    if (strstr(line, "damaged") != NULL) {
        if (page_is_good(page)) {
            wrong(line, "a good page");
        }
        return;
    }
    int length = snprintf(right, sizeof right, "%3u %-13.13s steps %u x %u", page, (const char *)at, at[STEPS_AT],
                          at[COUNT_AT]);
    static const struct {
        const char *word;
        unsigned at;
    } fields[] = {{"code", CODE_AT}, {"next", NEXT_AT}, {"exit", NEXT_AT + 1}};
    for (unsigned i = 0; i < 3; i++) {
        if (at[fields[i].at] != 0) {
            length += snprintf(right + length, sizeof right - (size_t)length, " %s %u", fields[i].word, at[fields[i].at]);
        }
    }
    for (unsigned link = LINK1_AT; link <= LINK2_AT; link += 2) {
        if (at[link + 1] != 0) {
            length += snprintf(right + length, sizeof right - (size_t)length, " on code %u", at[link + 1]);
            if (at[link] != 0) {   /* 0: the play ends there */
                length += snprintf(right + length, sizeof right - (size_t)length, " to %u", at[link]);
            }
        }
    }
    if (!page_is_good(page) || is_empty(page) || strncmp(line, right, (size_t)length) != 0) {
        wrong(line, right);
    }
    reached("list of pages");
}

/* Checks ` number:steps:"name"` or ` number:!:"what is wrong"` for each page that is not empty. */
void views_list(const char *answer, int first, int last)
{
    const char *at = answer + strlen("@list");
    char right[64];
    for (int page = first; page <= last; page++) {
        if (is_empty((unsigned)page)) {
            continue;
        }
        const uint8_t *of = page_at((unsigned)page);
        const bool is_good = page_is_good((unsigned)page);
        int length = is_good ? snprintf(right, sizeof right, " %d:%u:\"%.13s\"", page, of[STEPS_AT], (const char *)of)
                             : snprintf(right, sizeof right, " %d:!:\"", page);
        if (strncmp(at, right, (size_t)length) != 0) {
            wrong(at, right);
        }
        at += length;
        at += is_good ? 0 : strcspn(at, "\"") + 1;
    }
    if (strcmp(at, " OK") != 0) {
        wrong(at, " OK");
    }
    reached("pages listed by a request");
}

/* ---- servos, goals ---- */

static void look_at_servo(const char *line)
{
    unsigned id, position;
    char on[4];
    if (sscanf(line, "%u position %u torque %3s", &id, &position, on) != 3 || !rules_is_well() ||
        session.tick - session.goals_tick < STILL || session.tick - session.pushed_tick < 2 * STILL) {
        return;
    }
    const servo_t *servo = id < JOINTS ? session.joint[id].servo : NULL;
    if (servo == NULL || abs(to_page(id, servo->position) - (int)position) > 3 ||
        (servo->table[TORQUE_AT] != 0) != (on[1] == 'n')) {
        wrong(line, servo == NULL ? "no such servo" : "another position or torque");
    }
    reached("list of servos");
}

/* Checks `@now 5 2 0007FFFE`, followed by six digits for each present servo: goal and position. */
static void look_at_now(const char *line)
{
    unsigned page, step, there;
    int at = 0;
    if (sscanf(line, "@now %u %u %8x %n", &page, &step, &there, &at) != 3 || at == 0) {
        return;
    }
    for (unsigned id = 0; id < JOINTS; id++) {
        views.goal_now[id] = UNKNOWN;
    }
    views.now_tick = session.tick;
    for (unsigned id = 0; id < JOINTS; id++) {
        const joint_t *joint = &session.joint[id];
        char goal[4] = "", position[4] = "";
        if ((there >> id & 1u) == 0) {
            if (joint->is_known && rules_is_well() && session.tick - session.boot_tick > 4 * SECOND) {
                wrong(line, "a servo more");
            }
            continue;
        }
        memcpy(goal, line + at, 3);
        memcpy(position, line + at + 3, 3);
        at += 6;
        if (joint->servo == NULL) {
            wrong(line, "no such servo");
        }
        const bool is_driven = joint->goal_tick > session.boot_tick && session.tick - joint->goal_tick <= 2 &&
                               session.tick - session.typed_tick > TURNED;
        if (goal[0] != '-' && !session.is_edit && is_driven && !session.has_deaf) {
            views.goal_now[id] = (int)strtoul(goal, NULL, 16);
        }
        if (position[0] != '-' && rules_is_well() && session.tick - session.goals_tick > 2 * STILL &&
            session.tick - session.pushed_tick > 2 * STILL &&
            abs((int)strtoul(position, NULL, 16) - to_page(id, joint->servo->position)) > 3) {
            wrong(line, "another position");
        }
    }
    if (line[at] != '\0') {
        wrong(line, "fewer servos");
    }
    reached("goals and positions by @watch");
}

/* Torque is switched on by a WRITE to one joint of the goal that it has. The law does not see that, and the program
 * takes the position of a joint that it does not drive for its goal. */
static bool has_goal(unsigned id)
{
    const uint8_t *goal = &session.joint[id].servo->table[GOAL_AT];
    return abs(to_page(id, goal[0] | goal[1] << 8) - views.goal_now[id]) <= YIELDS;
}

/* What a servo gets of a shown goal: a trim can put that out of its reach. */
static int sent_of(unsigned id)
{
    return limited(views.goal_now[id] + trim_of(id)) - trim_of(id);
}

/* The shown goals have been sent, or are sent in the next ticks. */
static void look_at_goals(void)
{
    for (unsigned id = 0; id < JOINTS; id++) {
        if (views.goal_now[id] != UNKNOWN && !law_was_goal(id, views.goal_now[id], NOW_AGE) &&
            !law_was_goal(id, sent_of(id), NOW_AGE) && !has_goal(id)) {
            session_fail("goals are shown as they are sent", "servo %u: %d", id, views.goal_now[id]);
        }
    }
    views.now_tick = NEVER_TICK;
}

/* ---- events ---- */

void views_typed(const char *line)
{
    views.is_list = strcmp(line, "list") == 0;
    views.is_servos = strcmp(line, "servos") == 0;
    views.listed = 0;
}

void views_printed(const char *line)
{
    unsigned page;
    if (strncmp(line, "Going to", 8) == 0) {
        views.now_tick = NEVER_TICK;   /* law.c begins anew and has no goals of before */
    } else if (strncmp(line, "@now ", 5) == 0) {
        look_at_now(line);
    } else if (strcmp(line, " OK") == 0) {
        views.is_list = views.is_servos = false;
    } else if (views.is_list && sscanf(line, "%3u ", &page) == 1 && line[3] == ' ' && page < PAGES &&
               (strstr(line, " steps ") != NULL || strstr(line, " damaged: ") != NULL)) {
        look_at_page(line, page);
    } else if (views.is_servos) {
        look_at_servo(line);
    }
}

void views_tick(void)
{
    if (views.now_tick != NEVER_TICK && session.tick - views.now_tick > NOW_LATER) {
        look_at_goals();
    }
}

void views_boot(void)
{
    views.is_list = views.is_servos = false;
    views.now_tick = NEVER_TICK;
}
