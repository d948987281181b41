/* SPDX-License-Identifier: MIT
 * performer_ready.c - the state READY: pose, torque, the plan of the approach. */
#include "performer_ready.h"

#include "performer_shape.h"

void performer_get_ready(performer_t *performer)
{
    performer->ready_left = performer_usable(performer);
    performer->joints = 0;
    performer->faulty = 0;
    performer->leaving = false;
    performer->battery_reported = false;
    performer->heat_reported = false;
    performer->end_reason = PERFORMER_END_DONE;
    performer->state = PERFORMER_READY;
}

/* Switches torque on in one call and reads the pose in the next: at most 5 ms each. Sets full moving speed, because goals
 * come a tick apart and Edit may have set a slow one. */
static performer_ready_t ask_one_joint(performer_t *performer)
{
    servo_link_t *servos = performer->servos;
    const uint8_t id = servo_link_lowest(&performer->ready_left);
    const uint32_t joint = servo_link_bit(id);
    bool is_there = (performer_layers_joints(performer) & joint) != 0; /* a layer moves it: its goal is its place */
    if (!is_there && !servo_link_has(&servos->torque, id)) {
        if (servo_link_torque_on(servos, joint) != 0) {
            return READY_ASKING;
        }
    } else if (!is_there && servo_link_read_pose(servos, joint) != 0 && servo_link_full_speed(servos, joint) != 0) {
        performer->goal_pos[id] = servos->present_pos[id];
        is_there = true;
    }
    servo_link_put(&performer->ready_left, id, false);
    if (is_there) {
        servo_link_put(&performer->joints, id, true);
        return READY_ASKING;
    }
    servo_link_put(&performer->faulty, id, true);
    performer_event_put(&performer->events, PERFORMER_EV_SILENT, id, 0, 0);
    return performer->settings->fault_rule == SETTINGS_FAULT_LIMP ? READY_ASKING : READY_SILENT;
}

/* Puts the target of the approach into next_pos: the positions of the first step. (The pose of a move is there already.)
 * Returns the joints that have one. */
static uint32_t take_first_pose(performer_t *performer)
{
    uint16_t *to_pos = performer->player.next_pos;
    uint32_t joints = performer->move_joints;
    if (performer->move_deg_s == 0) {
        joints = player_first_pose(performer->source, &performer->shape, performer->first_page, to_pos);
    }
    return joints & performer->joints & ~performer_layers_joints(performer);
}

static performer_ready_t plan_approach(performer_t *performer)
{
    const uint16_t limit_deg_s = performer->move_deg_s != 0 ? performer->move_deg_s
                                                            : performer->settings->approach_deg_s;
    if (limit_deg_s == 0) {
        return READY_THERE;
    }
    const uint32_t joints = take_first_pose(performer);
    const uint16_t ticks = player_move(&performer->player, performer->goal_pos, joints, limit_deg_s);
    if (ticks == 0) {
        return READY_THERE;
    }
    const uint16_t seconds = (uint16_t)((ticks + PLAYER_TICKS_PER_SECOND - 1) / PLAYER_TICKS_PER_SECOND);
    performer_event_put(&performer->events, PERFORMER_EV_APPROACH, performer->page,
                        (uint8_t)(seconds > UINT8_MAX ? UINT8_MAX : seconds), 0);
    return READY_APPROACH;
}

performer_ready_t performer_ready_poll(performer_t *performer)
{
    if (performer->ready_left != 0) {
        return ask_one_joint(performer);
    }
    return performer->joints == 0 ? READY_SILENT : plan_approach(performer);
}
