/* SPDX-License-Identifier: MIT
 * slopes.c - the softness of a joint in a play. Its slope registers are those of the page that plays, or of the
 * layer's page for joints of a layer (motion/PAGE_FORMAT.md bytes 32 to 62, hal/DYNAMIXEL.md, and the headers
 * servo_link.h and performer_shape.h in firmware/common). This also holds after a fault, a loss of power or a
 * search. */
#include "session.h"

#include <stdio.h>
#include <string.h>

#include "servo_fault.h"

#define SETTLED 16u                /* ticks from the line that names a page until its slopes are set */
#define WRONG_MOST 48u             /* goals: the line of the next page may be late; polling 31 servos takes 31 ticks */
#define PAGE_CHAIN 16u             /* pages that a layer plays in a chain */
enum { CW_SLOPE_AT = 28, CCW_SLOPE_AT = 29, COMPLIANCE_AT = 32, NEXT_AT = 25 };

static struct {
    unsigned page;                 /* the page that plays; 0: none or unknown */
    uint32_t page_tick;            /* since when it plays */
    bool is_lost;                  /* unknown requests were possible, or lines are missing, until this play ends */
    unsigned layer;                /* first page of the layer; 0: none */
    uint32_t layer_joints;
    bool is_layer_sure;            /* false: joints may or may not be the layer's */
    bool is_asked;                 /* the newest line, not yet answered, requests another layer or none */
    unsigned asked_layer;
    uint32_t asked_joints;
    uint32_t code_joints;          /* possibly moved by code: they leave a layer */
    unsigned wrong[JOINTS];        /* goals in a row with wrong slopes */
    uint32_t goal_tick[JOINTS];    /* of the last goal that was checked */
} slopes;

static uint32_t bit(unsigned id)
{
    return (uint32_t)1 << id;
}

/* Returns whether the servo has the slopes of the page. A nibble outside of the page format allows any. */
static bool has_slopes(unsigned id, unsigned page)
{
    const uint8_t byte = page_at(page)[COMPLIANCE_AT + id], *table = session.joint[id].servo->table;
    const unsigned cw = byte >> 4, ccw = byte & 15u;
    const bool has_cw = cw == 0 || cw > 7 || table[CW_SLOPE_AT] == 1u << cw;
    return has_cw && (ccw == 0 || ccw > 7 || table[CCW_SLOPE_AT] == 1u << ccw);
}

/* The same for a layer. It follows its own links and does not report its page. */
static bool has_slopes_of_layer(unsigned id)
{
    unsigned page = slopes.layer;
    for (unsigned i = 0; i < PAGE_CHAIN && page != 0; i++, page = page_at(page)[NEXT_AT]) {
        if (has_slopes(id, page)) {
            return true;
        }
    }
    return page != 0;
}

static bool is_right(unsigned id)
{
    const bool may_be_of_layer = slopes.layer != 0 && (slopes.layer_joints & bit(id)) != 0;
    if (may_be_of_layer && has_slopes_of_layer(id)) {
        reached("slopes of a layer");
        return true;
    }
    const bool is_of_layer = may_be_of_layer && slopes.is_layer_sure && (slopes.code_joints & bit(id)) == 0;
    return !is_of_layer && has_slopes(id, slopes.page);
}

/* A servo that has not answered yet does not receive. */
static bool hears(unsigned id)
{
    const servo_t *servo = session.joint[id].servo;
    return !servo_fault_is_on(servo, SERVO_FAULT_MISHEARS) && !servo_fault_is_on(servo, SERVO_FAULT_LATE) &&
           !servo_fault_is_on(servo, SERVO_FAULT_DEAD) && long_ago(session.late_tick, SECOND);
}

