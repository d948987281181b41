/* SPDX-License-Identifier: MIT
 * performer_ready.c - between "play this" and the first goal: pose, torque, approach; the player is bound here. */
#include "performer_parts.h"

#include <string.h>
#include "bound.h"

static player_law_t law(const performer_t *performer)
{
    return PERFORMER_SETTINGS(performer)->law == PLAYER_LAW_CLASSIC ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT;
}

/* Binds the player anew and starts it at `page` from pose_pos. */
player_status_t performer_start_player(performer_t *performer, uint8_t page, uint32_t joints)
{
    player_t *player = &performer->engine.player;
    player_init(player, performer->source);
    return player_start(player, &performer->link, page, law(performer), performer->pose_pos, joints);
}

/* ---- READY: pose and torque, one joint a call ---- */

static uint8_t lowest_joint(uint32_t joints)
{
    uint8_t id = 0;
    while ((joints & 1u) == 0) {
        joints >>= 1;
        id++;
    }
    return id;
}

/* Torque on in one call, pose in the next: at most 5 ms each. The editor leaves slow moving speeds behind; goals a tick
 * apart need the servos' full one. */
static void ask_one_joint(performer_t *performer)
{
    servo_link_t *servos = PERFORMER_SERVOS(performer);
    const uint8_t id = lowest_joint(performer->ready_left);
    const uint32_t joint = servo_link_bit(id);
    if ((servos->torque & joint) == 0) {
        if (servo_link_torque_on(servos, joint) != 0) {
            return;
        }
    } else if (servo_link_read_pose(servos, joint) != 0) {
        servo_link_full_speed(servos, joint);
        performer->ready_left &= ~joint;
        performer->joints |= joint;
        performer->pose_pos[id] = servos->present_pos[id];
        return;
    }
    performer->ready_left &= ~joint;
    performer->faulty |= joint;
    performer_tell(performer, PERFORMER_EV_SILENT, id, 0, 0);
    if (PERFORMER_SETTINGS(performer)->fault_rule != SETTINGS_FAULT_LIMP) {
        performer_finish(performer, PERFORMER_END_SERVO);
    }
}

void performer_begin_page(performer_t *performer)
{
    performer->state = PERFORMER_PLAY;
    performer->slopes_due = false;
    if (performer_start_player(performer, performer->page, performer->joints) != PLAYER_OK) {
        performer_finish(performer, PERFORMER_END_PAGE);
    }
}

/* Where the approach leads: the first step's positions, or the pose of a move. Returns the joints it concerns. */
static uint32_t first_pose(const performer_t *performer, uint16_t to_pos[PAGE_JOINTS])
{
    if (performer->move_deg_s != 0) {
        memcpy(to_pos, performer->engine.approach.target_pos, sizeof performer->engine.approach.target_pos);
        return performer->move_joints & performer->joints;
    }
    memcpy(to_pos, performer->pose_pos, sizeof performer->pose_pos);
    return player_first_pose(performer->source, performer->first_page, to_pos) & performer->joints;
}

static void begin_approach(performer_t *performer)
{
    if (performer->joints == 0) {
        performer_finish(performer, PERFORMER_END_SERVO);
        return;
    }
    uint16_t to_pos[PAGE_JOINTS];
    const uint32_t joints = first_pose(performer, to_pos);
    const uint16_t limit_deg_s = performer->move_deg_s != 0 ? performer->move_deg_s
                                                            : PERFORMER_SETTINGS(performer)->approach_deg_s;
    uint16_t ticks = 0;
    if (limit_deg_s != 0) {
        ticks = approach_start(&performer->engine.approach, performer->pose_pos, to_pos, joints, limit_deg_s);
    }
    if (ticks > 0) {
        const uint16_t seconds = (uint16_t)((ticks + PLAYER_TICKS_PER_SECOND - 1) / PLAYER_TICKS_PER_SECOND);
        performer->state = PERFORMER_APPROACH;
        performer_tell(performer, PERFORMER_EV_APPROACH, performer->page,
                       (uint8_t)(seconds > UINT8_MAX ? UINT8_MAX : seconds), 0);
    } else if (performer->move_deg_s != 0) {
        performer_finish(performer, PERFORMER_END_THERE);
    } else {
        performer_begin_page(performer);
    }
}

void performer_ready_poll(performer_t *performer)
{
    if (performer->leaving) {
        performer_finish(performer, performer->end);
    } else if (performer->ready_left != 0) {
        ask_one_joint(performer);
    } else {
        begin_approach(performer);
    }
}
