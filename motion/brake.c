/* SPDX-License-Identifier: MIT
 * brake.c - break and pause: from whatever speed a joint has to a stand, at a constant deceleration. */
#include "fix.h"
#include "law.h"

static void stand_at_goal(const player_t *player, player_joint_t *joint, int32_t speed)
{
    uint16_t pos = player->goal_pos[joint - player->joint];
    joint->exact.pos_q16_16 = fix_from_pos(pos) + (speed < 0 ? FIX_ROUND_DOWN : FIX_ROUND_UP);
    joint->exact.speed_q16_16 = speed;
    joint->exact.accel_q16_16 = 0;
}

void exact_freeze(player_t *player)
{
    bool between = player->law == PLAYER_LAW_EXACT && player->primed, pausing = player->tick >= player->step_ticks;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int32_t speed = joint->exact.speed_q16_16;
        if (between) { /* speed is a size there */
            bool down = joint->target_pos < player->goal_pos[joint - player->joint];
            stand_at_goal(player, joint, down ? -speed : speed);
        } else if (pausing) {
            stand_at_goal(player, joint, 0);
        } else { /* speed is that of the coming tick: half an acceleration further on */
            joint->exact.speed_q16_16 = speed - joint->exact.accel_q16_16 / 2;
        }
    }
}

void brake_start(player_t *player)
{
    player->brake_ticks = law_brake_ticks(player);
    uint16_t recip = fix_ramp_recip(player->brake_ticks);
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int32_t speed = joint->exact.speed_q16_16;
        bool down = speed < 0;
        int32_t accel = -(int32_t)fix_by_ramp((uint32_t)(down ? -speed : speed), recip, player->brake_ticks);
        if (down) {
            accel = -accel;
        }
        joint->exact.accel_q16_16 = accel;
        joint->exact.speed_q16_16 = speed + accel / 2;
    }
}

/* A joint that reaches an end of its range while slowing down stands there. */
static void keep_in_range(player_joint_t *joint)
{
    int32_t pos = joint->exact.pos_q16_16 + joint->exact.speed_q16_16;
    if (pos < 0 || pos >= (int32_t)(PAGE_POS_MAX + 1) << FIX_POS_BITS) {
        joint->exact.speed_q16_16 = joint->exact.accel_q16_16 = 0;
        joint->exact.pos_q16_16 = pos < 0 ? 0 : (int32_t)PAGE_POS_MAX << FIX_POS_BITS;
    }
}

bool brake_tick(player_t *player)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        keep_in_range(joint);
    }
    exact_move(player);
    return --player->brake_ticks != 0;
}
