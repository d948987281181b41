/* SPDX-License-Identifier: MIT
 * requests_state.c - requests about the present state of the robot: pose, where, watch. */
#include "requests_parts.h"

#include "performer_shape.h"
#include "text.h"
#include "tick.h"

#define WATCH_TICKS_MIN 6u   /* 47 ms; a @now line of 31 joints takes 37 ms */

static struct {
    uint16_t every_ticks;    /* 0: nobody watches */
    uint16_t last_tick;
} watch;

/* Prints id:position:torque for each joint, position "?" if the servo does not answer. */
uint8_t request_pose(void *context, const shell_args_t *args)
{
    const servo_link_t *servos = requests_image.servos;
    (void)context;
    (void)args;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (!servo_link_has(&servos->present, id)) {
            continue;
        }
        text_put(' ');
        text_number(id);
        text_put(':');
        if (servo_link_has(&servos->silent, id) || servos->present_pos[id] == SERVO_LINK_NO_POSE) {
            text_put('?');
        } else {
            text_number(servos->present_pos[id]);
        }
        text_put(':');
        text_put(servo_link_has(&servos->torque, id) ? '1' : '0');
    }
    return REQUEST_OK;
}

static void print_state_name(const performer_t *performer)
{
    TEXT_NAMED(idle, "idle");
    TEXT_NAMED(ready, "ready");
    TEXT_NAMED(approach, "approach");
    TEXT_NAMED(paused, "paused");
    TEXT_NAMED(playing, "playing");
    static const char *const names[] PROGMEM = {
        [PERFORMER_IDLE] = idle, [PERFORMER_READY] = ready, [PERFORMER_APPROACH] = approach,
        [PERFORMER_APPROACH_PAUSED] = paused, [PERFORMER_PLAY] = playing,
    };
    text_P(performer_is_paused(performer) ? paused : (const char *)pgm_read_ptr(&names[performer->state]));
}

uint8_t request_where(void *context, const shell_args_t *args)
{
    const performer_t *performer = requests_image.performer;
    const bool plays = performer->state == PERFORMER_PLAY;
    (void)context;
    (void)args;
    TEXT(" state=");
    print_state_name(performer);
    text_P_number(TEXT_P(" page="), performer_is_idle(performer) ? 0 : performer->page);
    text_P_number(TEXT_P(" step="), plays ? performer->engine.player.step : 0);
    text_P_number(TEXT_P(" repetition="), plays ? performer->engine.player.repetition : 0);
    text_P_number(TEXT_P(" code="), plays ? performer->link.code : 0);
    text_P_number(TEXT_P(" dv="), requests_image.servos->voltage_dv);
    text_P_number(TEXT_P(" missed="), tick_missed());
    TEXT(" faulty=");
    text_mask(performer->faulty);
    if (requests_image.where != NULL) {
        requests_image.where();
    }
    return REQUEST_OK;
}

/* ---- @watch ---- */

uint8_t request_watch(void *context, const shell_args_t *args)
{
    const uint16_t ticks = (uint16_t)((uint32_t)args->number[0] * TICK_HZ / 1000u);
    (void)context;
    watch.every_ticks = ticks != 0 && ticks < WATCH_TICKS_MIN ? WATCH_TICKS_MIN : ticks;
    watch.last_tick = tick_now16();
    return REQUEST_OK;
}

void requests_end_watch(void)
{
    watch.every_ticks = 0;
}

bool requests_now_is_due(void)
{
    return watch.every_ticks != 0 && (uint16_t)(tick_now16() - watch.last_tick) >= watch.every_ticks;
}

/* The joints that a play, a move or a layer gives goals. */
static uint32_t joints_with_goals(const performer_t *performer)
{
    const uint32_t of_play = performer->state > PERFORMER_READY ? performer->joints : 0;
    return of_play | performer_layers_joints(performer);
}

/* NOINLINE: it would be copied twice. */
static NOINLINE void print_pos(bool known, uint16_t pos)
{
    if (known) {
        text_hex(pos, 3);
    } else {
        TEXT("---");
    }
}

void requests_print_now(void)
{
    const performer_t *performer = requests_image.performer;
    const servo_link_t *servos = requests_image.servos;
    const uint32_t with_goals = joints_with_goals(performer);
    watch.last_tick = tick_now16();
    text_P_number(TEXT_P("@now "), performer_is_idle(performer) ? 0 : performer->page);
    text_put(' ');
    text_number(performer->state == PERFORMER_PLAY ? performer->engine.player.step : 0);
    text_put(' ');
    text_mask(servos->present);
    text_put(' ');
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&servos->present, id)) {
            const uint16_t present_pos = servos->present_pos[id];
            print_pos(servo_link_has(&with_goals, id), performer->goal_pos[id]);
            print_pos(!servo_link_has(&servos->silent, id) && present_pos != SERVO_LINK_NO_POSE, present_pos);
        }
    }
    text_line_end();
}