static void look_at(unsigned id)
{
    const joint_t *joint = &session.joint[id];
    if (joint->is_deaf && joint->fault_tick > session.boot_tick) {
        return;   /* the search may not have noticed that it is deaf: it asks a servo once */
    }
    const bool has_new_goal = joint->goal_tick > slopes.goal_tick[id] && joint->goal_tick > slopes.page_tick + SETTLED;
    if (slopes.page == 0 || !hears(id) || is_right(id)) {
        slopes.wrong[id] = 0;
    } else if (has_new_goal && ++slopes.wrong[id] > WRONG_MOST) {
        const uint8_t *table = joint->servo->table;
        session_fail("a joint that plays is as soft as its page says", "servo %u has %u %u, page %u says %02x, layer %u", id,
                     table[CW_SLOPE_AT], table[CCW_SLOPE_AT], slopes.page, page_at(slopes.page)[COMPLIANCE_AT + id],
                     slopes.layer);
    } else if (has_new_goal) {
        reached("slopes on their way");
    }
    slopes.goal_tick[id] = joint->goal_tick;
}

void slopes_tick(void)
{
    for (unsigned id = 0; id < JOINTS && !session.is_edit; id++) {
        if (session.joint[id].servo != NULL) {
            look_at(id);
        }
    }
}

/* ---- plays and layers ---- */

static void plays(unsigned page)
{
    if (page != slopes.page) {
        slopes.page_tick = session.tick;
    }
    slopes.page = page < PAGES ? page : 0;
}

static uint32_t joints_of_first_step(unsigned page)
{
    const uint8_t *at = page_at(page) + STEP_BYTES;
    uint32_t joints = 0;
    for (unsigned id = 0; id < JOINTS; id++) {
        joints |= (at[2 * id] | (unsigned)at[2 * id + 1] << 8) < 1024 ? bit(id) : 0;
    }
    return joints;
}

static void asks_for_layer(unsigned page, uint32_t joints)
{
    slopes.is_asked = !rules_is_searching();   /* typed ahead of the prompt: the next answer is another line's */
    slopes.asked_layer = page;
    slopes.asked_joints = joints;
    slopes.is_layer_sure = false;
    if (slopes.layer == 0) {   /* the layer may begin before the answer */
        slopes.layer = page;
        slopes.layer_joints = joints;
    }
}

void slopes_typed(const char *line)
{
    unsigned id, page;
    int at = 0;
    line += *line == '@' ? 1 : 0;
    slopes.is_asked = false;
    if (!session.typed_is_known || strncmp(line, "settings talk", 13) == 0) {
        plays(0);
        slopes.is_lost = true;
    } else if (strncmp(line, "layer off", 9) == 0) {
        asks_for_layer(0, 0);
    } else if (sscanf(line, "layer %u%n", &page, &at) == 1 && page < PAGES) {
        const uint32_t joints = joints_named(line + at);
        asks_for_layer(page, joints != 0 ? joints : joints_of_first_step(page));
    } else if (sscanf(line, "aim %u", &id) == 1 || sscanf(line, "swing %u", &id) == 1) {
        slopes.code_joints |= id < JOINTS ? bit(id) : 0;
    }
}

static void answered(void)
{
    if (slopes.is_asked) {
        slopes.layer = slopes.asked_layer;
        slopes.layer_joints = slopes.asked_joints;
        slopes.is_layer_sure = true;
    }
    slopes.is_asked = false;
}

void slopes_printed(const char *line)
{
    static const char *const other[] = {"Going to", "Moving", "Ended", "Stopped", "Broken", NULL};   /* no page plays */
    unsigned number;
    const char *step = strstr(line, " step ");
    if ((sscanf(line, "Playing page %u", &number) == 1 || sscanf(line, "Page %u step", &number) == 1) && step != NULL) {
        plays(slopes.is_lost ? 0 : number);
    } else if (begins_with_one_of(line, other) || strstr(line, "dropped") != NULL) {
        plays(0);
        slopes.is_lost = strstr(line, "dropped") != NULL;
        slopes.layer = slopes.layer_joints = 0;
    } else if (strncmp(line, "The layer ended", 15) == 0) {
        slopes.layer = slopes.layer_joints = 0;
    } else if (strcmp(line, " OK") == 0) {
        answered();
    } else if (strncmp(line, "Servo ", 6) == 0) {
        slopes.is_layer_sure = false;   /* it may have left the layer */
    }
}

void slopes_boot(void)
{
    memset(&slopes, 0, sizeof slopes);
}
